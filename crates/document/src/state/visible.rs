//! What a view shows instead of a mesh of the document's scene: the mesh without its hidden elements, or what
//! its modifiers make of it. Here is also which edges have marks, computed once after a change of marks, and the
//! changes that keep a copy of the scene equal to it.
//!
//! The document's scene always has the mesh with all elements, so that saved files are complete; a displayed copy
//! gets another mesh.

use trigon_mesh::{Mesh, MeshChange};
use trigon_modelling::{ChangedValues, EdgeId, EditMesh, ElementMap, ElementNumbers, Evaluation};
use trigon_scene::{MeshId, Scene};

/// What a copy of the scene shows of a mesh.
#[derive(Debug)]
pub(crate) struct VisibleMesh {
    pub(crate) sight: Sight,
    pub(crate) map: ElementMap,
    pub(crate) numbers: ElementNumbers,
    /// The surface that the copy has; changes are found by comparing with it.
    pub(crate) surface: Option<Mesh>,
    /// Changes that the copy has not received.
    pub(crate) values: ChangedValues,
    /// Whether the visible elements have changed since.
    pub(crate) is_outdated: bool,
}

/// How a mesh is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sight {
    /// As the scene has it.
    Whole,
    /// Without what is hidden.
    Part,
    /// As its modifiers make it.
    Surface,
    /// The same with the mesh over it as its cage, without what is hidden.
    Cage,
}

impl Sight {
    pub(crate) fn of(evaluation: &Evaluation, is_edited: bool, has_hidden: bool) -> Self {
        match (evaluation.changes_mesh(), is_edited) {
            (false, true) if has_hidden => Self::Part,
            (false, _) => Self::Whole,
            (true, true) => Self::Cage,
            (true, false) => Self::Surface,
        }
    }

    /// What a copy shows of a mesh, which the evaluation belongs to.
    pub(crate) fn mesh(self, edited: &EditMesh, evaluation: &Evaluation) -> (Mesh, ElementMap) {
        let evaluated = match self {
            Self::Whole => None,
            Self::Part => return edited.to_visible_mesh(),
            Self::Surface => evaluation.to_mesh().map(|mesh| (mesh, ElementMap::default())),
            Self::Cage => evaluation.to_mesh_with_cage(edited),
        };
        // The sight is that of the evaluation; while a drag makes all modifiers impossible, the mesh itself is shown.
        evaluated.unwrap_or_else(|| edited.to_mesh())
    }
}

impl VisibleMesh {
    pub(crate) fn new(sight: Sight, edited: &EditMesh, evaluation: &Evaluation) -> (Self, Mesh) {
        let (mesh, map) = sight.mesh(edited, evaluation);
        let numbers = ElementNumbers::new(edited, &mesh, &map);
        let surface = matches!(sight, Sight::Surface | Sight::Cage).then(|| mesh.clone());
        let values = ChangedValues::default();
        (Self { sight, map, numbers, surface, values, is_outdated: false }, mesh)
    }

    /// The change of a mesh that the copy has not received.
    pub(crate) fn take(
        &mut self,
        id: MeshId,
        edited: &EditMesh,
        evaluation: &Evaluation,
    ) -> Option<SceneChange> {
        let values = std::mem::take(&mut self.values);
        if values.is_empty() {
            return None;
        }
        let Some(surface) = &mut self.surface else {
            return Some(SceneChange::Values(id, edited.mesh_change(&values, &self.numbers)));
        };
        let (mesh, map) = self.sight.mesh(edited, evaluation);
        let change = MeshChange::between(surface, &mesh);
        *surface = mesh;
        if map != self.map {
            // A vertex that moves may make modifiers join, cut or remove other elements.
            self.numbers = ElementNumbers::new(edited, surface, &map);
            self.map = map;
        }
        Some(match change {
            Some(change) => SceneChange::Values(id, change),
            None => SceneChange::Visible(id, Box::new(surface.clone())),
        })
    }
}

