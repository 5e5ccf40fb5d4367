//! Triangles that reach far beyond the image: to the rim of the guard band,
//! 32768 pixels from the middle, over it, and to the end of what is a coordinate.

use super::against_rays::check;
use crate::coverage::fan_triangles;
use crate::coverage_support::{SIDE, Values, clip_position, count, pixel};
use crate::effort::cases;
use crate::multisampling::light;
use proptest::prelude::*;
use trigon_math::{Vec4, elementary};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::mask;
use trigon_study::oracle::ray::Tolerance;

/// The guard band's rim in steps of the grid from the image's middle.
const RIM: i32 = 32768 * 256;

/// Coordinates on the rim, a step inside it, and in the image.
fn at_the_rim() -> impl Strategy<Value = i32> {
    let middle = SIDE * 128;
    prop_oneof![
        2 => Just(middle - RIM),
        2 => Just(middle + RIM),
        1 => prop_oneof![Just(middle - RIM + 1), Just(middle + RIM - 1)],
        3 => 0..SIDE * 256,
        1 => middle - RIM..middle + RIM,
    ]
}

fn point_at_the_rim() -> impl Strategy<Value = GridPoint> {
    [at_the_rim(), at_the_rim()]
}

proptest! {
    #![proptest_config(cases(300))]

    /// Hard case 8: the longest edges that are never cut, with the largest products.
    #[test]
    fn corners_on_the_rim_of_the_guard_band_are_exact(
        points in [point_at_the_rim(), point_at_the_rim(), point_at_the_rim()],
        samples in prop_oneof![Just(1_u32), Just(8)],
    ) {
        let light = light(&Values::on_grid(&points), &[[0, 1, 2]], samples);
        for (index, &light) in light.iter().enumerate() {
            let expected = mask(points, samples, pixel(index)).count_ones();
            prop_assert_eq!(light * samples as f32, expected as f32, "{:?} at {:?}", points, pixel(index));
        }
    }
}

/// Where an `f32` in pixels is about to leave the fixed-point numbers, or has left.
const PIXELS: [f32; 5] = [32_768.0, 65_536.0, 8_388_608.0, 1e6, 1e9];

/// A coordinate in clip space for w = 1, up to 10⁹ pixels out, also one step of f32
/// before and behind what [`PIXELS`] names.
fn far_out() -> impl Strategy<Value = f32> {
    let edge =
        (prop::sample::select(&PIXELS[..]), any::<bool>(), -1..=1_i32).prop_map(|(pixels, left, step)| {
            let at = pixels / (SIDE as f32 / 2.0);
            let at = f32::from_bits(at.to_bits().wrapping_add_signed(step));
            if left { -at } else { at }
        });
    prop_oneof![2 => edge, 1 => -1e5_f32..1e5, 2 => -1.0_f32..1.0]
}

/// A corner at a depth, in an infinite perspective with the near plane at 1/8.
pub(super) fn far_corner() -> impl Strategy<Value = Vec4> {
    (far_out(), far_out(), 0.25_f32..8.0).prop_map(|(x, y, w)| Vec4::new(x * w, y * w, 0.125, w))
}

/// Corners are snapped by at most 1/512 pixel on either axis. Those that are cut have
/// been rounded to f32 before, coordinate and w, each by 2^-24 of 32768 pixels, which
/// is 1/512, too; and cut from coordinates of up to 10⁹ pixels, at another corner's w
/// 32 times as much, with 2^-44 of that (see `clipping::vertices`), 1/549. Together,
/// over both axes, less than 1/90. Depths of at most 1 are rounded twice, and what
/// `primitive/depth.rs` adds is less.
const TOLERANCE: Tolerance = Tolerance { outline: 1.0 / 90.0, depth: 1.0 / (1 << 22) as f64 };

proptest! {
    #![proptest_config(cases(200))]

    /// Hard cases 9 and 10: what is cut at the guard band covers what rays meet, and
    /// lies as deep.
    #[test]
    fn huge_triangles_cover_what_rays_meet_and_at_its_depth(corners in [far_corner(), far_corner(), far_corner()]) {
        check(corners, TOLERANCE);
    }

    /// Beyond what rays can tell, too: neighbours are cut at the same points.
    #[test]
    fn a_fan_to_the_end_of_the_range_has_no_gaps(
        centre in [0..SIDE * 256, 0..SIDE * 256],
        exponents in proptest::collection::vec(3..99_i32, 3..30),
        turn in 0.0_f64..7.0,
    ) {
        let corners = exponents.len() as u32;
        let mut positions = vec![clip_position(centre, 0.5)];
        for (i, &exponent) in (0..corners).zip(&exponents) {
            let angle = turn + std::f64::consts::TAU * f64::from(i) / f64::from(corners);
            let (sine, cosine) = elementary::sin_cos(angle);
            let radius = elementary::exp2(f64::from(exponent));
            positions.push(Vec4::new((cosine * radius) as f32, (sine * radius) as f32, 0.5, 1.0));
        }
        let counts = count(&Values::ones(positions), &fan_triangles(corners));
        let wrong = counts.iter().position(|&count| count != 1);
        prop_assert!(wrong.is_none(), "not exactly once at {:?}", wrong.map(pixel));
    }
}
