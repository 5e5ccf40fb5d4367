//! How the files of the rows are made: a sound square to start from, what can
//! stand on it, and GLB chunks by hand.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

use crate::gltf::{Doc, push};

pub(super) const JSON_CHUNK: u32 = 0x4e4f_534a;
pub(super) const BIN_CHUNK: u32 = 0x004e_4942;

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
const IHDR: &[u8] = b"\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0\x90\x77\x53\xde";
/// A gamma of 1.8, as old Macintosh images have.
const GAMMA: &[u8] = b"\0\0\0\x04gAMA\x00\x00\xd9\x04\xdc\xb2\xda\x02";
const IDAT: &[u8] = b"\0\0\0\x0cIDAT\x78\xda\x63\xf8\xcf\xc0\0\0\x03\x01\x01\0\xf7\x03\x41\x43";
const IEND: &[u8] = b"\0\0\0\0IEND\xae\x42\x60\x82";
/// One red texel without loss.
pub(super) const WEBP: &[u8] = b"RIFF\x16\0\0\0WEBPVP8L\x0a\0\0\0\x2f\x00\x00\x00\x00\x88\xfe\x47\xff\x03";

/// A PNG of one red texel.
pub(super) fn png() -> Vec<u8> {
    [SIGNATURE, IHDR, IDAT, IEND].concat()
}

pub(super) fn png_with_gamma() -> Vec<u8> {
    [SIGNATURE, IHDR, GAMMA, IDAT, IEND].concat()
}

pub(super) fn png_without_data() -> Vec<u8> {
    [SIGNATURE, IHDR].concat()
}

/// Its header is two bytes longer than a header is.
pub(super) fn png_with_long_header() -> Vec<u8> {
    let mut bytes = png();
    bytes[SIGNATURE.len() + 3] += 2;
    bytes
}

/// The square, in a scene, with all that the validator wants of it.
pub(super) fn square() -> Doc {
    let mut doc = Doc::square();
    doc.json["accessors"][0]["min"] = json!([0, 0, 0]);
    doc.json["accessors"][0]["max"] = json!([1, 1, 0]);
    doc.json["bufferViews"][0]["target"] = json!(34962);
    doc.json["bufferViews"][1]["target"] = json!(34963);
    doc.json["scenes"] = json!([{"nodes": [0]}]);
    doc.json["scene"] = json!(0);
    doc
}

/// The document as JSON with its bytes in it.
pub(super) fn gltf(doc: &Doc) -> Vec<u8> {
    gltf_with_uri(doc, &data_uri("application/octet-stream", &doc.bytes))
}

/// The document as JSON whose buffer is elsewhere.
pub(super) fn gltf_with_uri(doc: &Doc, uri: &str) -> Vec<u8> {
    let mut json = doc.json.clone();
    json["buffers"] = json!([{"byteLength": doc.bytes.len(), "uri": uri}]);
    text(&json)
}

pub(super) fn text(json: &Value) -> Vec<u8> {
    serde_json::to_vec(json).expect("JSON")
}

/// A GLB of chunks as they are, with a length that fits.
pub(super) fn container(chunks: &[(u32, &[u8])]) -> Vec<u8> {
    let mut body = Vec::new();
    for (kind, data) in chunks {
        body.extend((data.len() as u32).to_le_bytes());
        body.extend(kind.to_le_bytes());
        body.extend(*data);
    }
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((body.len() as u32 + 12).to_le_bytes());
    bytes.extend(body);
    bytes
}

/// The two chunks of the square, to be put together wrongly: JSON and bytes.
pub(super) fn chunks() -> (Vec<u8>, Vec<u8>) {
    let doc = square();
    let mut json = doc.json.clone();
    json["buffers"] = json!([{"byteLength": doc.bytes.len()}]);
    let mut json = text(&json);
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = doc.bytes;
    binary.resize(binary.len().next_multiple_of(4), 0);
    (json, binary)
}

/// The square's node.
pub(super) fn node(doc: &mut Doc) -> &mut Value {
    &mut doc.json["nodes"][0]
}

/// An attribute of the square.
pub(super) fn attribute(doc: &mut Doc, name: &str, accessor: usize) {
    doc.primitive()["attributes"][name] = json!(accessor);
}

