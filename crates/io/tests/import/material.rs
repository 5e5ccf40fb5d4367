//! Materials of glTF: every factor, every texture, and how its bytes are meant.

use serde_json::json;
use trigon_io::{LoadOptions, Loaded, SceneChoice, load_from_slice};
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_scene::{Material, MetallicRoughness, NormalMap, Shading, TextureBinding, TextureFormat};

use crate::gltf::{Doc, push};
use crate::texture::textured_square;
use crate::{meshes, warns_once};

fn material(loaded: &Loaded) -> &Material {
    loaded.scene.materials.iter().next().expect("a material").1
}

fn format(loaded: &Loaded, binding: Option<TextureBinding>) -> TextureFormat {
    let texture = binding.expect("a texture").texture;
    loaded.scene.textures.get(texture).expect("in the scene").texture.format()
}

/// The textured square with all textures, which are one image.
fn full() -> Doc {
    let mut doc = textured_square();
    let texture = json!({"index": 0});
    doc.json["materials"] = json!([{
    "name": "full", "emissiveFactor": [0.5, 0.25, 0], "emissiveTexture": texture,
    "normalTexture": {"index": 0, "scale": -0.5,
        "extensions": {"KHR_texture_transform": {"offset": [0.25, 0]}}},
    "occlusionTexture": {"index": 0, "strength": 0.75},
    "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.5], "baseColorTexture": texture,
        "metallicFactor": 0.25, "roughnessFactor": 2, "metallicRoughnessTexture": texture},
    "extensions": {
        "KHR_materials_emissive_strength": {"emissiveStrength": 8},
        "KHR_materials_ior": {"ior": 1.25},
        "KHR_materials_specular": {"specularFactor": 0.5, "specularTexture": texture,
            "specularColorFactor": [2, 0.5, -1], "specularColorTexture": texture},
        "KHR_materials_transmission": {"transmissionFactor": 0.75, "transmissionTexture": texture}
    }}]);
    doc
}

#[test]
fn every_factor_and_texture_arrives() {
    let loaded = full().load();
    for word in ["roughnessFactor", "specularColorFactor"] {
        warns_once(&loaded, word);
    }
    assert_eq!(loaded.warnings.len(), 2, "nothing else to warn of");
    let found = material(&loaded);
    assert_eq!(found.base_color, Vec4::new(0.5, 0.25, 1.0, 0.5), "base colour");
    assert_eq!(found.emissive, Vec3::new(4.0, 2.0, 0.0), "times its strength");
    assert_eq!((found.ior, found.transmission), (1.25, 0.75), "for rays");
    let Shading::MetallicRoughness(model) = found.shading else { panic!("{:?}", found.shading) };
    assert_eq!((model.metallic, model.roughness, model.specular), (0.25, 1.0, 0.5), "within their range");
    assert_eq!(model.specular_color, Vec3::new(2.0, 0.5, 0.0), "never negative");
    let NormalMap { binding, scale } = found.normal_map.expect("a normal map");
    assert_eq!((binding.transform.translation, scale), (Vec2::new(0.25, 0.0), -0.5), "the normal map");
    assert_eq!(found.occlusion.expect("occlusion").strength, 0.75, "occlusion");
    for (binding, expected) in [
        (found.base_color_texture, TextureFormat::Srgb),
        (found.emissive_texture, TextureFormat::Srgb),
        (model.specular_color_texture, TextureFormat::Srgb),
        (model.texture, TextureFormat::Linear),
        (model.specular_texture, TextureFormat::Linear),
        (found.transmission_texture, TextureFormat::Linear),
        (Some(binding), TextureFormat::Linear),
        (found.occlusion.map(|occlusion| occlusion.binding), TextureFormat::Linear),
    ] {
        assert_eq!(format(&loaded, binding), expected, "how the bytes are meant");
    }
    assert_eq!(loaded.scene.textures.len(), 2, "one image, once as colours and once as data");
}

#[test]
fn defaults_are_those_of_the_specification() {
    let mut doc = Doc::square();
    doc.json["materials"] = json!([{}]);
    doc.primitive()["material"] = json!(0);
    let loaded = doc.load();
    let found = material(&loaded);
    let rough_metal = MetallicRoughness { metallic: 1.0, roughness: 1.0, ..MetallicRoughness::default() };
    assert_eq!(found.shading, Shading::MetallicRoughness(rough_metal), "metal 1, rough 1");
    assert_eq!(
        (found.base_color, found.emissive, found.ior),
        (Vec4::ONE, Vec3::ZERO, 1.5),
        "white, dark, 1.5"
    );
    assert!(!found.double_sided && found.normal_map.is_none() && found.occlusion.is_none(), "nothing more");
}

#[test]
fn a_normal_map_brings_tangents_and_nothing_else_does() {
    let tangents = |doc: &Doc| meshes(&doc.load())[0].attributes().corner_tangents.clone();
    assert_eq!(tangents(&textured_square()), None, "no normal map, no tangents");
    let mut doc = full();
    let generated = tangents(&doc).expect("generated");
    // u grows with x, and v falls with y: up in the image is up in space.
    assert!(
        generated.iter().all(|&tangent| tangent.distance(Vec4::new(1.0, 0.0, 0.0, 1.0)) < 1e-6),
        "{generated:?}"
    );
    let given = doc.floats("VEC4", &[0., 2., 0., -1.].repeat(4));
    doc.primitive()["attributes"]["TANGENT"] = json!(given);
    assert_eq!(tangents(&doc), Some(generated), "without normals the file's tangents do not count");
    let normals = doc.floats("VEC3", &[0., 0., 1.].repeat(4));
    doc.primitive()["attributes"]["NORMAL"] = json!(normals);
    let expected = vec![Vec4::new(0.0, 1.0, 0.0, -1.0); 6];
    assert_eq!(tangents(&doc), Some(expected), "with them they do, as unit vectors");
}

