//! What the reading half of the `gltf` crate makes of files where it is wrong, and what we make
//! of them: the reasons why the product uses `gltf::json` alone. On good files that half is
//! an oracle (`gltf_oracle`).
//!
//! `gltf::binary` refuses containers that the specification allows, accepts some that it does
//! not, and says no place; `gltf::Gltf` and the readers of accessors panic on files that
//! their own validation lets through.

use std::panic::{AssertUnwindSafe, catch_unwind};

use gltf::Gltf;
use serde_json::{Value, json};

use crate::gltf::Doc;
use crate::{loaded, refused, warns_once};

/// What the crate makes of a file.
#[derive(Debug, PartialEq)]
enum Theirs {
    Reads,
    Refuses(String),
    Panics,
}

/// In release builds overflows wrap around instead.
const OVERFLOWS_PANIC: bool = cfg!(debug_assertions);

fn caught(read: impl FnOnce() -> Result<(), gltf::Error>) -> Theirs {
    match catch_unwind(AssertUnwindSafe(read)) {
        Ok(Ok(())) => Theirs::Reads,
        Ok(Err(error)) => Theirs::Refuses(error.to_string()),
        Err(_) => Theirs::Panics,
    }
}

fn container(bytes: &[u8]) -> Theirs {
    caught(|| Gltf::from_slice_without_validation(bytes).map(|_| ()))
}

/// With its own validation, and all positions and indices.
fn everything(bytes: &[u8]) -> Theirs {
    caught(|| {
        let gltf = Gltf::from_slice(bytes)?;
        for primitive in gltf.meshes().flat_map(|mesh| mesh.primitives()) {
            let reader = primitive.reader(|_| gltf.blob.as_deref());
            reader.read_positions().into_iter().flatten().for_each(drop);
            reader.read_indices().into_iter().flat_map(|indices| indices.into_u32()).for_each(drop);
        }
        Ok(())
    })
}

const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// A GLB of any chunks, padded to four bytes with one byte.
fn glb_of(chunks: &[(u32, &[u8])], padding: u8) -> Vec<u8> {
    let mut body = Vec::new();
    for (kind, data) in chunks {
        let length = data.len().next_multiple_of(4);
        body.extend((length as u32).to_le_bytes());
        body.extend(kind.to_le_bytes());
        body.extend(*data);
        body.extend(std::iter::repeat_n(padding, length - data.len()));
    }
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend((body.len() as u32 + 12).to_le_bytes());
    glb.extend(body);
    glb
}

/// The chunks of a square.
fn square() -> (Vec<u8>, Vec<u8>) {
    let glb = Doc::square().glb();
    let glb = gltf::Glb::from_slice(&glb).expect("a GLB");
    (glb.json.into_owned(), glb.bin.expect("a binary chunk").into_owned())
}

/// A square whose buffer is in its JSON.
pub(crate) fn square_without_chunk() -> Vec<u8> {
    let mut doc = Doc::square();
    let hex: String = doc.bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    doc.json["buffers"] = json!([{"byteLength": doc.bytes.len(), "uri": format!("data:,{hex}")}]);
    serde_json::to_vec(&doc.json).expect("JSON")
}

/// The specification wants unknown chunks ignored (4.4.3.1).
#[test]
fn gltf_binary_refuses_chunks_of_extensions() {
    let (json, binary) = square();
    let glb = glb_of(&[(JSON, &json), (0x1234_5678, b"skip"), (BIN, &binary)], b' ');
    assert_eq!(container(&glb), Theirs::Refuses("unknown chunk type".into()), "theirs");
    assert_eq!(loaded("a.glb", &glb).warnings, [], "ours");
}

/// It looks for a chunk there, and finds half of one.
#[test]
fn gltf_binary_refuses_bytes_after_the_end() {
    let mut glb = glb_of(&[(JSON, &square_without_chunk())], b' ');
    glb.push(b'\n');
    assert_eq!(container(&glb), Theirs::Refuses("failed to fill whole buffer".into()), "theirs");
    warns_once(&loaded("a.glb", &glb), "1 bytes after the declared end are ignored");
}

/// Some exporters do so.
#[test]
fn gltf_binary_refuses_json_padded_with_zeros() {
    let (mut json, binary) = square();
    json.push(b' ');
    let glb = glb_of(&[(JSON, &json), (BIN, &binary)], 0);
    let Theirs::Refuses(message) = container(&glb) else { panic!("it is refused") };
    assert!(message.starts_with("trailing characters"), "theirs: {message}");
    assert_eq!(loaded("a.glb", &glb).warnings, [], "ours");
}

