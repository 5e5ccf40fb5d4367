//! Pictures of single effects against what geometry says.

use std::sync::Arc;

use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, Vec3, Vec4, color, elementary};
use trigon_mesh::{Attributes, Deltas, MorphTarget, primitives};
use trigon_raster::{Texture, TextureFormat};

use super::*;
use crate::{
    AlphaMode, Background, Frame, Light, LightKind, Lighting, Material, MetallicRoughness, Node, NormalMap,
    Occlusion, RenderSettings, Renderer, Scene, Shading, Style, TextureBinding, Transform, render,
};

const SIDE: u32 = 128;

/// Metres from the left edge of the picture to the right one.
const WIDE: f64 = 4.0;

fn settings(effects: EffectSettings) -> RenderSettings {
    RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(Vec3::ZERO),
        lighting: Lighting::Scene,
        effects,
        ..RenderSettings::new(SIDE, SIDE)
    }
}

/// Straight down, parallel; x to the right, z downwards.
fn from_above() -> Camera {
    let projection = Projection::orthographic(WIDE, 0.1, 20.0).expect("the numbers are in range");
    Camera { projection, ..Camera::look_at(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z) }
}

/// Straight at the scene from +Z, parallel.
fn from_front() -> Camera {
    let projection = Projection::orthographic(WIDE, 0.1, 20.0).expect("the numbers are in range");
    Camera { projection, ..Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y) }
}

fn matt(color: Vec3) -> Material {
    Material { base_color: color.extend(1.0), shading: Shading::Lambert, ..Material::default() }
}

/// A light that shines along a direction.
fn shining(light: Light, from: DVec3, along: DVec3) -> Node {
    let turned = Camera::look_at(from, from + along, DVec3::Z).orientation;
    Node::from_light(light).with_transform(Transform::from_scale_rotation_translation(
        DVec3::ONE,
        turned,
        from,
    ))
}

/// The light of a pixel's green, which is that of all channels here.
fn light(frame: &Frame, x: u32, y: u32) -> f32 {
    color::srgb8_to_linear(frame.pixel(x, y)[1])
}

/// A floor, and a square of one metre one metre above it.
fn square_over_floor(lamp: Node) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(8.0, 8.0), matt(Vec3::ONE));
    let square = scene.add_object("square", primitives::plane(1.0, 1.0), matt(Vec3::new(1.0, 0.0, 0.0)));
    scene.node_mut(square).expect("just added").transform = Transform::from_translation(DVec3::Y);
    scene.add(lamp);
    scene
}

const WAYS: [Shadows; 2] = [Shadows::Maps { resolution: 512 }, Shadows::Rays];

/// Where the shadow on the middle row begins and ends, in metres; the square itself
/// shows no green.
fn dark_span(frame: &Frame, beyond: f64) -> [f64; 2] {
    let metres = |x: u32| (f64::from(x) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
    let dark = |&x: &u32| light(frame, x, SIDE / 2) < 0.3;
    let first = (0..SIDE).filter(|&x| metres(x) > beyond).find(dark).expect("there is a shadow");
    let last = (first..SIDE).take_while(dark).last();
    [first, last.expect("there is a shadow")].map(metres)
}

#[test]
fn a_shadow_lies_where_parallel_light_puts_it() {
    let sun = shining(Light::directional(1.0), DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0));
    let scene = square_over_floor(sun);
    for shadows in WAYS {
        let frame =
            render(&scene, &from_above(), &settings(EffectSettings { shadows, ..Default::default() }));
        let [first, last] = dark_span(&frame.expect("drawn"), 0.5);
        // From 0.5 (where the square ends, as seen from above) to 1.5, within a pixel
        // of the picture (31 mm) and 1.7 texels of the map (16 mm each).
        assert!((first - 0.5).abs() < 0.06 && (last - 1.5).abs() < 0.06, "{shadows:?}: {first} to {last}");
    }
}

#[test]
fn a_shadow_grows_with_the_distance_from_a_point() {
    let spot = Light { kind: LightKind::Spot { inner: 0.7, outer: 0.75 }, ..Light::spot(9.0) };
    for light in [Light::point(9.0), spot] {
        let scene = square_over_floor(shining(light, DVec3::Y * 3.0, DVec3::NEG_Y));
        for shadows in WAYS {
            let frame =
                render(&scene, &from_above(), &settings(EffectSettings { shadows, ..Default::default() }));
            let [first, last] = dark_span(&frame.expect("drawn"), 0.5);
            // Half a metre two metres away is three quarters three metres away.
            let right = (first - 0.5).abs() < 0.06 && (last - 0.75).abs() < 0.06;
            assert!(right, "{:?} {shadows:?}: {first} to {last}", light.kind);
        }
    }
}

