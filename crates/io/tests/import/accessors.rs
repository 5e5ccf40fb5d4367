//! Accessors in every layout: component types, strides, offsets in views and within them, sparse storage over
//! numbers or over none, by what the bytes were made from.

use std::collections::BTreeMap;

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_io::Loaded;
use trigon_scene::Interpolation;

use crate::gltf::{Doc, push};
use crate::meshes;

/// A component type, and whether its integers stand for 0…1 or −1…1.
#[derive(Clone, Copy, Debug)]
struct Component {
    code: u32,
    normalized: bool,
}

impl Component {
    fn size(self) -> usize {
        match self.code {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        }
    }

    /// Section 3.6.2.2 of the glTF 2.0 specification.
    fn number(self, raw: u32) -> f32 {
        let [b0, b1, ..] = raw.to_le_bytes();
        let (number, largest) = match self.code {
            5120 => (f32::from(b0 as i8), 127.0),
            5121 => (f32::from(b0), 255.0),
            5122 => (f32::from(i16::from_le_bytes([b0, b1])), 32767.0),
            5123 => (f32::from(u16::from_le_bytes([b0, b1])), 65535.0),
            _ => return f32::from_bits(raw),
        };
        if self.normalized { (number / largest).max(-1.0) } else { number }
    }
}

/// Where bytes are: in a view of their own that begins with some that belong to nothing, or behind such in a view
/// that others use too.
#[derive(Clone, Copy, Debug)]
struct Offset {
    bytes: usize,
    is_shared: bool,
}

/// Elements that replace others.
#[derive(Clone, Debug)]
struct Sparse {
    replaced: Vec<(prop::sample::Index, [u32; 4])>,
    index_component: u32,
    indices: Offset,
    values: Offset,
}

/// How an accessor stores its elements.
#[derive(Clone, Debug)]
struct Stored {
    /// None if all are zero but for the sparse ones.
    base: Option<(Offset, usize)>,
    sparse: Option<Sparse>,
    /// Raw numbers, of which accessors use as many as they need.
    raw: Vec<[u32; 4]>,
}

fn offset() -> impl Strategy<Value = Offset> {
    (prop::sample::select(vec![0_usize, 4, 8, 20, 64]), any::<bool>())
        .prop_map(|(bytes, is_shared)| Offset { bytes, is_shared })
}

/// The bits of any finite number.
fn bits() -> impl Strategy<Value = u32> {
    prop_oneof![any::<u32>(), (-100.0_f32..100.0).prop_map(f32::to_bits)]
        .prop_filter("finite", |&raw| f32::from_bits(raw).is_finite())
}

fn stored() -> impl Strategy<Value = Stored> {
    let element = || [bits(), bits(), bits(), bits()];
    let replaced = prop::collection::vec((any::<prop::sample::Index>(), element()), 1..6);
    let index_component = prop::sample::select(vec![5121_u32, 5123, 5125]);
    let sparse = (replaced, index_component, offset(), offset()).prop_map(
        |(replaced, index_component, indices, values)| Sparse { replaced, index_component, indices, values },
    );
    let base = prop::option::weighted(0.7, (offset(), 0_usize..4));
    (base, prop::option::weighted(0.7, sparse), prop::collection::vec(element(), 24))
        .prop_map(|(base, sparse, raw)| Stored { base, sparse, raw })
}

/// Puts bytes into a new view or, from its end, into the last one, and says which view and at which byte of it.
fn place(doc: &mut Doc, offset: Offset, data: &[u8]) -> [usize; 2] {
    let junk = vec![0xa5; offset.bytes];
    let last = doc.json["bufferViews"].as_array().expect("a list").len() - 1;
    if !(offset.is_shared && doc.json["bufferViews"][last]["byteStride"].is_null()) {
        let view = doc.view(&[&junk[..], data].concat());
        return [view, offset.bytes];
    }
    while !doc.bytes.len().is_multiple_of(4) {
        doc.bytes.push(0xa5);
    }
    let view = &mut doc.json["bufferViews"][last];
    let begin = view["byteOffset"].as_u64().expect("a number") as usize;
    let start = doc.bytes.len() - begin + offset.bytes;
    view["byteLength"] = json!(start + data.len());
    doc.bytes.extend([&junk[..], data].concat());
    [last, start]
}

