//! The file that a scene came from, with the scene as loaded.

use std::collections::BTreeMap;

use trigon_mesh::edit::Marks;
use trigon_scene::{MeshId, Scene};

use crate::gltf_source::GltfSource;

/// A file, and the scene as loaded: whatever is unchanged in a scene is unchanged in the file.
#[derive(Debug)]
pub(super) struct KeptFile {
    pub(super) source: GltfSource,
    pub(super) scene: Scene,
    pub(super) marks: BTreeMap<MeshId, Marks>,
}