/// Floats as an attribute of the square.
pub(super) fn floats(doc: &mut Doc, name: &str, kind: &str, values: &[f32]) -> usize {
    let accessor = doc.floats(kind, values);
    attribute(doc, name, accessor);
    accessor
}

/// Normals that point at the viewer.
pub(super) fn normals(doc: &mut Doc) {
    floats(doc, "NORMAL", "VEC3", &[0., 0., 1.].repeat(4));
}

/// Texture coordinates.
pub(super) fn uv(doc: &mut Doc) {
    floats(doc, "TEXCOORD_0", "VEC2", &[0., 1., 1., 1., 1., 0., 0., 0.]);
}

/// A material on the square.
pub(super) fn material(doc: &mut Doc, material: Value) {
    let index = push(&mut doc.json["materials"], material);
    doc.primitive()["material"] = json!(index);
}

/// A material with an extension.
pub(super) fn extended(doc: &mut Doc, name: &str, extension: Value) {
    uses(doc, &[name]);
    material(doc, json!({"extensions": {name: extension}}));
}

pub(super) fn uses(doc: &mut Doc, names: &[&str]) {
    for name in names {
        push(&mut doc.json["extensionsUsed"], json!(name));
    }
}

/// A texture of a file in the buffer; returns its index.
pub(super) fn texture(doc: &mut Doc, file: &[u8], mime_type: &str) -> usize {
    let view = doc.view(file);
    let image = push(&mut doc.json["images"], json!({"bufferView": view, "mimeType": mime_type}));
    push(&mut doc.json["textures"], json!({"source": image}))
}

/// The square with a texture as its colour.
pub(super) fn textured(doc: &mut Doc, file: &[u8], mime_type: &str) {
    uv(doc);
    let index = texture(doc, file, mime_type);
    material(doc, json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": index}}}));
}

/// The square with a texture whose sampler is this.
pub(super) fn sampled(doc: &mut Doc, sampler: Value) {
    textured(doc, &png(), "image/png");
    doc.json["samplers"] = json!([sampler]);
    doc.json["textures"][0]["sampler"] = json!(0);
}

/// A JSON file whose texture is at a URI.
pub(super) fn with_image_uri(uri: &str) -> Vec<u8> {
    let mut doc = square();
    textured(&mut doc, &png(), "image/png");
    doc.json["images"] = json!([{"uri": uri}]);
    gltf(&doc)
}

/// The square with a normal map.
pub(super) fn with_normal_map(doc: &mut Doc) {
    normals(doc);
    uv(doc);
    let index = texture(doc, &png(), "image/png");
    material(doc, json!({"normalTexture": {"index": index}}));
}

/// Tangents, with a sign of their own.
pub(super) fn tangents(doc: &mut Doc, sign: f32) {
    floats(doc, "TANGENT", "VEC4", &[1., 0., 0., sign].repeat(4));
}

/// The square follows one joint, node 1.
pub(super) fn skin(doc: &mut Doc) {
    weights(doc, &[0, 0, 0, 0], &[1., 0., 0., 0.]);
    node(doc)["skin"] = json!(0);
    push(&mut doc.json["nodes"], json!({"name": "joint"}));
    doc.json["scenes"][0]["nodes"] = json!([0, 1]);
    doc.json["skins"] = json!([{"joints": [1]}]);
}

/// Joints and weights that all vertices share.
pub(super) fn weights(doc: &mut Doc, joints: &[u8; 4], weights: &[f32; 4]) {
    let joints = doc.accessor(5121, "VEC4", 4, &joints.repeat(4));
    attribute(doc, "JOINTS_0", joints);
    floats(doc, "WEIGHTS_0", "VEC4", &weights.repeat(4));
}

/// An identity, with one number changed.
pub(super) fn bind_matrix(at: usize, value: f32) -> [f32; 16] {
    let mut matrix = [0.0; 16];
    (0..4).for_each(|index| matrix[5 * index] = 1.0);
    matrix[at] = value;
    matrix
}

/// The skin's bind matrix.
pub(super) fn bound(doc: &mut Doc, matrix: &[f32]) -> usize {
    let accessor = doc.floats("MAT4", matrix);
    doc.json["skins"][0]["inverseBindMatrices"] = json!(accessor);
    accessor
}

/// A morph target that lifts the square; returns its accessor.
pub(super) fn target(doc: &mut Doc) -> usize {
    let deltas = doc.floats("VEC3", &[0., 0., 1.].repeat(4));
    doc.json["accessors"][deltas]["min"] = json!([0, 0, 1]);
    doc.json["accessors"][deltas]["max"] = json!([0, 0, 1]);
    push(&mut doc.primitive()["targets"], json!({"POSITION": deltas}));
    deltas
}

/// Times with their bounds.
pub(super) fn times(doc: &mut Doc, values: &[f32]) -> usize {
    let accessor = doc.floats("SCALAR", values);
    let finite = values.iter().copied();
    doc.json["accessors"][accessor]["min"] = json!([finite.clone().fold(f32::MAX, f32::min)]);
    doc.json["accessors"][accessor]["max"] = json!([finite.fold(f32::MIN, f32::max)]);
    accessor
}

/// An animation of the square's node with one channel.
pub(super) fn animate(doc: &mut Doc, path: &str, input: usize, output: usize) {
    doc.json["animations"] = json!([{"samplers": [{"input": input, "output": output}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}]}]);
}

