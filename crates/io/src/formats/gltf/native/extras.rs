//! `extras.trigon`, as text and as structs.

use std::collections::{BTreeMap, BTreeSet};

use serde::de::{DeserializeOwned, Deserializer};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

/// The member of `extras` of some object.
#[derive(Clone, Debug, Default)]
pub(in crate::formats::gltf) enum Extras<T> {
    /// It does not exist.
    #[default]
    Absent,
    /// It exists but cannot be parsed.
    Broken,
    Present(T),
}

impl<T> Extras<T> {
    pub(in crate::formats::gltf) fn get(&self) -> Option<&T> {
        match self {
            Self::Present(value) => Some(value),
            Self::Absent | Self::Broken => None,
        }
    }
}

impl<'de, T: DeserializeOwned> Deserialize<'de> for Extras<T> {
    /// Parses any value, at any depth, without recursion.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Members {
            #[serde(default)]
            trigon: Option<Box<RawValue>>,
        }
        let text = Box::<RawValue>::deserialize(deserializer)?;
        let members = serde_json::from_str::<Members>(text.get());
        let Some(own) = members.ok().and_then(|members| members.trigon) else { return Ok(Self::Absent) };
        Ok(serde_json::from_str(own.get()).map_or(Self::Broken, Self::Present))
    }
}

/// Of a mesh.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::formats::gltf) struct Header {
    pub(in crate::formats::gltf) version: u32,
    /// The hash of the triangles; see `triangle_hash`.
    pub(in crate::formats::gltf) triangles: String,
    /// The hash of the columns.
    pub(in crate::formats::gltf) data: String,
    /// Views by the names of columns.
    pub(in crate::formats::gltf) columns: BTreeMap<String, usize>,
    /// The material slot of each primitive.
    pub(in crate::formats::gltf) slots: Vec<u32>,
    /// The material of each slot: for those without a primitive.
    pub(in crate::formats::gltf) materials: Vec<Option<usize>>,
    /// How many joints the skin has for each vertex.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(in crate::formats::gltf) joints_per_vertex: Option<usize>,
    /// How many morph targets there are.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub(in crate::formats::gltf) targets: usize,
    /// Columns that exist without values: views have at least one byte.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub(in crate::formats::gltf) empty: BTreeSet<String>,
    /// Whether the mesh was being edited, and so has edit data.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(in crate::formats::gltf) edited: bool,
    /// In how many Catmull-Clark levels the mesh is shown.
    #[serde(default, skip_serializing_if = "is_plain")]
    pub(in crate::formats::gltf) subdivision: u32,
}

fn is_plain(levels: &u32) -> bool {
    *levels == 0
}

fn is_zero(number: &usize) -> bool {
    *number == 0
}

/// Of a node.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq)]
pub(in crate::formats::gltf) struct NodeExtras {
    pub(in crate::formats::gltf) version: u32,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(in crate::formats::gltf) hidden: bool,
    /// The light, if it is of a kind that the format lacks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(in crate::formats::gltf) ambient: Option<AmbientExtras>,
}

/// Ambient light.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq)]
pub(in crate::formats::gltf) struct AmbientExtras {
    pub(in crate::formats::gltf) color: [f32; 3],
    pub(in crate::formats::gltf) intensity: f32,
}

/// Of a material.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(in crate::formats::gltf) struct MaterialExtras {
    pub(in crate::formats::gltf) version: u32,
    pub(in crate::formats::gltf) shading: ExactShading,
}

/// The shading models that the format lacks.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq)]
#[serde(rename_all = "camelCase", tag = "model")]
pub(in crate::formats::gltf) enum ExactShading {
    Lambert,
    /// Its texture is the specular colour's.
    BlinnPhong {
        specular: [f32; 3],
        shininess: f32,
    },
}
