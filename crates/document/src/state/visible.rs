//! What a view shows instead of a mesh of the document's scene: the mesh without its hidden elements, or its
//! subdivision surface. Here is also which edges have marks, computed once after a change of marks, and the
//! changes that keep a copy of the scene equal to it.
//!
//! The document's scene always has the mesh with all elements, so that saved files are complete; a displayed copy
//! gets another mesh.

use trigon_mesh::{Mesh, MeshChange};
use trigon_modelling::{ChangedValues, EdgeId, EditMesh, ElementMap, ElementNumbers};
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
    /// As its surface after so many levels.
    Surface(u32),
    /// The same with the mesh over it as its cage, without what is hidden.
    Cage(u32),
}

/// In how many levels a view shows a mesh: as many as it has, but so that a change of it is seen soon.
pub(crate) fn shown_levels(mesh: &EditMesh) -> u32 {
    /// They are made anew in less than a tenth of a second.
    const MOST_FACES: u64 = 1 << 17;
    let is_small = |levels: &u32| mesh.subdivided_face_count(*levels) <= MOST_FACES;
    let most = if mesh.face_count() == 0 { 0 } else { mesh.subdivision() };
    (1..=most).rev().find(is_small).unwrap_or(0)
}

impl Sight {
    pub(crate) fn of(mesh: &EditMesh, is_edited: bool, has_hidden: bool) -> Self {
        match (shown_levels(mesh), is_edited) {
            (0, true) if has_hidden => Self::Part,
            (0, _) => Self::Whole,
            (levels, true) => Self::Cage(levels),
            (levels, false) => Self::Surface(levels),
        }
    }

    /// What a copy shows of a mesh.
    pub(crate) fn mesh(self, edited: &EditMesh) -> (Mesh, ElementMap) {
        let surface = match self {
            Self::Whole => return edited.to_mesh(),
            Self::Part => return edited.to_visible_mesh(),
            Self::Surface(levels) => {
                edited.to_subdivided_mesh(levels).map(|mesh| (mesh, ElementMap::default()))
            }
            Self::Cage(levels) => edited.to_mesh_with_cage(levels),
        };
        surface.expect("a view shows few levels of large meshes")
    }
}

impl VisibleMesh {
    pub(crate) fn new(sight: Sight, edited: &EditMesh) -> (Self, Mesh) {
        let (mesh, map) = sight.mesh(edited);
        let numbers = ElementNumbers::new(edited, &mesh, &map);
        let surface = matches!(sight, Sight::Surface(_) | Sight::Cage(_)).then(|| mesh.clone());
        let values = ChangedValues::default();
        (Self { sight, map, numbers, surface, values, is_outdated: false }, mesh)
    }

    /// The change of a mesh that the copy has not received.
    pub(crate) fn take(&mut self, id: MeshId, edited: &EditMesh) -> Option<SceneChange> {
        let values = std::mem::take(&mut self.values);
        if values.is_empty() {
            return None;
        }
        let Some(surface) = &mut self.surface else {
            return Some(SceneChange::Values(id, edited.mesh_change(&values, &self.numbers)));
        };
        let (mesh, _) = self.sight.mesh(edited);
        let change = MeshChange::between(surface, &mesh);
        *surface = mesh;
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
    /// Show another mesh than the scene's: the visible part of an edited one, or a subdivision surface.
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