#[test]
fn gltf_binary_overflows_on_a_length_below_that_of_the_header() {
    let mut glb = Doc::square().glb();
    glb[8..12].copy_from_slice(&11_u32.to_le_bytes());
    let wrapped = Theirs::Refuses("could not completely read the object".into());
    assert_eq!(container(&glb), if OVERFLOWS_PANIC { Theirs::Panics } else { wrapped }, "theirs");
    assert!(refused("a.glb", &glb).contains("byte 8: the length in the header is 11"), "ours");
}

#[test]
fn gltf_binary_reads_beyond_the_declared_end() {
    let mut glb = Doc::square().glb();
    let declared = glb.len() as u32 - 4;
    glb[8..12].copy_from_slice(&declared.to_le_bytes());
    assert_eq!(container(&glb), Theirs::Reads, "theirs");
    assert!(refused("a.glb", &glb).contains("a chunk claims"), "ours");
}

#[test]
fn gltf_binary_takes_no_notice_of_a_second_binary_chunk() {
    let (json, binary) = square();
    let glb = glb_of(&[(JSON, &json), (BIN, &binary), (BIN, &binary)], b' ');
    assert_eq!(container(&glb), Theirs::Reads, "theirs");
    assert!(refused("a.glb", &glb).contains("there is a second binary chunk"), "ours");
}

/// Both refuse these; ours says where.
#[test]
fn both_refuse_broken_containers() {
    let (json, _) = square();
    for (what, glb, place) in [
        ("version 1", b"glTF\x01\0\0\0\x0c\0\0\0".to_vec(), "byte 4"),
        ("no chunks", glb_of(&[], 0), "byte 12"),
        ("empty JSON", glb_of(&[(JSON, b"")], 0), "byte 12"),
        ("binary first", glb_of(&[(BIN, b"data"), (JSON, &json)], b' '), "byte 12"),
        ("no GLB", b"glTG\x02\0\0\0\x0c\0\0\0".to_vec(), ""),
    ] {
        assert!(matches!(container(&glb), Theirs::Refuses(_)), "{what}: {:?}", container(&glb));
        assert!(refused("a.glb", &glb).contains(place), "{what}: {}", refused("a.glb", &glb));
    }
    let good = Doc::square().glb();
    for length in 4..good.len() {
        let glb = &good[..length];
        assert!(matches!(container(glb), Theirs::Refuses(_)), "{length} bytes: {:?}", container(glb));
        refused("a.glb", glb);
    }
}

/// A square that the crate's validation takes: it wants bounds of positions.
fn bounded() -> Doc {
    let mut doc = Doc::square();
    doc.json["accessors"][0]["min"] = json!([0, 0, 0]);
    doc.json["accessors"][0]["max"] = json!([1, 1, 0]);
    doc
}

/// What the crate does with a changed square, and what our message says.
fn changed(pointer: &str, value: Value) -> (Theirs, String) {
    let mut doc = bounded();
    *doc.json.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer} is there")) = value;
    (everything(&doc.glb()), doc.refused())
}

#[test]
fn gltf_reads_a_sound_file() {
    assert_eq!(everything(&bounded().glb()), Theirs::Reads, "so the rest is not for another reason");
}

/// The validation itself follows the reference that it is about to check.
#[test]
fn gltf_validation_panics_on_positions_that_lead_nowhere() {
    let (theirs, ours) = changed("/meshes/0/primitives/0/attributes/POSITION", json!(9));
    assert_eq!(theirs, Theirs::Panics, "theirs");
    assert!(ours.contains("accessor 9 does not exist"), "ours: {ours}");
}

#[test]
fn gltf_panics_on_elements_that_overlap() {
    let mut doc = bounded();
    doc.json["bufferViews"][0]["byteStride"] = json!(4);
    assert_eq!(everything(&doc.glb()), Theirs::Panics, "theirs");
    assert!(doc.refused().contains("elements of 12 bytes are only 4 bytes apart"), "ours");
}

#[test]
fn gltf_panics_on_indices_that_are_no_integers() {
    let (theirs, ours) = changed("/meshes/0/primitives/0/indices", json!(0));
    assert_eq!(theirs, Theirs::Panics, "theirs");
    assert!(ours.contains("accessor 0"), "ours: {ours}");
}