/// "Acne": a surface that shadows itself.
#[test]
fn what_nothing_hides_is_as_bright_as_without_shadows() {
    for tilt in [0.0, 0.5, 1.0, 1.3, 1.5] {
        let mut scene = Scene::new();
        scene.add_object("floor", primitives::plane(3.0, 3.0), matt(Vec3::ONE));
        let ball = scene.add_object("ball", primitives::uv_sphere(0.5, 96, 48), matt(Vec3::ONE));
        scene.node_mut(ball).expect("just added").transform = Transform::from_translation(DVec3::Y * 0.5);
        let along = DVec3::new(elementary::sin(tilt), -elementary::cos(tilt), 0.2);
        scene.add(shining(Light::directional(1.0), DVec3::ZERO, along));
        let draw = |shadows| {
            let settings = settings(EffectSettings { shadows, ..Default::default() });
            render(&scene, &from_above(), &settings).expect("drawn")
        };
        let [off, exact] = [draw(Shadows::Off), draw(Shadows::Rays)];
        let mapped = draw(Shadows::Maps { resolution: 1024 });
        let (mut lit, mut wrong) = (0, 0);
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            // Near the edge of a shadow a texel's width is allowed.
            let near = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy)));
            let open = near.into_iter().all(|(dx, dy)| {
                let (x, y) =
                    (x.saturating_add_signed(dx).min(SIDE - 1), y.saturating_add_signed(dy).min(SIDE - 1));
                exact.pixel(x, y) == off.pixel(x, y)
            });
            if open && light(&off, x, y) > 0.05 {
                lit += 1;
                wrong += usize::from(mapped.pixel(x, y) != off.pixel(x, y));
            }
        }
        assert!(lit > 1000, "something is lit at {tilt}: {lit}");
        assert_eq!(wrong, 0, "of {lit} pixels that nothing hides, at {tilt}");
    }
}

#[test]
fn a_warm_cache_gives_the_bytes_of_a_cold_one() {
    let mut scene = square_over_floor(shining(Light::point(6.0), DVec3::new(0.3, 3.0, 0.2), DVec3::NEG_Y));
    let settings =
        settings(EffectSettings { shadows: Shadows::Maps { resolution: 256 }, ..Default::default() });
    let mut warm = Renderer::new();
    let mut check = |scene: &Scene, camera: &Camera, what: &str, drawn: u64| {
        let kept = warm.render(scene, camera, &settings).expect("drawn");
        assert_eq!(kept, render(scene, camera, &settings).expect("drawn"), "{what}");
        assert_eq!(warm.effect_counts(Effect::ShadowMaps).passes, drawn, "maps drawn: {what}");
    };
    check(&scene, &from_above(), "cold", 6);
    check(&scene, &from_above(), "the same again", 0);
    check(&scene, &from_front(), "seen from elsewhere", 0);
    let square = scene.nodes().iter().find(|(_, node)| node.name == "square").map(|(id, _)| id);
    let node = scene.node_mut(square.expect("it is there")).expect("it is there");
    node.transform.set_translation(DVec3::new(0.2, 1.2, 0.0));
    check(&scene, &from_above(), "a caster moved", 6);
    let lamp = scene.nodes().iter().find(|(_, node)| node.light.is_some()).map(|(id, _)| id);
    scene
        .node_mut(lamp.expect("it is there"))
        .expect("it is there")
        .transform
        .set_translation(DVec3::Y * 4.0);
    check(&scene, &from_above(), "the lamp moved", 6);
}

