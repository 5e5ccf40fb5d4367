//! Shadows lie where geometry puts them, and nowhere else.

use super::*;
use crate::effect::Effect;
use proptest::prelude::*;

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
        // of the image (31 mm) and 1.7 texels of the map (16 mm each).
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

/// Maps began at 10⁻⁴ of the distance of the farthest caster, and what was nearer cast no shadow.
#[test]
fn what_is_right_before_a_lamp_casts_its_shadow_in_a_huge_scene() {
    let spot = Light { kind: LightKind::Spot { inner: 0.7, outer: 0.75 }, ..Light::spot(9.0) };
    for light in [Light::point(9.0), spot] {
        for far in [1e5, 1e7, 1e12] {
            let mut scene = square_over_floor(shining(light, DVec3::Y * 3.0, DVec3::NEG_Y));
            let mountain = scene.add_object("mountain", primitives::plane(1.0, 1.0), matt(Vec3::ONE));
            scene.node_mut(mountain).expect("just added").transform =
                Transform::from_translation(DVec3::new(far, -far, 0.0));
            let shadows = Shadows::Maps { resolution: 512 };
            let frame =
                render(&scene, &from_above(), &settings(EffectSettings { shadows, ..Default::default() }));
            let [first, last] = dark_span(&frame.expect("drawn"), 0.5);
            let right = (first - 0.5).abs() < 0.06 && (last - 0.75).abs() < 0.06;
            assert!(right, "{:?}, a mountain at {far} m: {first} to {last}", light.kind);
        }
    }
}

/// A rotation by any angle about any axis.
fn rotation() -> impl Strategy<Value = DQuat> {
    [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0, 0.01..1.0].prop_map(|q| DQuat::from_array(q).normalize())
}

/// A lamp of any kind at up to 20 metres from the origin, that shines at a point near it.
fn lamp() -> impl Strategy<Value = Node> {
    let spot = (0.02_f32..std::f32::consts::FRAC_PI_2)
        .prop_map(|outer| Light { kind: LightKind::Spot { inner: outer * 0.9, outer }, ..Light::spot(1.0) });
    let light = prop_oneof![Just(Light::directional(1.0)), Just(Light::point(1.0)), spot];
    let target = [-0.3..0.3_f64, -0.3..0.3, -0.3..0.3].prop_map(DVec3::from);
    let radius = prop::sample::select(vec![0.0_f32, 0.01, 0.3, 2.0]);
    (light, rotation(), prop_oneof![0.5..3.0_f64, 3.0..20.0], target, radius).prop_map(
        |(light, rotation, distance, target, radius)| {
            let from = rotation * DVec3::Z * distance;
            let bright = Light {
                intensity: if light.kind == LightKind::Directional {
                    1.0
                } else {
                    (distance * distance) as f32
                },
                radius,
                ..light
            };
            shining(bright, from, target - from)
        },
    )
}

/// How many pixels of a plane that is turned like this a lamp's map takes for shadowed.
fn pixels_in_own_shadow(lamp: Node, turn: DQuat, resolution: u32) -> usize {
    let mut scene = Scene::new();
    let plane = scene.add_object(
        "plane",
        primitives::plane(3.0, 3.0),
        Material { double_sided: true, ..matt(Vec3::ONE) },
    );
    scene.node_mut(plane).expect("just added").transform =
        Transform::from_scale_rotation_translation(DVec3::ONE, turn, DVec3::ZERO);
    scene.add(lamp);
    let [off, mapped] = [Shadows::Off, Shadows::Maps { resolution }].map(|shadows| {
        render(&scene, &from_above(), &settings(EffectSettings { shadows, ..Default::default() }))
            .expect("drawn")
    });
    off.color.chunks_exact(4).zip(mapped.color.chunks_exact(4)).filter(|(off, mapped)| off != mapped).count()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 4, ..ProptestConfig::default() })]

    /// "Acne" along no direction, on no slope, under no lamp and in no map: a plane hides nothing of itself.
    #[test]
    fn a_plane_casts_no_shadow_on_itself(lamp in lamp(), turn in rotation(), resolution in 8_u32..600) {
        prop_assert_eq!(pixels_in_own_shadow(lamp, turn, resolution), 0);
    }
}

