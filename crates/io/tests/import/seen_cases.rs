//! Files as people bring them, as they are seen: colours of points, keyframes, planes, lamps and open edges.

use std::collections::HashMap;
use std::fs;

use trigon_camera::{Camera, Projection};
use trigon_io::Loaded;
use trigon_math::color::srgb8_to_linear;
use trigon_math::{DVec3, Vec4};
use trigon_scene::{Background, Frame, Outputs, RenderSettings, Scene, render};

use crate::{loaded, meshes, warnings};

fn bytes(name: &str) -> Vec<u8> {
    let path = format!("{}/tests/cases/{name}", env!("CARGO_MANIFEST_DIR"));
    fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn case(name: &str) -> Loaded {
    let model = loaded(name.rsplit('/').next().unwrap_or(name), &bytes(name));
    // The balls have triangles without area at their poles.
    let all = warnings(&model);
    assert!(all.iter().all(|warning| warning.contains("fewer than 3 different vertices")), "{all:?}");
    model
}

fn image(scene: &Scene, camera: &Camera, [width, height]: [u32; 2]) -> Frame {
    let outputs = Outputs { ids: true, ..Outputs::default() };
    let background = Background::Color(trigon_math::Vec3::ZERO);
    let settings =
        RenderSettings { outputs, background, samples_per_axis: 1, ..RenderSettings::new(width, height) };
    render(scene, camera, &settings).expect("in range")
}

/// COLOR_0 multiplies the base colour in every mode (glTF 2.0, 3.9.2): green times white, unlit.
#[test]
fn points_and_lines_of_a_gltf_are_green() {
    for name in ["mode0", "mode1", "mode3"] {
        let scene = case(&format!("gltf-point-line-colors/{name}.gltf")).scene;
        let frame = image(&scene, &scene.overview(1.0), [64, 64]);
        let seen: Vec<&[u8]> = frame.color.chunks_exact(4).filter(|pixel| pixel[1] > 0).collect();
        let other = frame.color.chunks_exact(4).filter(|pixel| pixel[0] > 0 || pixel[2] > 0).count();
        assert_eq!(other, 0, "{name}: nothing is red or blue");
        assert!(seen.len() >= 64, "{name}: {} pixels are seen", seen.len());
        assert!(seen.iter().filter(|pixel| pixel[1] == 255).count() > 16, "{name}: in full green");
    }
}

/// Clouds and lines with a colour for each vertex: bytes of a GLB are linear light, those of a PLY are sRGB.
#[test]
fn clouds_and_lines_have_the_colors_in_their_bytes() {
    for (name, edges) in [("cloud.glb", 0), ("lines.glb", 2999)] {
        let model = case(&format!("points-colors/{name}"));
        let mesh = meshes(&model)[0];
        assert_eq!((mesh.vertex_count(), mesh.loose_edges().len()), (3000, edges), "{name}");
        let file = bytes(&format!("points-colors/{name}"));
        // The last view: four bytes for each vertex.
        let stored = file[file.len() - 12_000..].chunks_exact(4);
        let expected =
            stored.map(|bytes| Vec4::from_slice(&[0, 1, 2, 3].map(|i| f32::from(bytes[i]) / 255.0)));
        assert_colors(name, &model, expected.collect());
    }
    let file = bytes("points-colors/cloud.ply");
    let rows = file[file.len() - 15_000..].chunks_exact(15);
    let expected = rows.map(|row| {
        let [r, g, b] = [12, 13, 14].map(|at| srgb8_to_linear(row[at]));
        Vec4::new(r, g, b, 1.0)
    });
    assert_colors("cloud.ply", &case("points-colors/cloud.ply"), expected.collect());
}

/// Asserts the colours of a model's vertices, and that many of them are seen.
fn assert_colors(name: &str, model: &Loaded, expected: Vec<Vec4>) {
    let mesh = meshes(model)[0];
    let found = mesh.attributes().vertex_colors.as_ref().unwrap_or_else(|| panic!("{name} has colours"));
    assert_eq!(found.len(), expected.len(), "{name}");
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((*found - expected).abs().max_element() < 1e-6, "{name}: {found}, not {expected} at {index}");
    }
    let frame = image(&model.scene, &model.scene.overview(1.0), [64, 64]);
    let mut colors: Vec<&[u8]> = frame.color.chunks_exact(4).collect();
    colors.sort_unstable();
    colors.dedup();
    assert!(colors.len() > 300, "{name} shows {} colours", colors.len());
}

