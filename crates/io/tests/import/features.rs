//! What glTF can ask for, in images small enough to be written down: a letter for
//! each pixel. And light, against the formulas of the specification.

use serde_json::{Value, json};
use trigon_camera::{Camera, Projection};
use trigon_math::{DVec3, Vec3, color};
use trigon_scene::{
    Background, EffectSettings, Exposure, Frame, Lighting, Material, MetallicRoughness, ParameterField,
    RenderSettings, Scene, Shading, Texture, TextureBinding, TextureFormat, render,
};

use crate::gltf::{Doc, push};
use crate::texture::textured_square;

/// A square of one metre on a side, unlit, with four texels: red, green above blue,
/// white. It is seen from the front only.
fn square() -> Doc {
    let mut doc = textured_square();
    doc.json["materials"][0]["extensions"] = json!({"KHR_materials_unlit": {}});
    doc.json["samplers"] = json!([{"magFilter": 9728, "minFilter": 9728}]);
    doc
}

/// The same in white, without coordinates: for what is about places.
fn white() -> Doc {
    let mut doc = square();
    doc.json["materials"][0]["pbrMetallicRoughness"] = json!({});
    doc
}

/// Two metres around the middle of the square, seen along −Z without perspective.
fn front() -> Camera {
    let projection = Projection::orthographic(2.0, 0.1, 20.0).expect("the numbers are in range");
    Camera { position: DVec3::new(0.5, 0.5, 10.0), projection, ..Camera::default() }
}

fn image(scene: &Scene, camera: &Camera, side: u32) -> Frame {
    let settings = RenderSettings {
        samples_per_axis: 1,
        background: Background::Transparent,
        lighting: Lighting::Scene,
        // Lamps as bright as the file has them.
        effects: EffectSettings { exposure: Exposure::Stops(0.0), ..EffectSettings::default() },
        ..RenderSettings::new(side, side)
    };
    render(scene, camera, &settings).expect("the settings are in range")
}

/// Eight rows of eight letters, from the top: a pixel is a quarter of a metre.
fn letters(frame: &Frame) -> Vec<String> {
    let letter = |pixel: &[u8]| match pixel {
        [.., 0] => '.',
        [255, 0, 0, 255] => 'R',
        [0, 255, 0, 255] => 'G',
        [0, 0, 255, 255] => 'B',
        [255, 255, 255, 255] => 'W',
        [255, 255, 0, 255] => 'Y',
        [0, 0, 0, 255] => 'K',
        _ => '?',
    };
    frame.color.chunks(32).map(|row| row.chunks(4).map(letter).collect()).collect()
}

/// Eight rows from those that are not empty: `first` are above them.
fn rows(first: usize, rows: &str) -> Vec<String> {
    let mut all = vec![".".repeat(8); first];
    all.extend(rows.split('/').map(|row| format!("{row:.<8}")));
    all.resize(8, ".".repeat(8));
    all
}

/// Four columns two to the right, twice each: the square where it belongs.
fn in_place(upper: &str, lower: &str) -> Vec<String> {
    rows(2, &[upper, upper, lower, lower].map(|row| format!("..{row}..")).join("/"))
}

#[track_caller]
fn check(what: &str, doc: &Doc, expected: &[String]) {
    let loaded = doc.load();
    assert!(loaded.warnings.is_empty(), "{what}: {:?}", loaded.warnings);
    assert_eq!(letters(&image(&loaded.scene, &front(), 8)), expected, "{what}");
}

/// Changes the texture of the square.
fn with_texture(change: impl Fn(&mut Doc, &mut Value)) -> Doc {
    let mut doc = square();
    let mut texture = doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"].clone();
    change(&mut doc, &mut texture);
    doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = texture;
    doc
}

