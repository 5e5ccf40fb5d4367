//! The object in the file for each part of the scene.

use std::collections::{BTreeMap, BTreeSet};

use trigon_scene::{MaterialId, MeshId, NodeId, SkinId, TextureId};

/// Indices of the file by ids of the scene.
#[derive(Default)]
pub(crate) struct Origins {
    pub(crate) nodes: BTreeMap<NodeId, usize>,
    pub(crate) meshes: BTreeMap<MeshId, MeshOrigin>,
    pub(crate) materials: BTreeMap<MaterialId, usize>,
    pub(crate) textures: BTreeMap<TextureId, BTreeSet<usize>>,
    pub(crate) skins: BTreeMap<SkinId, usize>,
    /// By their index in the scene.
    pub(crate) animations: Vec<usize>,
    pub(crate) cameras: BTreeMap<NodeId, usize>,
    pub(crate) lights: BTreeMap<NodeId, usize>,
    /// The loaded scene, if the file has scenes.
    pub(crate) scene: Option<usize>,
}

/// A mesh of the file.
pub(crate) struct MeshOrigin {
    pub(crate) index: usize,
    /// In the order of their faces.
    pub(crate) primitives: Vec<PrimitiveFaces>,
}

/// The faces of a primitive: from the end of the previous one's.
#[derive(Clone, Debug)]
pub(crate) struct PrimitiveFaces {
    /// Its index in the mesh of the file.
    pub(crate) primitive: usize,
    /// One after its last face.
    pub(crate) end: usize,
}

impl MeshOrigin {
    pub(super) fn primitive(&self, face: usize) -> Option<usize> {
        let next = self.primitives.partition_point(|faces| faces.end <= face);
        Some(self.primitives.get(next)?.primitive)
    }
}
