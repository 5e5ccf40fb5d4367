//! Textures: which pixel ends up where, and what stands in for broken ones.

use serde_json::json;
use trigon_io::{Limits, LoadOptions, Loaded, Pixels, encode_png, encode_webp, load, load_image, write_png};
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_scene::{AlphaMode, Shading, TextureBinding, Wrap};

use crate::gltf::Doc;
use crate::{warnings, warns_once};

/// Red, green above; blue, white below.
const PIXELS: [u8; 12] = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];

pub(crate) fn png() -> Vec<u8> {
    let mut bytes = Vec::new();
    encode_png(&mut bytes, 2, 2, Pixels::Rgb8(&PIXELS)).expect("memory takes it");
    bytes
}

fn binding(loaded: &Loaded) -> TextureBinding {
    let (_, material) = loaded.scene.materials.iter().next().expect("a material");
    material.base_color_texture.unwrap_or_else(|| panic!("a texture: {:#?}", warnings(loaded)))
}

/// The colour of the first texture at a coordinate of the mesh.
fn color_at(loaded: &Loaded, uv: Vec2) -> Vec3 {
    let binding = binding(loaded);
    let texture = &loaded.scene.textures.get(binding.texture).expect("in the scene").texture;
    let mut sampler = binding.sampler;
    sampler.magnification = trigon_scene::Filter::Nearest;
    texture.sample(binding.transform.transform_point2(uv), Vec2::ZERO, Vec2::ZERO, &sampler).truncate()
}

pub(crate) fn textured_square() -> Doc {
    let mut doc = Doc::square();
    let uv = doc.floats("VEC2", &[0., 1., 1., 1., 1., 0., 0., 0.]);
    let view = doc.view(&png());
    doc.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
    doc.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    doc.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    doc.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    doc.json["samplers"] = json!([{"wrapS": 33071, "wrapT": 33648}]);
    doc.json["images"] = json!([{"bufferView": view, "mimeType": "image/jpeg"}]);
    doc
}

#[test]
fn obj_and_gltf_agree_which_way_is_up() {
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(dir.path().join("lib")).expect("a folder");
    write_png(dir.path().join("lib/my tex.png"), 2, 2, Pixels::Rgb8(&PIXELS)).expect("an image");
    std::fs::write(dir.path().join("lib/m.mtl"), "newmtl m\nmap_Kd -bm 1 my tex.png\n").expect("a file");
    let obj = "mtllib lib/m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nvt 1 0\nvt 0 0\nusemtl m\nf 1/1 2/2 3/3\n";
    std::fs::write(dir.path().join("a.obj"), obj).expect("a file");
    let from_obj = load(dir.path().join("a.obj"), &LoadOptions::default()).expect("a model");
    let (_, mesh) = from_obj.scene.meshes().iter().next().expect("a mesh");
    let uv = mesh.mesh().attributes().uv_sets[0][0];
    assert_eq!(color_at(&from_obj, uv), Vec3::X, "three quarters up, a quarter right is the upper left: red");
    assert_eq!(
        color_at(&textured_square().load(), Vec2::splat(0.25)),
        Vec3::X,
        "glTF counts from the upper left"
    );
    assert_eq!(from_obj.files.len(), 3, "the model, the library, the image: {:?}", from_obj.files);
}

#[test]
fn obj_scale_and_offset_count_from_below() {
    let dir = tempfile::tempdir().expect("a folder");
    write_png(dir.path().join("t.png"), 2, 2, Pixels::Rgb8(&PIXELS)).expect("an image");
    std::fs::write(dir.path().join("m.mtl"), "newmtl m\nmap_Kd -s 0.5 0.5 -o 0 0.5 t.png\n").expect("a file");
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nusemtl m\nf 1/1 2/1 3/1\n";
    std::fs::write(dir.path().join("a.obj"), obj).expect("a file");
    let loaded = load(dir.path().join("a.obj"), &LoadOptions::default()).expect("a model");
    // 0.5 · 0.5 + 0.5 = 0.75 up, 0.25 right.
    assert_eq!(color_at(&loaded, Vec2::splat(0.5)), Vec3::X, "the upper left");
}

#[test]
fn samplers_and_texture_transforms_arrive() {
    let mut doc = textured_square();
    let binding_of = |doc: &Doc| binding(&doc.load());
    assert_eq!(
        (binding_of(&doc).sampler.wrap_u, binding_of(&doc).sampler.wrap_v),
        (Wrap::ClampToEdge, Wrap::MirroredRepeat),
        "wrap"
    );
    doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = json!({"KHR_texture_transform": {"offset": [0.5, 0], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 4]}});
    let moved = binding_of(&doc).transform.transform_point2(Vec2::new(0.25, 0.5));
    // Scaled to (0.5, 2), a quarter turn counter-clockwise with v down to (2, −0.5), moved by (0.5, 0).
    assert!(moved.distance(Vec2::new(2.5, -0.5)) < 1e-6, "scale, turn, move: {moved}");
}

