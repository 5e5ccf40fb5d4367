//! Extensions that say otherwise how a surface reflects or transmits light: volumes, specular-glossiness, and
//! variants of materials.

use serde_json::{Value, json};
use trigon_io::{LoadOptions, Loaded, NativeDocument, Pixels, encode_png, load_from_slice};
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_scene::{Material, MetallicRoughness, Shading, TextureBinding, TextureFormat, Transform};

use crate::gltf::{Doc, push};
use crate::saving::json_of;
use crate::texture::textured_square;
use crate::{warnings, warns_once};

const GLOSSY: &str = "KHR_materials_pbrSpecularGlossiness";
const VARIANTS: &str = "KHR_materials_variants";

fn material(loaded: &Loaded) -> &Material {
    loaded.scene.materials.iter().next().expect("a material").1
}

fn model(loaded: &Loaded) -> &MetallicRoughness {
    material(loaded).shading.metallic_roughness().expect("metallic-roughness")
}

/// The bytes of a texture's first texel.
fn texel(loaded: &Loaded, binding: Option<TextureBinding>) -> ([u8; 4], TextureFormat) {
    let texture = &loaded.scene.textures.get(binding.expect("a texture").texture).expect("there").texture;
    (texture.texels().next().expect("a texel"), texture.format())
}

#[test]
fn a_volume_is_read_with_its_texture() {
    let mut doc = textured_square();
    doc.json["materials"][0]["extensions"] = json!({
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 2.5, "thicknessTexture": {"index": 0},
            "attenuationDistance": 0.25, "attenuationColor": [0.5, 0.25, 1]}
    });
    doc.json["extensionsUsed"] = json!(["KHR_materials_volume", "KHR_materials_transmission"]);
    let loaded = doc.load();
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
    let found = material(&loaded);
    assert_eq!((found.thickness, found.attenuation_distance), (2.5, 0.25));
    assert_eq!(found.attenuation_color, Vec3::new(0.5, 0.25, 1.0));
    assert_eq!(texel(&loaded, found.thickness_texture).1, TextureFormat::Linear, "data");
    doc.json["materials"][0]["extensions"]["KHR_materials_volume"] = json!({});
    let found = material(&doc.load()).clone();
    assert_eq!((found.thickness, found.attenuation_distance), (0.0, f32::INFINITY), "thin, and clear");
    doc.json["materials"][0]["extensions"]["KHR_materials_volume"] =
        json!({"thicknessFactor": -1, "attenuationDistance": "far", "attenuationColor": [1, 2]});
    let loaded = doc.load();
    warns_once(&loaded, "thicknessFactor");
    assert_eq!(material(&loaded).thickness, 0.0, "clamped");
    assert_eq!(material(&loaded).attenuation_distance, f32::INFINITY, "no number");
}

/// The square with one texel for diffuse colour and one for the specular colour and glossiness.
fn glossy(extension: Value) -> Doc {
    let mut doc = textured_square();
    let mut png = Vec::new();
    encode_png(&mut png, 1, 1, Pixels::Rgba8(&[200, 100, 50, 51])).expect("memory takes it");
    let view = doc.view(&png);
    let image = push(&mut doc.json["images"], json!({"bufferView": view, "mimeType": "image/png"}));
    push(&mut doc.json["textures"], json!({"source": image}));
    doc.json["materials"][0] = json!({
        "pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 1], "metallicFactor": 1},
        "extensions": {GLOSSY: extension}
    });
    for list in ["extensionsUsed", "extensionsRequired"] {
        doc.json[list] = json!([GLOSSY]);
    }
    doc
}

/// The extension's appendix: F0 is the specular colour, the base colour of a dielectric the diffuse colour,
/// and roughness 1 − glossiness. It comes before the metallic-roughness beside it.
#[test]
fn specular_glossiness_keeps_its_colours_and_its_roughness() {
    let loaded = glossy(json!({
        "diffuseFactor": [0.5, 0.25, 0.125, 0.75], "specularFactor": [0.2, 0.4, 0.6], "glossinessFactor": 0.75
    }))
    .load();
    assert_eq!(warnings(&loaded), [""; 0], "it is read, required or not");
    let (found, surface) = (material(&loaded), model(&loaded));
    assert_eq!(found.base_color, Vec4::new(0.5, 0.25, 0.125, 0.75));
    assert_eq!((surface.metallic, surface.roughness), (0.0, 0.25));
    let root = (found.ior - 1.0) / (found.ior + 1.0);
    let f0 = root * root * surface.specular;
    assert_eq!(surface.specular_color * f0, Vec3::new(0.2, 0.4, 0.6), "head-on");
    let loaded = glossy(json!({})).load();
    let surface = model(&loaded);
    assert_eq!((material(&loaded).base_color, surface.roughness), (Vec4::ONE, 0.0), "defaults");
    assert_eq!(surface.specular_color, Vec3::ONE, "reflects everything");
}

