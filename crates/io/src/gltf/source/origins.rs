//! Which object of the file each part of the scene was.

use std::collections::{BTreeMap, BTreeSet};

use trigon_scene::{MaterialId, MeshId, NodeId, SkinId, TextureId};

/// Indices of the file by ids of the scene.
#[derive(Default)]
pub(super) struct Origins {
    pub(super) nodes: BTreeMap<NodeId, usize>,
    pub(super) meshes: BTreeMap<MeshId, MeshOrigin>,
    pub(super) materials: BTreeMap<MaterialId, usize>,
    pub(super) textures: BTreeMap<TextureId, BTreeSet<usize>>,
    pub(super) skins: BTreeMap<SkinId, usize>,
    /// By their place in the scene.
    pub(super) animations: Vec<usize>,
    pub(super) cameras: BTreeMap<NodeId, usize>,
    pub(super) lights: BTreeMap<NodeId, usize>,
    /// The scene that was loaded, if the file has scenes.
    pub(super) scene: Option<usize>,
}

/// A mesh of the file.
pub(super) struct MeshOrigin {
    pub(super) index: usize,
    /// In the order of their faces.
    pub(super) primitives: Vec<PrimitiveFaces>,
}

/// The faces of a mesh that a primitive became: from where those of the one before end.
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
