//! Attributes of primitives and morph targets that are not read: gltf-json
//! keeps no names that it does not know.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};

/// An attribute that is not read.
pub(crate) struct ForeignAttribute {
    pub(crate) mesh: usize,
    pub(crate) primitive: usize,
    pub(crate) name: String,
    /// Whether it belongs to a morph target.
    pub(crate) in_target: bool,
}

/// The names in a primitive that are not read.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(crate) struct RawPrimitive {
    attributes: Names<false>,
    targets: Option<Vec<Names<true>>>,
}

/// The names in an object of attributes that are not read; in one of morph
/// targets or not.
#[derive(Default)]
struct Names<const IN_TARGET: bool>(Vec<String>);

impl<'de, const IN_TARGET: bool> Deserialize<'de> for Names<IN_TARGET> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Self::default())
    }
}

impl<'de, const IN_TARGET: bool> Visitor<'de> for Names<IN_TARGET> {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("attributes")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<Self, A::Error> {
        while let Some((name, _)) = map.next_entry::<String, IgnoredAny>()? {
            if !is_read(&name, IN_TARGET) {
                self.0.push(name);
            }
        }
        Ok(self)
    }
}

/// Whether an attribute is read, or is an application's own and not to be.
fn is_read(name: &str, in_target: bool) -> bool {
    if name.starts_with('_') || matches!(name, "POSITION" | "NORMAL" | "TANGENT") {
        return true;
    }
    // Numbers as gltf-json reads them.
    name.rsplit_once('_').is_some_and(|(kind, number)| {
        let is_known = matches!(kind, "TEXCOORD" | "COLOR" | "JOINTS" | "WEIGHTS");
        !in_target && is_known && number.parse::<u32>().is_ok()
    })
}

/// The attributes of all primitives, by mesh, that are not read.
pub(crate) fn foreign_attributes(meshes: Vec<Vec<RawPrimitive>>) -> Vec<ForeignAttribute> {
    let mut found = Vec::new();
    for (mesh, primitives) in meshes.into_iter().enumerate() {
        for (primitive, from) in primitives.into_iter().enumerate() {
            let mut add = |names: Vec<String>, in_target| {
                let attribute = |name| ForeignAttribute { mesh, primitive, name, in_target };
                found.extend(names.into_iter().map(attribute));
            };
            add(from.attributes.0, false);
            from.targets.into_iter().flatten().for_each(|names| add(names.0, true));
        }
    }
    found
}
