//! Our glTF reader against the reading half of the `gltf` crate, on files that it reads
//! rightly: names, children and transforms of nodes, and every corner of every face.

use std::path::{Path, PathBuf};

use gltf::mesh::{Mode, Reader};
use gltf::{Gltf, Semantic};
use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_io::{GltfSource, LoadOptions, Loaded, load, load_from_slice};
use trigon_math::DMat4;
use trigon_mesh::Mesh;

use crate::gltf::Doc;
use crate::gltf_crate::square_without_chunk;

/// A file that both read. Both take the bytes of its buffers from the source.
struct Both<'a> {
    theirs: &'a Gltf,
    ours: &'a Loaded,
    source: &'a GltfSource,
}

impl Both<'_> {
    fn check(&self) {
        for (id, node) in self.ours.scene.nodes().iter() {
            let Some(index) = self.source.node(id) else { continue };
            let theirs = self.theirs.nodes().nth(index).expect("a node");
            let name = theirs.name().map_or_else(|| format!("node {index}"), str::to_owned);
            assert_eq!(node.name, name, "node {index}");
            let children: Vec<_> = node.children().iter().map(|&child| self.source.node(child)).collect();
            let expected: Vec<_> = theirs.children().map(|child| Some(child.index())).collect();
            assert!(children.starts_with(&expected), "node {index}: {children:?}, {expected:?}");
            check_matrix(index, DMat4::from(node.transform.to_affine()), &theirs.transform());
        }
        for (id, asset) in self.ours.scene.meshes().iter() {
            let index = self.source.mesh(id).expect("all meshes are the file's");
            self.check_mesh(asset.mesh(), &self.theirs.meshes().nth(index).expect("a mesh"));
        }
    }

    /// Compares the faces, in order, by the numbers of their corners.
    fn check_mesh(&self, ours: &Mesh, theirs: &gltf::Mesh<'_>) {
        let attributes = ours.attributes();
        let mut face = 0;
        for primitive in theirs.primitives() {
            let reader = primitive.reader(|buffer| self.source.buffer(buffer.index()));
            let corners = Corners::read(&reader);
            let is_rigid =
                primitive.get(&Semantic::Joints(0)).is_none() && primitive.morph_targets().len() == 0;
            for triangle in triangles(primitive.mode(), &reader, corners.positions.len()) {
                if !corners.is_face(triangle, is_rigid) {
                    continue;
                }
                let first = 3 * face;
                for (corner, &vertex) in (first..).zip(&triangle) {
                    let place = || format!("mesh {}, face {face}, corner {corner}", theirs.index());
                    let position = ours.positions()[ours.corner_vertices()[corner] as usize];
                    assert_eq!(position.to_array(), corners.positions[vertex], "{}", place());
                    if let (Some(theirs), Some(ours)) = (&corners.normals, &attributes.corner_normals) {
                        assert_eq!(ours[corner].to_array(), theirs[vertex], "normal of {}", place());
                    }
                    if let (Some(theirs), Some(ours)) = (&corners.uvs, attributes.uv_sets.first()) {
                        check_near(&ours[corner].to_array(), &theirs[vertex], place);
                    }
                    if let (Some(theirs), Some(ours)) = (&corners.colors, &attributes.corner_colors) {
                        check_near(&ours[corner].to_array(), &theirs[vertex], place);
                    }
                }
                face += 1;
            }
        }
        assert_eq!(ours.face_count(), face, "mesh {}: as many faces", theirs.index());
    }
}

/// Theirs are sums and products in f32 of quaternions that need not be exactly of length 1:
/// an error of a few units of 2⁻²⁴ of the largest number.
fn check_matrix(node: usize, ours: DMat4, theirs: &gltf::scene::Transform) {
    let theirs = theirs.clone().matrix();
    let largest = theirs.as_flattened().iter().fold(1.0, |most: f32, value| most.max(value.abs()));
    for (ours, theirs) in ours.to_cols_array().iter().zip(theirs.as_flattened()) {
        let error = (ours - f64::from(*theirs)).abs();
        assert!(error <= 4e-6 * f64::from(largest), "node {node}: {ours} and {theirs}");
    }
}

