use trigon_camera::Camera;
use trigon_math::DVec3;
use trigon_mesh::{Attributes, Mesh, primitives};
use trigon_raster::simd::SimdLevel;
use trigon_raster::{Texture, TextureFormat};

use super::*;
use crate::{
    Light, MetallicRoughness, Node, Occlusion, Outputs, RenderSettings, Scene, TextureBinding, render,
    showcase,
};

/// A plane that fills the image.
fn plane() -> (Scene, Camera) {
    let mut scene = Scene::new();
    let pixel = |scene: &mut Scene, texel: [u8; 4], format| {
        let texture = Texture::new(1, 1, vec![texel], format).expect("one texel");
        TextureBinding::new(scene.add_texture("texel", texture))
    };
    let surface = pixel(&mut scene, [51, 102, 204, 255], TextureFormat::Linear);
    let model =
        MetallicRoughness { metallic: 0.5, roughness: 1.0, texture: Some(surface), ..Default::default() };
    let material = Material {
        base_color: Vec4::new(1.0, 1.0, 1.0, 0.4),
        base_color_texture: Some(pixel(&mut scene, [200, 100, 50, 255], TextureFormat::Srgb)),
        shading: Shading::MetallicRoughness(model),
        occlusion: Some(Occlusion { binding: surface, strength: 0.5 }),
        emissive: Vec3::ONE,
        emissive_texture: Some(pixel(&mut scene, [10, 20, 30, 255], TextureFormat::Srgb)),
        alpha_mode: AlphaMode::Blend,
        ..Material::default()
    };
    scene.add_object("plane", primitives::plane(4.0, 4.0), material);
    scene.add(Node::from_light(Light::directional(3.0)));
    // The plane lies across Y.
    (scene, Camera::look_at(DVec3::Y * 2.0, DVec3::ZERO, DVec3::NEG_Z))
}

fn settings(display: Display) -> RenderSettings {
    RenderSettings { display, samples_per_axis: 1, ..RenderSettings::new(9, 9) }
}

/// The pixel in the middle.
fn shown(display: Display) -> [u8; 4] {
    let (scene, camera) = plane();
    render(&scene, &camera, &settings(display)).expect("drawn").pixel(4, 4)
}

#[test]
fn each_mode_shows_the_value_of_the_surface() {
    for (display, expected) in [
        (Display::BaseColor, [200, 100, 50, 255]),
        (Display::Emission, [10, 20, 30, 255]),
        (Display::Metallic, [102, 102, 102, 255]),
        (Display::Roughness, [102, 102, 102, 255]),
        // 1 − 0.5 × (1 − 51/255).
        (Display::Occlusion, [153, 153, 153, 255]),
        (Display::Alpha, [102, 102, 102, 255]),
        // +Y.
        (Display::Normal, [127, 255, 127, 255]),
        (Display::GeometricNormal, [127, 255, 127, 255]),
        (Display::TextureCoordinates, [127, 127, 0, 255]),
    ] {
        assert_eq!(shown(display), expected, "{}", display.name());
    }
}

#[test]
fn normals_are_along_the_worlds_axes_whichever_way_the_camera_looks() {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(2.0), Material::default());
    for (from, expected) in [
        (DVec3::X, [255, 127, 127, 255]),
        (DVec3::NEG_X, [0, 127, 127, 255]),
        (DVec3::Z, [127, 127, 255, 255]),
        (DVec3::NEG_Z, [127, 127, 0, 255]),
    ] {
        let camera = Camera::look_at(from * 6.0, DVec3::ZERO, DVec3::Y);
        for display in [Display::Normal, Display::GeometricNormal] {
            let frame = render(&scene, &camera, &settings(display)).expect("drawn");
            assert_eq!(frame.pixel(4, 4), expected, "from {from}, {}", display.name());
        }
    }
}

/// The image of values and the output of the same name agree, within the rounding of each.
#[test]
fn modes_agree_with_the_outputs_of_the_same_name() {
    // Its triangles are large: moving vertices to the sub-pixel grid, which outputs do not, changes no byte by one.
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::icosphere(1.0, 1), Material::default());
    let camera = scene.overview(1.5);
    let outputs = Outputs { normals: true, geometric_normals: true, ..Outputs::default() };
    let byte = |value: f32| (value * 255.0).round().clamp(0.0, 255.0) as i32;
    for display in [Display::Normal, Display::GeometricNormal] {
        let settings = RenderSettings { width: 48, height: 32, outputs, ..settings(display) };
        let frame = render(&scene, &camera, &settings).expect("drawn");
        let vectors = if display == Display::Normal { &frame.normals } else { &frame.geometric_normals };
        let vectors = vectors.as_ref().expect("asked for");
        let seen: Vec<usize> = (0..vectors.len()).filter(|&at| vectors[at] != Vec3::ZERO).collect();
        assert!(seen.len() > 300, "the ball is in view");
        for at in seen {
            let expected = (vectors[at] * 0.5 + 0.5).to_array().map(byte);
            let pixel = &frame.color[4 * at..4 * at + 3];
            for (channel, expected) in pixel.iter().zip(expected) {
                let far = (i32::from(*channel) - expected).abs();
                assert!(far <= 1, "{} at {at}: {pixel:?}, not {expected}", display.name());
            }
        }
    }
}

