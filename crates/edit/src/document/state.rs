//! What commands change of a document.

use trigon_io::NativeDocument;
use trigon_mesh::edit::EditMesh;
use trigon_mesh::math::DAffine3;
use trigon_scene::{MeshId, NodeId};

use super::shown::Shown;
use crate::selection::Selection;

/// What commands change of a document, and what its scene shows of it.
#[derive(Debug, Default)]
pub(crate) struct State {
    /// The scene, its edited meshes, and what is kept of the file.
    pub(super) file: NativeDocument,
    pub(super) selection: Selection,
    /// How the scene follows the edited meshes.
    pub(super) shown: Shown,
    /// What was lost when meshes were made editable and has not been reported yet.
    pub(super) untold: Vec<String>,
}

impl State {
    /// A mesh with its neighbours, if it is or was edited.
    pub(crate) fn mesh(&self, id: MeshId) -> Option<&EditMesh> {
        self.file.edited.get(&id)
    }

    /// The map from a mesh into the world; see [`Document::mesh_transform`](super::Document::mesh_transform).
    pub(crate) fn mesh_transform(&self, id: MeshId) -> DAffine3 {
        let scene = &self.file.scene;
        let shows = |object: &NodeId| scene.node(*object).is_some_and(|node| node.mesh == Some(id));
        let selected = self.selection.objects.iter().copied().find(shows);
        let object = selected.or_else(|| scene.nodes().iter().map(|(object, _)| object).find(shows));
        object.map_or(DAffine3::IDENTITY, |object| scene.world_transform(object))
    }
}
