//! The object in the file for each part of the scene.

use std::collections::{BTreeMap, BTreeSet};

use trigon_scene::{MaterialId, MeshId, NodeId, SkinId, TextureId};

/// Indices of the file by ids of the scene.
#[derive(Default)]
pub(in crate::formats::gltf) struct Origins {
    pub(in crate::formats::gltf) nodes: BTreeMap<NodeId, usize>,
    pub(in crate::formats::gltf) meshes: BTreeMap<MeshId, MeshOrigin>,
    pub(in crate::formats::gltf) materials: BTreeMap<MaterialId, usize>,
    pub(in crate::formats::gltf) textures: BTreeMap<TextureId, BTreeSet<usize>>,
    pub(in crate::formats::gltf) skins: BTreeMap<SkinId, usize>,
    /// By their index in the scene.
    pub(in crate::formats::gltf) animations: Vec<usize>,
    pub(in crate::formats::gltf) cameras: BTreeMap<NodeId, usize>,
    pub(in crate::formats::gltf) lights: BTreeMap<NodeId, usize>,
    /// The loaded scene, if the file has scenes.
    pub(in crate::formats::gltf) scene: Option<usize>,
}

/// A mesh of the file.
pub(in crate::formats::gltf) struct MeshOrigin {
    pub(in crate::formats::gltf) index: usize,
    /// In the order of their faces.
    pub(in crate::formats::gltf) primitives: Vec<PrimitiveFaces>,
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