impl Stored {
    /// The accessor, and the raw numbers of its elements.
    fn accessor(
        &self,
        doc: &mut Doc,
        component: Component,
        width: usize,
        count: usize,
    ) -> (usize, Vec<Vec<u32>>) {
        let size = component.size();
        let bytes = |elements: &[u32]| -> Vec<u8> {
            elements.iter().flat_map(|raw| raw.to_le_bytes()[..size].to_vec()).collect()
        };
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1];
        let mut accessor = json!({"componentType": component.code, "type": kind, "count": count});
        if component.normalized {
            accessor["normalized"] = json!(true);
        }
        let mut elements = vec![vec![0; width]; count];
        if let Some((offset, spare)) = self.base {
            elements = (0..count).map(|i| self.raw[i % self.raw.len()][..width].to_vec()).collect();
            // Strides are multiples of four, and only of vertices.
            let stride = (width * size).next_multiple_of(4) + 4 * spare;
            let is_tight = spare == 0 || width == 1;
            let element = |raw: &Vec<u32>| {
                let mut element = bytes(raw);
                element.resize(if is_tight { element.len() } else { stride }, 0xa5);
                element
            };
            let data: Vec<u8> = elements.iter().flat_map(element).collect();
            let own = Offset { is_shared: offset.is_shared && is_tight, ..offset };
            let [view, start] = place(doc, own, &data);
            (accessor["bufferView"], accessor["byteOffset"]) = (json!(view), json!(start));
            if !is_tight {
                doc.json["bufferViews"][view]["byteStride"] = json!(stride);
            }
        }
        if let Some(sparse) = &self.sparse {
            let replaced: BTreeMap<usize, [u32; 4]> =
                sparse.replaced.iter().map(|(index, raw)| (index.index(count), *raw)).collect();
            accessor["sparse"] = sparse.json(doc, &replaced, |raw| bytes(&raw[..width]));
            for (target, raw) in replaced {
                elements[target] = raw[..width].to_vec();
            }
        }
        (push(&mut doc.json["accessors"], accessor), elements)
    }
}

impl Sparse {
    fn json(
        &self,
        doc: &mut Doc,
        replaced: &BTreeMap<usize, [u32; 4]>,
        bytes: impl Fn(&[u32; 4]) -> Vec<u8>,
    ) -> Value {
        let size = Component { code: self.index_component, normalized: false }.size();
        let targets: Vec<u8> =
            replaced.keys().flat_map(|&target| (target as u32).to_le_bytes()[..size].to_vec()).collect();
        let [index_view, index_start] = place(doc, self.indices, &targets);
        let values: Vec<u8> = replaced.values().flat_map(bytes).collect();
        let [value_view, value_start] = place(doc, self.values, &values);
        json!({"count": replaced.len(),
            "indices": {"bufferView": index_view, "byteOffset": index_start, "componentType": self.index_component},
            "values": {"bufferView": value_view, "byteOffset": value_start}})
    }
}

fn component(codes: &'static [u32]) -> impl Strategy<Value = Component> {
    let codes = prop::sample::select(codes);
    (codes, any::<bool>())
        .prop_map(|(code, normalized)| Component { code, normalized: normalized && code != 5126 })
}

/// A document of some triangles that share no vertex.
fn triangles(count: usize) -> Doc {
    let mut doc = Doc::square();
    let corner = |i: usize| [(i % 3 / 2) as f32, (i % 3 % 2) as f32, (i / 3) as f32];
    let positions: Vec<f32> = (0..3 * count).flat_map(corner).collect();
    let position = doc.floats("VEC3", &positions);
    *doc.primitive() = json!({"attributes": {"POSITION": position}});
    doc.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    doc.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    doc
}

fn numbers(component: Component, elements: &[Vec<u32>]) -> Vec<Vec<f32>> {
    elements.iter().map(|raw| raw.iter().map(|&raw| component.number(raw)).collect()).collect()
}