/// An animation that moves the square's node for a second.
pub(super) fn moved(doc: &mut Doc) {
    let (input, output) = (times(doc, &[0., 1.]), doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]));
    animate(doc, "translation", input, output);
}

/// An animation that turns the square's node, from none to a rotation.
pub(super) fn turned(doc: &mut Doc, to: [f32; 4]) {
    let input = times(doc, &[0., 1.]);
    let output = doc.floats("VEC4", &[[0., 0., 0., 1.], to].concat());
    animate(doc, "rotation", input, output);
}

/// The view of an accessor.
pub(super) fn view(doc: &mut Doc, accessor: usize) -> &mut Value {
    let view = doc.json["accessors"][accessor]["bufferView"].as_u64().expect("a view");
    &mut doc.json["bufferViews"][view as usize]
}

/// Texture coordinates of which sparse ones replace some: first the indices
/// into them, then one pair for each.
pub(super) fn sparse(doc: &mut Doc, indices: &[u8]) -> usize {
    uv(doc);
    let values: Vec<u8> = (0..2 * indices.len()).flat_map(|_| 0.5_f32.to_le_bytes()).collect();
    let (at, values) = (doc.view(indices), doc.view(&values));
    let sparse = json!({"count": indices.len(), "indices": {"bufferView": at, "componentType": 5121},
        "values": {"bufferView": values}});
    let accessor = push(
        &mut doc.json["accessors"],
        json!({"componentType": 5126, "type": "VEC2", "count": 4, "sparse": sparse}),
    );
    attribute(doc, "TEXCOORD_0", accessor);
    accessor
}

/// A camera on a node of its own.
pub(super) fn camera(doc: &mut Doc, camera: Value) {
    doc.json["cameras"] = json!([camera]);
    let index = push(&mut doc.json["nodes"], json!({"camera": 0}));
    push(&mut doc.json["scenes"][0]["nodes"], json!(index));
}

pub(super) fn orthographic(doc: &mut Doc, xmag: f64, ymag: f64, zfar: f64) {
    let projection = json!({"xmag": xmag, "ymag": ymag, "znear": 1, "zfar": zfar});
    camera(doc, json!({"type": "orthographic", "orthographic": projection}));
}

/// A light on a node of its own.
pub(super) fn light(doc: &mut Doc, light: Value) {
    uses(doc, &["KHR_lights_punctual"]);
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
    let node = json!({"extensions": {"KHR_lights_punctual": {"light": 0}}});
    let index = push(&mut doc.json["nodes"], node);
    push(&mut doc.json["scenes"][0]["nodes"], json!(index));
}

/// An animation whose only channel has the target, with a pointer of
/// KHR_animation_pointer besides.
pub(super) fn point(doc: &mut Doc, mut target: Value) {
    moved(doc);
    uses(doc, &["KHR_animation_pointer"]);
    target["extensions"] = json!({"KHR_animation_pointer": {"pointer": "/nodes/0/translation"}});
    doc.json["animations"][0]["channels"][0]["target"] = target;
}

/// Texture coordinates of a second set.
pub(super) fn second_uv(doc: &mut Doc) {
    floats(doc, "TEXCOORD_1", "VEC2", &[0.5; 8]);
}

pub(super) fn data_uri(mime_type: &str, bytes: &[u8]) -> String {
    format!("data:{mime_type};base64,{}", BASE64_STANDARD.encode(bytes))
}
