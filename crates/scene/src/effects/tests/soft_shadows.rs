//! Soft shadows against the fraction of a disc that a straight edge leaves visible.

use super::*;
use crate::effect::Effect;
use proptest::prelude::*;

/// The height of the plate that casts the shadow, in metres; its edge runs along Z above the origin.
const HEIGHT: f64 = 1.0;

/// A floor, and above its left half a plate, in the light of a lamp.
fn plate_over_floor(lamp: Node) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(24.0, 24.0), matt(Vec3::ONE));
    let plate = scene.add_object("plate", primitives::plane(12.0, 24.0), matt(Vec3::ONE));
    scene.node_mut(plate).expect("just added").transform =
        Transform::from_translation(DVec3::new(-6.0, HEIGHT, 0.0));
    scene.add(lamp);
    scene
}

/// A lamp, and how the floor sees it.
struct Subject {
    node: Node,
    radius: f64,
    /// From a point of the floor to the middle of the lamp; of length 1 if that is far away.
    towards: fn(DVec3) -> DVec3,
}

fn subjects() -> [Subject; 3] {
    let sun = |point: DVec3| DVec3::new(-1.0, 1.0, 0.0).normalize() + point * 0.0;
    let bulb = |point: DVec3| DVec3::new(-2.0, 3.0, 0.0) - point;
    let shining = |light: Light, radius: f64| {
        shining(light.with_radius(radius as f32), DVec3::new(-2.0, 3.0, 0.0), DVec3::new(1.0, -1.0, 0.0))
    };
    [
        Subject { node: shining(Light::directional(0.8), 0.2), radius: 0.2, towards: sun },
        Subject { node: shining(Light::point(6.0), 0.4), radius: 0.4, towards: bulb },
        Subject { node: shining(Light::spot(12.0), 0.4), radius: 0.4, towards: bulb },
    ]
}

impl Subject {
    /// The fraction of the lamp's disc on the far side of the edge, seen from a point of the floor: a disc without a
    /// circular segment.
    fn visible(&self, point: DVec3) -> f64 {
        let towards = (self.towards)(point);
        let distance = towards.length();
        let along = towards / distance;
        let beside = DVec3::new(along.y, -along.x, 0.0);
        let edge = DVec3::Y * HEIGHT - point;
        let cut = distance * edge.dot(beside) / edge.dot(along) / self.radius;
        let cut = cut.clamp(-1.0, 1.0);
        let area = elementary::atan2((1.0 - cut * cut).sqrt(), cut) - cut * (1.0 - cut * cut).sqrt();
        area / std::f64::consts::PI
    }
}

