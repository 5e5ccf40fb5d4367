//! The materials of lines and points. A mesh draws all of them in the material of its first slot.

use gltf::json::Root;
use trigon_math::{Vec3, Vec4};

use crate::formats::gltf::materials::{is_opaque, unlit_colors};

/// The materials of a mesh's lines and points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::formats::gltf) enum WireMaterials {
    /// It has neither.
    Absent,
    /// All of them have this one, which gets the first slot.
    One(Option<usize>),
    /// They have several. The first slot gets the default material, which is white, and their vertices the colours that
    /// their own materials show.
    Several,
}

impl WireMaterials {
    /// Takes the material of each primitive that is lines or points.
    pub(in crate::formats::gltf) fn of(materials: impl IntoIterator<Item = Option<usize>>) -> Self {
        materials.into_iter().fold(Self::Absent, |found, material| match found {
            Self::Absent => Self::One(material),
            Self::One(first) if first == material => found,
            _ => Self::Several,
        })
    }

    /// The material of the first slot, unless any primitive may have it.
    pub(in crate::formats::gltf) fn first_slot(self) -> Option<Option<usize>> {
        match self {
            Self::Absent => None,
            Self::One(material) => Some(material),
            Self::Several => Some(None),
        }
    }
}

/// What a material makes of the colours of lines and points.
#[derive(Clone, Copy)]
pub(super) struct WireTint {
    base_color: Vec4,
    emissive: Vec3,
    /// Whether it lets nothing through, wherever it is.
    pub(super) is_opaque: bool,
}

impl WireTint {
    pub(super) fn of(root: &Root, material: Option<usize>) -> Self {
        let (base_color, emissive) = unlit_colors(root, material);
        Self { base_color, emissive, is_opaque: is_opaque(root, material) }
    }

    /// The colour that a vertex shows: glTF 2.0, section 3.7.2.1.
    pub(super) fn shown(self, vertex: Vec4) -> Vec4 {
        let color = self.base_color * vertex;
        (color.truncate() + self.emissive).extend(color.w)
    }
}
