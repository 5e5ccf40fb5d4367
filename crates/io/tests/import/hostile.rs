//! Documents that lie: whatever the numbers say, a load ends with a scene that
//! can be posed or with an error of one line, and its memory is bounded by what
//! is there.

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_io::{LoadOptions, load_from_slice};
use trigon_mesh::{Deformed, RenderMesh};
use trigon_scene::Scene;

use crate::gltf::{Doc, push};
use crate::movement::{animated, skinned};

/// Everything at once: a skin, morph targets, sparse and compressed
/// accessors, instances and an animation.
fn everything() -> Doc {
    let mut doc = skinned();
    let (indices, values) = (doc.view(&[1]), doc.view(&[0; 12]));
    let sparse = json!({"componentType": 5126, "type": "VEC3", "count": 4, "sparse": {"count": 1,
        "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values}}});
    let target = push(&mut doc.json["accessors"], sparse);
    let normals = doc.floats("VEC3", &[0., 0., 1.].repeat(4));
    doc.primitive()["attributes"]["NORMAL"] = json!(normals);
    doc.primitive()["targets"] = json!([{"POSITION": target, "NORMAL": target}]);
    let mut stream = vec![0xe1, 0xf0, 0x00];
    stream.extend([0; 16]);
    let packed = doc.view(&stream);
    let offset = doc.json["bufferViews"][packed]["byteOffset"].clone();
    let view = json!({"buffer": 0, "byteLength": 12, "extensions": {"KHR_meshopt_compression": {
        "buffer": 0, "byteOffset": offset, "byteLength": stream.len(),
        "byteStride": 2, "mode": "TRIANGLES", "count": 6}}});
    let view = push(&mut doc.json["bufferViews"], view);
    let faces = json!({"bufferView": view, "componentType": 5123, "type": "SCALAR", "count": 6});
    doc.primitive()["indices"] = json!(push(&mut doc.json["accessors"], faces));
    let places = doc.floats("VEC3", &[1.0; 6]);
    let instanced = json!({"mesh": 0, "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}});
    push(&mut doc.json["nodes"], instanced);
    let times = doc.floats("SCALAR", &[0., 1.]);
    let turns = doc.floats("VEC4", &[0., 0., 0., 1., 0., 1., 0., 0.]);
    doc.json["animations"] = json!([{"samplers": [{"input": times, "output": turns}],
        "channels": [{"sampler": 0, "target": {"node": 3, "path": "rotation"}}]}]);
    doc
}

/// The numbers of a document, by how to reach them.
fn numbers(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(path.to_owned()),
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(key, item)| numbers(item, &format!("{path}/{key}"), found));
        }
        Value::Object(map) => {
            map.iter().for_each(|(key, item)| numbers(item, &format!("{path}/{key}"), found));
        }
        _ => {}
    }
}

/// Poses everything that can be posed.
fn pose(scene: &mut Scene) {
    for index in 0..scene.animations.len() {
        let animation = scene.animations[index].clone();
        for time in [-1.0, 0.0, 0.3, animation.duration(), f64::NAN] {
            let pose = scene.pose(&animation, time);
            scene.apply_pose(&pose);
        }
    }
    let mut deformed = Deformed::default();
    for (id, node) in scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let mesh = RenderMesh::from_mesh(asset.mesh());
        let palette = scene.skin_pose(id).map(|pose| pose.palette).unwrap_or_default();
        mesh.deform(&node.morph_weights, &palette, &mut deformed);
        assert_eq!(deformed.positions.len(), mesh.positions.len(), "as many as there were");
    }
    let _ = scene.bounds();
}

fn load_and_pose(doc: &Doc) {
    match load_from_slice("a.glb", &doc.glb(), &LoadOptions::default()) {
        Ok(mut loaded) => pose(&mut loaded.scene),
        Err(error) => assert!(!error.to_string().contains('\n'), "one line: {error}"),
    }
}

#[test]
fn everything_at_once_is_read() {
    let loaded = everything().load();
    assert_eq!(crate::warnings(&loaded), [""; 0], "nothing to warn of");
    assert_eq!((loaded.scene.animations.len(), loaded.scene.skins.len()), (1, 1), "it is all there");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn no_number_makes_a_loader_panic(
        seed in any::<bool>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(vec![
            json!(0), json!(1), json!(3), json!(7), json!(255), json!(5120), json!(5125), json!(65536),
            json!(u32::MAX), json!(u64::MAX), json!(1e300), json!(0.5)])), 1..4),
        bytes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
    ) {
        let mut doc = if seed { everything() } else { animated() };
        let mut paths: Vec<String> = Vec::new();
        numbers(&doc.json, "", &mut paths);
        for (path, value) in changes {
            *doc.json.pointer_mut(path.get::<String>(&paths)).expect("it was there") = value;
        }
        for (at, value) in bytes {
            let at = at.index(doc.bytes.len());
            doc.bytes[at] = value;
        }
        load_and_pose(&doc);
    }
}
