//! The environment as the background, and outlines.

use super::*;

/// Light that says where it comes from.
fn by_direction() -> EffectSettings {
    let (width, height) = (512, 256);
    let pixel = |i: usize| {
        let (u, v) = (((i % width) as f32 + 0.5) / width as f32, ((i / width) as f32 + 0.5) / height as f32);
        [u, v, 0.5]
    };
    let pixels: Vec<[f32; 3]> = (0..width * height).map(pixel).collect();
    let environment = Environment::from_equirectangular(width, height, &pixels).expect("the size fits");
    EffectSettings { environment: Some(Arc::new(environment)), ..Default::default() }
}

fn behind(effects: EffectSettings) -> RenderSettings {
    RenderSettings { background: Background::Environment, ..settings(effects) }
}

fn looking(towards: DVec3) -> Camera {
    let projection = Projection::perspective(1.0, 0.1, None).expect("the numbers are in range");
    Camera {
        projection,
        ..Camera::look_at(DVec3::new(1e7, -3.0, 5.0), DVec3::new(1e7, -3.0, 5.0) + towards, DVec3::Y)
    }
}

/// Every pixel of the background shows the light that comes along its ray, wherever
/// the eye is.
#[test]
fn each_pixel_shows_the_light_of_its_ray() {
    let settings = behind(by_direction());
    for towards in [DVec3::NEG_Z, DVec3::X, DVec3::new(0.4, 0.5, -0.7), DVec3::new(-0.3, -0.6, -0.2)] {
        let camera = looking(towards);
        let frame = render(&Scene::new(), &camera, &settings).expect("drawn");
        let viewport = trigon_camera::Viewport { width: SIDE, height: SIDE };
        let projector = trigon_camera::Projector::new(&camera, viewport);
        for (x, y) in [(0, 0), (SIDE - 1, 3), (SIDE / 2, SIDE / 2), (17, SIDE - 1)] {
            let place = trigon_math::DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let ray = projector.ray(place).expect("the image has an area").direction;
            let u = elementary::atan2_f32(ray.x as f32, -ray.z as f32) / std::f32::consts::TAU + 0.5;
            let v = elementary::acos_f32(ray.y as f32) / std::f32::consts::PI;
            let [red, green, ..] = frame.pixel(x, y).map(color::srgb8_to_linear);
            // Half a level at 0.9 is 0.004; a texel of the map is a 128th of a turn's quarter at most.
            let error = (red - u).abs().max((green - v).abs());
            assert!(error < 0.012, "{red}, {green} at {x}, {y}, where the ray is at {u}, {v}");
            assert_eq!(frame.pixel(x, y)[3], 255, "an environment is opaque");
        }
    }
}

/// A white room stays one colour: the ball in it, its edges and the background, with
/// exposure and tone mapping, too.
#[test]
fn a_ball_in_its_own_background_cannot_be_seen() {
    let mut scene = Scene::new();
    let model = MetallicRoughness { metallic: 1.0, roughness: 0.0, ..MetallicRoughness::default() };
    let material =
        Material { base_color: Vec4::ONE, shading: Shading::MetallicRoughness(model), ..Material::default() };
    scene.add_object("ball", primitives::uv_sphere(1.5, 64, 32), material);
    let room = EffectSettings {
        environment: Some(Arc::new(Environment::uniform(Vec3::splat(0.3)))),
        ..Default::default()
    };
    for (exposure, tone_mapping, samples) in
        [(0.0, ToneMapping::None, 1), (1.0, ToneMapping::KhronosPbrNeutral, 4)]
    {
        let effects = EffectSettings { exposure: Exposure::Stops(exposure), tone_mapping, ..room.clone() };
        let settings = RenderSettings { samples, ..behind(effects) };
        let frame = render(&scene, &from_front(), &settings).expect("drawn");
        let corner = light(&frame, 0, 0);
        for x in 0..SIDE {
            // A percent of the light that a white furnace may lose, and a level.
            let error = (light(&frame, x, SIDE / 2) - corner).abs();
            assert!(error < 0.01 * corner + 0.004, "{error} at {x} with an exposure of {exposure}");
        }
    }
}

/// What has no surface has no id and no depth, however it is lit.
#[test]
fn the_environment_is_still_background() {
    let outputs = crate::Outputs { ids: true, depth: true, ..Default::default() };
    let settings = RenderSettings { outputs, ..behind(by_direction()) };
    let frame = render(&Scene::new(), &looking(DVec3::X), &settings).expect("drawn");
    assert_eq!(frame.hit(Scene::new().nodes(), 5, 5), None, "nothing is hit");
    assert_eq!(frame.depth.as_ref().map(|depth| depth[0]), Some(f32::INFINITY), "infinitely far away");
}

/// The faces of a hidden-line drawing were as bright as the exposure said, before a
/// background that was not.
#[test]
fn hidden_lines_are_drawn_on_the_background_with_exposure_too() {
    let mut scene = Scene::new();
    scene.add_object("box", primitives::cube(1.0), matt(Vec3::X));
    let style = Style::HiddenLine;
    for background in [Background::Color(Vec3::splat(0.2)), Background::Environment] {
        let effects = EffectSettings { exposure: Exposure::Stops(1.0), ..by_direction() };
        let settings = RenderSettings { style, background, ..settings(effects) };
        let with = render(&scene, &from_front(), &settings).expect("drawn");
        let without = render(&Scene::new(), &from_front(), &settings).expect("drawn");
        let middle = (SIDE / 2 + 3, SIDE / 2 - 5);
        assert_eq!(with.pixel(middle.0, middle.1), without.pixel(middle.0, middle.1), "the face is paper");
        assert_ne!(with.color, without.color, "with its edges on it");
    }
}

#[test]
fn an_outline_runs_around_what_is_seen_of_a_node() {
    let mut scene = Scene::new();
    let ball = scene.add_object("ball", primitives::uv_sphere(1.0, 64, 32), matt(Vec3::ZERO));
    let outline = Outline { nodes: vec![ball], color: Vec3::new(1.0, 0.0, 0.0), width: 3 };
    let effects = EffectSettings { outline: Some(outline), ..EffectSettings::default() };
    let frame = render(&scene, &from_front(), &settings(effects)).expect("drawn");
    assert_eq!(frame.object_ids, None, "ids were not asked for");
    let red: Vec<u32> = (0..SIDE).filter(|&x| frame.pixel(x, SIDE / 2)[0] > 0).collect();
    // The ball has a radius of 32 pixels around the middle.
    assert_eq!(red, [29, 30, 31, 96, 97, 98], "three pixels on either side");
}