#[test]
fn broken_and_foreign_images_become_a_checkerboard() {
    for (bytes, word) in [
        (b"RIFF\x10\0\0\0WEBPVP8 ".to_vec(), "image"),
        (b"GIF89a\x01\0\x01\0".to_vec(), "Gif"),
        (b"\xabKTX 20\xbb\r\n\x1a\n".to_vec(), "KTX2"),
        (png()[..40].to_vec(), "too early"),
    ] {
        let mut doc = textured_square();
        let view = doc.view(&bytes);
        doc.json["images"] = json!([{"bufferView": view, "name": "the image"}]);
        doc.json["textures"] = json!([{"extensions": {"EXT_texture_webp": {"source": 0}}}]);
        doc.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
        let loaded = doc.load();
        warns_once(&loaded, word);
        warns_once(&loaded, "\"the image\"");
        assert_eq!(color_at(&loaded, Vec2::splat(0.01)), Vec3::new(1.0, 0.0, 1.0), "magenta");
    }
}

#[test]
fn a_webp_image_is_a_texture() {
    let mut doc = textured_square();
    let mut bytes = Vec::new();
    encode_webp(&mut bytes, 1, 1, &[255, 0, 0, 255]).expect("memory takes it");
    let view = doc.view(&bytes);
    doc.json["images"] = json!([{"bufferView": view, "mimeType": "image/webp"}]);
    doc.json["textures"] = json!([{"extensions": {"EXT_texture_webp": {"source": 0}}}]);
    doc.json["extensionsUsed"] = json!(["EXT_texture_webp"]);
    doc.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
    let loaded = doc.load();
    assert_eq!(warnings(&loaded), Vec::<String>::new(), "nothing is wrong with it");
    assert_eq!(color_at(&loaded, Vec2::splat(0.5)), Vec3::X, "red");
}

#[test]
fn missing_images_are_warnings_and_unused_ones_are_not_read() {
    let mut doc = textured_square();
    doc.json["images"] = json!([{"uri": "../gone.png"}, {"uri": "data:image/png;base64,broken"}]);
    let loaded = doc.load();
    warns_once(&loaded, "gone.png");
    assert_eq!(loaded.scene.textures.len(), 0, "no texture");
    assert_eq!(loaded.warnings.len(), 1, "the unused image is nobody's business: {:#?}", warnings(&loaded));
}

#[test]
fn a_set_that_is_missing_is_replaced() {
    let mut doc = textured_square();
    doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(1);
    let loaded = doc.load();
    warns_once(&loaded, "TEXCOORD_1");
    let (_, mesh) = loaded.scene.meshes().iter().next().expect("a mesh");
    let sets = &mesh.mesh().attributes().uv_sets;
    assert_eq!(sets[1], sets[0], "the first set stands in");
}

/// Each image is within the limits, all together are not.
#[test]
fn images_are_limited_together() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n";
    let dir = tempfile::tempdir().expect("a folder");
    let (mut obj, mut mtl) = (format!("mtllib a.mtl\n{square}"), String::new());
    for index in 0..3 {
        obj += &format!("usemtl m{index}\nf 1/1 2/1 3/1\n");
        mtl += &format!("newmtl m{index}\nmap_Kd {index}.png\n");
        std::fs::write(dir.path().join(format!("{index}.png")), png()).expect("an image");
    }
    std::fs::write(dir.path().join("a.mtl"), mtl).expect("a library");
    std::fs::write(dir.path().join("a.obj"), obj).expect("a model");
    let image = load_image(dir.path().join("0.png"), &Limits::default()).expect("an image");
    let one = u64::from(image.width * image.height);
    let limits = Limits { total_pixels: 2 * one, ..Limits::default() };
    let options = LoadOptions { limits, ..LoadOptions::default() };
    let loaded = load(dir.path().join("a.obj"), &options).expect("still a model");
    let warnings = warnings(&loaded);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].contains("\"2.png\"") && warnings[0].contains("smaller"), "{}", warnings[0]);
}

/// The name stands in the library, not in the model.
#[test]
fn a_name_that_was_mended_is_shown_where_it_stands() {
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(dir.path().join("textures")).expect("a folder");
    let obj = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    std::fs::write(dir.path().join("a.obj"), obj).expect("a model");
    std::fs::write(dir.path().join("a.mtl"), "newmtl m\nmap_Kd C:\\x\\textures\\a.png\n").expect("a library");
    std::fs::write(dir.path().join("textures/A.png"), png()).expect("an image");
    let found = load(dir.path().join("a.obj"), &LoadOptions::default()).expect("a model");
    warns_once(&found, "a.mtl, line 2");
    assert!(warnings(&found)[0].contains("A.png"), "{:?}", warnings(&found));
}

