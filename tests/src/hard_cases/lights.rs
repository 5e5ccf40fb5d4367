//! Lights on a surface, within it, of no brightness and of far too much, and cones of
//! no width, of a half-turn and wider.

use std::f32::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, Vec3, Vec4, color};
use trigon_mesh::primitives;
use trigon_scene::{
    Background, Exposure, Frame, Light, LightKind, Lighting, Material, MetallicRoughness, Node,
    RenderSettings, Scene, Shading, ShadingModel, Transform, render,
};

use super::flight::{check_numbers, settings};
use crate::effort::cases;

const SIDE: u32 = 33;

/// Metres from the middle of a pixel to that of the next.
const PIXEL: f64 = 4.0 / SIDE as f64;

/// How far the eye is above the floor.
const EYE: f64 = 8.0;

/// A white floor at y = 0, seen from straight above: x to the right, z down, 4 metres
/// across.
fn floor(shading: Shading, model: ShadingModel, lights: &[(Light, DVec3)]) -> Frame {
    let (sin, cos) = trigon_math::elementary::sin_cos(-std::f64::consts::FRAC_PI_4);
    // A spot's axis points down.
    let nodes = lights.iter().map(|&(light, place)| node(light, DQuat::from_xyzw(sin, 0.0, 0.0, cos), place));
    floor_under(shading, model, nodes)
}

fn node(light: Light, rotation: DQuat, place: DVec3) -> Node {
    let turned = Transform::from_scale_rotation_translation(DVec3::ONE, rotation, place);
    Node::from_light(light).with_transform(turned)
}

/// The same under lights that are turned in any way.
fn floor_under(shading: Shading, model: ShadingModel, lights: impl Iterator<Item = Node>) -> Frame {
    let mut scene = Scene::new();
    let white = Material { base_color: Vec4::ONE, shading, ..Material::default() };
    scene.add_object("floor", primitives::grid(6.0, 6.0, 24, 24), white);
    for light in lights {
        scene.add(light);
    }
    let projection = Projection::orthographic(4.0, 0.1, 20.0).expect("in range");
    let camera = Camera::look_at(DVec3::Y * EYE, DVec3::ZERO, DVec3::NEG_Z).with_projection(projection);
    let mut settings = RenderSettings {
        shading: model,
        lighting: Lighting::Scene,
        background: Background::Color(Vec3::ZERO),
        ..settings([SIDE, SIDE])
    };
    // In bytes, what is no number would be black.
    settings.outputs.radiance = true;
    // The law holds for lamps of any brightness.
    settings.effects.exposure = Exposure::Stops(0.0);
    render(&scene, &camera, &settings).expect("in range")
}

fn intensity() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.0), Just(1.0), Just(1e9), Just(f32::MAX), Just(1e-40), 0.01_f32..100.0]
}

fn height() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(1e-9),
        Just(-1e-9),
        Just(1e-45),
        (-4.0..2.0_f64).prop_map(|power| trigon_math::elementary::pow(10.0, power))
    ]
}

fn model() -> impl Strategy<Value = ShadingModel> {
    prop_oneof![Just(ShadingModel::Flat), Just(ShadingModel::Gouraud), Just(ShadingModel::Phong)]
}

/// A spot light: its angles and range are any numbers.
#[derive(Clone, Copy, Debug)]
struct Spot {
    place: DVec3,
    rotation: DQuat,
    angles: [f32; 2],
    range: f32,
    intensity: f32,
}

fn spot() -> impl Strategy<Value = Spot> {
    let place = [-3.0..3.0_f64, -0.5..3.0, -3.0..3.0].prop_map(DVec3::from);
    let rotation = [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0, 0.01..1.0];
    let angle = || {
        prop_oneof![
            6 => 0.0..FRAC_PI_2, 2 => 0.0..0.1_f32, 1 => FRAC_PI_2..7.0, 1 => Just(0.0), 1 => any::<u32>().prop_map(f32::from_bits)
        ]
    };
    // In order or not, and hardly apart.
    let angles = (angle(), angle(), 0_u8..4).prop_map(|(a, b, order)| match order {
        0 => [a, b],
        1 => [a, a],
        2 => [a, a + 1e-3],
        _ => [a.min(b), a.max(b)],
    });
    let range = prop_oneof![
        3 => 0.1_f32..6.0, 1 => Just(f32::INFINITY), 1 => any::<u32>().prop_map(f32::from_bits)
    ];
    (place, rotation, angles, range, 0.1_f32..100.0).prop_map(
        |(place, rotation, angles, range, intensity)| Spot {
            place,
            rotation: DQuat::from_array(rotation).normalize(),
            angles,
            range,
            intensity,
        },
    )
}

