//! A converted mesh, and what its materials need to know about it.

use trigon_mesh::{EditData, Mesh};
use trigon_scene::MaterialTexture;

use crate::formats::gltf::slots::SlotTexture;
use crate::gltf_source::PrimitiveFaces;

/// A mesh, and the contents of its slots.
pub(crate) struct BuiltMesh {
    pub(crate) mesh: Mesh,
    /// The material of each slot: an index of the document, or the default.
    pub(crate) materials: Vec<Option<usize>>,
    /// The faces of each primitive.
    pub(crate) primitives: Vec<PrimitiveFaces>,
    /// Of a native file, if the mesh was being edited.
    pub(crate) edit_data: Option<EditData>,
}

/// What a material needs of the meshes that use it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Needs {
    /// The UV sets of its textures.
    pub(crate) uv_sets: Vec<u32>,
    /// The UV set of its normal map.
    pub(crate) tangents_of: Option<u32>,
}

impl Needs {
    pub(crate) fn of(textures: &[SlotTexture]) -> Self {
        let mut uv_sets: Vec<u32> = textures.iter().map(|texture| texture.uv_set).collect();
        uv_sets.sort_unstable();
        uv_sets.dedup();
        let normal = textures.iter().find(|texture| texture.slot == MaterialTexture::Normal);
        Self { uv_sets, tangents_of: normal.map(|texture| texture.uv_set) }
    }
}