#[test]
fn depth_is_dark_where_it_is_near_and_keeps_what_else_is_asked_for() {
    let mut scene = Scene::new();
    for (x, z) in [(-1.0, 0.0), (1.0, -4.0)] {
        let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
        scene.node_mut(cube).expect("there").transform.translate(DVec3::new(x, 0.0, z));
    }
    let camera = Camera::look_at(DVec3::Z * 6.0, DVec3::ZERO, DVec3::Y);
    let outputs = Outputs { depth: true, ids: true, ..Outputs::default() };
    let settings = RenderSettings { width: 60, height: 30, outputs, ..settings(Display::Depth) };
    let frame = render(&scene, &camera, &settings).expect("drawn");
    let plain = RenderSettings { display: Display::Shaded, ..settings.clone() };
    let plain = render(&scene, &camera, &plain).expect("drawn");
    assert_eq!((&frame.depth, &frame.object_ids), (&plain.depth, &plain.object_ids), "the same");
    let greys: Vec<u8> = frame.color.chunks(4).map(|pixel| pixel[0]).collect();
    assert_eq!(greys.iter().min(), Some(&0), "the nearest is black");
    assert!(greys.contains(&235) || greys.contains(&234), "the farthest is light grey");
    assert_eq!(frame.pixel(0, 0), [255; 4], "the background is white");
    let alone = RenderSettings { outputs: Outputs::default(), ..settings };
    let alone = render(&scene, &camera, &alone).expect("drawn");
    assert!(alone.color == frame.color && alone.depth.is_none(), "the same colours, and no depth");
}

/// The material does not matter, nor where the scene's lights are; how a face is turned does.
#[test]
fn matcap_shows_one_clay() {
    let matcap = |material: Material, light: bool| {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::uv_sphere(1.0, 16, 8), material);
        if light {
            scene.add(Node::from_light(Light::directional(2.0)));
        }
        render(&scene, &scene.overview(1.0), &settings(Display::Matcap)).expect("drawn").color
    };
    let plain = matcap(Material::default(), false);
    assert!(plain == matcap(Material::from_color(Vec3::X), true), "one clay in the studio's light");
    let distinct: std::collections::BTreeSet<_> = plain.chunks(4).collect();
    assert!(distinct.len() > 10, "shaded");
}

/// Modes are drawn with the same bytes at every level and number of threads, like everything else.
#[test]
fn levels_and_threads_change_no_byte() {
    let scene = showcase();
    let camera = scene.overview(1.5);
    let levels: Vec<SimdLevel> = SimdLevel::ALL.into_iter().filter(|level| level.is_supported()).collect();
    for display in Display::ALL {
        let settings = RenderSettings { width: 60, height: 40, ..settings(display) };
        let expected = render(&scene, &camera, &settings).expect("drawn");
        for &level in &levels {
            let threads = std::num::NonZeroUsize::new(1);
            let settings = RenderSettings { simd: Some(level), threads, ..settings.clone() };
            assert!(render(&scene, &camera, &settings).expect("drawn") == expected, "{display:?} at {level}");
        }
    }
}

#[test]
fn a_mesh_without_coordinates_shows_zeros() {
    let mut mesh: Mesh = primitives::plane(4.0, 4.0);
    mesh.set_attributes(Attributes::default()).expect("no list to fit");
    let (mut scene, camera) = (Scene::new(), plane().1);
    scene.add_object("plane", mesh, Material::default());
    let outputs = Outputs { ids: true, ..Outputs::default() };
    for display in Display::ALL {
        let settings = RenderSettings { outputs, ..settings(display) };
        let frame = render(&scene, &camera, &settings).expect("drawn");
        assert_eq!(frame.object_ids, Some(vec![0; 81]), "{}: it fills the image", display.name());
        let is_zero = frame.color.chunks(4).all(|pixel| pixel == [0, 0, 0, 255]);
        assert!(is_zero || display != Display::TextureCoordinates, "{:?}", frame.color);
    }
}