/// The crate rounds normalized integers twice: the difference is one unit in the last place,
/// at most 2⁻²³ of the number.
fn check_near<const N: usize>(ours: &[f32; N], theirs: &[f32; N], place: impl Fn() -> String) {
    for (ours, theirs) in ours.iter().zip(theirs) {
        let error = (ours - theirs).abs();
        assert!(error <= 1.2e-7 * theirs.abs(), "{}: {ours} and {theirs}", place());
    }
}

/// The numbers of a primitive's vertices.
struct Corners {
    positions: Vec<[f32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    uvs: Option<Vec<[f32; 2]>>,
    colors: Option<Vec<[f32; 4]>>,
}

impl Corners {
    fn read<'a, 's, F>(reader: &Reader<'a, 's, F>) -> Self
    where
        F: Clone + Fn(gltf::Buffer<'a>) -> Option<&'s [u8]>,
    {
        Self {
            positions: reader.read_positions().into_iter().flatten().collect(),
            normals: reader.read_normals().map(Iterator::collect),
            uvs: reader.read_tex_coords(0).map(|uvs| uvs.into_f32().collect()),
            colors: reader.read_colors(0).map(|colors| colors.into_rgba_f32().collect()),
        }
    }

    /// Whether a triangle is one to us: those with a position that is not finite, or without
    /// three different vertices, are left out with a warning.
    fn is_face(&self, triangle: [usize; 3], is_rigid: bool) -> bool {
        let positions = triangle.map(|vertex| self.positions[vertex]);
        let same = |a: usize, b: usize| {
            if is_rigid { positions[a] == positions[b] } else { triangle[a] == triangle[b] }
        };
        positions.as_flattened().iter().all(|value| value.is_finite())
            && !same(0, 1)
            && !same(1, 2)
            && !same(2, 0)
    }
}

/// The triangles of a primitive as section 3.7.2.1 has them, up to where each begins.
fn triangles<'a, 's, F>(mode: Mode, reader: &Reader<'a, 's, F>, vertices: usize) -> Vec<[usize; 3]>
where
    F: Clone + Fn(gltf::Buffer<'a>) -> Option<&'s [u8]>,
{
    let indices: Vec<usize> = match reader.read_indices() {
        Some(indices) => indices.into_u32().map(|index| index as usize).collect(),
        None => (0..vertices).collect(),
    };
    let count = indices.len();
    match mode {
        Mode::Triangles => (0..count / 3).map(|i| [0, 1, 2].map(|corner| indices[3 * i + corner])).collect(),
        Mode::TriangleStrip => (0..count.saturating_sub(2))
            .map(|i| [i + i % 2, i + 1 - i % 2, i + 2].map(|corner| indices[corner]))
            .collect(),
        Mode::TriangleFan => {
            (0..count.saturating_sub(2)).map(|i| [0, i + 1, i + 2].map(|corner| indices[corner])).collect()
        }
        _ => Vec::new(),
    }
}

fn models(folder: &Path) -> Vec<PathBuf> {
    let folders = std::fs::read_dir(folder).expect("the corpus").flatten().map(|entry| entry.path());
    let files =
        folders.filter(|path| path.is_dir()).flat_map(|path| std::fs::read_dir(path).expect("a folder"));
    let mut models: Vec<PathBuf> = files.flatten().map(|entry| entry.path()).collect();
    models.retain(|path| path.extension().is_some_and(|ending| ending == "glb" || ending == "gltf"));
    models.sort();
    models
}

/// The files of the project's corpus that we read, and whose JSON the crate reads.
#[test]
fn files_are_what_gltf_reads() {
    let options = LoadOptions { keep_source: true, ..LoadOptions::default() };
    let mut compared = 0;
    for path in models(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus")) {
        let Ok(ours) = load(&path, &options) else { continue };
        let bytes = std::fs::read(&path).expect("a file");
        let Ok(theirs) = Gltf::from_slice_without_validation(&bytes) else { continue };
        // It takes quaternions of any length as they are.
        let is_turned = |rotation: [f32; 4]| {
            let length: f32 = rotation.iter().map(|value| value * value).sum();
            (length - 1.0).abs() < 1e-6
        };
        if !theirs.nodes().all(|node| is_turned(node.transform().decomposed().1)) {
            continue;
        }
        let source = ours.source.as_ref().expect("it was asked for");
        Both { theirs: &theirs, ours: &ours, source }.check();
        compared += 1;
    }
    assert!(compared >= 12, "the corpus is there: {compared} files");
}

/// A document of one mesh, in many of the ways that glTF allows.
#[derive(Clone, Debug)]
struct Drawn {
    positions: Vec<[f32; 3]>,
    choices: Vec<prop::sample::Index>,
    /// Of the indices; none for a primitive without.
    component: Option<u32>,
    mode: u32,
    stride: usize,
    offset: usize,
    sparse: bool,
    uv_component: u32,
    transform: Value,
    name: Option<String>,
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let number = prop_oneof![any::<f32>(), -100.0_f32..100.0, Just(0.0), Just(-0.0)];
    let small = || -1e3..1e3_f64;
    let transform = prop_oneof![
        Just(json!({})),
        prop::array::uniform12(small()).prop_map(|m| json!({"matrix":
            [m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, m[9], m[10], m[11], 1]})),
        (prop::array::uniform3(small()), prop::array::uniform4(0.1..1.0_f64), prop::array::uniform3(small()))
            .prop_map(|(translation, rotation, scale)| {
                let length = rotation.iter().map(|value| value * value).sum::<f64>().sqrt();
                let rotation = rotation.map(|value| value / length);
                json!({"translation": translation, "rotation": rotation, "scale": scale})
            }),
    ];
    (
        prop::collection::vec(prop::array::uniform3(number), 3..12),
        prop::collection::vec(any::<prop::sample::Index>(), 3..30),
        prop::sample::select(vec![None, Some(5121), Some(5123), Some(5125)]),
        prop::sample::select(vec![4_u32, 5, 6]),
        prop::sample::select(vec![12_usize, 16, 28, 252]),
        prop::sample::select(vec![0_usize, 4, 40]),
        any::<bool>(),
        prop::sample::select(vec![5121_u32, 5123, 5126]),
        transform,
        prop::option::of("[a-zé]{0,6}"),
    )
        .prop_map(
            |(positions, choices, component, mode, stride, offset, sparse, uv_component, transform, name)| {
                Drawn {
                    positions,
                    choices,
                    component,
                    mode,
                    stride,
                    offset,
                    sparse,
                    uv_component,
                    transform,
                    name,
                }
            },
        )
}

impl Drawn {
    fn doc(&self) -> Doc {
        let mut doc = Doc::square();
        let position = self.positions(&mut doc);
        let uv = self.uvs(&mut doc);
        let mut primitive = json!({"mode": self.mode, "attributes": {"POSITION": position, "TEXCOORD_0": uv, "NORMAL": position}});
        if let Some(component) = self.component {
            let size = match component {
                5121 => 1,
                5123 => 2,
                _ => 4,
            };
            let indices = self.choices.iter().map(|choice| choice.index(self.positions.len()) as u32);
            let bytes: Vec<u8> = indices.flat_map(|index| index.to_le_bytes()[..size].to_vec()).collect();
            primitive["indices"] = json!(doc.accessor(component, "SCALAR", self.choices.len(), &bytes));
        }
        *doc.primitive() = primitive;
        let mut node = self.transform.clone();
        node["mesh"] = json!(0);
        if let Some(name) = &self.name {
            node["name"] = json!(name);
        }
        doc.json["nodes"] = json!([{"children": [1]}, node]);
        doc
    }

    /// Interleaved with nothing, and perhaps with one value replaced.
    fn positions(&self, doc: &mut Doc) -> usize {
        let mut bytes = vec![0xff; self.offset];
        for position in &self.positions {
            let start = bytes.len();
            bytes.extend(position.iter().flat_map(|value| value.to_le_bytes()));
            bytes.resize(start + self.stride, 0xff);
        }
        let accessor = doc.accessor(5126, "VEC3", self.positions.len(), &bytes);
        let view = doc.json["accessors"][accessor]["bufferView"].as_u64().expect("a view") as usize;
        doc.json["bufferViews"][view]["byteStride"] = json!(self.stride);
        doc.json["accessors"][accessor]["byteOffset"] = json!(self.offset);
        if self.sparse {
            let (indices, values) = (doc.view(&[1, 0]), doc.view(&[0x40; 12]));
            doc.json["accessors"][accessor]["sparse"] = json!({"count": 1,
                "indices": {"bufferView": indices, "componentType": 5123}, "values": {"bufferView": values}});
        }
        accessor
    }

    fn uvs(&self, doc: &mut Doc) -> usize {
        let count = self.positions.len();
        let numbers = (0..2 * count).map(|number| number as u32 * 7919);
        let bytes: Vec<u8> = match self.uv_component {
            5121 => numbers.map(|number| number as u8).collect(),
            5123 => numbers.flat_map(|number| (number as u16).to_le_bytes()).collect(),
            _ => numbers.flat_map(|number| (number as f32 / 1000.0).to_le_bytes()).collect(),
        };
        let uv = doc.accessor(self.uv_component, "VEC2", count, &bytes);
        doc.json["accessors"][uv]["normalized"] = json!(self.uv_component != 5126);
        uv
    }
}

proptest! {
    #[test]
    fn every_mesh_is_what_gltf_reads(drawn in drawn()) {
        let glb = drawn.doc().glb();
        let theirs = Gltf::from_slice_without_validation(&glb).expect("glTF");
        let options = LoadOptions { keep_source: true, ..LoadOptions::default() };
        match load_from_slice("a.glb", &glb, &options) {
            Ok(ours) => {
                let source = ours.source.as_ref().expect("it was asked for");
                Both { theirs: &theirs, ours: &ours, source }.check();
            }
            Err(error) => prop_assert!(error.to_string().contains("nothing to draw"), "{}", error),
        }
    }

    /// Both of the crate's halves: it writes a container, it reads one.
    #[test]
    fn containers_are_what_gltf_reads(json in "[ -~]{1,40}", binary in prop::option::of(prop::collection::vec(any::<u8>(), 0..40))) {
        // A document that is shown whatever the chunk of the buffer holds.
        let mut text: Value = serde_json::from_slice(&square_without_chunk()).expect("JSON");
        text["extras"] = json!({"text": json});
        if let Some(binary) = &binary {
            let own = text["buffers"][0].take();
            text["buffers"] = json!([{"byteLength": binary.len()}, own]);
            for view in text["bufferViews"].as_array_mut().expect("a list") {
                view["buffer"] = json!(1);
            }
        }
        let header = gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 };
        let json = serde_json::to_vec(&text).expect("JSON").into();
        let glb = gltf::Glb { header, json, bin: binary.map(Into::into) }.to_vec().expect("memory takes it");
        let theirs = gltf::Glb::from_slice(&glb).expect("its own");
        let options = LoadOptions { keep_source: true, ..LoadOptions::default() };
        let ours = load_from_slice("a.glb", &glb, &options).expect("a square");
        let source = ours.source.expect("it was asked for");
        prop_assert_eq!(source.json().as_bytes(), &theirs.json[..]);
        if let Some(binary) = &theirs.bin {
            prop_assert_eq!(source.buffer(0), Some(&binary[..]));
        }
    }
}
