//! How near the depth of a sample comes to the exact plane through its triangle's
//! snapped vertices.

use crate::coverage::triangle;
use crate::coverage_support::{SIDE, Samples, Values, clip_position, pixel, rasterizer};
use crate::effort::cases;
use crate::hard_cases::slivers::sliver;
use num_traits::Signed;
use proptest::prelude::*;
use trigon_raster::{BlendMode, Culling, Draw, ExecuteSettings, Output, Pass};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::area::rational;
use trigon_study::oracle::coverage::sample_points;
use trigon_study::oracle::depth::Plane;

/// What the depth is off by at most before it is rounded to f32: the bound that
/// `primitive/depth.rs` states, `2^-50 Δz XY/A`, for the slopes; an eighth more and
/// two roundings of depths in f64 for the two sums.
pub(crate) fn bound(plane: &Plane) -> f64 {
    let [low, high] = plane.range().map(f64::from);
    9.0 / 8.0 * exp2(-50) * (high - low) * plane.stretch() + 2.0 * exp2(-53) * high
}

fn exp2(exponent: i32) -> f64 {
    trigon_math::elementary::exp2(f64::from(exponent))
}

/// Also triangles of a few pixels, and slivers.
fn corners() -> impl Strategy<Value = [GridPoint; 3]> {
    let place = 0..SIDE * 256;
    let step = || [-1000..1000_i32, -1000..1000_i32];
    let small = ([place.clone(), place], step(), step())
        .prop_map(|([x, y], [ax, ay], [bx, by])| [[x, y], [x + ax, y + ay], [x + bx, y + by]]);
    prop_oneof![2 => triangle(), 2 => small, 1 => sliver()]
}

/// Depths of any size, and neighbours.
fn depths() -> impl Strategy<Value = [f32; 3]> {
    let any = || prop_oneof![0.0_f32..=1.0, (0..60).prop_map(|e: i32| exp2(-e) as f32), Just(0.0)];
    let near = (0.01_f32..0.9, [0..9_u32, 0..9_u32, 0..9_u32])
        .prop_map(|(depth, steps)| steps.map(|step| f32::from_bits(depth.to_bits() + step)));
    prop_oneof![3 => [any(), any(), any()], 1 => near]
}

fn planes() -> impl Strategy<Value = Vec<Plane>> {
    let plane = (corners(), depths()).prop_map(|(corners, depths)| Plane { corners, depths });
    proptest::collection::vec(plane, 1..20)
}

/// No needles, and depths that f64 sees at once.
fn ordinary_plane() -> impl Strategy<Value = Plane> {
    let depth = || exp2(-12) as f32..1.0;
    let plane = (corners(), [depth(), depth(), depth()]);
    let plane = plane.prop_map(|(corners, depths)| Plane { corners, depths });
    plane.prop_filter("no needle", |plane| plane.stretch() <= 1024.0)
}

/// What is seen: the triangle's number, its depth, and where.
fn seen(planes: &[Plane], surface: BlendMode, samples: u32) -> Vec<(usize, f32, GridPoint)> {
    let vertices = planes
        .iter()
        .flat_map(|plane| [0, 1, 2].map(|i| (clip_position(plane.corners[i], plane.depths[i]), 1.0)));
    let pipeline = Values { vertices: vertices.collect() };
    let triangles: Vec<_> = (0..planes.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mut pass = Pass::new();
    pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(&pipeline, &triangles) });
    let samples = Samples { per_axis: 1, per_pixel: samples };
    let mut target = samples.target([SIDE as u32; 2], &[Output::Depth, Output::Triangle]);
    rasterizer(&ExecuteSettings::default()).draw(&pass, &mut target);
    let (depths, ids) = (target.depth().expect("asked for"), target.triangles().expect("asked for"));
    // Depth and ids are those of the first sample.
    let point = |index| sample_points(samples.per_pixel, pixel(index)).next().expect("at least one");
    let all = (0..).zip(depths.iter().zip(ids)).filter(|(_, (_, id))| **id != u32::MAX);
    all.map(|(index, (&depth, &id))| (id as usize, depth, point(index))).collect()
}

/// Every so many samples are enough: rationals are slow.
const STEP: usize = 7;

proptest! {
    #![proptest_config(cases(50))]

    #[test]
    fn depth_is_that_of_the_exact_plane(
        planes in planes(),
        surface in prop_oneof![Just(BlendMode::Opaque), Just(BlendMode::Masked)],
        samples in prop_oneof![Just(1_u32), Just(4), Just(16)],
    ) {
        for (number, (id, depth, point)) in seen(&planes, surface, samples).into_iter().enumerate() {
            let plane = &planes[id];
            let [low, high] = plane.range();
            prop_assert!(low <= depth && depth <= high, "{depth} of {plane:?} at {point:?}");
            if number % STEP == 0 {
                let exact = plane.at(point).expect("what is seen has an area");
                let bound = rational(bound(plane));
                // Half a unit of the last place of f32; less among the denormal ones.
                let rounded = rational(exp2(-24)) * (&exact + &bound) + rational(exp2(-150));
                let error = (rational(depth) - exact).abs();
                prop_assert!(error <= bound + rounded, "{depth} of {plane:?} at {point:?}");
            }
        }
    }

    /// As `docs/conventions.md` says.
    #[test]
    fn depth_is_within_one_ulp_where_there_is_no_needle(
        plane in ordinary_plane(),
        samples in prop_oneof![Just(1_u32), Just(8)],
    ) {
        let planes = [plane];
        for (_, depth, point) in seen(&planes, BlendMode::Opaque, samples).into_iter().step_by(STEP) {
            let error = (rational(depth) - planes[0].at(point).expect("what is seen has an area")).abs();
            let ulp = f64::from(depth) - f64::from(depth.next_down());
            prop_assert!(error <= rational(ulp), "{depth} of {:?} at {point:?}", planes[0]);
        }
    }
}