/// The marks of a mesh.
#[derive(Debug)]
pub(crate) struct MarkedElements {
    pub(crate) sharp: Vec<EdgeId>,
    pub(crate) seams: Vec<EdgeId>,
    pub(crate) creases: Vec<EdgeId>,
    /// Whether any vertex, edge or face is hidden.
    pub(crate) has_hidden: bool,
}

impl MarkedElements {
    pub(crate) const NONE: Self =
        Self { sharp: Vec::new(), seams: Vec::new(), creases: Vec::new(), has_hidden: false };

    /// Takes time proportional to the mesh.
    pub(crate) fn of(mesh: &EditMesh) -> Self {
        let mut marked = Self::NONE;
        for edge in mesh.edges() {
            if mesh.is_sharp(edge) {
                marked.sharp.push(edge);
            }
            if mesh.is_seam(edge) {
                marked.seams.push(edge);
            }
            if mesh.crease(edge) > 0.0 {
                marked.creases.push(edge);
            }
        }
        marked.has_hidden = mesh.vertices().any(|vertex| mesh.is_vertex_hidden(vertex))
            || mesh.edges().any(|edge| mesh.is_edge_hidden(edge))
            || mesh.faces().any(|face| mesh.is_face_hidden(face));
        marked
    }
}

/// A change that keeps a copy of a document's scene equal to it.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneChange {
    /// Replace the copy with a clone.
    Whole,
    /// Take over a mesh: [`Scene::adopt_mesh`].
    Mesh(MeshId),
    /// Show another mesh than the scene's: the visible part of an edited one, or what modifiers make of it.
    /// [`Scene::replace_mesh`].
    Visible(MeshId, Box<Mesh>),
    /// Take over everything except meshes: [`Scene::swap_parts`].
    Parts,
    /// Give a mesh other values: [`Scene::change_mesh`].
    Values(MeshId, MeshChange),
}

impl SceneChange {
    /// Applies the change to a copy. For a scene that reports changes to others, such as a
    /// window's, call the methods that the variants name.
    pub fn apply(self, from: &Scene, copy: &mut Scene) {
        match self {
            Self::Whole => *copy = from.clone(),
            Self::Mesh(id) => {
                copy.adopt_mesh(from, id).expect("meshes come in the order of their ids");
            }
            Self::Visible(id, mesh) => copy.replace_mesh(id, *mesh).expect("an earlier change added it"),
            Self::Parts => copy.swap_parts(&mut from.parts()),
            Self::Values(id, change) => copy.change_mesh(id, &change).expect("the original was changed so"),
        }
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;
    use trigon_modelling::{FaceId, VertexId};

    use super::*;

    #[test]
    fn each_mark_is_in_its_own_list() {
        type Hide = fn(&mut EditMesh);
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(1.0));
        let of = |mesh: &EditMesh| {
            let MarkedElements { sharp, seams, creases, has_hidden } = MarkedElements::of(mesh);
            (
                [sharp, seams, creases].map(|edges| edges.into_iter().map(EdgeId::index).collect::<Vec<_>>()),
                has_hidden,
            )
        };
        assert_eq!(of(&mesh), ([vec![], vec![], vec![]], false), "a cube has none");
        mesh.set_sharp(EdgeId::new(2), true);
        mesh.set_seam(EdgeId::new(3), true);
        mesh.set_seam(EdgeId::new(5), true);
        mesh.set_crease(EdgeId::new(7), 0.25);
        let marked = [vec![2], vec![3, 5], vec![7]];
        assert_eq!(of(&mesh), (marked.clone(), false), "one sharp, two seams, one crease");
        let hide: [Hide; 3] = [
            |mesh| mesh.set_vertex_hidden(VertexId::new(1), true),
            |mesh| mesh.set_edge_hidden(EdgeId::new(1), true),
            |mesh| mesh.set_face_hidden(FaceId::new(1), true),
        ];
        for hide in hide {
            let mut mesh = mesh.clone();
            hide(&mut mesh);
            assert_eq!(of(&mesh), (marked.clone(), true), "one element is hidden");
        }
    }
}