/// Beside an endless wall a floor sees half of the sky, far away all of it.
#[test]
fn a_wall_takes_half_of_the_sky_away() {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(60.0, 60.0), matt(Vec3::ONE));
    let wall = scene.add_object("wall", primitives::plane(60.0, 60.0), matt(Vec3::ONE));
    let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::X);
    scene.node_mut(wall).expect("just added").transform =
        Transform::from_scale_rotation_translation(DVec3::ONE, upright, DVec3::X * 0.5);
    scene.add(Node::from_light(Light::ambient(1.0)));
    let occlusion = |distance| EffectSettings {
        ambient_occlusion: Some(AmbientOcclusion { rays: 64, distance }),
        ..Default::default()
    };
    let mean = |frame: &Frame, x: u32| (40..80).map(|y| light(frame, x, y)).sum::<f32>() / 40.0;
    let endless = render(&scene, &from_above(), &settings(occlusion(1e3))).expect("drawn");
    // 0.5 m is at column 80: a pixel before it, the wall takes half of the rays.
    assert!((mean(&endless, 78) - 0.5).abs() < 0.06, "{} beside the wall", mean(&endless, 78));
    let near = render(&scene, &from_above(), &settings(occlusion(0.5))).expect("drawn");
    assert_eq!(mean(&near, 10), 1.0, "2 m away nothing within half a metre is in the way");
}

/// The white furnace: what reflects everything vanishes in a white room.
#[test]
fn a_white_surface_cannot_be_seen_in_a_white_room() {
    for (metallic, roughness) in [(1.0, 0.0), (1.0, 0.4), (1.0, 1.0), (0.0, 0.1), (0.0, 0.6), (0.0, 1.0)] {
        let mut scene = Scene::new();
        let model = MetallicRoughness { metallic, roughness, ..MetallicRoughness::default() };
        let material = Material {
            base_color: Vec4::ONE,
            shading: Shading::MetallicRoughness(model),
            ..Material::default()
        };
        scene.add_object("ball", primitives::uv_sphere(1.5, 64, 32), material);
        let room = EffectSettings {
            environment: Some(Arc::new(Environment::uniform(Vec3::splat(0.5)))),
            ..Default::default()
        };
        let settings = RenderSettings { background: Background::Color(Vec3::splat(0.5)), ..settings(room) };
        let frame = render(&scene, &from_front(), &settings).expect("drawn");
        let (least, most) = (0..SIDE)
            .map(|x| light(&frame, x, SIDE / 2))
            .fold((1.0_f32, 0.0_f32), |(least, most), light| (least.min(light), most.max(light)));
        // One percent of the light, and one of 255 steps.
        let within = least > 0.495 - 0.004 && most < 0.505 + 0.004;
        assert!(within, "metallic {metallic}, roughness {roughness}: {least} to {most}");
    }
}

#[test]
fn a_sphere_is_as_bright_as_lamberts_law_says() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.5, 512, 256), matt(Vec3::splat(0.8)));
    let towards = DVec3::new(0.6, 0.48, 0.64);
    scene.add(shining(Light::directional(1.0), DVec3::ZERO, -towards));
    let frame = render(&scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let place = |pixel: u32| ((f64::from(pixel) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0) / 1.5;
        let (right, up) = (place(x), -place(y));
        let square = right * right + up * up;
        if square > 0.9 {
            continue;
        }
        let normal = DVec3::new(right, up, (1.0 - square).sqrt());
        let expected = 0.8 * normal.dot(towards).max(0.0);
        let shown = f64::from(light(&frame, x, y));
        // Half a step of sRGB is up to 0.0045 here; the facets' own is below 1e-3.
        assert!((shown - expected).abs() < 0.006, "({x}, {y}): {shown}, not {expected}");
    }
}