impl Spot {
    fn node(&self) -> Node {
        let [inner, outer] = self.angles;
        let kind = LightKind::Spot { inner, outer };
        node(Light { kind, range: self.range, ..Light::point(self.intensity) }, self.rotation, self.place)
    }

    /// The least and the greatest light on a white floor, by KHR_lights_punctual and Lambert's law in f64. Each factor
    /// is that of places which are up to three roundings of 10 metres farther or nearer on each axis (see below).
    fn light_at(&self, point: DVec3) -> [f64; 2] {
        let way = self.place - point;
        let off = 3.0_f64.sqrt() * 3.0 * 10.0 * f64::from(f32::EPSILON);
        // Within that of the lamp there may be any light.
        let distance = way.length();
        if distance < 100.0 * off {
            return [0.0, f64::INFINITY];
        }
        let distances = [distance + off, distance - off];
        let share = 2.0 * off / distance;
        let height = [self.place.y - off, self.place.y + off].map(|height| height.max(0.0) / distance);
        let cosine = (self.rotation * DVec3::Z).dot(way / distance);
        let cone = [cosine - share, cosine + share].map(|cosine| self.cone(cosine));
        // Near the range, the rounding of 1 is much of what is left.
        let window = [(distances[0], -1e-6), (distances[1], 1e-6)]
            .map(|(distance, rounding)| (self.window(distance) + rounding).clamp(0.0, 1.0));
        let sides = [0, 1].map(|i| {
            let square = distances[i] * distances[i];
            f64::from(self.intensity) * height[i] * cone[i] * window[i] / square
        });
        // The product and its factors are rounded some twenty times.
        [sides[0] * (1.0 - 4e-6), sides[1] * (1.0 + 4e-6)]
    }

    /// The share that a cone lets through, where the cosine of the angle from its axis is this.
    fn cone(&self, cosine: f64) -> f64 {
        #[expect(
            clippy::disallowed_methods,
            reason = "of the oracle's own; its last bit is far below the bound"
        )]
        let [inner, outer] = self.angles.map(|angle| f64::from(angle).cos());
        if inner.is_nan() || outer.is_nan() {
            return 0.0;
        }
        let share = ((cosine - outer) / (inner - outer).max(0.001)).clamp(0.0, 1.0);
        share * share
    }

    /// The share that a range leaves.
    fn window(&self, distance: f64) -> f64 {
        let range = f64::from(self.range);
        if range > 0.0 {
            let relative = distance / range;
            (1.0 - relative * relative * relative * relative).max(0.0)
        } else {
            1.0
        }
    }
}

fn metal(roughness: f32) -> Shading {
    Shading::MetallicRoughness(MetallicRoughness { metallic: 1.0, roughness, ..MetallicRoughness::default() })
}

/// The light on a white floor `across` metres from below a lamp: I h / (h² + r²)^3/2.
fn lambert(intensity: f64, height: f64, across: f64) -> f64 {
    let square = height * height + across * across;
    if height > 0.0 { intensity * height / (square * square.sqrt()) } else { 0.0 }
}

