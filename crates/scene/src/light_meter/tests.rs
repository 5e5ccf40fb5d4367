//! The light meter against values computed by hand.

use std::f64::consts::PI;
use std::num::NonZeroUsize;

use trigon_camera::{Camera, Projection};
use trigon_math::{DVec3, Vec3, Vec4, color};
use trigon_mesh::primitives;
use trigon_raster::simd::SimdLevel;

use super::*;
use crate::{
    Animation, Background, Cause, Channel, Curve, Decision, Effect, EffectPlan, EffectSettings, Environment,
    Interpolation, Light, LightKind, Lighting, Material, Node, NodeId, Outputs, Property, Renderer, Shading,
    Transform, render, views,
};

/// A lamp of so many candela, or lux if it is parallel: a white matt surface in E lux shows E / π.
fn physical(light: Light, photometric: f64) -> Light {
    Light { intensity: (photometric / PI) as f32, ..light }
}

fn white() -> Material {
    Material { base_color: Vec4::ONE, shading: Shading::Lambert, ..Material::default() }
}

/// A white chip, so small that the light on it is the same everywhere.
fn chip() -> Scene {
    let mut scene = Scene::new();
    scene.add_object("chip", primitives::plane(0.01, 0.01), white());
    scene
}

/// The chip with a lamp one metre above it.
fn chip_under(light: Light) -> Scene {
    let mut scene = chip();
    scene.add(Node::from_light(light).at(DVec3::Y));
    scene
}

/// The chip fills the image.
fn from_above() -> Camera {
    let projection = Projection::orthographic(0.005, 0.1, 20.0).expect("the numbers are in range");
    Camera { projection, ..Camera::look_at(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z) }
}

fn settings(lighting: Lighting, exposure: Exposure) -> RenderSettings {
    let effects = EffectSettings { exposure, ..EffectSettings::default() };
    RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(Vec3::ZERO),
        lighting,
        effects,
        ..RenderSettings::new(16, 16)
    }
}

fn middle(scene: &Scene, settings: &RenderSettings) -> u8 {
    render(scene, &from_above(), settings).expect("drawn").pixel(8, 8)[0]
}

/// 1000 cd from one metre are 1000 lx, and a white surface has 1000/π = 318.31 times the display's
/// white: log2(0.7 / 318.31) = −8.829 stops show it as 0.7. Rounded to −8.83, they are a factor of
/// 0.0021974, and the pixel is 0.6995: 217.8 of 255 in sRGB.
#[test]
fn a_white_plane_one_metre_under_a_thousand_candela() {
    let scene = chip_under(physical(Light::point(1.0), 1000.0));
    let reading = scene.light_reading().expect("there is light");
    // The corners of the chip are 5 mm to the side: 4e-5 darker.
    assert!((f64::from(reading.white) - 318.31).abs() < 0.02, "{reading:?}");
    assert_eq!(reading.stops, -8.83, "log2(0.7 / 318.31)");
    let metered = |lighting| middle(&scene, &settings(lighting, Exposure::Metered));
    assert_eq!(metered(Lighting::Scene), 218, "0.6995");
    assert_eq!(metered(Lighting::Automatic), 231, "0.7995, with the ambient light that is added");
    assert_eq!(middle(&scene, &settings(Lighting::Scene, Exposure::Stops(0.0))), 255, "off");
}

#[test]
fn lux_and_faint_candela_are_exposed_alike() {
    // In the sun, under a street lamp's glow, and by starlight.
    for (light, photometric, stops) in [
        (Light::directional(1.0), 100_000.0, -15.47),
        (Light::point(1.0), 0.001, 11.10),
        (Light::spot(1.0), 1e-9, 31.03),
    ] {
        let node = Node::from_light(physical(light, photometric)).at(DVec3::Y);
        let down = Camera::look_at(DVec3::Y, DVec3::ZERO, DVec3::Z).orientation;
        let mut scene = chip();
        scene.add(node.with_transform(Transform::from_scale_rotation_translation(
            DVec3::ONE,
            down,
            DVec3::Y,
        )));
        let reading = scene.light_reading().expect("there is light");
        assert!((reading.stops - stops).abs() < 0.006, "{photometric}: {reading:?}");
        let shown = middle(&scene, &settings(Lighting::Scene, Exposure::Metered));
        assert!((216..=219).contains(&shown), "{photometric}: {shown}, not 0.7");
    }
}

