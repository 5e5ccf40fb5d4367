//! Everything that knows a vertical follows the up axis of the scene.

use trigon_camera::UpAxis;

use super::*;
use crate::views;

/// The axes of a world.
const AXES: [DVec3; 6] = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];

/// With +Y up, and alike from no two sides: metals, a mirror, glass and plastic on a floor with a pole.
fn upright() -> Scene {
    let mut scene = Scene::new();
    let rough = MetallicRoughness { metallic: 1.0, roughness: 0.4, ..MetallicRoughness::default() };
    let rough = Material { shading: Shading::MetallicRoughness(rough), ..Material::default() };
    let mut glass = metal(0.0);
    glass.transmission = 0.9;
    let parts = [
        (primitives::cylinder(0.1, 2.0, 12), rough.clone(), DVec3::new(-1.0, 1.0, -0.5)),
        (primitives::icosphere(0.5, 2), metal(1.0), DVec3::new(0.6, 0.5, -0.4)),
        (primitives::cube(0.6), rough, DVec3::new(-0.3, 0.3, 0.6)),
        (primitives::icosphere(0.3, 2), glass, DVec3::new(0.7, 0.3, 0.7)),
        (primitives::disc(1.5, 24), metal(0.2), DVec3::ZERO),
    ];
    for (mesh, material, position) in parts {
        let node = scene.add_object("part", mesh, material);
        scene.node_mut(node).expect("just added").transform = Transform::from_translation(position);
    }
    scene
}

/// The same with another axis up: every coordinate is one of the other scene, or the opposite of one.
fn turned(up: UpAxis) -> Scene {
    let mut scene = upright();
    scene.turn_to(up);
    scene
}

/// Another colour in every direction, brightest above.
fn room() -> Arc<Environment> {
    let (width, height) = (64_usize, 32_usize);
    let pixel = |i: usize| {
        let (u, v) = ((i % width) as f32 / width as f32, (i / width) as f32 / height as f32);
        [u, 1.0 - v, if u > 0.5 { 0.8 } else { 0.1 }]
    };
    let pixels: Vec<[f32; 3]> = (0..width * height).map(pixel).collect();
    Arc::new(Environment::from_equirectangular(width, height, &pixels).expect("the size fits"))
}

fn drawn(scene: &Scene, settings: &RenderSettings) -> Frame {
    render(scene, &scene.overview(settings.aspect()), settings).expect("drawn")
}

/// The largest difference of a channel.
fn largest_difference(one: &Frame, other: &Frame) -> u8 {
    let pairs = one.color.iter().zip(&other.color);
    pairs.map(|(one, other)| one.abs_diff(*other)).max().expect("an image has pixels")
}

/// Compares the images of the turned scenes with that of the upright one.
fn check(name: &str, settings: &RenderSettings, allowed: u8) {
    let expected = drawn(&upright(), settings);
    for up in AXES.map(UpAxis::new) {
        let found = drawn(&turned(up), settings);
        let error = largest_difference(&expected, &found);
        assert!(error <= allowed, "{name}, {up} up: {error} of 255");
        // The test would notice if nothing followed the axis.
        let mut lying = turned(up);
        let camera = lying.overview(settings.aspect());
        lying.up = UpAxis::new(-up.direction());
        let frame = render(&lying, &camera, settings).expect("drawn");
        assert!(
            largest_difference(&expected, &frame) > 20,
            "{name}: what is around stands on its head, {up}"
        );
    }
}

fn studio(effects: EffectSettings) -> RenderSettings {
    RenderSettings { lighting: Lighting::Studio, ..settings(effects) }
}

#[test]
fn an_environment_turns_with_the_up_axis() {
    let effects = EffectSettings { environment: Some(room()), ..EffectSettings::default() };
    check("lit", &settings(effects.clone()), 0);
    check("behind", &RenderSettings { background: Background::Environment, ..settings(effects) }, 0);
}

#[test]
fn the_studio_in_metals_turns_with_the_up_axis() {
    check("metals", &studio(EffectSettings::default()), 0);
}

/// The dot products of rays and triangles are sums in another order: a last place of f32, so a step of 8 bits at
/// most.
#[test]
fn what_rays_see_far_away_turns_with_the_up_axis() {
    let effects = EffectSettings { sight: SightRays::all(3), ..EffectSettings::default() };
    check("studio", &studio(effects.clone()), 1);
    check("environment", &settings(EffectSettings { environment: Some(room()), ..effects }), 1);
}

#[test]
fn cameras_around_a_scene_turn_with_the_up_axis() {
    for up in AXES.map(UpAxis::new) {
        let cameras = |scene: &Scene| -> Vec<Camera> {
            scene.surround(views::hemisphere(7, 3), 1.5).chain([scene.overview(1.5)]).collect()
        };
        for (straight, found) in cameras(&upright()).iter().zip(cameras(&turned(up))) {
            let expected = up.frame() * straight.position;
            assert!(found.position.distance(expected) < 1e-12, "{up}: {} for {expected}", found.position);
            let error = found.up().distance(up.frame() * straight.up());
            assert!(error < 1e-12, "{up}: what is up in the image is off by {error}");
        }
    }
}

/// A renderer that keeps its last image draws a new one when nothing but the up axis changes.
#[test]
fn images_kept_from_another_up_axis_are_drawn_again() {
    let mut scene = upright();
    let (camera, settings) = (scene.overview(1.0), studio(EffectSettings::default()));
    let mut renderer = Renderer::new(settings.clone());
    for _ in 0..3 {
        renderer.render(&scene, &camera).expect("drawn");
    }
    scene.up = UpAxis::Z;
    let found = renderer.render(&scene, &camera).expect("drawn");
    assert!(found == render(&scene, &camera, &settings).expect("drawn"), "as a fresh image");
}
