//! The file that a scene came from, with the scene as loaded.

use std::collections::BTreeMap;

use trigon_mesh::EditData;
use trigon_scene::{MeshId, Scene};

use crate::gltf_source::GltfSource;

/// A file, and the scene as loaded: whatever is unchanged in a scene is unchanged in the file.
#[derive(Debug)]
pub(crate) struct RetainedFile {
    pub(crate) source: GltfSource,
    pub(crate) scene: Scene,
    pub(crate) edit_data: BTreeMap<MeshId, EditData>,
}