proptest! {
    #[test]
    fn attributes_are_read_from_every_layout(
        uv in (component(&[5120, 5121, 5122, 5123, 5126]), stored()),
        color in (component(&[5121, 5123, 5126]), stored(), 3_usize..=4),
        count in 1_usize..9,
    ) {
        let mut doc = triangles(count);
        let (uv_accessor, uvs) = uv.1.accessor(&mut doc, uv.0, 2, 3 * count);
        let color_component = Component { normalized: color.0.code != 5126, ..color.0 };
        let (color_accessor, colors) = color.1.accessor(&mut doc, color_component, color.2, 3 * count);
        doc.primitive()["attributes"]["TEXCOORD_0"] = json!(uv_accessor);
        doc.primitive()["attributes"]["COLOR_0"] = json!(color_accessor);
        let loaded = doc.load();
        let attributes = meshes(&loaded)[0].attributes();
        let found: Vec<Vec<f32>> = attributes.uv_sets[0].iter().map(|uv| uv.to_array().to_vec()).collect();
        prop_assert_eq!(found, numbers(uv.0, &uvs));
        let colored = attributes.corner_colors.as_ref().expect("there are colours");
        let found: Vec<Vec<f32>> = colored.iter().map(|color| color.to_array().to_vec()).collect();
        let mut expected = numbers(color_component, &colors);
        for color in &mut expected {
            color.resize(4, 1.0);
            // "Clamped to [0.0, 1.0] range", section 3.7.2.1.
            color.iter_mut().for_each(|channel| *channel = channel.clamp(0.0, 1.0));
        }
        prop_assert_eq!(found, expected);
    }

    #[test]
    fn indices_are_read_from_every_layout(code in prop::sample::select(vec![5121_u32, 5123, 5125]), mut stored in stored(), count in 1_usize..9) {
        // Each row of the corners of a triangle names three of its own, in any order.
        let vertices = 3 * count;
        let indices = stored.raw.iter_mut().chain(stored.sparse.iter_mut().flat_map(|s| s.replaced.iter_mut().map(|(_, raw)| raw)));
        indices.for_each(|raw| raw[0] %= vertices as u32);
        let mut doc = triangles(count);
        let component = Component { code, normalized: false };
        let (accessor, elements) = stored.accessor(&mut doc, component, 1, vertices);
        doc.primitive()["indices"] = json!(accessor);
        let corners: Vec<u32> = elements.into_iter().flatten().collect();
        let faces: Vec<&[u32]> = corners.chunks(3).filter(|c| c[0] != c[1] && c[1] != c[2] && c[2] != c[0]).collect();
        if faces.is_empty() {
            prop_assert!(doc.refused().contains("nothing to draw"));
            return Ok(());
        }
        let loaded = doc.load();
        let mesh = meshes(&loaded)[0];
        let found = mesh.corner_vertices().iter().map(|&vertex| mesh.positions()[vertex as usize].to_array());
        let corner = |&i: &u32| [(i % 3 / 2) as f32, (i % 3 % 2) as f32, (i / 3) as f32];
        prop_assert_eq!(found.collect::<Vec<_>>(), faces.concat().iter().map(corner).collect::<Vec<_>>());
    }

    #[test]
    fn rotations_are_read_from_every_layout(component in component(&[5120, 5121, 5122, 5123, 5126]), stored in stored(), keys in 1_usize..8) {
        let component = Component { normalized: component.code != 5126, ..component };
        let mut doc = triangles(1);
        // Tight, as glTF wants it where no vertices are.
        let stored = Stored { base: stored.base.map(|(offset, _)| (offset, 0)), ..stored };
        let times: Vec<f32> = (0..keys).map(|key| key as f32).collect();
        let input = doc.floats("SCALAR", &times);
        let (output, elements) = stored.accessor(&mut doc, component, 4, 3 * keys);
        doc.json["animations"] = json!([{"samplers": [{"input": input, "output": output, "interpolation": "CUBICSPLINE"}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}]);
        let loaded: Loaded = doc.load();
        let curve = &loaded.scene.animations[0].channels[0].curve;
        prop_assert_eq!(curve.interpolation(), Interpolation::CubicSpline);
        prop_assert_eq!(curve.times(), times);
        prop_assert_eq!(curve.values(), numbers(component, &elements).concat());
    }
}