/// At the ends of what a display can show: middle grey just clipped, and a white of 0.018.
#[test]
fn ordinary_lamps_change_no_byte() {
    for (intensity, is_metered) in
        [(0.0179_f32, true), (0.0181, false), (0.5, false), (1.0, false), (5.55, false), (5.56, true)]
    {
        let scene = chip_under(Light::point(intensity));
        let [metered, fixed] = [Exposure::Metered, Exposure::Stops(0.0)].map(|exposure| {
            render(&scene, &from_above(), &settings(Lighting::Automatic, exposure)).expect("drawn").color
        });
        assert_eq!(metered != fixed, is_metered, "{intensity}");
    }
}

/// What is added to the lamps is neither dimmed nor brightened.
#[test]
fn only_lamps_are_exposed() {
    let mut unlit = chip_under(physical(Light::point(1.0), 1000.0));
    for (_, material) in unlit.materials.iter_mut() {
        *material =
            Material { base_color: Vec4::new(0.3, 0.3, 0.3, 1.0), shading: Shading::Unlit, ..white() };
    }
    let grey = color::linear_to_srgb8(0.3);
    assert_eq!(middle(&unlit, &settings(Lighting::Automatic, Exposure::Metered)), grey, "unlit");
    let mut glowing = chip_under(physical(Light::point(1.0), 1000.0));
    for (_, material) in glowing.materials.iter_mut() {
        *material = Material { base_color: Vec4::W, emissive: Vec3::splat(0.3), ..white() };
    }
    assert_eq!(middle(&glowing, &settings(Lighting::Automatic, Exposure::Metered)), grey, "light of its own");
    // From below, no lamp shines on it.
    let below = Camera { position: DVec3::NEG_Y, ..Camera::look_at(DVec3::NEG_Y, DVec3::ZERO, DVec3::X) };
    let below = Camera { projection: from_above().projection, ..below };
    let mut lit = chip_under(physical(Light::point(1.0), 1000.0));
    lit.materials.iter_mut().for_each(|(_, material)| material.double_sided = true);
    let frame = render(&lit, &below, &settings(Lighting::Automatic, Exposure::Metered)).expect("drawn");
    assert_eq!(frame.pixel(8, 8)[0], color::linear_to_srgb8(0.1), "the ambient light that is added");
}

#[test]
fn an_environment_lights_what_faint_lamps_do_not() {
    let with = |photometric| {
        let scene = chip_under(physical(Light::point(1.0), photometric));
        let mut settings = settings(Lighting::Automatic, Exposure::Metered);
        settings.effects.environment = Some(std::sync::Arc::new(Environment::uniform(Vec3::splat(0.5))));
        let plan = EffectPlan::new(&scene, &from_above(), &settings);
        (middle(&scene, &settings), plan.decision(Effect::LightMeter).to_string())
    };
    let (shown, said) = with(0.001);
    assert_eq!(shown, color::linear_to_srgb8(0.5), "the environment alone");
    assert_eq!(said, "off, because the environment takes its place");
    assert!(with(1000.0).1.starts_with("on"), "bright lamps are dimmed");
}