#[test]
fn texture_transforms() {
    let quarter = std::f64::consts::FRAC_PI_2;
    for (transform, upper, lower) in [
        (json!({}), "RRGG", "BBWW"),
        (json!({"offset": [0.5, 0]}), "GGRR", "WWBB"),
        (json!({"offset": [0, 0.5]}), "BBWW", "RRGG"),
        (json!({"scale": [2, 1]}), "RGRG", "BWBW"),
        // u' = v and v' = 1 - u, counter-clockwise.
        (json!({"rotation": quarter}), "BBRR", "WWGG"),
        (json!({"rotation": quarter, "offset": [0.5, 0]}), "WWGG", "BBRR"),
    ] {
        let doc =
            with_texture(|_, texture| texture["extensions"] = json!({"KHR_texture_transform": transform}));
        check(&transform.to_string(), &doc, &in_place(upper, lower));
    }
}

#[test]
fn wrap_modes() {
    // Columns look at u = -0.75, 0.25, 1.25 and 2.25.
    let spread = json!({"KHR_texture_transform": {"scale": [4, 1], "offset": [-1.25, 0]}});
    for (wrap, upper, lower) in [(10497, "RRRR", "BBBB"), (33648, "GRGR", "WBWB"), (33071, "RRGG", "BBWW")] {
        let doc = with_texture(|doc, texture| {
            texture["extensions"] = spread.clone();
            doc.json["samplers"][0]["wrapS"] = json!(wrap);
        });
        check(&format!("wrapS {wrap}"), &doc, &in_place(upper, lower));
    }
}

#[test]
fn both_sets_of_coordinates() {
    for in_extension in [false, true] {
        let doc = with_texture(|doc, texture| {
            let flipped = doc.floats("VEC2", &[1., 1., 0., 1., 0., 0., 1., 0.]);
            doc.primitive()["attributes"]["TEXCOORD_1"] = json!(flipped);
            if in_extension {
                texture["extensions"] = json!({"KHR_texture_transform": {"texCoord": 1}});
            } else {
                texture["texCoord"] = json!(1);
            }
        });
        check(&format!("in the extension: {in_extension}"), &doc, &in_place("GGRR", "WWBB"));
    }
}

#[test]
fn vertex_colors_and_alpha() {
    let mut doc = square();
    let yellow = doc.floats("VEC3", &[1., 1., 0., 1., 1., 0., 1., 1., 0., 1., 1., 0.]);
    doc.primitive()["attributes"]["COLOR_0"] = json!(yellow);
    check("a factor of yellow", &doc, &in_place("RRGG", "KKYY"));
    // Alpha grows from 0 on the left to 1 on the right.
    let fading = doc.floats("VEC4", &[1., 1., 1., 0., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 0.]);
    doc.primitive()["attributes"]["COLOR_0"] = json!(fading);
    check("opaque whatever alpha says", &doc, &in_place("RRGG", "BBWW"));
    doc.json["materials"][0]["alphaMode"] = json!("MASK");
    check("a hole below the cutoff", &doc, &in_place("..GG", "..WW"));
    doc.json["materials"][0]["alphaCutoff"] = json!(0.75);
    check("another cutoff", &doc, &in_place("...G", "...W"));
}