#[test]
fn glossiness_in_a_texture_becomes_roughness() {
    for (factor, roughness) in [(1.0, 204), (0.5, 230)] {
        let loaded = glossy(json!({
            "diffuseTexture": {"index": 0}, "glossinessFactor": factor,
            "specularGlossinessTexture": {"index": 1, "texCoord": 0}
        }))
        .load();
        assert_eq!(warnings(&loaded), [""; 0]);
        let surface = model(&loaded);
        assert_eq!(texel(&loaded, material(&loaded).base_color_texture).0, [255, 0, 0, 255], "diffuse");
        let specular = texel(&loaded, surface.specular_color_texture);
        assert_eq!(specular, ([200, 100, 50, 51], TextureFormat::Srgb), "the specular colour as it is");
        let (made, format) = texel(&loaded, surface.texture);
        // 1 − factor · 51 / 255
        assert_eq!((made[1], format, surface.roughness), (roughness, TextureFormat::Linear, 1.0), "{factor}");
    }
}

/// What hostile files put in the place of numbers and textures.
#[test]
fn specular_glossiness_that_makes_no_sense_is_the_default() {
    for extension in [
        json!([]),
        json!({"diffuseFactor": "red", "specularFactor": [1], "glossinessFactor": [], "diffuseTexture": 7}),
        json!({"diffuseFactor": [1e39, -1, 9, 2], "glossinessFactor": 1e39}),
    ] {
        let loaded = glossy(extension).load();
        assert!(material(&loaded).base_color.is_finite(), "{:?}", material(&loaded));
    }
    let missing = glossy(json!({"specularGlossinessTexture": {"index": 77}})).refused();
    assert!(missing.contains("77"), "{missing}");
}

/// Once it is edited, the older extension would hide what is written beside it.
#[test]
fn an_edited_specular_glossiness_is_written_in_the_newer_extensions() {
    let glb = glossy(json!({
        "diffuseFactor": [0.5, 0.25, 0.125, 1], "glossinessFactor": 0.5, "diffuseTexture": {"index": 0},
        "specularGlossinessTexture": {"index": 1}
    }))
    .glb();
    let loaded = load_from_slice("a.glb", &glb, &LoadOptions::default()).expect("it can be read");
    let (mut document, _) =
        NativeDocument::load_from_slice("a.glb", &glb, &LoadOptions::default()).expect("it can be read");
    for (_, material) in document.scene.materials.iter_mut() {
        material.base_color = Vec4::new(0.1, 0.2, 0.3, 1.0);
    }
    let bytes = document.encode().expect("it is small").to_bytes();
    let again = load_from_slice("b.glb", &bytes, &LoadOptions::default()).expect("it can be read again");
    let [before, after] = [&loaded, &again].map(|loaded| *model(loaded));
    assert_eq!(material(&again).base_color, Vec4::new(0.1, 0.2, 0.3, 1.0));
    assert_eq!((after.roughness, after.metallic), (before.roughness, before.metallic));
    assert_eq!(material(&again).ior, 0.0, "the specular colour is F0");
    assert_eq!(texel(&again, after.texture), texel(&loaded, before.texture), "roughness, not glossiness");
    let image = texel(&again, after.specular_color_texture);
    assert_eq!(image, texel(&loaded, before.specular_color_texture));
}