#[test]
fn gltf_overflows_on_accessors_without_elements() {
    let (theirs, ours) = changed("/accessors/0/count", json!(0));
    assert_eq!(theirs, if OVERFLOWS_PANIC { Theirs::Panics } else { Theirs::Reads }, "theirs");
    assert!(ours.contains("its count is 0"), "ours: {ours}");
}

/// In release builds it reads numbers that are none of the file's positions.
#[test]
fn gltf_takes_the_type_of_positions_on_trust() {
    let (theirs, ours) = changed("/accessors/0/type", json!("VEC2"));
    assert_eq!(theirs, if OVERFLOWS_PANIC { Theirs::Panics } else { Theirs::Reads }, "theirs");
    assert!(ours.contains("its type must be VEC3"), "ours: {ours}");
}

#[test]
fn gltf_passes_on_indices_that_lead_nowhere() {
    let mut doc = bounded();
    let last = doc.bytes.len() - 1;
    doc.bytes[last] = 200;
    assert_eq!(everything(&doc.glb()), Theirs::Reads, "theirs");
    assert!(doc.refused().contains("index 200 does not exist"), "ours");
}

/// It returns nothing, as for a primitive that has no positions.
#[test]
fn gltf_says_nothing_of_views_outside_their_buffer() {
    let (theirs, ours) = changed("/bufferViews/0/byteLength", json!(4_000_000_000_u32));
    assert_eq!(theirs, Theirs::Reads, "theirs");
    assert!(ours.contains("lie outside buffer 0"), "ours: {ours}");
}

/// Whoever walks the tree walks for ever.
#[test]
fn gltf_validation_lets_nodes_hang_on_themselves() {
    let (theirs, ours) = changed("/nodes", json!([{"mesh": 0, "children": [1]}, {"children": [1]}]));
    assert_eq!(theirs, Theirs::Reads, "theirs");
    assert!(ours.contains("node"), "ours: {ours}");
}

/// Exporters leave them out, and KHR_mesh_quantization is common.
#[test]
fn gltf_validation_refuses_files_that_can_be_shown() {
    let plain = Doc::square();
    assert!(matches!(everything(&plain.glb()), Theirs::Refuses(_)), "positions without bounds");
    assert_eq!(plain.load().warnings, [], "ours");
    let mut quantized = bounded();
    quantized.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    quantized.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert!(matches!(everything(&quantized.glb()), Theirs::Refuses(_)), "an extension");
    assert_eq!(quantized.load().warnings, [], "ours");
}

#[test]
fn gltf_rounds_node_transforms() {
    let mut doc = bounded();
    doc.json["nodes"][0]["translation"] = json!([10_000_000.001, 0, 0]);
    let theirs = Gltf::from_slice(&doc.glb()).expect("glTF");
    let (translation, ..) = theirs.nodes().next().expect("a node").transform().decomposed();
    assert_eq!(f64::from(translation[0]), 10_000_000.0, "a millimetre is lost");
    let ours = doc.load();
    let (_, node) = ours.scene.nodes().iter().next().expect("a node");
    assert_eq!(node.transform.translation().x, 10_000_000.001, "ours");
}

/// It multiplies by the rounded reciprocal of 255 (or 65 535) instead of dividing.
#[test]
fn gltf_rounds_normalized_integers_twice() {
    let wrong =
        |values: Vec<(f32, f32)>| values.into_iter().filter(|(theirs, exact)| theirs != exact).count();
    let bytes = (0..=255_u8).map(|value| (f32::from(value) * 255_f32.recip(), f32::from(value) / 255.0));
    assert_eq!(wrong(bytes.collect()), 126, "of 256 bytes");
    let mut doc = bounded();
    let colors = doc.accessor(5121, "VEC4", 4, &[1, 2, 3, 255].repeat(4));
    doc.json["accessors"][colors]["normalized"] = json!(true);
    doc.primitive()["attributes"]["COLOR_0"] = json!(colors);
    let theirs = Gltf::from_slice(&doc.glb()).expect("glTF");
    let primitive = theirs.meshes().next().expect("a mesh").primitives().next().expect("a primitive");
    let read = primitive.reader(|_| theirs.blob.as_deref()).read_colors(0).expect("colours");
    let first = read.into_rgba_f32().next().expect("a colour");
    assert_ne!(first, [1.0, 2.0, 3.0, 255.0].map(|value: f32| value / 255.0), "theirs");
    let ours = doc.load();
    let colors = crate::meshes(&ours)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors[0].to_array(), [1.0, 2.0, 3.0, 255.0].map(|value: f32| value / 255.0), "ours");
}