#[test]
fn mirrored_and_turned_nodes() {
    let turned = json!({"mesh": 0, "rotation": [0, 1, 0, 0], "translation": [1, 0, 0]});
    for (node, double_sided, expected) in [
        (json!({"mesh": 0, "scale": [-1, 1, 1], "translation": [1, 0, 0]}), false, in_place("GGRR", "WWBB")),
        (json!({"mesh": 0, "scale": [1, -1, 1], "translation": [0, 1, 0]}), false, in_place("BBWW", "RRGG")),
        (turned.clone(), false, rows(0, "")),
        (turned, true, in_place("GGRR", "WWBB")),
        (json!({"mesh": 0, "scale": [1.5, 0.5, 1]}), false, rows(4, "..RRRGGG/..BBBWWW")),
        (
            json!({"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1]}),
            false,
            in_place("GGWW", "RRBB"),
        ),
    ] {
        let mut doc = square();
        doc.json["nodes"] = json!([node]);
        doc.json["materials"][0]["doubleSided"] = json!(double_sided);
        check(&node.to_string(), &doc, &expected);
    }
}

#[test]
fn primitive_modes() {
    // Points are three times as wide as lines.
    let (points, line) = (".WWW.WWW", "..WWWWW");
    let square = in_place("WWWW", "WWWW");
    for (mode, indices, expected) in [
        (0, None, rows(1, &[points, points, points, ".", points, points, points].join("/"))),
        (1, None, rows(2, &format!("{line}/./././{line}"))),
        (2, None, rows(2, &format!("{line}/..W...W/..W...W/..W...W/{line}"))),
        (3, None, rows(2, &format!("{line}/......W/......W/......W/{line}"))),
        (4, Some([0, 1, 2, 0, 2, 3].as_slice()), square.clone()),
        (5, Some(&[0, 1, 3, 2]), square.clone()),
        (6, None, square),
    ] {
        let mut doc = white();
        let primitive = doc.primitive();
        primitive["mode"] = json!(mode);
        primitive.as_object_mut().expect("an object").remove("indices");
        if let Some(indices) = indices {
            let indices = doc.accessor(5121, "SCALAR", indices.len(), indices);
            doc.primitive()["indices"] = json!(indices);
        }
        if mode < 4 {
            // Lines and points lie in the middle of pixels.
            doc.json["nodes"][0]["translation"] = json!([0.125, -0.125, 0]);
        }
        check(&format!("mode {mode}"), &doc, &expected);
    }
}

/// They were white: <https://github.com/KhronosGroup/glTF-Sample-Viewer/issues/549>.
#[test]
fn colours_of_vertices_multiply_the_base_colour_in_every_mode() {
    let in_modes = |letter: char| {
        let (points, line) = (".WWW.WWW", "..WWWWW");
        let pictures = [
            rows(1, &[points, points, points, ".", points, points, points].join("/")),
            rows(2, &format!("{line}/./././{line}")),
            rows(2, &format!("{line}/..W...W/..W...W/..W...W/{line}")),
            rows(2, &format!("{line}/......W/......W/......W/{line}")),
        ];
        pictures.map(|rows| rows.iter().map(|row| row.replace('W', &letter.to_string())).collect::<Vec<_>>())
    };
    for (base, letter) in [([1, 1, 1, 1], 'G'), ([1, 1, 0, 1], 'G'), ([1, 0, 0, 1], 'K')] {
        for (mode, expected) in in_modes(letter).iter().enumerate() {
            let mut doc = white();
            doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!(base);
            doc.json["nodes"][0]["translation"] = json!([0.125, -0.125, 0]);
            let colors = doc.floats("VEC3", &[0.0_f32, 1.0, 0.0].repeat(4));
            let primitive = doc.primitive();
            (primitive["mode"], primitive["attributes"]["COLOR_0"]) = (json!(mode), json!(colors));
            primitive.as_object_mut().expect("an object").remove("indices");
            check(&format!("{base:?} in mode {mode}"), &doc, expected);
        }
    }
}

#[test]
fn sparse_and_quantized_positions() {
    let mut doc = white();
    let moved: Vec<u8> =
        [1.5_f32, 0., 0., 1.5, 1., 0.].iter().flat_map(|value| value.to_le_bytes()).collect();
    let (indices, values) = (doc.view(&[1, 2]), doc.view(&moved));
    doc.json["accessors"][0]["sparse"] = json!({"count": 2,
        "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values}});
    check("two of four replaced", &doc, &rows(2, &["..WWWWWW"; 4].join("/")));

    let mut doc = white();
    let bytes = [[0, 0], [255, 0], [255, 255], [0, 255]].map(|[x, y]| [x, y, 0, 0]);
    let places = doc.accessor(5121, "VEC3", 4, bytes.as_flattened());
    let view = doc.json["accessors"][places]["bufferView"].as_u64().expect("a view") as usize;
    doc.json["bufferViews"][view]["byteStride"] = json!(4);
    doc.json["accessors"][places]["normalized"] = json!(true);
    doc.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    doc.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    doc.primitive()["attributes"]["POSITION"] = json!(places);
    check("bytes", &doc, &in_place("WWWW", "WWWW"));
}

#[test]
fn instances_scenes_and_cameras() {
    let mut doc = square();
    let quarter = |x: f64, y: f64| json!({"mesh": 0, "scale": [0.5, 0.5, 1], "translation": [x, y, 0]});
    doc.json["nodes"] =
        json!([quarter(-0.5, 1.0), quarter(0.0, 0.5), {"camera": 0, "translation": [1.5, 0.5, 9]}]);
    doc.json["scenes"] = json!([{"nodes": [1]}, {"nodes": [0, 1, 2]}]);
    doc.json["scene"] = json!(1);
    doc.json["cameras"] = json!([{"type": "orthographic",
        "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 20}}]);
    check("one mesh twice", &doc, &rows(0, "RG/BW/..RG/..BW"));
    let scene = doc.load().scene;
    let (_, camera) = scene.cameras()[0];
    // The camera stands a metre further to the right.
    assert_eq!(letters(&image(&scene, &camera, 8)), rows(0, ""), "nothing is there");
    doc.json["nodes"][2]["translation"] = json!([0, 0.5, 9]);
    let scene = doc.load().scene;
    let (_, camera) = scene.cameras()[0];
    assert_eq!(letters(&image(&scene, &camera, 8)), rows(0, "..RG/..BW/....RG/....BW"), "two to the right");
    doc.json["scene"] = json!(0);
    check("another scene", &doc, &rows(2, "..RG/..BW"));
}

#[test]
fn joints_and_targets() {
    let mut doc = white();
    let joints = doc.accessor(5121, "VEC4", 4, &[0; 16]);
    let weights = doc.floats("VEC4", &[1., 0., 0., 0.].repeat(4));
    doc.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    doc.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    doc.json["skins"] = json!([{"joints": [1]}]);
    doc.json["nodes"] = json!([{"mesh": 0, "skin": 0}, {"translation": [0.25, 0.5, 0]}]);
    check("a joint to the right and up", &doc, &rows(0, &["...WWWW"; 4].join("/")));

    let mut doc = white();
    let target = doc.floats("VEC3", &[0., 0., 0., 0.5, 0., 0., 0.5, 0., 0., 0., 0., 0.]);
    doc.primitive()["targets"] = json!([{"POSITION": target}]);
    for (weight, row) in [(0.0, "..WWWW"), (0.5, "..WWWWW"), (1.0, "..WWWWWW"), (-0.5, "..WWW")] {
        doc.json["meshes"][0]["weights"] = json!([weight]);
        check(&format!("weight {weight}"), &doc, &rows(2, &[row; 4].join("/")));
    }
}

#[test]
fn animations_at_a_time() {
    // From 0 to 1.6 m within a second; the spline's tangents are level.
    let straight = [0., 0., 0., 1.6, 0., 0.];
    let spline = [[0.; 3], [0.; 3], [0.; 3], [0.; 3], [1.6, 0., 0.], [0.; 3]];
    for (interpolation, values, time, row) in [
        ("STEP", straight.as_slice(), 0.9, "..WWWW"),
        ("LINEAR", &straight, 0.3125, "....WWWW"),
        // 3 t² − 2 t³ = 5/32.
        ("CUBICSPLINE", spline.as_flattened(), 0.25, "...WWWW"),
        ("LINEAR", &straight, -7.0, "..WWWW"),
    ] {
        let mut doc = white();
        let times = doc.floats("SCALAR", &[0., 1.]);
        doc.json["accessors"][times]["min"] = json!([0]);
        doc.json["accessors"][times]["max"] = json!([1]);
        let values = doc.floats("VEC3", values);
        doc.json["animations"] = json!([{
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
            "samplers": [{"input": times, "output": values, "interpolation": interpolation}]}]);
        let mut scene = doc.load().scene;
        let pose = scene.pose(&scene.animations[0], time);
        scene.apply_pose(&pose);
        let expected = rows(2, &[row; 4].join("/"));
        assert_eq!(letters(&image(&scene, &front(), 8)), expected, "{interpolation} at {time}");
    }
}

/// A matt square (or one with highlights) in the light of one lamp above its middle,
/// which shines down on it.
fn lit(material: Value, light: Value, height: f64) -> Doc {
    let mut doc = square();
    doc.json["materials"][0] = material;
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
    push(
        &mut doc.json["nodes"],
        json!({"translation": [0.5, 0.5, height], "extensions": {"KHR_lights_punctual": {"light": 0}}}),
    );
    doc
}

/// A white surface that reflects nothing but diffuse light.
fn matt() -> Value {
    json!({"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})
}

#[track_caller]
fn assert_shows(frame: &Frame, [x, y]: [u32; 2], channel: usize, exact: f64, what: &str) {
    let (shown, exact) = (frame.pixel(x, y)[channel], color::linear_to_srgb8(exact as f32));
    assert!(shown.abs_diff(exact) <= 1, "{what}: {shown} at ({x}, {y}), not {exact}");
}

/// KHR_lights_punctual: candela over the square of the distance, the window of the
/// range, and the smooth rim of the cone, on a surface that shows light / π.
#[test]
fn a_spot_falls_off_as_the_extension_says() {
    let (intensity, range, inner, outer, height) = (1.5_f64, 3.0_f64, 0.3_f64, 0.8_f64, 0.75_f64);
    let light = json!({"type": "spot", "intensity": intensity, "range": range,
        "spot": {"innerConeAngle": inner, "outerConeAngle": outer}});
    const SIDE: u32 = 32;
    let frame = image(&lit(matt(), light, height).load().scene, &front(), SIDE);
    let [inner_cosine, outer_cosine] = [inner, outer].map(trigon_math::elementary::cos);
    let mut lit = 0;
    for (x, y) in
        (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))).filter(|&(x, y)| frame.pixel(x, y)[3] > 0)
    {
        let place = |at: u32| (f64::from(at) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
        let squared = |value: f64| value * value;
        let distance = (squared(place(x)) + squared(place(y)) + squared(height)).sqrt();
        let cosine = height / distance;
        let window = (1.0 - squared(squared(distance / range))).clamp(0.0, 1.0) / squared(distance);
        let rim = squared(((cosine - outer_cosine) / (inner_cosine - outer_cosine)).clamp(0.0, 1.0));
        let shown = intensity * window * rim * cosine / std::f64::consts::PI;
        assert_shows(&frame, [x, y], 1, shown, "a spot");
        lit += usize::from(frame.pixel(x, y)[1] > 0);
    }
    assert!(lit > 100, "{lit} pixels are lit");
}

/// Head-on, a rough dielectric reflects f0 · D · V of the light, 1 / (4 π) of it, and
/// the rest of it diffusely; f0 follows from the two extensions.
#[test]
fn highlights_follow_ior_and_specular() {
    let lux = 8.0 * std::f64::consts::PI;
    for (extensions, f0) in [
        (json!({}), [0.04; 3]),
        (json!({"KHR_materials_ior": {"ior": 2.0}}), [1.0 / 9.0; 3]),
        (json!({"KHR_materials_ior": {"ior": 1.0}}), [0.0; 3]),
        (json!({"KHR_materials_specular": {"specularFactor": 0.5}}), [0.02; 3]),
        (json!({"KHR_materials_specular": {"specularColorFactor": [1, 0.5, 4]}}), [0.04, 0.02, 0.16]),
        (
            json!({"KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [4, 1, 1]},
            "KHR_materials_ior": {"ior": 2.0}}),
            [2.0 / 9.0, 0.5 / 9.0, 0.5 / 9.0],
        ),
    ] {
        let pbr = json!({"metallicFactor": 0, "roughnessFactor": 1, "baseColorFactor": [0, 0, 0, 1]});
        let material = json!({"pbrMetallicRoughness": pbr, "extensions": extensions});
        let sun = json!({"type": "directional", "intensity": lux});
        let frame = image(&lit(material, sun, 3.0).load().scene, &front(), 8);
        for (channel, f0) in f0.into_iter().enumerate() {
            let shown = f0 * lux / (4.0 * std::f64::consts::PI);
            assert_shows(&frame, [4, 4], channel, shown, &extensions.to_string());
        }
    }
}

#[test]
fn emission_has_a_strength() {
    let mut doc = square();
    doc.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]},
        "emissiveFactor": [0.25, 0.1, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}}]);
    let frame = image(&doc.load().scene, &front(), 8);
    for (channel, shown) in [0.5, 0.2, 0.0].into_iter().enumerate() {
        assert_shows(&frame, [4, 4], channel, shown, "twice as strong");
    }
}

/// Red of one half over green of a quarter over nothing, premultiplied: (1/2, 1/8, 0)
/// and alpha 5/8, whichever of the two is listed first.
#[test]
fn translucent_squares_are_laid_over_each_other() {
    for swapped in [false, true] {
        let mut doc = white();
        let pane = |color: [f64; 4]| {
            json!({"pbrMetallicRoughness": {"baseColorFactor": color}, "alphaMode": "BLEND",
                "extensions": {"KHR_materials_unlit": {}}})
        };
        doc.json["materials"] = json!([pane([0.0, 1.0, 0.0, 0.25]), pane([1.0, 0.0, 0.0, 0.5])]);
        let mut near = doc.json["meshes"][0].clone();
        near["primitives"][0]["material"] = json!(1);
        push(&mut doc.json["meshes"], near);
        let (far, near) = (json!({"mesh": 0}), json!({"mesh": 1, "translation": [0, 0, 1]}));
        doc.json["nodes"] = if swapped { json!([near, far]) } else { json!([far, near]) };
        let frame = image(&doc.load().scene, &front(), 8);
        let alpha: f64 = 0.5 + 0.5 * 0.25;
        for (channel, premultiplied) in [0.5, 0.125, 0.0].into_iter().enumerate() {
            assert_shows(&frame, [4, 4], channel, premultiplied / alpha, "straight again");
        }
        assert_eq!(f64::from(frame.pixel(4, 4)[3]), (alpha * 255.0).round(), "alpha");
    }
}

/// Sets each parameter of an extension to a value that is not its default.
fn set_all_parameters(material: &mut Material, colors: TextureBinding, data: TextureBinding) {
    for row in Material::EXTENSION_PARAMETERS {
        match row.field {
            ParameterField::Share(field) | ParameterField::Amount(field) => {
                *field(material).expect("the model has it") = 0.25;
            }
            ParameterField::Color(field) => *field(material).expect("it has") = Vec3::new(0.5, 0.25, 0.75),
            ParameterField::Texture(place) => {
                let is_color = place.format() == TextureFormat::Srgb;
                material.set_texture(place, Some(if is_color { colors } else { data }));
            }
        }
    }
}

#[test]
fn parameters_of_extensions_are_written_and_read() {
    let mut scene = Scene::new();
    let texture = |format| Texture::new(1, 1, vec![[9, 8, 7, 6]], format).expect("one texel");
    let [colors, data] = [TextureFormat::Srgb, TextureFormat::Linear]
        .map(|format| TextureBinding::new(scene.add_texture("texel", texture(format))));
    let shading = Shading::MetallicRoughness(MetallicRoughness::default());
    let mut material = Material::default().with_shading(shading);
    set_all_parameters(&mut material, colors, data);
    scene.add_object("cube", trigon_mesh::primitives::cube(1.0), material.clone());
    let glb = trigon_io::encode_glb(&scene, &trigon_io::ExportOptions::default()).expect("it can be written");
    let options = trigon_io::LoadOptions::default();
    let read = trigon_io::load_from_slice("cube.glb", &glb, &options).expect("it can be read").scene;
    let mut read = read.materials.iter().next().map(|(_, read)| read.clone()).expect("one material");
    for row in Material::EXTENSION_PARAMETERS {
        match row.field {
            ParameterField::Share(field) | ParameterField::Amount(field) => {
                assert_eq!(field(&mut read), field(&mut material), "{}", row.name);
            }
            ParameterField::Color(field) => {
                assert_eq!(field(&mut read), field(&mut material), "{}", row.name);
            }
            ParameterField::Texture(place) => assert!(read.texture(place).is_some(), "{}", row.name),
        }
    }
}
