//! Images of all directions: the seam behind the viewer, where their left and right edges meet, and the poles, where a
//! row of texels is one point.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DVec3, color, elementary};
use trigon_scene::{Background, EffectSettings, Environment, RenderSettings, Scene, render};

use crate::effort::cases;

/// An image of all directions.
#[derive(Clone, Debug)]
struct Image {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
}

fn image() -> impl Strategy<Value = Image> {
    let sizes =
        vec![[16, 8], [8, 4], [64, 32], [36, 18], [7, 5], [3, 2], [1, 4], [4, 1], [256, 128], [1024, 16]];
    prop::sample::select(sizes).prop_flat_map(|[width, height]| {
        let pixel = prop::array::uniform3(0.0_f32..1.0);
        prop::collection::vec(pixel, width * height).prop_map(move |pixels| Image { width, height, pixels })
    })
}

impl Image {
    /// The texel of a direction: longitude from the left edge, which lies behind (+Z), through +X's opposite, and the
    /// angle from straight up.
    fn texel(&self, direction: DVec3) -> [f32; 3] {
        let around = elementary::atan2(direction.x, -direction.z) / TAU + 0.5;
        let down = elementary::acos((direction.y / direction.length()).clamp(-1.0, 1.0)) / PI;
        let index = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
        self.pixels[index(down, self.height) * self.width + index(around, self.width)]
    }

    /// The least and the greatest light within an angle about a direction, channel by channel.
    fn range(&self, direction: DVec3, angle: f64) -> [[f32; 3]; 2] {
        let ahead = direction.normalize();
        let (aside, up) = ahead.any_orthonormal_pair();
        let [mut least, mut greatest] = [self.texel(ahead); 2];
        for (ring, step) in (1..=4).flat_map(|ring| (0..32).map(move |step| (ring, step))) {
            let (sine, cosine) = elementary::sin_cos(TAU * f64::from(step) / 32.0);
            let texel = self.texel(ahead + (aside * cosine + up * sine) * (angle * f64::from(ring) / 4.0));
            least = [0, 1, 2].map(|channel| least[channel].min(texel[channel]));
            greatest = [0, 1, 2].map(|channel| greatest[channel].max(texel[channel]));
        }
        [least, greatest]
    }
}

/// Directions about the seam, the poles, along the axes, and anywhere.
fn direction() -> impl Strategy<Value = DVec3> {
    let little = || prop_oneof![Just(0.0), Just(-0.0), -1e-9..1e-9, -0.05..0.05, -1.0..1.0_f64];
    let ends =
        prop::sample::select(vec![DVec3::Z, DVec3::Y, DVec3::NEG_Y, DVec3::X, DVec3::NEG_X, DVec3::NEG_Z]);
    prop_oneof![
        4 => (ends, little(), little(), little()).prop_map(|(end, x, y, z)| end + 0.5 * DVec3::new(x, y, z)),
        // Along the whole seam, from pole to pole.
        3 => (0.0..PI, little()).prop_map(|(down, aside)| {
            let (sine, cosine) = elementary::sin_cos(down);
            DVec3::new(0.05 * aside * sine, cosine, sine)
        }),
        2 => prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array),
    ]
    .prop_filter("has a length", |direction| direction.length() > 0.01)
}

/// How wide a look-up is: two texels of a map of 256 on a side, that is of 2/256 in the plane of a face of the octahedron,
/// which is tilted by √3 and as far as 1/√3 from the middle; from corner to corner.
const REACH: f64 = 2.0 / 256.0 * 3.0 * std::f64::consts::SQRT_2 * 1.2;

proptest! {
    // An environment takes a third of a second.
    #![proptest_config(cases(4))]

    /// Every direction shows the light of the image there, between the texels that it lies between, also across the seam
    /// and over the poles; within a texel exactly that one. The same as a background.
    #[test]
    fn every_direction_shows_its_texel_across_the_seam_and_at_the_poles(
        image in image(), directions in prop::collection::vec(direction(), 400), turn in -0.2..0.2_f64,
    ) {
        let environment = Environment::from_equirectangular(image.width, image.height, &image.pixels);
        let environment = Arc::new(environment.expect("the size fits"));
        for direction in directions {
            let shown = environment.radiance(direction.as_vec3(), 0.0).to_array();
            let [least, greatest] = image.range(direction, REACH);
            for channel in 0..3 {
                // Four products and three sums of numbers below 1.
                let (low, high) = (least[channel] - 1e-6, greatest[channel] + 1e-6);
                let is_between = (low..=high).contains(&shown[channel]);
                prop_assert!(is_between, "{:?} not in {:?} at {}", shown, [least, greatest], direction);
            }
        }
        for towards in [DVec3::Z, DVec3::Y, DVec3::NEG_Y, DVec3::new(0.0, -1.0, 1.0)] {
            let up = DVec3::new(turn, 0.3, 1.0 - turn);
            check_background(&image, &environment, &Camera::look_at(DVec3::ZERO, towards, up));
        }
    }
}

/// Holds each pixel of a small piece of the sky against the image.
fn check_background(image: &Image, environment: &Arc<Environment>, camera: &Camera) {
    const SIZE: [u32; 2] = [24, 18];
    const ANGLE: f64 = 0.3;
    let projection = Projection::perspective(ANGLE, 0.1, None).expect("in range");
    let effects = EffectSettings { environment: Some(Arc::clone(environment)), ..EffectSettings::default() };
    let settings = RenderSettings {
        background: Background::Environment,
        samples_per_axis: 1,
        effects,
        ..RenderSettings::new(SIZE[0], SIZE[1])
    };
    let frame = render(&Scene::new(), &camera.with_projection(projection), &settings).expect("in range");
    let scale = 2.0 * elementary::tan(ANGLE / 2.0) / f64::from(SIZE[1]);
    for (index, shown) in frame.color.chunks_exact(4).enumerate() {
        let [x, y] = [index as u32 % SIZE[0], index as u32 / SIZE[0]].map(|v| f64::from(v) + 0.5);
        let [right, down] = [x - f64::from(SIZE[0]) / 2.0, y - f64::from(SIZE[1]) / 2.0].map(|v| v * scale);
        let direction = camera.orientation * DVec3::new(right, -down, -1.0);
        let [least, greatest] = image.range(direction, REACH + scale);
        for channel in 0..3 {
            let byte = |light: f32| color::linear_to_srgb8(light);
            let (low, high) =
                (byte(least[channel]).saturating_sub(1), byte(greatest[channel]).saturating_add(1));
            assert!((low..=high).contains(&shown[channel]), "{shown:?} at {x}, {y}, seen along {direction}");
        }
    }
}
