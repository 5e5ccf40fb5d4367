//! The state of a document: what commands change, and what its scene shows of it.
//!
//! | file | what it holds |
//! |---|---|
//! | `mod` | the state |
//! | `change` | a command's access to it |
//! | `names` | unique names of objects |
//! | `shown` | how the scene follows the edited meshes |
//! | `visible` | what a view shows instead of a mesh of the scene; marked elements; changes for a copy of it |

mod change;
mod names;
mod shown;
mod visible;

use trigon_mesh::math::DAffine3;
use trigon_modelling::EditMesh;
use trigon_scene::{MeshId, NodeId};

use crate::document_file::DocumentFile;
use crate::selection::Selection;

pub(crate) use change::{AfterEdit, Change};
pub(crate) use names::Names;
pub(crate) use shown::{Outdated, Shown, Untold};
pub(crate) use visible::MarkedElements;
pub use visible::SceneChange;

/// What commands change of a document, and what its scene shows of it.
#[derive(Debug, Default)]
pub(crate) struct State {
    /// The scene, its edited meshes, and what is kept of the file.
    pub(crate) file: DocumentFile,
    pub(crate) selection: Selection,
    /// How the scene follows the edited meshes.
    pub(crate) shown: Shown,
    /// How many bytes of memory an operation may let a mesh take, if not [`EditMesh::MEMORY`].
    pub(crate) memory: Option<u64>,
    /// What was lost when meshes were made editable and has not been reported yet.
    pub(crate) untold: Vec<String>,
}

impl State {
    /// A mesh with its neighbours, if it is or was edited.
    pub(crate) fn mesh(&self, id: MeshId) -> Option<&EditMesh> {
        self.file.edited.get(&id)
    }

    /// The map from a mesh into the world; see [`Document::mesh_transform`](crate::Document::mesh_transform).
    pub(crate) fn mesh_transform(&self, id: MeshId) -> DAffine3 {
        self.owner(id).map_or(DAffine3::IDENTITY, |object| self.file.native.scene.world_transform(object))
    }

    /// The first selected object that shows a mesh, or the first one at all.
    pub(crate) fn owner(&self, id: MeshId) -> Option<NodeId> {
        let scene = &self.file.native.scene;
        let shows = |object: &NodeId| scene.node(*object).is_some_and(|node| node.mesh == Some(id));
        let selected = self.selection.objects.iter().copied().find(shows);
        selected.or_else(|| scene.nodes().iter().map(|(object, _)| object).find(shows))
    }
}