/// A scene in which the effect is off, and one in which it is on.
fn with(effect: Effect) -> [(Scene, RenderSettings); 2] {
    let mut scene = Scene::new();
    let ball = primitives::uv_sphere(1.0, 24, 12);
    let texture = scene.add_texture("grey", grey());
    let binding = TextureBinding::new(texture);
    let plain = Material { shading: Shading::Unlit, double_sided: false, ..Material::default() };
    let mut material = Material { base_color: Vec4::ONE, ..plain.clone() };
    let mut effects = EffectSettings::default();
    let mut style = Style::Surface;
    let mut lights = vec![];
    let lit = Material { shading: Shading::Lambert, ..plain.clone() };
    match effect {
        Effect::Lamps => (material, lights) = (lit, vec![Light::point(3.0)]),
        Effect::AmbientLight => (material, lights) = (lit, vec![Light::ambient(0.5)]),
        Effect::Highlights => (material, lights) = (Material::default(), vec![Light::point(3.0)]),
        Effect::Textures => material.base_color_texture = Some(binding),
        Effect::NormalMaps => {
            material = Material { normal_map: Some(NormalMap { binding, scale: 1.0 }), ..lit };
            lights = vec![Light::point(3.0)];
        }
        Effect::OcclusionMaps => {
            material = Material { occlusion: Some(Occlusion { binding, strength: 1.0 }), ..lit };
            lights = vec![Light::ambient(1.0)];
        }
        Effect::Emission => {
            material = Material { emissive: Vec3::ONE, emissive_texture: Some(binding), ..plain.clone() };
        }
        Effect::Masks => {
            material = Material {
                alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
                base_color_texture: Some(binding),
                ..plain.clone()
            };
        }
        Effect::Transparency => material.alpha_mode = AlphaMode::Blend,
        Effect::Environment => {
            material = lit;
            effects.environment = Some(Arc::new(Environment::uniform(Vec3::ONE)));
        }
        Effect::ShadowMaps | Effect::ShadowRays => {
            (material, lights) = (lit, vec![Light::point(3.0)]);
            effects.shadows =
                if effect == Effect::ShadowRays { Shadows::Rays } else { Shadows::Maps { resolution: 64 } };
        }
        Effect::AmbientOcclusion => {
            (material, lights) = (lit, vec![Light::ambient(1.0)]);
            effects.ambient_occlusion = Some(AmbientOcclusion { rays: 4, distance: 1.0 });
        }
        Effect::Reflection | Effect::Refraction => {
            let metallic = if effect == Effect::Reflection { 1.0 } else { 0.0 };
            material = Material { transmission: 1.0 - metallic, ..metal(metallic) };
            (effects.bounces, lights) = (2, vec![Light::ambient(1.0)]);
        }
        Effect::Fog => effects.fog = Some(Fog { color: Vec3::ONE, density: 0.1 }),
        Effect::ToneMapping => effects.exposure = 1.0,
        Effect::Edges => style = Style::SurfaceWithEdges,
        Effect::VertexColors | Effect::Poses | Effect::Outline => {}
    }
    let mut without = scene.clone();
    without.add_object("ball", ball.clone(), plain);
    let mut ball = ball;
    if effect == Effect::VertexColors {
        let corner_colors = Some(vec![Vec4::ONE; ball.corner_count()]);
        ball.set_attributes(Attributes { corner_colors, ..ball.attributes().clone() }).expect("one each");
    }
    if effect == Effect::Poses {
        let positions = Deltas::from_dense(vec![Vec3::X; ball.vertex_count()]);
        let target = MorphTarget { positions, ..MorphTarget::default() };
        let attributes = Attributes { morph_targets: vec![target], ..ball.attributes().clone() };
        ball.set_attributes(attributes).expect("one delta each");
    }
    let ball = scene.add_object("ball", ball, material);
    scene.node_mut(ball).expect("just added").morph_weights = vec![0.5];
    if effect == Effect::Outline {
        effects.outline = Some(Outline { nodes: vec![ball], color: Vec3::X, width: 2 });
    }
    for light in lights {
        scene.add(Node::from_light(light).at(DVec3::new(0.0, 0.0, 3.0)));
    }
    let off = settings(EffectSettings::default());
    let on = RenderSettings { style, ..settings(effects) };
    [(without, off), (scene, on)]
}

fn grey() -> Texture {
    Texture::new(1, 1, vec![[128, 128, 255, 255]], TextureFormat::Linear).expect("one texel")
}

/// The promise of the planner: what is off takes nothing, whatever else is on.
#[test]
fn off_means_zero() {
    for made_for in Effect::ALL {
        for (scene, settings) in with(made_for) {
            let mut renderer = Renderer::new();
            renderer.render(&scene, &from_front(), &settings).expect("drawn");
            let plan = renderer.plan().expect("there was a picture").clone();
            assert_eq!(plan, EffectPlan::new(&scene, &from_front(), &settings), "the plan is a function");
            for effect in Effect::ALL {
                let counts = renderer.effect_counts(effect);
                let none = counts == EffectCounts::default();
                assert!(plan.is_on(effect) || none, "{effect} is off and took {counts:?} ({made_for})");
            }
        }
        let [(scene, settings), on] = with(made_for);
        let plan = EffectPlan::new(&scene, &from_front(), &settings);
        assert!(!plan.is_on(made_for), "{made_for}: {}", plan.decision(made_for));
        let mut renderer = Renderer::new();
        renderer.render(&on.0, &from_front(), &on.1).expect("drawn");
        let decision = renderer.plan().expect("drawn").decision(made_for).clone();
        assert!(matches!(decision, Decision::On(_)), "{made_for}: {decision}");
        let counts = renderer.effect_counts(made_for);
        assert_ne!(counts, EffectCounts::default(), "{made_for} is on and takes something");
    }
}

