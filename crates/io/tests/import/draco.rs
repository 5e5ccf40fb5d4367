//! KHR_draco_mesh_compression: what glTF-Transform compressed, against the same model uncompressed; what
//! happens to streams that do not fit their document; and files that are saved again.

use serde_json::json;
use trigon_io::{LoadErrorKind, LoadOptions, Loaded, load_from_slice};
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::Mesh;
use trigon_modelling::{EditMesh, VertexId};

use crate::gltf::{Doc, push};
use crate::saving::{doc_of, document, json_of, put, saved};
use crate::{loaded, meshes, warnings};

const DRACO: &str = "KHR_draco_mesh_compression";

fn file(name: &str) -> Vec<u8> {
    let path = format!("{}/tests/draco/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A corner of a triangle with everything that it has.
#[derive(Clone, Copy, Debug)]
struct Corner {
    position: Vec3,
    normal: Vec3,
    uv: Vec2,
    color: Vec4,
    /// The weight of joint 1.
    weight: f32,
    material: u32,
}

fn corners(mesh: &Mesh) -> Vec<Corner> {
    let attributes = mesh.attributes();
    let corner = |(corner, &vertex): (usize, &u32)| Corner {
        position: mesh.positions()[vertex as usize],
        normal: attributes.corner_normals.as_ref().map_or(Vec3::ZERO, |normals| normals[corner]),
        uv: attributes.uv_sets.first().map_or(Vec2::ZERO, |set| set[corner]),
        color: attributes.corner_colors.as_ref().map_or(Vec4::ONE, |colors| colors[corner]),
        weight: attributes.skin.as_ref().map_or(0.0, |skin| {
            let of_vertex = skin.influences(vertex as usize);
            of_vertex.filter(|(joint, _)| *joint == 1).map(|(_, weight)| weight).sum()
        }),
        material: attributes.face_materials.as_ref().map_or(0, |materials| materials[corner / 3]),
    };
    mesh.corner_vertices().iter().enumerate().map(corner).collect()
}

/// Coarser than any precision of the compressed files.
const STEP: f32 = 0.01;

fn is_close(a: &Corner, b: &Corner) -> bool {
    a.position.distance(b.position) < STEP
        && a.normal.distance(b.normal) < 2.0 * STEP
        && a.uv.distance(b.uv) < STEP
        && (a.color - b.color).abs().max_element() < STEP
        && (a.weight - b.weight).abs() < STEP
        && a.material == b.material
}

/// Asserts that two meshes have the same triangles, in any order and from any corner on.
fn assert_same_triangles(name: &str, found: &Mesh, expected: &Mesh) {
    let (found, expected) = (corners(found), corners(expected));
    assert_eq!(found.len(), expected.len(), "{name}");
    let mut left: Vec<&[Corner]> = found.chunks(3).collect();
    for triangle in expected.chunks(3) {
        let is_same = |other: &&[Corner]| {
            (0..3).any(|turn| (0..3).all(|k| is_close(&other[(k + turn) % 3], &triangle[k])))
        };
        let place =
            left.iter().position(is_same).unwrap_or_else(|| panic!("{name}: {triangle:?} is missing"));
        left.swap_remove(place);
    }
}

/// Asserts that a file shows what the uncompressed one shows.
fn assert_shows_plain(name: &str, found: &Loaded) {
    let plain = loaded("plain.glb", &file("plain.glb"));
    let (found, expected) = (meshes(found), meshes(&plain));
    assert_eq!(found.len(), expected.len(), "{name}");
    for (found, expected) in found.into_iter().zip(expected) {
        assert_same_triangles(name, found, expected);
    }
}

#[test]
fn compressed_models_show_what_was_compressed() {
    for name in ["edgebreaker.glb", "sequential.glb", "fast.glb", "small.glb"] {
        let found = loaded(name, &file(name));
        assert_shows_plain(name, &found);
        assert_eq!(warnings(&found), [""; 0], "{name}");
        assert_eq!(found.scene.skins.len(), 1, "{name}");
    }
}

/// Colours are bytes, and lossless.
#[test]
fn values_that_are_not_quantized_are_exact() {
    let (found, plain) =
        (loaded("sequential.glb", &file("sequential.glb")), loaded("plain.glb", &file("plain.glb")));
    let colors = |model: &Loaded| {
        let mut colors: Vec<[u32; 4]> = meshes(model)[0]
            .attributes()
            .corner_colors
            .iter()
            .flatten()
            .map(|color| color.to_array().map(f32::to_bits))
            .collect();
        colors.sort_unstable();
        colors
    };
    assert!(colors(&found) == colors(&plain), "the same bits");
}

/// The bytes of a view.
fn bytes_of(doc: &Doc, view: u64) -> Vec<u8> {
    let view = &doc.json["bufferViews"][view as usize];
    let number = |name: &str| view[name].as_u64().unwrap_or(0) as usize;
    doc.bytes[number("byteOffset")..][..number("byteLength")].to_vec()
}

/// The model compressed, and beside it the accessors of the plain one.
fn with_plain_form() -> Doc {
    let (mut doc, packed) = (doc_of(&file("plain.glb")), doc_of(&file("edgebreaker.glb")));
    for mesh in 0..2 {
        for primitive in 0..if mesh == 0 { 2 } else { 1 } {
            let path = format!("/meshes/{mesh}/primitives/{primitive}");
            let mut stream = packed.json.pointer(&path).expect("it is there")["extensions"][DRACO].clone();
            let bytes = bytes_of(&packed, stream["bufferView"].as_u64().expect("a view"));
            stream["bufferView"] = json!(doc.view(&bytes));
            doc.json.pointer_mut(&path).expect("it is there")["extensions"] = json!({DRACO: stream});
        }
    }
    doc.json["extensionsUsed"] = json!([DRACO]);
    doc
}

/// Breaks the stream of the first primitive.
fn break_stream(doc: &mut Doc) {
    let view = doc.primitive()["extensions"][DRACO]["bufferView"].as_u64().expect("a view") as usize;
    let start = doc.json["bufferViews"][view]["byteOffset"].as_u64().expect("an offset") as usize;
    doc.bytes[start] = b'X';
}

#[test]
fn a_broken_stream_gives_way_to_the_plain_form_with_a_warning() {
    let mut doc = with_plain_form();
    assert_eq!(warnings(&doc.load()), [""; 0], "as long as it is sound");
    break_stream(&mut doc);
    let found = doc.load();
    assert_shows_plain("broken", &found);
    let all = warnings(&found);
    assert!(all.len() == 1 && all[0].contains("mesh 0, primitive 0") && all[0].contains("Draco"), "{all:?}");
}

#[test]
fn a_broken_stream_without_a_plain_form_is_refused_by_name() {
    let mut doc = doc_of(&file("edgebreaker.glb"));
    break_stream(&mut doc);
    let message = doc.refused();
    assert!(
        message.contains("mesh 0, primitive 0") && message.contains("Draco data are invalid"),
        "{message}"
    );
    let mut doc = doc_of(&file("edgebreaker.glb"));
    let view = doc.primitive()["extensions"][DRACO]["bufferView"].as_u64().expect("a view") as usize;
    let start = doc.json["bufferViews"][view]["byteOffset"].as_u64().expect("an offset") as usize;
    doc.bytes[start + 6] = 1;
    let error = load_from_slice("a.glb", &doc.glb(), &LoadOptions::default()).expect_err("another version");
    assert_eq!(error.kind, LoadErrorKind::Unsupported, "{error}");
}

#[test]
fn descriptions_that_do_not_fit_the_stream_are_told() {
    let refused = |change: &dyn Fn(&mut Doc), word: &str| {
        let mut doc = doc_of(&file("edgebreaker.glb"));
        change(&mut doc);
        let message = doc.refused();
        assert!(message.contains(word), "{word}: {message}");
    };
    let stream = |doc: &mut Doc, member: &str, value: serde_json::Value| {
        doc.primitive()["extensions"][DRACO][member] = value;
    };
    refused(&|doc| stream(doc, "bufferView", json!(99)), "bufferView 99");
    refused(&|doc| stream(doc, "attributes", json!(3)), "not described");
    refused(&|doc| stream(doc, "attributes", json!({"POSITION": 7})), "attribute 7");
    refused(&|doc| stream(doc, "attributes", json!({"POSITION": 2})), "components");
    let warned = |change: &dyn Fn(&mut Doc), word: &str| {
        let mut doc = doc_of(&file("edgebreaker.glb"));
        change(&mut doc);
        let found = doc.load();
        let all = warnings(&found);
        assert!(all.len() == 1 && all[0].contains(word), "{word}: {all:?}");
        assert_shows_plain(word, &found);
    };
    warned(&|doc| doc.json["accessors"][1]["count"] = json!(80), "should have 80 values");
    warned(&|doc| doc.json["accessors"][0]["count"] = json!(3), "should have 3 indices");
    warned(&|doc| doc.primitive()["mode"] = json!(0), "mode");
}

/// Exporters share accessors that read alike; each stream has its own values.
#[test]
fn an_accessor_of_two_streams_has_the_values_of_each() {
    let mut doc = doc_of(&file("edgebreaker.glb"));
    let mut second = doc.json["meshes"][0]["primitives"][1].clone();
    let stream = &mut second["extensions"][DRACO]["bufferView"];
    let mut bytes = bytes_of(&doc, stream.as_u64().expect("a view"));
    // The smallest position of the cube is stored as it is.
    let words = |numbers: [f32; 3]| numbers.map(f32::to_le_bytes).concat();
    let smallest = words([-1.0, -1.0, 2.0]);
    let at = bytes.windows(12).position(|window| window == smallest).expect("it is there");
    bytes[at..at + 12].copy_from_slice(&words([-1.0, -1.0, 12.0]));
    *stream = json!(doc.view(&bytes));
    push(&mut doc.json["meshes"][0]["primitives"], second);
    let found = doc.load();
    let mesh = meshes(&found)[0];
    assert_eq!(mesh.face_count(), 152, "the surface and two cubes");
    let high = mesh.positions().iter().filter(|position| position.z > 11.5).count();
    assert_eq!((high, mesh.vertex_count()), (8, 81 + 2 * 8), "one of them is ten higher");
}

/// Attributes that are not in the stream are read from their accessors, in the order of the stream's vertices (each
/// vertex of the surface has a place of its own); and primitives without a stream stand beside those that have one.
#[test]
fn plain_attributes_and_primitives_stand_beside_a_stream() {
    for name in ["edgebreaker.glb", "sequential.glb"] {
        let mut doc = doc_of(&file(name));
        let surface = meshes(&doc.load())[0].positions()[..81].to_vec();
        let coordinates: Vec<f32> = surface.iter().flat_map(|place| [place.x, place.y]).collect();
        let beside = doc.floats("VEC2", &coordinates);
        doc.primitive()["attributes"]["TEXCOORD_1"] = json!(beside);
        let plain = doc.floats("VEC3", &[7.0, 0.0, 0.0, 9.0, 0.0, 0.0, 7.0, 5.0, 0.0]);
        push(&mut doc.json["meshes"][0]["primitives"], json!({"attributes": {"POSITION": plain}}));
        let found = doc.load();
        assert_eq!(warnings(&found), [""; 0], "{name}");
        let mesh = meshes(&found)[0];
        assert_eq!(mesh.face_count(), 128 + 12 + 1, "{name}: the surface, the cube and a plain triangle");
        let uvs = mesh.attributes().uv_sets.get(1).unwrap_or_else(|| panic!("{name}: a second set"));
        for (corner, &vertex) in mesh.corner_vertices()[..3 * 128].iter().enumerate() {
            let place = mesh.positions()[vertex as usize];
            assert_eq!(uvs[corner], Vec2::new(place.x, place.y), "{name}: corner {corner}");
        }
        let high = mesh.positions().iter().filter(|place| place.x == 9.0).count();
        assert_eq!(high, 1, "{name}: the corner of the plain triangle");
    }
}

#[test]
fn compressed_meshes_that_nobody_touches_stay_compressed() {
    let bytes = file("edgebreaker.glb");
    let (first, warned) = document("a.glb", &bytes);
    assert_eq!(warned, [], "nothing to warn of");
    let again = saved(&first);
    let (was, now) = (doc_of(&bytes), doc_of(&again));
    let mut expected = was.json.clone();
    expected["buffers"][0]["byteLength"] = now.json["buffers"][0]["byteLength"].clone();
    assert_eq!(now.json, expected, "the whole document");
    assert_eq!(now.bytes[..was.bytes.len()], was.bytes, "every byte");
}

#[test]
fn edited_meshes_are_written_uncompressed_and_the_others_stay() {
    let bytes = file("edgebreaker.glb");
    let (mut first, _) = document("a.glb", &bytes);
    let ids: Vec<_> = first.scene.meshes().iter().map(|(id, asset)| (id, asset.mesh().clone())).collect();
    let packed = |json: &serde_json::Value| json.to_string().matches(DRACO).count();
    // Two primitives of one mesh, one of the other, and the two lists of extensions.
    assert_eq!(packed(&json_of(&bytes)), 5, "all are compressed");
    for (number, left) in [(1, 4), (0, 0)] {
        let (id, mesh) = &ids[number];
        let (mut editable, _) = EditMesh::from_mesh(mesh);
        editable.set_position(VertexId::new(0), Vec3::new(0.25, -4.0, 1.0));
        put(&mut first, *id, &editable);
        let file = first.encode().expect("it is small");
        let lost: Vec<String> = file.what_would_be_lost().iter().map(ToString::to_string).collect();
        assert_eq!(lost, ["mesh 1, primitive 0: its attribute _HEAT"], "nothing else");
        let again = file.to_bytes();
        assert_eq!(packed(&json_of(&again)), left, "after {number}");
        let (second, warned) = document("a.glb", &again);
        assert_eq!(warned, [], "{number}");
        let position = |id| second.scene.meshes().get(id).map(|asset| asset.mesh().positions()[0]);
        let all: Vec<_> = second.scene.meshes().iter().map(|(id, _)| id).collect();
        assert!(second.edit_data.contains_key(&all[number]), "{number}");
        assert_eq!(position(all[number]), Some(Vec3::new(0.25, -4.0, 1.0)), "{number}");
        let plain = loaded("a.glb", &again);
        assert_eq!(meshes(&plain).iter().map(|mesh| mesh.face_count()).sum::<usize>(), 152, "all triangles");
    }
}

#[test]
fn a_changed_document_with_streams_loads_or_is_refused() {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as usize % below
    };
    for name in ["edgebreaker.glb", "sequential.glb", "small.glb"] {
        let doc = doc_of(&file(name));
        for _ in 0..300 {
            let mut changed = Doc { json: doc.json.clone(), bytes: doc.bytes.clone() };
            for _ in 0..1 + next(3) {
                let at = next(changed.bytes.len());
                changed.bytes[at] = next(256) as u8;
            }
            if let Err(error) = load_from_slice("a.glb", &changed.glb(), &LoadOptions::default()) {
                assert!(error.to_string().starts_with("a.glb"), "{error}");
            }
        }
    }
}
