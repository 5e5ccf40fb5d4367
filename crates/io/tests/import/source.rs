//! The file beside the scene: every `extras`, every unknown extension and every number is
//! reachable as it was written, and all bytes are there.

use std::fmt::Write;

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_io::{GltfSource, Limits, LoadOptions, Loaded, load, load_from_slice};
use trigon_scene::NodeId;

use crate::gltf::{Doc, push};
use crate::movement::{animated, skinned};
use crate::texture::{png, textured_square};
use crate::{warnings, warns_once};

fn keeping() -> LoadOptions<'static> {
    LoadOptions { keep_source: true, ..LoadOptions::default() }
}

/// Loads from memory what must load, and keeps the file.
fn kept(name: &str, bytes: &[u8]) -> (Loaded, GltfSource) {
    let mut loaded = load_from_slice(name, bytes, &keeping()).unwrap_or_else(|error| panic!("{error}"));
    let source = loaded.source.take().unwrap_or_else(|| panic!("no source: {:#?}", warnings(&loaded)));
    (loaded, source)
}

fn nodes(loaded: &Loaded) -> Vec<NodeId> {
    loaded.scene.nodes().iter().map(|(id, _)| id).collect()
}

/// What no tree of f64 and sorted maps could give back.
const ODD: &str = r#"{ "z":12345678901234567890123,"a" : 0.1000000000000000055511151231257827021181583404541015625, "e": -1E-400,"a2":[1.0,1, 10e-1 ], "s":"\u00e9é\/" }"#;

/// A document with the odd value in `extras` and in an unknown extension of everything
/// that may have them, and the pointers to all of these.
fn odd_everywhere() -> (String, Vec<String>) {
    let mut doc = skinned();
    let textured = textured_square();
    for list in ["materials", "textures", "samplers"] {
        doc.json[list] = textured.json[list].clone();
    }
    let view = doc.view(&png());
    let uvs = doc.floats("VEC2", &[0.0; 8]);
    doc.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
    let times = doc.floats("SCALAR", &[0., 1.]);
    let moves = doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]);
    let (indices, values) = (doc.view(&[1]), doc.view(&[0; 12]));
    let sparse = json!({"count": 1, "indices": {"bufferView": indices, "componentType": 5121},
        "values": {"bufferView": values}});
    let target = json!({"componentType": 5126, "type": "VEC3", "count": 4, "sparse": sparse});
    let target = push(&mut doc.json["accessors"], target);
    doc.primitive()["targets"] = json!([{"POSITION": target}]);
    doc.primitive()["material"] = json!(0);
    doc.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    doc.json["materials"][0]["normalTexture"] = json!({"index": 0});
    doc.json["materials"][0]["occlusionTexture"] = json!({"index": 0});
    doc.json["materials"][0]["emissiveTexture"] = json!({"index": 0});
    doc.json["animations"] = json!([{"samplers": [{"input": times, "output": moves}],
        "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}]);
    doc.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25}}]);
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    doc.json["nodes"][1]["camera"] = json!(0);
    doc.json["nodes"][2]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    doc.json["scenes"] = json!([{"nodes": [0, 1]}]);
    doc.json["buffers"] = json!([{"byteLength": doc.bytes.len(), "uri": data_uri(&doc.bytes)}]);
    let mut pointers = Vec::new();
    for holder in holders(&doc.json, target) {
        let object = doc.json.pointer_mut(&holder).unwrap_or_else(|| panic!("{holder} is there"));
        object["extras"] = json!("ODD");
        object["extensions"]["VENDOR_x"] = json!({"inside": "ODD"});
        pointers.extend([format!("{holder}/extras"), format!("{holder}/extensions/VENDOR_x/inside")]);
    }
    let text = serde_json::to_string_pretty(&doc.json).expect("JSON").replace("\"ODD\"", ODD);
    (text, pointers)
}