/// A lamp in a small shade: the shade is in ten thousand times the light of the room.
#[test]
fn what_is_next_to_a_lamp_does_not_decide() {
    let mut room = Scene::new();
    let lamp = physical(Light::point(1.0), 1000.0);
    room.add(Node::from_light(lamp).at(DVec3::Y));
    for step in 0..20 {
        let chip = room.add_object("chip", primitives::plane(0.01, 0.01), white());
        room.node_mut(chip).expect("just added").transform =
            Transform::from_translation(DVec3::X * 1e-3 * f64::from(step));
    }
    let before = room.light_reading().expect("there is light");
    let shade = room.add_object("shade", primitives::plane(0.001, 0.001), white());
    room.node_mut(shade).expect("just added").transform = Transform::from_translation(DVec3::Y * 0.99);
    let after = room.light_reading().expect("there is light");
    assert_eq!(after.stops, before.stops, "one of 21 objects");
    assert_eq!(before.stops, -8.83, "the light on the others");
}

/// A wide floor with a lamp above its middle, and what stands there.
#[test]
fn a_wide_floor_does_not_outweigh_what_stands_on_it() {
    let mut scene = chip_under(physical(Light::point(1.0), 1000.0));
    let floor = scene.add_object("floor", primitives::plane(200.0, 200.0), white());
    scene.node_mut(floor).expect("just added").transform = Transform::from_translation(DVec3::Y * -0.001);
    let reading = scene.light_reading().expect("there is light");
    assert!((reading.stops + 8.83).abs() < 0.02, "the chip's light: {reading:?}");
}

/// Half the sphere of directions has a cosine below 0.9 on a tenth of its area.
#[test]
fn the_key_light_is_that_of_the_brightest_tenth() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 96, 48), white());
    scene.add(Node::from_light(physical(Light::directional(1.0), 10_000.0)));
    let white = f64::from(scene.light_reading().expect("there is light").white);
    // Up to a tenth of its points off: 128 of them are measured.
    assert!((white / (10_000.0 / PI) - 0.9).abs() < 0.02, "{white}");
}

#[test]
fn range_and_cone_are_those_of_the_light() {
    let at = |light: Light| chip_under(light).light_reading();
    assert_eq!(at(Light::point(1000.0).with_range(0.5)), None, "out of range");
    assert_eq!(
        at(Light { kind: LightKind::Spot { inner: 0.1, outer: 0.2 }, ..Light::spot(1e3) }),
        None,
        "beside"
    );
    let half = at(Light::point(1000.0).with_range(2.0)).expect("there is light").white;
    assert!((half - 1000.0 * (1.0 - 0.0625)).abs() < 1.0, "1 − (1/2)⁴: {half}");
}

/// A lamp that is animated, far away at first.
fn moving() -> (Scene, NodeId) {
    let mut scene = chip();
    let lamp = scene.add(Node::from_light(physical(Light::point(1.0), 1000.0)).at(DVec3::Y * 0.1));
    let values = vec![0.0, 1.0, 0.0, 0.0, 100.0, 0.0];
    let curve = Curve::new(Interpolation::Linear, 3, vec![0.0, 1.0], values).expect("a curve");
    let channels = vec![Channel { node: lamp, property: Property::Translation, curve }];
    scene.animations.push(Animation { name: "away".to_owned(), channels });
    (scene, lamp)
}

/// Frames of an animation have one exposure, whether they are drawn one after the other or each on its own.
#[test]
fn an_animation_keeps_one_exposure() {
    for seconds in [0.0, 0.25, 1.0] {
        let (mut scene, _) = moving();
        let pose = scene.pose(&scene.animations[0], seconds);
        scene.apply_pose(&pose);
        assert_eq!(scene.light_reading().expect("there is light").stops, -8.83, "at {seconds} s, on its own");
    }
    let (mut scene, lamp) = moving();
    let exposures: Vec<f32> = [0.0, 0.5, 1.0]
        .map(|seconds| {
            let pose = scene.pose(&scene.animations[0], seconds);
            scene.apply_pose(&pose);
            scene.light_reading().expect("there is light").stops
        })
        .to_vec();
    assert_eq!(exposures, [-8.83; 3], "one after the other");
    scene.node_mut(lamp).expect("it is there").light = Some(Box::new(Light::point(1.0)));
    assert!(scene.light_reading().expect("there is light").is_in_range(), "another lamp is measured anew");
}