#[test]
fn what_is_out_of_view_is_named() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 8, 4), matt(Vec3::ONE));
    let glass = Material { alpha_mode: AlphaMode::Blend, ..matt(Vec3::ONE) };
    let pane = scene.add_object("pane", primitives::plane(1.0, 1.0), glass);
    scene.node_mut(pane).expect("just added").transform = Transform::from_translation(DVec3::X * 50.0);
    let plan = EffectPlan::new(&scene, &from_front(), &settings(EffectSettings::default()));
    let said = plan.decision(Effect::Transparency).to_string();
    assert_eq!(said, "off, because the only object that has it, `pane`, is outside of the view", "named");
    assert_eq!(plan.to_string().lines().count(), Effect::ALL.len(), "a line for each");
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

fn metal(metallic: f32) -> Material {
    let model = MetallicRoughness { metallic, roughness: 0.0, ..MetallicRoughness::default() };
    Material { base_color: Vec4::ONE, shading: Shading::MetallicRoughness(model), ..Material::default() }
}

/// A pane in the middle, and an unlit wall of a colour somewhere.
fn pane_and_wall(pane: Material, turn: DQuat, wall: (DVec3, DVec3)) -> Scene {
    let mut scene = Scene::new();
    let (place, facing) = wall;
    for (name, mesh, material, rotation, place) in [
        ("pane", primitives::plane(2.0, 2.0), pane, turn, DVec3::ZERO),
        (
            "wall",
            primitives::plane(3.0, 3.0),
            Material { shading: Shading::Unlit, ..matt(Vec3::new(0.2, 0.6, 0.4)) },
            DQuat::from_rotation_arc(DVec3::Y, facing),
            place,
        ),
    ] {
        let id = scene.add_object(name, mesh, material);
        scene.node_mut(id).expect("just added").transform =
            Transform::from_scale_rotation_translation(DVec3::ONE, rotation, place);
    }
    scene
}

fn middle(scene: &Scene) -> Vec3 {
    let effects = EffectSettings { bounces: 3, ..EffectSettings::default() };
    let frame = render(scene, &from_front(), &settings(effects)).expect("drawn");
    let [r, g, b, _] = frame.pixel(SIDE / 2, SIDE / 2);
    Vec3::from([r, g, b].map(color::srgb8_to_linear))
}

#[test]
fn a_mirror_shows_what_is_beside_the_eye() {
    // The pane's normal is between +Z and +X, so that the eye sees along +X.
    let askew = DQuat::from_rotation_arc(DVec3::Y, DVec3::new(1.0, 0.0, 1.0).normalize());
    let scene = pane_and_wall(metal(1.0), askew, (DVec3::X * 4.0, DVec3::NEG_X));
    let shown = middle(&scene);
    assert!((shown - Vec3::new(0.2, 0.6, 0.4)).abs().max_element() < 0.01, "the wall: {shown}");
}

#[test]
fn glass_as_thin_as_air_is_not_seen() {
    let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
    let air = Material { transmission: 1.0, ior: 1.0, ..metal(0.0) };
    let scene = pane_and_wall(air, upright, (DVec3::NEG_Z * 3.0, DVec3::Z));
    let shown = middle(&scene);
    assert!((shown - Vec3::new(0.2, 0.6, 0.4)).abs().max_element() < 0.01, "the wall behind: {shown}");
    let glass = Material { transmission: 1.0, ior: 1.5, ..metal(0.0) };
    let through = middle(&pane_and_wall(glass, upright, (DVec3::NEG_Z * 3.0, DVec3::Z)));
    // Head-on, 4 % are reflected where the light enters; the pane has no other side.
    assert!((through / shown - 0.96).abs().max_element() < 0.02, "{through} of {shown}");
}