proptest! {
    #![proptest_config(cases(48))]

    /// Lambert's law within what f32 leaves of where floor and lamp are: each lies up to
    /// [`EYE`] and two metres from the eye, so their places are off by three roundings of
    /// 2⁻²⁴ · 10, and the light is between those of a lamp that is so much nearer and
    /// farther, but for its own ten roundings and the byte's half step.
    #[test]
    fn a_lamp_at_any_height_lights_the_floor_by_lamberts_law(intensity in intensity(), height in height()) {
        let place = DVec3::new(0.0, height, 0.0);
        let frame = floor(Shading::Lambert, ShadingModel::Phong, &[(Light::point(intensity), place)]);
        check_numbers(&frame);
        let off = 3.0 * 10.0 * f64::from(f32::EPSILON) / 2.0;
        for (index, pixel) in (0..SIDE * SIDE).zip(frame.color.chunks_exact(4)) {
            let [x, z] = [index % SIDE, index / SIDE].map(|at| (f64::from(at) + 0.5) * PIXEL - 2.0);
            let across = trigon_math::elementary::hypot(x, z);
            if across < 0.5 * PIXEL {
                // Right below the lamp the floor is a point of any brightness.
                continue;
            }
            let at = |up: f64, out: f64| lambert(f64::from(intensity), height + up * off, across + out * off);
            let around = [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, -1.0), at(1.0, 1.0), at(0.0, 0.0)];
            // Where the law has its greatest value between the ends, that is greater than at them by
            // a share of (off / h)² only, with h = r / √2 of 4 cm and more: 2 · 10⁻⁹.
            let most = around.iter().fold(0.0_f64, |most, &light| most.max(light)) * (1.0 + 1e-6);
            let least = around.iter().fold(f64::INFINITY, |least, &light| least.min(light)) * (1.0 - 1e-6);
            let [low, high] = [least, most].map(|light| color::linear_to_srgb8(light as f32));
            prop_assert!(
                (low..=high).contains(&pixel[1]),
                "{} at {} m across is not between {} and {}", pixel[1], across, low, high
            );
        }
    }

    /// Every way to answer to light, under lamps where they should not be: nothing is NaN,
    /// which would be black, so what a lamp of 10⁹ shines on is white.
    #[test]
    fn far_too_bright_lamps_make_white_and_not_nan(
        height in prop_oneof![Just(1e-3), Just(0.1), Just(1.0), Just(100.0)], model in model(), strong in prop_oneof![Just(1e9_f32), Just(1e30), Just(f32::MAX)],
        shading in prop_oneof![
            Just(Shading::Lambert), Just(Shading::blinn_phong(Vec3::ONE, 0.0)), Just(Shading::blinn_phong(Vec3::ONE, 1e5)),
            Just(metal(1.0)),
            Just(Shading::MetallicRoughness(MetallicRoughness { roughness: 0.0, ..MetallicRoughness::default() })),
        ],
    ) {
        let lamp = (Light::point(strong), DVec3::new(0.0, height, 0.0));
        // A second one that gives no light, and one whose numbers are none.
        let none = (Light::point(0.0), DVec3::new(0.5, 0.5, 0.5));
        let broken = (Light { color: Vec3::new(f32::NAN, f32::INFINITY, -1.0), ..Light::point(f32::NAN) }, DVec3::ONE);
        let frame = floor(shading, model, &[lamp, none, broken]);
        check_numbers(&frame);
        let bright = frame.color.chunks_exact(4).filter(|pixel| pixel[..3] == [255; 3]).count();
        prop_assert!(bright == (SIDE * SIDE) as usize, "{} of {} pixels are white", bright, SIDE * SIDE);
    }

    /// Any numbers in lamps only ever add light to what a good one gives: neither NaN nor
    /// a brightness below zero takes any away.
    #[test]
    fn any_numbers_in_lamps_take_no_light_away(
        bits in prop::collection::vec(prop::array::uniform8(any::<u32>()), 1..4), model in model(), roughness in 0.2_f32..1.0,
    ) {
        let good = (Light::point(3.0), DVec3::new(0.3, 1.0, 0.2));
        let mut lights: Vec<_> = bits.iter().map(|bits| {
            let [intensity, range, inner, outer, r, g, b, kind] = bits.map(f32::from_bits);
            let kind = match kind.to_bits() % 4 {
                0 => LightKind::Ambient,
                1 => LightKind::Directional,
                2 => LightKind::Point,
                _ => LightKind::Spot { inner, outer },
            };
            (Light { kind, color: Vec3::new(r, g, b), intensity, range, radius: r }, DVec3::new(f64::from(r), 1.0, f64::from(b)))
        }).collect();
        let alone = floor(metal(roughness), model, &[good]);
        let brightest = alone.color.chunks_exact(4).map(|pixel| pixel[0]).max();
        prop_assert!(brightest > Some(100), "the good lamp gives light: {:?}", brightest);
        lights.push(good);
        let together = floor(metal(roughness), model, &lights);
        check_numbers(&together);
        let is_darker = together.color.iter().zip(&alone.color).any(|(together, alone)| together < alone);
        prop_assert!(!is_darker, "a pixel lost light");
    }

    /// Anywhere above the floor or below it, turned in any way, with any angles and range.
    #[test]
    fn a_spot_of_any_pose_lights_by_the_formula_of_the_extension(spot in spot()) {
        let frame = floor_under(Shading::Lambert, ShadingModel::Phong, std::iter::once(spot.node()));
        check_numbers(&frame);
        for (index, shown) in (0..SIDE * SIDE).zip(frame.radiance.expect("asked for")) {
            let [x, z] = [index % SIDE, index / SIDE].map(|at| (f64::from(at) + 0.5) * PIXEL - 2.0);
            let [low, high] = spot.light_at(DVec3::new(x, 0.0, z));
            let shown = f64::from(shown.y);
            prop_assert!((low..=high).contains(&shown), "{shown} at ({x}, {z}) is not between {low} and {high}");
        }
    }

    /// From nothing to a half-turn from side to side.
    #[test]
    fn a_cone_of_any_angle_ends_where_it_should(
        outer in prop_oneof![Just(0.0), Just(FRAC_PI_2), Just(1e-6_f32), 0.0..FRAC_PI_2], share in prop_oneof![Just(0.0_f32), Just(1.0), 0.0..1.0_f32],
    ) {
        check_cone(outer * share, outer);
    }
}