#[test]
fn all_views_of_a_model_have_one_exposure() {
    let scene = chip_under(physical(Light::point(1.0), 1000.0));
    let mut renderer = Renderer::new(settings(Lighting::Automatic, Exposure::Metered));
    let mut causes = Vec::new();
    for camera in scene.surround(views::turntable(5, 0.7), 1.0) {
        renderer.render(&scene, &camera).expect("drawn");
        causes.push(renderer.plan().expect("drawn").decision(Effect::LightMeter).clone());
    }
    let reading = scene.light_reading().expect("there is light");
    assert!(causes.iter().all(|cause| *cause == Decision::On(Cause::Metered(reading))), "{causes:?}");
}

#[test]
fn metered_images_are_the_same_at_every_level_and_with_any_threads() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 48, 24), Material::default());
    scene.add(Node::from_light(physical(Light::point(1.0), 54_350.0)).at(DVec3::new(4.07, 5.9, 1.0)));
    let camera = scene.overview(1.0);
    let draw = |simd, threads| {
        let threads = NonZeroUsize::new(threads);
        let settings = RenderSettings { simd, threads, ..settings(Lighting::Automatic, Exposure::Metered) };
        render(&scene, &camera, &settings).expect("drawn").color
    };
    let expected = draw(None, 1);
    for level in SimdLevel::ALL.into_iter().filter(|level| level.is_supported()) {
        assert!(draw(Some(level), 3) == expected, "{level:?} and three threads change the image");
    }
}

#[test]
fn the_plan_says_why_lamps_are_exposed_or_not() {
    let said = |scene: &Scene, settings: &RenderSettings| {
        EffectPlan::new(scene, &from_above(), settings).decision(Effect::LightMeter).to_string()
    };
    let metered = settings(Lighting::Automatic, Exposure::Metered);
    let bright = chip_under(physical(Light::point(1.0), 1000.0));
    let expected = "on, because a white surface in the light of the lamps would have 318 times the display's white; they are exposed by -8.83 stops";
    assert_eq!(said(&bright, &metered), expected);
    let fixed = settings(Lighting::Automatic, Exposure::Stops(0.0));
    assert_eq!(said(&bright, &fixed), "off, because the settings set the exposure");
    let studio = settings(Lighting::Studio, Exposure::Metered);
    assert_eq!(said(&bright, &studio), "off, because no lamp of the scene shines");
    assert_eq!(said(&chip(), &metered), "off, because no lamp of the scene shines");
    let ordinary =
        "off, because a white surface in the light of the lamps has 0.500 times the display's white";
    assert_eq!(said(&chip_under(Light::point(0.5)), &metered), ordinary);
    let unreached = chip_under(Light::point(1000.0).with_range(0.5));
    assert_eq!(said(&unreached, &metered), "off, because no lamp reaches any face");
}

/// Twice the light is twice the light, metered or not.
#[test]
fn the_intensity_of_all_lights_still_counts() {
    let scene = chip_under(physical(Light::point(1.0), 1000.0));
    let half = RenderSettings { light_intensity: 0.5, ..settings(Lighting::Scene, Exposure::Metered) };
    let frame = render(
        &scene,
        &from_above(),
        &RenderSettings { outputs: Outputs { radiance: true, ..Outputs::default() }, ..half },
    );
    let radiance = frame.expect("drawn").radiance.expect("asked for")[8 * 16 + 8].x;
    assert!((radiance - 0.350).abs() < 1e-3, "half of 0.6995: {radiance}");
}

