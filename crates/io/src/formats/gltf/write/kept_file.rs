//! The file that a scene came from, with the scene as loaded.

use std::collections::BTreeMap;

use trigon_modelling::Marks;
use trigon_scene::{MeshId, Scene};

use crate::gltf_source::GltfSource;

/// A file, and the scene as loaded: whatever is unchanged in a scene is unchanged in the file.
#[derive(Debug)]
pub(crate) struct KeptFile {
    pub(crate) source: GltfSource,
    pub(crate) scene: Scene,
    pub(crate) marks: BTreeMap<MeshId, Marks>,
}
