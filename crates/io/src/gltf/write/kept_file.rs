//! The file that a scene came from, beside what was made of it.

use std::collections::BTreeMap;

use trigon_mesh::edit::Marks;
use trigon_scene::{MeshId, Scene};

use crate::gltf::source::GltfSource;

/// A file, and what was made of it: what is the same in a scene is the same in the file.
#[derive(Debug)]
pub(super) struct KeptFile {
    pub(super) source: GltfSource,
    pub(super) scene: Scene,
    pub(super) marks: BTreeMap<MeshId, Marks>,
}