/// Pointers to the objects of a document, one of whose accessors is sparse.
fn holders(json: &Value, sparse: usize) -> Vec<String> {
    const LISTS: &[&str] = &[
        "accessors",
        "animations",
        "bufferViews",
        "buffers",
        "cameras",
        "images",
        "materials",
        "meshes",
        "nodes",
        "samplers",
        "scenes",
        "skins",
        "textures",
    ];
    const INNER: &[&str] = &[
        "",
        "/asset",
        "/extensions/KHR_lights_punctual/lights/0",
        "/animations/0/channels/0",
        "/animations/0/channels/0/target",
        "/animations/0/samplers/0",
        "/cameras/0/perspective",
        "/materials/0/pbrMetallicRoughness",
        "/materials/0/pbrMetallicRoughness/baseColorTexture",
        "/materials/0/normalTexture",
        "/materials/0/occlusionTexture",
        "/materials/0/emissiveTexture",
        "/meshes/0/primitives/0",
    ];
    let items = LISTS.iter().flat_map(|list| {
        let length = json[list].as_array().expect("a list").len();
        (0..length).map(move |item| format!("/{list}/{item}"))
    });
    let inner = INNER.iter().map(|&pointer| pointer.to_owned());
    let sparse = ["", "/indices", "/values"].map(|part| format!("/accessors/{sparse}/sparse{part}"));
    items.chain(inner).chain(sparse).collect()
}

fn data_uri(bytes: &[u8]) -> String {
    let mut uri = "data:application/octet-stream,".to_owned();
    bytes.iter().for_each(|byte| write!(uri, "%{byte:02x}").expect("a string takes it"));
    uri
}

#[test]
fn extras_and_unknown_extensions_are_reachable_at_every_level() {
    let (text, pointers) = odd_everywhere();
    let (loaded, source) = kept("a.gltf", text.as_bytes());
    let warnings = warnings(&loaded);
    assert!(
        warnings.len() == 1 && warnings[0].contains("the extension VENDOR_x is not drawn"),
        "{warnings:?}"
    );
    assert_eq!(source.json(), text, "the whole file");
    assert!(pointers.len() > 80, "many places: {}", pointers.len());
    for pointer in pointers {
        assert_eq!(source.at(&pointer), Some(ODD), "{pointer}");
    }
}