/// Keyframe k at f32(k/24) with the value k: the frame at k/24 shows k.
#[test]
fn steps_of_a_file_show_their_own_keyframe_at_their_own_rate() {
    let scene = case("gltf-step-frames/m24.gltf").scene;
    for frame in 0..=24 {
        let mut scene = scene.clone();
        let pose = scene.pose(&scene.animations[0], f64::from(frame) / 24.0);
        scene.apply_pose(&pose);
        let places: Vec<f64> =
            scene.nodes().iter().map(|(id, _)| scene.world_transform(id).translation.x).collect();
        assert!(places.contains(&f64::from(frame)), "frame {frame} is at {places:?}");
    }
}

/// An eye at the origin that looks along −Z, with the planes that the engine sets.
fn ahead(scene: &Scene, eye: DVec3) -> Camera {
    let projection = Projection::perspective(0.8, 1.0, None).expect("in range");
    let camera = Camera::look_at(eye, eye + DVec3::NEG_Z, DVec3::Y).with_projection(projection);
    camera.with_clip_planes(&scene.bounds())
}

/// A ball of 1 m at 2 m: a circle with a radius of 0.5/√3.75 of a metre at a metre's distance, where a row is 0.4228/18.
#[test]
fn a_ball_is_seen_before_a_moon_and_a_ground_right_under_the_eye() {
    let radius = 0.5 / 3.75_f64.sqrt() / (0.422_793 / 18.0);
    let area = std::f64::consts::PI * radius * radius;
    for name in ["near-moon/nomoon.glb", "near-moon/moon.glb"] {
        let scene = case(name).scene;
        let ids = image(&scene, &ahead(&scene, DVec3::ZERO), [48, 36]).object_ids.expect("asked for");
        let ball = ids.iter().filter(|&&id| id == 0).count() as f64;
        // Of 48 triangles around: a little less than a circle.
        assert!((0.97 * area - 4.0..area + 4.0).contains(&ball), "{name}: {ball} pixels of {area}");
    }
    let scene = case("near-moon/ground.glb").scene;
    let ids = image(&scene, &ahead(&scene, DVec3::Y * 1.7), [48, 36]).object_ids.expect("asked for");
    let (sky, ground) = ids.split_at(ids.len() / 2);
    assert!(ground.iter().all(|&id| id == 0), "all below the horizon is ground");
    assert!(sky.iter().all(|&id| id == u32::MAX), "none of it is above");
}

/// A lamp of 54,350 cd, seven metres from a red ball: it shows red, neither white nor black.
#[test]
fn a_lamp_in_candela_shows_a_red_ball() {
    let scene = case("lamps-physical/lamp.glb").scene;
    let frame = image(&scene, &scene.overview(1.0), [64, 64]);
    let ids = frame.object_ids.as_ref().expect("asked for");
    let ball: Vec<&[u8]> =
        frame.color.chunks_exact(4).zip(ids).filter(|(_, id)| **id == 0).map(|(pixel, _)| pixel).collect();
    let share =
        |is: &dyn Fn(&[u8]) -> bool| ball.iter().filter(|pixel| is(pixel)).count() as f64 / ball.len() as f64;
    assert!(ball.len() > 1000, "it fills the image");
    assert!(
        share(&|pixel| pixel[0] > 80 && u16::from(pixel[0]) > 2 * u16::from(pixel[1])) > 0.4,
        "much of it is red"
    );
    assert!(share(&|pixel| pixel[0] == 255) < 0.05, "little of it is as bright as can be");
}

/// A box that lacks two triangles: the edges that only one triangle has, counted by the places of their ends.
#[test]
fn the_open_edges_of_a_box_are_those_of_one_triangle() {
    let file = bytes("open-edges/open.stl");
    let mut sides: HashMap<[[u32; 3]; 2], u32> = HashMap::new();
    for facet in file[84..].chunks_exact(50) {
        let number = |at: usize| u32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]);
        let corner = |corner: usize| [0, 1, 2].map(|axis| number(12 + 12 * corner + 4 * axis));
        for k in 0..3 {
            let mut ends = [corner(k), corner((k + 1) % 3)];
            ends.sort_unstable();
            *sides.entry(ends).or_default() += 1;
        }
    }
    let open = sides.values().filter(|&&count| count == 1).count();
    assert!(open >= 4, "{open} edges are open");
    let model = case("open-edges/open.stl");
    let surface = meshes(&model)[0].surface();
    assert_eq!((surface.open_edges.len(), surface.non_manifold_edges.len()), (open, 0));
    let findings = model.scene.check();
    let told = findings.iter().find(|finding| finding.fault == "open-edges").expect("it is told");
    assert!(told.to_string().contains(&format!("{open} open edges")), "{told}");
}