#[test]
fn a_model_that_is_white_or_black_anyway_is_told() {
    let bright = chip_under(physical(Light::point(1.0), 1000.0));
    let warning = |scene: &Scene, exposure| scene.exposure_warning(&settings(Lighting::Scene, exposure));
    assert_eq!(warning(&bright, Exposure::Metered), None, "it is exposed");
    let clipped = warning(&bright, Exposure::Stops(0.0)).expect("it is white");
    assert_eq!((clipped.fault, clipped.share), (ExposureFault::Clipped, 1.0));
    assert!((clipped.stops + 8.83).abs() < 0.01, "{clipped:?}");
    assert_eq!(
        clipped.to_string(),
        "100 % of the model is clipped to white: a white surface there would have 318 times the display's white; an exposure of -8.83 stops would show it, and without one the light meter decides"
    );
    let black = warning(&bright, Exposure::Stops(-20.0)).expect("it is black");
    assert_eq!((black.fault, black.stops), (ExposureFault::Black, -8.83));
    // Three of four chips are out of the lamp's range.
    let mut scene = chip_under(physical(Light::point(1.0), 1000.0).with_range(2.0));
    for x in 1..4 {
        let far = scene.add_object("far", primitives::plane(0.01, 0.01), white());
        scene.node_mut(far).expect("just added").transform =
            Transform::from_translation(DVec3::X * f64::from(x) * 10.0);
    }
    let black = warning(&scene, Exposure::Metered).expect("most of it is black");
    assert!(black.fault == ExposureFault::Black && (black.share - 0.75).abs() < 1e-6, "{black:?}");
    assert!(black.to_string().ends_with("add an environment, or use the studio lights"), "{black}");
    let added = settings(Lighting::Automatic, Exposure::Metered);
    assert_eq!(scene.exposure_warning(&added), None, "ambient light is added");
    let findings = scene.check();
    let faults: Vec<&str> = findings.iter().map(|finding| finding.fault).collect();
    assert!(faults.contains(&"lamps-out-of-range") && faults.contains(&"underexposed"), "{findings:?}");
    assert!(
        chip_under(Light::point(1.0)).check().iter().all(|finding| !finding.fault.contains("expos")),
        "ordinary"
    );
}

/// Files may hold any numbers.
#[test]
fn hostile_lamps_and_meshes_are_measured_too() {
    let mut scene = chip_under(Light::point(f32::MAX));
    scene.add(Node::from_light(Light::point(f32::MAX)).at(DVec3::ZERO));
    scene.add(Node::from_light(Light::directional(f32::NAN)));
    let mut broken = primitives::plane(1.0, 1.0);
    broken.positions_mut()[0].x = f32::NAN;
    broken.positions_mut()[2].y = f32::INFINITY;
    scene.add_object("broken", broken, white());
    let reading = scene.light_reading().expect("there is light");
    assert!(reading.white.is_finite() && reading.stops.is_finite() && reading.factor() > 0.0, "{reading:?}");
    render(&scene, &from_above(), &settings(Lighting::Automatic, Exposure::Metered)).expect("drawn");
    let faint = chip_under(Light::point(1e-45));
    assert!(faint.light_reading().expect("there is light").factor().is_finite());
}

/// A lamp in candela, as modelling programs export it: 1000 W of Blender are 54,350 cd, and the ball was white.
#[test]
fn a_lamp_of_blender_shows_a_ball_as_blender_does() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 48, 24), white());
    scene.add(Node::from_light(physical(Light::point(1.0), 54_350.0)).at(DVec3::new(4.07, 5.9, 1.0)));
    let reading = scene.light_reading().expect("there is light");
    // A tenth of the ball is the cap around the direction of the lamp, 7.237 m away, up to a cosine of 0.8. At its rim
    // the lamp is √(1 + 7.237² − 2 · 7.237 · 0.8) = 6.468 m away, and its light is slanted by (0.8 · 7.237 − 1) / 6.468.
    let key = 54_350.0 / PI * (0.8 * 7.237 - 1.0) / (6.468 * 6.468 * 6.468);
    assert!(
        (f64::from(reading.white) / key - 1.0).abs() < 0.05,
        "{reading:?}, not {key}: 128 points are measured"
    );
    // Blender itself shows 1000 W as 1/683 of that.
    let times = f64::from(reading.factor()) * 683.0;
    assert!((0.7..1.6).contains(&times), "{times} times as bright as in Blender");
}