/// `extras` may be anything, and gltf::json wants objects: the file is parsed twice.
#[test]
fn extras_that_are_no_objects_stay_as_they_are() {
    let mut doc = Doc::square();
    doc.json["nodes"][0]["extras"] = json!([1.5, "two", null]);
    doc.json["extras"] = json!(5);
    let (_, source) = kept("a.glb", &doc.glb());
    assert_eq!(source.at("/nodes/0/extras"), Some(r#"[1.5,"two",null]"#), "a list");
    assert_eq!(source.at("/extras"), Some("5"), "a number");
}

#[test]
fn ids_lead_to_the_objects_of_the_file() {
    let mut doc = animated();
    let first = doc.primitive().clone();
    let [mut red, mut lines, mut blind] = [first.clone(), first.clone(), first.clone()];
    red["material"] = json!(1);
    lines["mode"] = json!(1);
    blind["attributes"] = json!({});
    let unused = json!({"primitives": [first.clone()]});
    doc.json["meshes"] = json!([unused, {"primitives": [blind, red, lines, first]}]);
    doc.json["materials"] = json!([{"name": "unused"}, {"name": "red"}]);
    doc.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0}},
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 1}}]);
    doc.json["extensions"] =
        json!({"KHR_lights_punctual": {"lights": [{"type": "spot"}, {"type": "point"}]}});
    let count = doc.json["nodes"].as_array().expect("nodes").len();
    for node in doc.json["nodes"].as_array_mut().expect("nodes") {
        if node.get("mesh").is_some() {
            node["mesh"] = json!(1);
        }
    }
    let nodes_of_the_scene: Vec<usize> = (0..count).chain([count + 1, count + 2]).collect();
    push(&mut doc.json["nodes"], json!({"name": "outside", "mesh": 0}));
    push(&mut doc.json["nodes"], json!({"name": "blind", "camera": 0}));
    let light = json!({"name": "lamp", "camera": 1, "extensions": {"KHR_lights_punctual": {"light": 1}}});
    push(&mut doc.json["nodes"], light);
    let children: Vec<usize> = doc.json["nodes"]
        .as_array()
        .expect("nodes")
        .iter()
        .flat_map(|node| node["children"].as_array().cloned().unwrap_or_default())
        .map(|child| child.as_u64().expect("a number") as usize)
        .collect();
    let roots: Vec<usize> = nodes_of_the_scene.into_iter().filter(|node| !children.contains(node)).collect();
    doc.json["scenes"] = json!([{"nodes": roots}]);
    // An animation of a node that the scene does not show, before the one that is played.
    let mut outside = doc.json["animations"][0].clone();
    for channel in outside["channels"].as_array_mut().expect("channels") {
        channel["target"]["node"] = json!(count);
    }
    doc.json["animations"].as_array_mut().expect("a list").insert(0, outside);
    let (loaded, source) = kept("a.glb", &doc.glb());

    let indices: Vec<_> = nodes(&loaded).into_iter().map(|id| source.node(id)).collect();
    let expected: Vec<_> = (0..count).chain([count + 1, count + 2]).map(Some).collect();
    assert_eq!(indices, expected, "all but the one outside");
    let (mesh, asset) = loaded.scene.meshes().iter().next().expect("a mesh");
    assert_eq!(source.mesh(mesh), Some(1), "the used one");
    assert_eq!(asset.mesh().face_count(), 4, "of two primitives");
    let primitives: Vec<_> = (0..5).map(|face| source.primitive(mesh, face)).collect();
    assert_eq!(primitives, [Some(1), Some(1), Some(3), Some(3), None], "not those without faces");
    let materials: Vec<_> = loaded
        .scene
        .materials
        .iter()
        .map(|(id, material)| (material.name.clone(), source.material(id)))
        .collect();
    assert_eq!(materials, [("default".to_owned(), None), ("red".to_owned(), Some(1))], "by name");
    assert_eq!(loaded.scene.animations.len(), 1, "the other moves nothing here");
    assert_eq!([source.animation(0), source.animation(1)], [Some(1), None], "the second of the file");
    let [blind, lamp] = nodes(&loaded)[count..] else { panic!("two more nodes") };
    assert_eq!((source.camera(blind), source.light(blind)), (None, None), "its camera is left out");
    assert_eq!((source.camera(lamp), source.light(lamp)), (Some(1), Some(1)), "as the file says");
}