/// What the middle row of the floor shows of the lamp, as a fraction, with the position on the floor.
fn row(scene: &Scene, effects: &EffectSettings) -> Vec<(DVec3, f64)> {
    let light = |shadows| {
        let mut settings = settings(EffectSettings { shadows, ..effects.clone() });
        settings.outputs.radiance = true;
        let frame = render(scene, &from_above(), &settings).expect("drawn");
        let row = (SIDE / 2 * SIDE) as usize..((SIDE / 2 + 1) * SIDE) as usize;
        frame.radiance.expect("requested")[row].iter().map(|light| f64::from(light.x)).collect::<Vec<f64>>()
    };
    let metres = |x: usize| (x as f64 + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
    let lit = light(effects.shadows).into_iter().zip(light(Shadows::Off));
    let all = lit.enumerate().map(|(x, (lit, open))| (DVec3::X * metres(x), lit / open));
    // The plate hides the floor beneath it.
    all.filter(|(at, _)| at.x > 0.0).collect()
}

/// A way of drawing them.
struct Way {
    effects: EffectSettings,
    /// How far a fraction may be off.
    most: f64,
    /// How far from a penumbra, in metres, the fractions of both sides still mix.
    reach: f64,
}

/// By rays at every sample only the number of rays matters, and where they start. Pixels that share them take the mean of
/// five pixels of 0.06 m, and their neighbours read it; where that is too coarse they cast 32 of the rays themselves.
/// Maps compare 32 texels, and search as many, which may miss a caster that hides a tenth of the lamp.
fn ways() -> [Way; 3] {
    let by_rays = |rays, sampling| EffectSettings {
        shadows: Shadows::Rays,
        soft_shadows: SoftShadows { rays, sampling, ..SoftShadows::default() },
        ..EffectSettings::default()
    };
    let maps = EffectSettings { shadows: Shadows::Maps { resolution: 2048 }, ..EffectSettings::default() };
    [
        Way { effects: by_rays(256, RaySampling::Full), most: 0.015, reach: 0.01 },
        Way { effects: by_rays(128, RaySampling::Shared), most: 0.1, reach: 0.22 },
        Way { effects: maps, most: 0.15, reach: 0.05 },
    ]
}

#[test]
fn behind_a_straight_edge_the_fraction_of_a_disc_is_visible() {
    for subject in subjects() {
        let scene = plate_over_floor(subject.node.clone());
        for Way { effects, most, reach } in ways() {
            let row = row(&scene, &effects);
            let exact = |at: DVec3| subject.visible(at);
            let penumbra = row.iter().filter(|(at, _)| (0.01..0.99).contains(&exact(*at))).count();
            assert!(penumbra > 10, "{penumbra} pixels of a penumbra");
            let off = |(at, found): &(DVec3, f64)| (found - exact(*at)).abs();
            let worst = row.iter().max_by(|one, other| off(one).total_cmp(&off(other))).expect("pixels");
            let what = (&subject.node.light, effects.shadows, effects.soft_shadows.sampling);
            assert!(off(worst) < most, "{what:?}: {worst:?}, not {}", exact(worst.0));
            for (at, found) in &row {
                let around = [-reach, reach].map(|step| exact(*at + DVec3::X * step));
                if around == [1.0; 2] || around == [0.0; 2] {
                    // The ratio of two numbers of f32.
                    assert!((found - around[0]).abs() < 1e-5, "{what:?}: {found} at {}", at.x);
                }
            }
        }
    }
}

/// A lamp straight above the edge: by similar triangles, half the penumbra is as wide as the lamp's radius times the
/// distance of the floor from the edge, over that of the lamp.
#[test]
fn a_penumbra_is_as_wide_as_similar_triangles_say() {
    let [lamp, radius] = [4.0, 1.2];
    let light = Light::point(9.0).with_radius(radius as f32);
    let scene = plate_over_floor(shining(light, DVec3::Y * lamp, DVec3::NEG_Y));
    let width = radius * HEIGHT / (lamp - HEIGHT);
    for Way { effects, most, reach } in ways() {
        let row = row(&scene, &effects);
        let end = row.iter().find(|(_, lit)| *lit > 0.999).expect("it ends").0.x;
        // A thousandth of the disc is 1 % of its radius from its edge, and pixels are 0.03 m wide.
        assert!((end - width).abs() < 0.04 + reach, "{:?}: {end}, not {width}", effects.shadows);
        // Half a pixel is 4 % of the penumbra.
        assert!((row[0].1 - 0.5).abs() < 0.04 + most, "{:?}: {} below the edge", effects.shadows, row[0].1);
    }
}

/// A search whose width is that of a high roof has few texels for the wall at whose foot the point lies.
#[test]
fn the_foot_of_a_wall_is_dark_beneath_a_roof() {
    for (subject, edge) in [(0, -2.1), (1, -1.4)] {
        let mut scene = Scene::new();
        scene.add_object("floor", primitives::plane(24.0, 24.0), matt(Vec3::ONE));
        for (size, middle) in [
            (DVec3::new(0.1, 0.5, 12.0), DVec3::new(-0.05, 0.25, 0.0)),
            (DVec3::new(1.4, 0.1, 12.0), DVec3::new(edge + 0.7, 2.5, 0.0)),
        ] {
            let body = scene.add_object("body", primitives::cube(1.0), matt(Vec3::ONE));
            scene.node_mut(body).expect("just added").transform =
                Transform::from_scale_rotation_translation(size, DQuat::IDENTITY, middle);
        }
        scene.add(subjects()[subject].node.clone());
        for Way { effects, .. } in ways() {
            let row = row(&scene, &effects);
            let foot: Vec<_> = row.iter().filter(|(at, _)| (0.05..0.2).contains(&at.x)).collect();
            assert!(foot.len() > 1, "{} pixels", foot.len());
            // The wall hides the whole lamp.
            assert!(foot.iter().all(|(_, lit)| *lit < 1e-5), "{subject}, {:?}: {foot:?}", effects.shadows);
        }
    }
}

#[test]
fn a_lamp_without_a_radius_casts_the_sharp_shadow() {
    for shadows in [Shadows::Rays, Shadows::Maps { resolution: 256 }] {
        let draw = |radius: f32, soft_shadows| {
            let mut subject = subjects()[1].node.clone();
            subject.light = subject.light.map(|light| Box::new(light.with_radius(radius)));
            let effects = EffectSettings { shadows, soft_shadows, ..EffectSettings::default() };
            let mut renderer = Renderer::new(settings(effects));
            let frame = renderer.render(&plate_over_floor(subject), &from_above()).expect("drawn");
            (frame, renderer.effect_counts(Effect::SoftShadows))
        };
        let usual = SoftShadows::default();
        let (sharp, _) = draw(0.0, usual);
        for radius in [0.0, -0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
            let shared = SoftShadows { rays: 3, sampling: RaySampling::Shared, radius };
            let (drawn, counts) = draw(radius, shared);
            assert!(drawn == sharp, "{radius}, {shadows:?}");
            assert_eq!(counts, EffectCounts::default(), "{radius}, {shadows:?}");
        }
        assert!(draw(0.4, usual).0 != sharp, "a radius changes the image");
        assert!(draw(0.0, SoftShadows { radius: 0.4, ..usual }).0 == draw(0.4, usual).0, "one for all lamps");
    }
}

/// A small image of everything at once: lamps of any size at any place, also within the plate or on the floor.
fn any_lamp() -> impl Strategy<Value = Node> {
    let radius =
        prop::sample::select(vec![1e-30_f32, 1e-6, 0.01, 0.5, 3.0, 100.0, 1e18, 1e30, f32::INFINITY]);
    let place = || prop::sample::select(vec![-2.0_f64, 0.0, 0.1, 1.0, 5.0]);
    let light = prop::sample::select(vec![Light::directional(0.5), Light::point(2.0), Light::spot(2.0)]);
    (radius, [place(), place(), place()], light).prop_map(|(radius, place, light)| {
        shining(light.with_radius(radius), DVec3::from(place), DVec3::new(0.3, -1.0, 0.1))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 4, ..ProptestConfig::default() })]

    /// Points within a lamp see some of it, too.
    #[test]
    fn lamps_of_any_size_take_light_away_and_add_none(lamp in any_lamp(), way in 0..3_usize) {
        let scene = plate_over_floor(lamp);
        let effects = [
            (Shadows::Rays, RaySampling::Full),
            (Shadows::Rays, RaySampling::Shared),
            (Shadows::Maps { resolution: 64 }, RaySampling::Full),
        ]
        .map(|(shadows, sampling)| EffectSettings {
            shadows,
            soft_shadows: SoftShadows { rays: 4, sampling, ..SoftShadows::default() },
            ..EffectSettings::default()
        });
        let draw = |effects: EffectSettings| {
            let mut settings = RenderSettings { width: 20, height: 20, ..settings(effects) };
            settings.outputs.radiance = true;
            render(&scene, &from_above(), &settings).expect("drawn").radiance.expect("requested")
        };
        let (shaded, open) = (draw(effects[way].clone()), draw(EffectSettings::default()));
        for (shaded, open) in shaded.iter().zip(&open) {
            prop_assert!(shaded.is_finite(), "{shaded}");
            // A mean of fractions is rounded.
            prop_assert!(shaded.x >= 0.0 && shaded.x <= open.x * 1.000_001, "{shaded}, not up to {open}");
        }
    }
}

/// Buffers are few: other lamps' rays start at every sample.
#[test]
fn many_lamps_share_no_more_than_some_buffers() {
    let mut scene = plate_over_floor(subjects()[1].node.clone());
    for _ in 0..30 {
        scene.add(subjects()[1].node.clone());
    }
    let soft_shadows = SoftShadows { rays: 16, sampling: RaySampling::Shared, ..SoftShadows::default() };
    let effects = EffectSettings { shadows: Shadows::Rays, soft_shadows, ..EffectSettings::default() };
    let mut renderer = Renderer::new(RenderSettings { width: 24, height: 24, ..settings(effects) });
    renderer.render(&scene, &from_above()).expect("drawn");
    assert_eq!(renderer.effect_counts(Effect::SoftShadows).passes, 16, "of 31 lamps");
}