#[test]
fn a_broken_image_of_data_is_left_out() {
    let mut doc = full();
    let view = doc.view(b"no image at all");
    push(&mut doc.json["images"], json!({"bufferView": view, "name": "broken"}));
    push(&mut doc.json["textures"], json!({"source": 1}));
    doc.json["materials"][0]["normalTexture"]["index"] = json!(1);
    let loaded = doc.load();
    warns_once(&loaded, "left out");
    assert_eq!(material(&loaded).normal_map, None, "rather than bumps in a checkerboard");
    doc.json["materials"][0]["occlusionTexture"]["index"] = json!(9);
    assert!(doc.refused().contains("texture 9 does not exist"), "a reference to nothing");
}

#[test]
fn the_scene_that_is_asked_for_is_loaded() {
    let mut doc = Doc::square();
    doc.json["nodes"] = json!([{"mesh": 0, "name": "first"}, {"mesh": 0, "name": "second"}]);
    doc.json["scenes"] = json!([{"nodes": [0], "name": "inside"}, {"nodes": [1]}]);
    doc.json["scene"] = json!(0);
    let shown = |scene: Option<SceneChoice>| {
        let options = LoadOptions { scene, ..LoadOptions::default() };
        let loaded = load_from_slice("a.glb", &doc.glb(), &options).map_err(|error| error.to_string())?;
        assert_eq!(loaded.scene_names, ["inside", "scene 1"], "all are named");
        let mut nodes = loaded.scene.nodes().iter();
        Ok::<String, String>(nodes.next().expect("a node").1.name.clone())
    };
    assert_eq!(shown(None).as_deref(), Ok("first"), "the file's own");
    assert_eq!(shown(Some(SceneChoice::Index(1))).as_deref(), Ok("second"), "by number");
    assert_eq!(shown(Some(SceneChoice::Name("inside".to_owned()))).as_deref(), Ok("first"), "by name");
    let message = shown(Some(SceneChoice::Name("attic".to_owned()))).expect_err("no such scene");
    assert!(message.contains("attic") && message.contains("\"inside\", \"scene 1\""), "{message}");
    shown(Some(SceneChoice::Index(2))).expect_err("no such number");
}

#[test]
fn instances_become_nodes_that_share_the_mesh() {
    let mut doc = Doc::square();
    let places = doc.floats("VEC3", &[1., 0., 0., 2., 0., 0., 3., 0., 0.]);
    let sizes = doc.floats("VEC3", &[1., 1., 1., 2., 2., 2., -1., 1., 1.]);
    let instancing =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places, "SCALE": sizes}}});
    doc.json["nodes"] =
        json!([{"mesh": 0, "name": "tree", "translation": [0, 5, 0], "extensions": instancing}]);
    doc.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let loaded = doc.load();
    assert_eq!((loaded.scene.nodes().len(), loaded.scene.meshes().len()), (4, 1), "three copies on one node");
    let (bounds, low) = (loaded.scene.bounds(), DVec3::new(1.0, 5.0, 0.0));
    assert_eq!((bounds.min, bounds.max), (low, DVec3::new(4.0, 7.0, 0.0)), "where they were put");
    let fewer = doc.floats("VEC3", &[1., 1., 1.]);
    doc.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = json!(fewer);
    assert!(doc.refused().contains("different lengths"), "lists that do not match");
}

#[test]
fn compressed_views_are_decoded() {
    let mut doc = Doc::square();
    // The six indices as the codes of two triangles: all new, then an edge and a new one.
    let mut stream = vec![0xe1, 0xf0, 0x00];
    stream.extend([0; 16]);
    let packed = doc.view(&stream);
    let from = doc.json["bufferViews"][packed].clone();
    let view = json!({"buffer": 1, "byteLength": 12, "extensions": {"EXT_meshopt_compression": {
        "buffer": 0, "byteOffset": from["byteOffset"], "byteLength": from["byteLength"],
        "byteStride": 2, "mode": "TRIANGLES", "count": 6}}});
    let view = push(&mut doc.json["bufferViews"], view);
    let indices = json!({"bufferView": view, "componentType": 5123, "type": "SCALAR", "count": 6});
    let indices = push(&mut doc.json["accessors"], indices);
    doc.primitive()["indices"] = json!(indices);
    doc.json["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
    doc.json["buffers"] = json!([null, {"byteLength": 12}]);
    let loaded = doc.load();
    let mesh = meshes(&loaded)[0];
    assert_eq!(mesh.face_vertices(1), [0, 2, 3], "the same square");
    let extension = |doc: &mut Doc, key: &str, value| {
        doc.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
    };
    for (key, value, word) in [
        ("count", json!(9), "do not fill"),
        ("mode", json!("ATTRIBUTES"), "multiple of 4"),
        ("mode", json!("STRIPS"), "unknown mode STRIPS"),
        ("filter", json!("SEPIA"), "unknown filter SEPIA"),
        ("byteLength", json!(7), "too short"),
        ("byteOffset", json!(u64::MAX), "outside buffer 0"),
        ("buffer", json!(5), "buffer 5 does not exist"),
    ] {
        let before = doc.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"].clone();
        extension(&mut doc, key, value);
        let message = doc.refused();
        assert!(message.contains(word) && message.contains("bufferView"), "{key}: {message}");
        doc.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = before;
    }
}