#[test]
fn skins_and_instances_are_told_apart() {
    let mut doc = skinned();
    let unused = json!({"joints": [1]});
    let skin = doc.json["skins"][0].clone();
    doc.json["skins"] = json!([unused, skin]);
    doc.json["nodes"][0]["skin"] = json!(1);
    let places = doc.floats("VEC3", &[1.0; 6]);
    let instances = json!({"mesh": 0, "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}});
    push(&mut doc.json["nodes"], instances);
    let (loaded, source) = kept("a.glb", &doc.glb());
    let (skin, _) = loaded.scene.skins.iter().next().expect("a skin");
    assert_eq!(source.skin(skin), Some(1), "the used one");
    let indices: Vec<_> = nodes(&loaded).into_iter().map(|id| source.node(id)).collect();
    let file = [Some(0), Some(1), Some(2), Some(3), Some(4)];
    assert!(indices.starts_with(&file), "those of the file come first: {indices:?}");
    assert_eq!(indices[file.len()..], [None, None], "the two copies are no nodes of the file");
    let (mesh, _) = loaded.scene.meshes().iter().next().expect("a mesh");
    assert_eq!(source.mesh(mesh), Some(0), "though its node draws copies only");
}

#[test]
fn all_buffers_and_images_are_there_used_or_not() {
    let mut doc = textured_square();
    let loose = data_uri(b"no image");
    let unused = doc.view(b"unused");
    doc.json["buffers"] = json!([{}, {"byteLength": 3, "uri": data_uri(b"abc")},
        {"byteLength": 8, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}]);
    for image in [json!({"uri": loose}), json!({"bufferView": unused}), json!({"uri": loose})] {
        push(&mut doc.json["images"], image);
    }
    // The image of the colour as data, too, by way of another image of the same bytes.
    let image = doc.json["images"][0].clone();
    let copy = push(&mut doc.json["images"], image);
    let texture = push(&mut doc.json["textures"], json!({"source": copy}));
    doc.json["materials"][0]["emissiveTexture"] = json!({"index": texture});
    doc.json["materials"][0]["occlusionTexture"] = json!({"index": texture});
    let (loaded, source) = kept("a.glb", &doc.glb());
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
    let mut binary = doc.bytes.clone();
    binary.resize(binary.len().next_multiple_of(4), 0);
    assert_eq!(source.buffer(0), Some(&binary[..]), "the chunk of the GLB");
    assert_eq!(source.buffer(1), Some(&b"abc"[..]), "of no accessor");
    assert_eq!([source.buffer(2), source.buffer(3)], [None, None], "a stand-in, and nothing");
    let images: Vec<_> = (0..6).map(|image| source.image(image).map(<[u8]>::to_vec)).collect();
    let plain = Some(b"no image".to_vec());
    let expected = [Some(png()), plain.clone(), Some(b"unused".to_vec()), plain, Some(png()), None];
    assert_eq!(images, expected, "encoded as they are");
    let textures: Vec<Vec<usize>> =
        loaded.scene.textures.iter().map(|(id, _)| source.images(id).collect()).collect();
    assert_eq!(textures.len(), 2, "colours and data");
    assert!(textures.contains(&vec![0, copy]), "two images are one texture: {textures:?}");
    assert!(textures.contains(&vec![copy]), "and one of them is data, too: {textures:?}");
}

#[test]
fn files_beside_the_model_are_kept_and_missing_ones_are_said() {
    let dir = tempfile::tempdir().expect("a folder");
    let mut doc = textured_square();
    doc.json["images"] = json!([{"uri": "a.png"}, {"uri": "gone.png"}]);
    let length = doc.bytes.len();
    doc.json["buffers"] = json!([{"byteLength": length, "uri": "a.bin"}, {"byteLength": 9, "uri": "short.bin"},
        {"byteLength": 9, "uri": "../outside.bin"}]);
    for (name, bytes) in [("a.png", &png()[..]), ("a.bin", &doc.bytes), ("short.bin", b"short")] {
        std::fs::write(dir.path().join(name), bytes).expect("a file");
    }
    let path = dir.path().join("model.gltf");
    std::fs::write(&path, serde_json::to_vec(&doc.json).expect("JSON")).expect("a file");
    let loaded = load(&path, &keeping()).unwrap_or_else(|error| panic!("{error}"));
    let source = loaded.source.as_ref().expect("it is kept all the same");
    assert_eq!(source.buffer(0), Some(&doc.bytes[..]), "a file");
    assert_eq!(source.image(0), Some(&png()[..]), "a file");
    assert_eq!((source.buffer(1), source.buffer(2), source.image(1)), (None, None, None), "not there");
    for place in ["buffer 1", "buffer 2", "image 1"] {
        warns_once(&loaded, &format!("{place}: it is not kept to be written back: "));
    }
}

/// What is read only to be kept counts towards the limits, and is given up where it passes them.
#[test]
fn limits_hold_for_what_is_only_kept() {
    let mut doc = Doc::square();
    doc.json["buffers"] = json!([{}, {"byteLength": 3000, "uri": data_uri(&[7; 3000])}]);
    let glb = doc.glb();
    let limits = Limits { total_bytes: 2999, ..Limits::default() };
    let options = LoadOptions { limits, ..keeping() };
    let loaded = load_from_slice("a.glb", &glb, &options).unwrap_or_else(|error| panic!("{error}"));
    assert!(loaded.source.as_ref().is_some_and(|source| source.buffer(1).is_none()), "given up");
    warns_once(&loaded, "more than the limit");
    let without = LoadOptions { keep_source: false, ..options };
    let loaded = load_from_slice("a.glb", &glb, &without).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(warnings(&loaded), [""; 0], "nobody asked for that buffer");
}

/// A parser that builds a tree refuses such depth, or overflows its stack.
#[test]
fn depth_is_kept_as_text() {
    const DEPTH: usize = 100_000;
    let deep = format!("{}{}", "[".repeat(DEPTH), "]".repeat(DEPTH));
    let mut doc = Doc::square();
    doc.json["nodes"][0]["extras"] = json!({"deep": "DEEP"});
    doc.json["buffers"] = json!([{"byteLength": doc.bytes.len(), "uri": data_uri(&doc.bytes)}]);
    let text = serde_json::to_string(&doc.json).expect("JSON").replace("\"DEEP\"", &deep);
    let (_, source) = kept("a.gltf", text.as_bytes());
    assert_eq!(source.at("/nodes/0/extras/deep"), Some(deep.as_str()), "all of it");
}

/// JSON is UTF-8. In parts that nothing reads a loader need not notice, but no text can be
/// made of it.
#[test]
fn a_file_that_is_not_utf8_is_shown_and_not_kept() {
    let mut doc = Doc::square();
    doc.json["nodes"][0]["extras"] = json!({"name": "???"});
    let mut glb = doc.glb();
    let place = glb.windows(3).position(|bytes| bytes == b"???").expect("the name");
    glb[place] = 0xff;
    let loaded = load_from_slice("a.glb", &glb, &keeping()).unwrap_or_else(|error| panic!("{error}"));
    assert!(loaded.source.is_none(), "there is no text");
    // The JSON begins at byte 20 of the GLB.
    warns_once(&loaded, &format!("byte {} of its JSON is not UTF-8", place - 20));
}

#[test]
fn a_byte_order_mark_is_no_part_of_the_text() {
    let mut doc = Doc::square();
    doc.json["buffers"] = json!([{"byteLength": doc.bytes.len(), "uri": data_uri(&doc.bytes)}]);
    let text = serde_json::to_string(&doc.json).expect("JSON");
    let (_, source) = kept("a.gltf", format!("\u{feff}{text}").as_bytes());
    assert_eq!(source.json(), text, "the JSON");
}

#[test]
fn nothing_is_kept_unless_asked_for() {
    let loaded = Doc::square().load();
    assert!(loaded.source.is_none(), "off by default");
    let obj = load_from_slice("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &keeping());
    assert!(obj.expect("an OBJ").source.is_none(), "an OBJ has none");
}

/// Keeping the file changes neither the scene nor what is said of it.
#[test]
fn keeping_changes_nothing_else() {
    for doc in [Doc::square(), textured_square(), skinned(), animated()] {
        let plain = doc.load();
        let (loaded, _) = kept("a.glb", &doc.glb());
        assert_eq!(format!("{:?}", plain.scene), format!("{:?}", loaded.scene), "the scene");
        assert_eq!(plain.warnings, loaded.warnings, "the warnings");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// Whatever the numbers say, what is kept can be asked for anything.
    #[test]
    fn no_document_makes_a_source_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(vec![
            json!(0), json!(2), json!(255), json!(u64::MAX), json!(0.5), json!("x"), Value::Null])), 1..4),
    ) {
        let (text, _) = odd_everywhere();
        let mut json: Value = serde_json::from_str(&text.replace(ODD, "{}")).expect("JSON");
        let mut paths = Vec::new();
        leaves(&json, String::new(), &mut paths);
        for (path, value) in changes {
            if let Some(place) = json.pointer_mut(path.get::<String>(&paths)) {
                *place = value;
            }
        }
        let text = serde_json::to_string(&json).expect("JSON");
        if let Ok(loaded) = load_from_slice("a.gltf", text.as_bytes(), &keeping()) {
            let source = loaded.source.expect("it is UTF-8");
            prop_assert_eq!(source.json(), &text);
            for index in 0..20 {
                let _ = (source.buffer(index), source.image(index), source.animation(index));
            }
            for id in loaded.scene.nodes().iter().map(|(id, _)| id) {
                let _ = (source.node(id), source.camera(id), source.light(id));
            }
        }
    }
}

/// The values that are neither lists nor objects, by how to reach them.
fn leaves(value: &Value, path: String, found: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(key, item)| leaves(item, format!("{path}/{key}"), found));
        }
        Value::Object(map) => {
            map.iter().for_each(|(key, item)| leaves(item, format!("{path}/{key}"), found));
        }
        _ => found.push(path),
    }
}
