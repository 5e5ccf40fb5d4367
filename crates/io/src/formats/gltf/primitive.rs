//! A primitive's elements: indices, or none, and a mode become triangles, edges and points. Attributes that are not
//! read are found by name: gltf-json keeps no names that it does not know.

use std::fmt;

use gltf::json::mesh::Mode;
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};

/// What a primitive draws, as indices into its own attributes.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Elements {
    /// Three corners each.
    pub(crate) triangles: Vec<u32>,
    pub(crate) edges: Vec<[u32; 2]>,
    pub(crate) points: Vec<u32>,
    /// How many indices at the end make no whole element.
    pub(crate) left_over: usize,
}

impl Elements {
    pub(crate) fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.edges.is_empty() && self.points.is_empty()
    }
}

/// How many corners, ends and points a mode makes of some indices, or more.
pub(crate) fn corner_count(mode: Mode, indices: usize) -> usize {
    let each = match mode {
        Mode::Points | Mode::Lines | Mode::Triangles => 1,
        Mode::LineStrip | Mode::LineLoop => 2,
        Mode::TriangleStrip | Mode::TriangleFan => 3,
    };
    indices.saturating_mul(each)
}

/// Sorts indices into elements. Strips turn every second triangle round, so
/// that all face the same way. Indices of triangles, which may be many, are taken over.
pub(crate) fn elements(mode: Mode, mut indices: Vec<u32>) -> Elements {
    let mut elements = Elements::default();
    match mode {
        Mode::Points => elements.points = indices,
        Mode::Lines => {
            let (edges, rest) = indices.as_chunks();
            (elements.edges, elements.left_over) = (edges.to_vec(), rest.len());
        }
        Mode::LineStrip => elements.edges = strip_edges(&indices),
        Mode::LineLoop => {
            elements.edges = strip_edges(&indices);
            if let (&[first, _, ..], Some(&last)) = (indices.as_slice(), indices.last()) {
                elements.edges.push([last, first]);
            }
        }
        Mode::Triangles => {
            elements.left_over = indices.len() % 3;
            indices.truncate(indices.len() - elements.left_over);
            elements.triangles = indices;
        }
        Mode::TriangleStrip => {
            let turned = |(index, corner): (usize, &[u32])| {
                if index % 2 == 0 {
                    [corner[0], corner[1], corner[2]]
                } else {
                    [corner[1], corner[0], corner[2]]
                }
            };
            elements.triangles = indices.windows(3).enumerate().flat_map(turned).collect();
        }
        Mode::TriangleFan => {
            let rest = indices.get(1..).unwrap_or_default();
            elements.triangles = rest.windows(2).flat_map(|pair| [indices[0], pair[0], pair[1]]).collect();
        }
    }
    elements
}

fn strip_edges(indices: &[u32]) -> Vec<[u32; 2]> {
    indices.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mode_becomes_elements() {
        let indices = [0, 1, 2, 3, 4];
        let elements = |mode: Mode, indices: &[u32]| elements(mode, indices.to_vec());
        let triangles = |mode: Mode| elements(mode, &indices).triangles.as_chunks().0.to_vec();
        assert_eq!(elements(Mode::Points, &indices).points, indices, "points");
        assert_eq!(elements(Mode::Lines, &indices).edges, [[0, 1], [2, 3]], "lines");
        assert_eq!(elements(Mode::Lines, &indices).left_over, 1, "one left over");
        assert_eq!(elements(Mode::LineStrip, &indices).edges, [[0, 1], [1, 2], [2, 3], [3, 4]], "strip");
        assert_eq!(elements(Mode::LineLoop, &indices[..3]).edges, [[0, 1], [1, 2], [2, 0]], "loop");
        assert_eq!(triangles(Mode::Triangles), [[0, 1, 2]], "triangles");
        assert_eq!(
            triangles(Mode::TriangleStrip),
            [[0, 1, 2], [2, 1, 3], [2, 3, 4]],
            "all the same way round"
        );
        assert_eq!(triangles(Mode::TriangleFan), [[0, 1, 2], [0, 2, 3], [0, 3, 4]], "fan");
    }

    #[test]
    fn few_indices_make_nothing() {
        let modes = [
            Mode::Lines,
            Mode::LineStrip,
            Mode::LineLoop,
            Mode::Triangles,
            Mode::TriangleStrip,
            Mode::TriangleFan,
        ];
        for mode in modes {
            for indices in [&[][..], &[0]] {
                let found = elements(mode, indices.to_vec());
                assert!(found.triangles.is_empty() && found.edges.is_empty(), "{mode:?} of {indices:?}");
            }
        }
    }
}