/// Points next to a lamp are moved off the plane by more than the lamp's height above it. The plane through a moved point then
/// lay on the lamp's other side, and all of the true plane before it.
#[test]
fn points_that_are_moved_past_a_wide_lamp_are_not_shadowed_by_their_plane() {
    for height in [0.01, 0.05, 0.2] {
        let lamp = Light { intensity: 0.25, radius: 0.3, ..Light::point(1.0) };
        let lamp = shining(lamp, DVec3::new(0.4, height, 0.1), DVec3::NEG_Y);
        assert_eq!(pixels_in_own_shadow(lamp, DQuat::IDENTITY, 8), 0, "{height} m above the plane");
    }
}

/// "Acne": a surface that shadows itself.
#[test]
fn what_nothing_hides_is_as_bright_as_without_shadows() {
    let tilts = [0.0, 0.5, 1.0, 1.3, 1.5].into_iter();
    let turned = tilts.flat_map(|tilt| [0.0, 0.4, 2.2, 3.9].map(|around| [tilt, around]));
    for [tilt, around] in turned {
        let mut scene = Scene::new();
        scene.add_object("floor", primitives::plane(3.0, 3.0), matt(Vec3::ONE));
        let ball = scene.add_object("ball", primitives::uv_sphere(0.5, 96, 48), matt(Vec3::ONE));
        scene.node_mut(ball).expect("just added").transform = Transform::from_translation(DVec3::Y * 0.5);
        let along = DVec3::new(elementary::sin(tilt), -elementary::cos(tilt), 0.2);
        let along = DQuat::from_xyzw(0.0, elementary::sin(around), 0.0, elementary::cos(around)) * along;
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
        assert!(lit > 1000, "something is lit at {tilt}, {around}: {lit}");
        assert_eq!(wrong, 0, "of {lit} pixels that nothing hides, at {tilt}, {around}");
    }
}

#[test]
fn a_warm_cache_gives_the_bytes_of_a_cold_one() {
    let mut scene = square_over_floor(shining(Light::point(6.0), DVec3::new(0.3, 3.0, 0.2), DVec3::NEG_Y));
    let settings =
        settings(EffectSettings { shadows: Shadows::Maps { resolution: 256 }, ..Default::default() });
    let mut warm = Renderer::new(settings.clone());
    let mut check = |scene: &Scene, camera: &Camera, what: &str, drawn: u64| {
        let kept = warm.render(scene, camera).expect("drawn");
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

/// An image can be exchanged under its id, and takes the holes of a shadow with it.
#[test]
fn a_mask_that_is_exchanged_changes_its_shadow() {
    let texture = |alpha| Texture::new(1, 1, vec![[255, 255, 255, alpha]], TextureFormat::Srgb);
    let mut scene =
        square_over_floor(shining(Light::directional(1.0), DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0)));
    let id = scene.add_texture("mask", texture(255).expect("a texel"));
    let masked = Material { alpha_mode: AlphaMode::Mask { cutoff: 0.5 }, ..Material::from_texture(id) };
    let masked = scene.add_material(masked);
    let (_, square) = scene.nodes_mut().find(|(_, node)| node.name == "square").expect("it is there");
    square.materials = vec![masked];
    let settings =
        settings(EffectSettings { shadows: Shadows::Maps { resolution: 64 }, ..Default::default() });
    let mut warm = Renderer::new(settings.clone());
    let whole = warm.render(&scene, &from_above()).expect("drawn");
    scene.textures.get_mut(id).expect("just added").texture = Arc::new(texture(0).expect("a texel"));
    let open = warm.render(&scene, &from_above()).expect("drawn");
    assert_eq!(open, render(&scene, &from_above(), &settings).expect("drawn"), "as without a cache");
    let light_in = |frame: &Frame| frame.color.iter().map(|&byte| u64::from(byte)).sum::<u64>();
    assert!(light_in(&open) > light_in(&whole), "neither square nor shadow");
}
