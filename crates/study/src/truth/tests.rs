//! The truth of scenes for which there is a closed form; and that of the study's own, at two numbers of rays.

use super::*;
use trigon_math::{DQuat, Vec3, Vec4};
use trigon_mesh::primitives;
use trigon_scene::camera::Projection;
use trigon_scene::{
    AlphaMode, AmbientOcclusion, Background, Light, Material, MetallicRoughness, Node, Shading, Shadows,
    SightRays, Transform,
};

const SIZE: [u32; 2] = [16, 16];

/// A camera above the middle of a square of one unit a pixel, y down in the image being z.
fn above() -> Camera {
    let projection = Projection::orthographic(16.0, 0.1, 100.0).unwrap();
    Camera::look_at(DVec3::Y * 50.0, DVec3::ZERO, DVec3::NEG_Z).with_projection(projection)
}

fn settings() -> RenderSettings {
    RenderSettings { background: Background::Color(Vec3::ZERO), ..RenderSettings::new(SIZE[0], SIZE[1]) }
}

fn colored(shading: Shading, color: Vec4) -> Material {
    let alpha_mode = if color.w < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
    Material { base_color: color, alpha_mode, shading, ..Material::default() }
}

/// The light at the middle of the image, and at each of its pixels.
fn light(scene: &Scene, settings: &RenderSettings) -> Vec<[f64; 3]> {
    Truth::new(scene, &above(), settings).unwrap().light
}

const MIDDLE: usize = 8 * 16 + 8;

fn floor(scene: &mut Scene, side: f32, material: Material) {
    scene.add_object("floor", primitives::plane(side, side), material);
}

#[test]
fn pixels_are_covered_by_the_area_of_a_surface() {
    let mut scene = Scene::new();
    // From −2.3 to 2.3: 0.3 of the pixels at the edge, and 0.09 at the corner.
    floor(&mut scene, 4.6, colored(Shading::Unlit, Vec4::ONE));
    let light = light(&scene, &settings());
    for (pixel, [red, ..]) in light.iter().enumerate() {
        let covered = |step: usize| (2.3 - (step as f64 + 0.5 - 8.0).abs() + 0.5).clamp(0.0, 1.0);
        let area = covered(pixel % 16) * covered(pixel / 16);
        // Both sides of a rectangle among 256 points that lie one to each rectangle of that area.
        assert!((red - area).abs() < 2.0 / 256.0, "{pixel}: {red} of {area}");
    }
}

#[test]
fn light_has_closed_forms() {
    let white = colored(Shading::Lambert, Vec4::ONE);
    let mut scene = Scene::new();
    floor(&mut scene, 40.0, white.clone());
    scene.add(Node::from_light(Light::ambient(0.25)));
    scene.add(Node::from_light(Light::point(8.0)).at(DVec3::new(0.5, 3.0, 0.5)));
    let [red, ..] = light(&scene, &settings())[MIDDLE];
    // In the middle of the pixel 1/4 + 8/9; elsewhere in it 8·3/(9 + r²)^(3/2), whose mean is less by 3/2 · (1/6) / 9.
    let expected = 0.25 + 8.0 / 9.0 * (1.0 - 1.5 / 54.0);
    assert!((red - expected).abs() < 2e-3, "{red}, not {expected}");
    // A smaller plate between the lamp and the floor.
    let plate = scene.add_object("plate", primitives::plane(1.0, 1.0), white);
    scene.node_mut(plate).unwrap().transform.set_translation(DVec3::new(0.5, 1.0, 0.5));
    let mut shadowed = settings();
    shadowed.effects.shadows = Shadows::Rays;
    let light = light(&scene, &shadowed);
    assert!(light[MIDDLE][0] > 1.0, "the plate is nearer to the lamp");
    // The shadow reaches 0.75 from the middle at (0.5, 0.5); the next pixel is lit from there to 1.5.
    let parts =
        |from: f64, to: f64| (0..100).map(move |part| from + (to - from) * (f64::from(part) + 0.5) / 100.0);
    let lit = |x: f64, z: f64| 24.0 / elementary::pow(9.0 + x * x + z * z, 1.5);
    let mean: f64 =
        parts(0.75, 1.5).flat_map(|x| parts(-0.5, 0.5).map(move |z| lit(x, z))).sum::<f64>() / 1e4;
    let (found, expected) = (light[MIDDLE + 1][0], 0.25 + 0.75 * mean);
    assert!((found - expected).abs() < 5e-3, "{found}, not {expected}");
}

