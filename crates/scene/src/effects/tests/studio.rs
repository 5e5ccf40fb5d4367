//! The default light on white surfaces, against the sum of its lamps. Everything that knows a vertical follows the up axis
//! of the scene.

use trigon_camera::UpAxis;

use super::*;
use crate::lighting::{LampSource, Lights};
use crate::{Outputs, views};

fn rough() -> Shading {
    Shading::MetallicRoughness(MetallicRoughness { metallic: 0.0, roughness: 1.0, ..Default::default() })
}

fn white(shading: Shading) -> Material {
    Material { base_color: Vec4::ONE, shading, ..Material::default() }
}

/// White without highlights: Blinn-Phong adds nothing to its diffuse light then.
fn matt_models() -> [Shading; 3] {
    [Shading::Lambert, Shading::blinn_phong(Vec3::ZERO, 30.0), rough()]
}

fn in_the_studio() -> RenderSettings {
    let outputs = Outputs { radiance: true, normals: true, ..Outputs::default() };
    RenderSettings { lighting: Lighting::Automatic, outputs, ..settings(EffectSettings::default()) }
}

/// Lambert's law for a unit normal in camera space, in f64.
fn lambert(normal: DVec3) -> f64 {
    each_lamp(|towards, light| light * normal.dot(towards).max(0.0))
}

/// The rough dielectric of the glTF specification, appendix B, seen along −Z: with an α of
/// 1 the distribution is 1/π and V is 1 / (2 (n·l + n·v)). In the same light from
/// everywhere a white one shows just that.
fn rough_dielectric(normal: DVec3) -> f64 {
    each_lamp(|towards, light| {
        let [n_dot_l, n_dot_v] = [normal.dot(towards).max(0.0), normal.z];
        let v_dot_h = (towards + DVec3::Z).normalize().z;
        let away = (1.0 - v_dot_h) * (1.0 - v_dot_h);
        let fresnel = 0.04 + 0.96 * away * away * (1.0 - v_dot_h);
        light * n_dot_l * (1.0 - fresnel + fresnel * 0.5 / (n_dot_l + n_dot_v))
    })
}

fn each_lamp(of: impl Fn(DVec3, f64) -> f64) -> f64 {
    let studio = Lights::studio();
    let lamps = studio.lamps.iter().map(|lamp| match lamp.source {
        LampSource::Directional(towards) => of(towards.as_dvec3(), f64::from(lamp.radiance.x)),
        LampSource::Point { .. } => panic!("lamps of the studio are parallel"),
    });
    f64::from(studio.ambient.x) + lamps.sum::<f64>()
}

#[test]
fn a_white_ball_shows_the_sum_of_the_lamps_and_is_clipped_nowhere() {
    for shading in matt_models() {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::uv_sphere(1.9, 128, 64), white(shading));
        let frame = render(&scene, &from_front(), &in_the_studio()).expect("drawn");
        let (radiance, normals) = (frame.radiance.expect("asked for"), frame.normals.expect("asked for"));
        // The image's vertices are snapped to 1/256 pixel, those of the normals are not:
        // that is 3e-5 of the ball's radius, and near its rim up to ten times as much of a
        // normal. The table of what rough surfaces reflect of light from everywhere is
        // within 1 %.
        let is_rough = matches!(shading, Shading::MetallicRoughness(_));
        let tolerance = if is_rough { 0.01 * 0.2 + 3e-4 } else { 3e-4 };
        let (mut count, mut brightest) = (0, 0.0_f64);
        for (pixel, (light, normal)) in radiance.iter().zip(&normals).enumerate() {
            let normal = normal.as_dvec3();
            // Near the rim of the ball the division by n·v magnifies how f32 rounds it.
            if normal.z < 0.1 {
                continue;
            }
            let [right, up] = on_ball(pixel, 1.9);
            // Chords of 1/128 of a circle on both axes: the faces are up to 6e-4 of the radius within the ball.
            let off = (normal.x - right).abs().max((normal.y - up).abs());
            assert!(off < 1e-3, "the normal {normal} is {off} off");
            let exact = if is_rough { rough_dielectric(normal) } else { lambert(normal) };
            let shown = f64::from(light.y);
            assert!((shown - exact).abs() < tolerance, "{shading:?}, {normal}: {shown}, not {exact}");
            (count, brightest) = (count + 1, brightest.max(shown));
        }
        assert!(count > 8000, "most of the ball was seen: {count} pixels");
        assert!(brightest <= 1.0, "{shading:?} is clipped: {brightest}");
        assert!(brightest > 0.9, "{shading:?} is nearly white where it is brightest: {brightest}");
    }
}

#[test]
fn a_white_plate_that_faces_the_camera_is_white() {
    let perspective = Camera::look_at(DVec3::Z * 3.0, DVec3::ZERO, DVec3::Y);
    for (shading, camera) in matt_models().into_iter().flat_map(|s| [(s, from_front()), (s, perspective)]) {
        let mut scene = Scene::new();
        let plate = scene.add_object("plate", primitives::plane(2.0, 2.0), white(shading));
        let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
        scene.node_mut(plate).expect("just added").transform =
            Transform::from_scale_rotation_translation(DVec3::ONE, upright, DVec3::ZERO);
        let frame = render(&scene, &camera, &in_the_studio()).expect("drawn");
        for pixel in [SIDE / 2, SIDE * 5 / 12].map(|at| frame.pixel(at, at)) {
            assert!(pixel.iter().all(|&channel| channel >= 235), "{shading:?}: {pixel:?}");
        }
    }
}

/// What files say of their light is not changed by how bright the default one is.
#[test]
fn lamps_of_the_scene_get_a_tenth_of_white_from_everywhere() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 64, 32), white(Shading::Lambert));
    scene.add(shining(Light::directional(0.5), DVec3::Y, DVec3::NEG_Z));
    let frame = render(&scene, &from_front(), &in_the_studio()).expect("drawn");
    let shown = frame.radiance.expect("asked for")[(SIDE * SIDE / 2 + SIDE / 2) as usize].x;
    assert!((shown - 0.6).abs() < 1e-3, "half from the lamp and a tenth beside it: {shown}");
}

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