/// Wider than a half-turn from the axis there is nothing left to shine on: the formula goes on
/// with the cosine. An angle that is no number, or has no cosine, lights nothing.
#[test]
fn a_cone_wider_than_it_can_be_is_finite() {
    for outer in [PI, 10.0, -1.0, f32::NAN, f32::INFINITY] {
        check_cone(0.0, outer);
        check_cone(outer, outer);
    }
}

/// Holds a spot, a metre above the floor, against the formula of KHR_lights_punctual in f64.
fn check_cone(inner: f32, outer: f32) {
    let height = 1.0;
    let spot = Light { kind: LightKind::Spot { inner, outer }, ..Light::point(1.0) };
    let frame = floor(Shading::Lambert, ShadingModel::Phong, &[(spot, DVec3::Y * height)]);
    check_numbers(&frame);
    let [near, far] = [inner, outer].map(|angle| trigon_math::elementary::cos(f64::from(angle)));
    let scale = 1.0 / (near - far).max(0.001);
    for (index, pixel) in (0..SIDE * SIDE).zip(frame.color.chunks_exact(4)) {
        let [x, z] = [index % SIDE, index / SIDE].map(|at| (f64::from(at) + 0.5) * PIXEL - 2.0);
        let cosine = height / (height * height + x * x + z * z).sqrt();
        // The places of lamp and floor, and the cosine's own roundings, f32's of a
        // few metres: 10 · 2⁻²⁴ · 3, as above; a cone's edge is up to 1000 times as steep.
        let off = 30.0 * f64::from(f32::EPSILON) / 2.0;
        // The law itself goes with the cube of places that are so much off, and rounds ten
        // times: 100 · 2⁻²⁴ of it.
        let share = 6e-6;
        let light = |cosine: f64| {
            let fade = ((cosine - far) * scale).clamp(0.0, 1.0);
            let fade = if fade.is_nan() { 0.0 } else { fade };
            fade * fade * lambert(1.0, height, trigon_math::elementary::hypot(x, z))
        };
        let [low, high] = [light(cosine - off) * (1.0 - share), light(cosine + off) * (1.0 + share)]
            .map(|light| color::linear_to_srgb8(light as f32));
        let shown = pixel[1];
        assert!((low..=high).contains(&shown), "{shown} is not from {low} to {high} at ({x}, {z})");
    }
}
