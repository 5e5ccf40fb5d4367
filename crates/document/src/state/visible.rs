//! What a view shows instead of a mesh of the document's scene: the mesh without its hidden elements, or its
//! subdivision surface.
//!
//! The document's scene always has the mesh with all elements, so that saved files are complete; a displayed copy
//! gets another mesh.

use trigon_mesh::{Mesh, MeshChange};
use trigon_modelling::{ChangedValues, EditMesh, ElementMap, ElementNumbers};
use trigon_scene::MeshId;

use super::scene_change::SceneChange;

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