/// An OBJ triangle with a material of these statements, beside `t.png` (the
/// four colours), `n.png` (directions) and `g.png` (grey).
fn obj_with(statements: &str) -> Loaded {
    let dir = tempfile::tempdir().expect("a folder");
    let write = |name: &str, pixels: &[u8; 3]| {
        write_png(dir.path().join(name), 1, 1, Pixels::Rgb8(pixels)).expect("an image");
    };
    write("n.png", &[128, 128, 255]);
    write("g.png", &[51, 51, 51]);
    write_png(dir.path().join("t.png"), 2, 2, Pixels::Rgb8(&PIXELS)).expect("an image");
    std::fs::write(dir.path().join("m.mtl"), format!("newmtl m\n{statements}")).expect("a library");
    let obj = "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    std::fs::write(dir.path().join("a.obj"), obj).expect("a model");
    load(dir.path().join("a.obj"), &LoadOptions::default()).expect("a model")
}

/// The first texel that a binding shows.
fn texel(loaded: &Loaded, binding: Option<TextureBinding>) -> Vec4 {
    let binding = binding.unwrap_or_else(|| panic!("a texture: {:#?}", warnings(loaded)));
    let texture = &loaded.scene.textures.get(binding.texture).expect("in the scene").texture;
    let sampler = trigon_scene::Sampler { magnification: trigon_scene::Filter::Nearest, ..binding.sampler };
    texture.sample(Vec2::splat(0.01), Vec2::ZERO, Vec2::ZERO, &sampler)
}

#[test]
fn maps_of_mtl_become_textures_of_the_material() {
    let found =
        obj_with("Ks 1 1 1\nmap_Kd t.png\nmap_Ks t.png\nmap_Ke g.png\nmap_d g.png\nnorm n.png\nbump g.png\n");
    warns_once(&found, "bump \"g.png\" is not drawn beside norm");
    assert_eq!(found.warnings.len(), 1, "nothing else to warn of: {:#?}", warnings(&found));
    let material = found.scene.materials.iter().next().expect("a material").1;
    assert_eq!(
        texel(&found, material.base_color_texture),
        Vec4::new(1.0, 0.0, 0.0, 0.2),
        "red, alpha by grey"
    );
    assert_eq!(material.alpha_mode, AlphaMode::Mask { cutoff: 0.5 }, "with holes");
    let Shading::BlinnPhong { specular_texture, .. } = material.shading else {
        panic!("{:?}", material.shading)
    };
    assert_eq!(texel(&found, specular_texture), Vec4::new(1.0, 0.0, 0.0, 1.0), "the same image, opaque");
    let grey = texel(&found, material.emissive_texture).x;
    assert!((grey - 0.0331).abs() < 1e-4, "0.2 in sRGB is darker in light: {grey}");
    let normal = texel(&found, material.normal_map.map(|map| map.binding));
    assert_eq!(normal, Vec4::new(128.0 / 255.0, 128.0 / 255.0, 1.0, 1.0), "data is not decoded as a colour");
    let (_, mesh) = found.scene.meshes().iter().next().expect("a mesh");
    assert!(mesh.mesh().attributes().corner_tangents.is_some(), "a normal map needs tangents");
}

#[test]
fn roughness_and_metal_share_a_texture_as_in_gltf() {
    let found = obj_with("Pr 0.5\nmap_Pr g.png\nmap_Pm t.png\n");
    let material = found.scene.materials.iter().next().expect("a material").1;
    let Shading::MetallicRoughness(model) = material.shading else { panic!("{:?}", material.shading) };
    assert_eq!((model.roughness, model.metallic), (0.5, 1.0), "factors");
    let texel = texel(&found, model.texture);
    assert_eq!((texel.y, texel.z), (0.2, 1.0), "green by map_Pr, blue by the red of map_Pm");
}

#[test]
fn bump_maps_are_drawn_when_they_are_normal_maps() {
    let normal_map = |loaded: &Loaded| loaded.scene.materials.iter().next().expect("a material").1.normal_map;
    let directions = obj_with("map_Bump -bm 1.0 n.png\n");
    assert!(normal_map(&directions).is_some(), "as Blender writes them");
    let heights = obj_with("map_Bump -bm 1.0 g.png\n");
    assert_eq!(normal_map(&heights), None, "heights are not");
    warns_once(&heights, "height map");
}