/// N. Hoffman and others, "Radiosity": what a wall of this height hides of the hemisphere is half of 1 − d / √(d² + h²).
#[test]
fn a_wall_hides_what_its_form_factor_says() {
    let mut scene = Scene::new();
    floor(&mut scene, 400.0, colored(Shading::Lambert, Vec4::ONE));
    let wall = scene.add_object("wall", primitives::cube(1.0), colored(Shading::Lambert, Vec4::ONE));
    let scale_and_offset = [DVec3::new(2.0, 6.0, 4000.0), DVec3::NEG_X];
    scene.node_mut(wall).unwrap().transform =
        Transform::from_scale_rotation_translation(scale_and_offset[0], DQuat::IDENTITY, scale_and_offset[1]);
    scene.add(Node::from_light(Light::ambient(1.0)));
    let mut occluded = settings();
    occluded.effects.ambient_occlusion = Some(AmbientOcclusion::new(1, 1e6));
    let [red, ..] = light(&scene, &occluded)[MIDDLE + 1];
    // The cube is centred: its side is 3 high, and the pixel from 1 to 2 beside it.
    let open = 1.0 - 0.5 * (1.0 - 1.5 / (1.5_f64 * 1.5 + 9.0).sqrt());
    assert!((red - open).abs() < 0.01, "{red}, not {open}");
}

#[test]
fn layers_and_mirrors_show_what_lies_behind_and_before() {
    let mut scene = Scene::new();
    let metal = MetallicRoughness { metallic: 1.0, roughness: 0.0, ..MetallicRoughness::default() };
    floor(&mut scene, 40.0, colored(Shading::MetallicRoughness(metal), Vec4::new(0.5, 0.5, 0.5, 1.0)));
    let red = colored(Shading::Unlit, Vec4::new(1.0, 0.0, 0.0, 0.25));
    let plate = scene.add_object("plate", primitives::plane(4.0, 4.0), red);
    scene.node_mut(plate).unwrap().transform.set_translation(DVec3::Y);
    scene.add(Node::from_light(Light::ambient(0.2)));
    let plain = light(&scene, &settings())[MIDDLE];
    // Through the plate, the metal: half of the ambient light.
    let expected = [0.25 + 0.75 * 0.1, 0.75 * 0.1, 0.75 * 0.1];
    assert!(plain.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{plain:?}");
    let mut mirrored = settings();
    mirrored.effects.sight = SightRays::all(2);
    let mirrored = light(&scene, &mirrored)[MIDDLE];
    let behind = 0.5 * (0.25 + 0.75 * 0.2);
    assert!((mirrored[0] - (0.25 + 0.75 * behind)).abs() < 1e-6, "and the plate in it: {mirrored:?}");
}

#[test]
fn what_is_not_implemented_is_refused() {
    let mut scene = Scene::new();
    floor(&mut scene, 1.0, Material { transmission: 1.0, ..Material::default() });
    assert!(Truth::new(&scene, &above(), &settings()).is_err(), "glass");
    let rough = Shading::MetallicRoughness(MetallicRoughness::default());
    let mut scene = Scene::new();
    floor(&mut scene, 1.0, colored(rough, Vec4::ONE));
    assert!(Truth::new(&scene, &above(), &settings()).is_err(), "the studio's ambient light on a dielectric");
}

/// A cached image is that which was computed, and another scene has another name.
#[test]
fn images_come_back_from_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = Scene::new();
    floor(&mut scene, 4.6, colored(Shading::Lambert, Vec4::ONE));
    let cached = |scene: &Scene| Truth::cached(scene, &above(), &settings(), folder.path()).unwrap();
    let files =
        || std::fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().path()).collect::<Vec<_>>();
    let first = cached(&scene);
    let [file] = &files()[..] else { panic!("one file") };
    assert_eq!(cached(&scene), first, "the same");
    assert_eq!(first, Truth::new(&scene, &above(), &settings()).unwrap(), "as it was computed");
    std::fs::write(file, b"broken").unwrap();
    assert_eq!(cached(&scene), first, "a broken file is written again");
    floor(&mut scene, 1.0, colored(Shading::Lambert, Vec4::ONE));
    cached(&scene);
    assert_eq!(files().len(), 2, "another scene, another file");
}