/// The square in red, with the variants blue and green; only blue changes it.
fn variants() -> Doc {
    let mut doc = Doc::square();
    let colored = |color: [f32; 4]| json!({"pbrMetallicRoughness": {"baseColorFactor": color}});
    doc.json["materials"] = json!([colored([1., 0., 0., 1.]), colored([0., 0., 1., 1.])]);
    doc.primitive()["material"] = json!(0);
    doc.primitive()["extensions"] = json!({VARIANTS: {"mappings": [{"material": 1, "variants": [1]}]}});
    doc.json["extensions"] = json!({VARIANTS: {"variants": [{"name": "green"}, {"name": "blue"}]}});
    for list in ["extensionsUsed", "extensionsRequired"] {
        doc.json[list] = json!([VARIANTS]);
    }
    doc
}

fn with_variant(doc: &Doc, variant: &str) -> Result<Loaded, trigon_io::LoadError> {
    let options = LoadOptions { variant: Some(variant.to_owned()), ..LoadOptions::default() };
    load_from_slice("a.glb", &doc.glb(), &options)
}

#[test]
fn a_variant_is_chosen_by_its_name() {
    let plain = variants().load();
    assert_eq!(warnings(&plain), [""; 0], "it is read, required or not");
    assert_eq!(plain.variant_names, ["green", "blue"]);
    let red = Vec4::new(1.0, 0.0, 0.0, 1.0);
    assert_eq!(material(&plain).base_color, red, "without a choice the file's own");
    let blue = with_variant(&variants(), "blue").expect("there is one");
    assert_eq!(material(&blue).base_color, Vec4::new(0.0, 0.0, 1.0, 1.0));
    let green = with_variant(&variants(), "green").expect("there is one");
    assert_eq!(material(&green).base_color, red, "a primitive without a mapping keeps its own");
    let error = with_variant(&variants(), "Blue").expect_err("there is none").to_string();
    assert!(error.contains("\"Blue\"") && error.contains("\"green\", \"blue\""), "{error}");
    let without = with_variant(&Doc::square(), "blue").expect("it is drawn all the same");
    warns_once(&without, "no variants");
}

#[test]
fn variants_that_make_no_sense_are_told_or_ignored() {
    let mut doc = variants();
    let mapping = json!({"material": 9, "variants": [1]});
    doc.primitive()["extensions"][VARIANTS] =
        json!({"mappings": [mapping, {"material": 1, "variants": [1]}]});
    let loaded = with_variant(&doc, "blue").expect("there is one");
    warns_once(&loaded, "several materials");
    warns_once(&loaded, "does not exist");
    assert_eq!(material(&loaded).base_color, Vec4::new(0.0, 0.0, 1.0, 1.0), "the one that exists");
    for broken in
        [json!(5), json!({"mappings": {}}), json!({"mappings": [7, {"material": -1, "variants": 1}]})]
    {
        doc.primitive()["extensions"][VARIANTS] = broken;
        with_variant(&doc, "blue").expect("ignored");
    }
    for broken in [json!([]), json!({"variants": 3}), json!({"variants": [1, {"name": 2}]})] {
        doc.json["extensions"][VARIANTS] = broken;
        assert!(doc.load().variant_names.len() <= 2, "ignored or without names");
    }
}

/// Both the names and the mappings are still there, to the byte, when the file is written again.
#[test]
fn variants_survive_being_written_back() {
    let glb = variants().glb();
    let (mut document, _) =
        NativeDocument::load_from_slice("a.glb", &glb, &LoadOptions::default()).expect("it can be read");
    let (id, _) = document.scene.nodes().iter().next().expect("a node");
    document.scene.node_mut(id).expect("just found").transform = Transform::from_translation(DVec3::X);
    let (was, now) = (json_of(&glb), json_of(&document.encode().expect("it is small").to_bytes()));
    for pointer in ["/extensions", "/extensionsRequired", "/meshes", "/materials"] {
        assert_eq!(now.pointer(pointer), was.pointer(pointer), "{pointer}");
    }
    assert_ne!(now["nodes"], was["nodes"], "what was edited is written");
}

/// Shading models of unlit surfaces stay so, whatever an older extension says.
#[test]
fn unlit_comes_before_specular_glossiness() {
    let mut doc = glossy(json!({"diffuseFactor": [0, 0, 1, 1]}));
    doc.json["materials"][0]["extensions"]["KHR_materials_unlit"] = json!({});
    let loaded = doc.load();
    assert_eq!(material(&loaded).shading, Shading::Unlit);
    assert_eq!(material(&loaded).base_color, Vec4::new(0.0, 1.0, 0.0, 1.0), "that of metallic-roughness");
}
