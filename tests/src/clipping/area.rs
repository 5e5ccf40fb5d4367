//! Inside and outside parts add up to the whole.

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use trigon_math::{ClipPolygon, Vec4};

use super::check;
use super::input::{self, Planes};
use crate::effort::cases;
use trigon_study::oracle::area::{Weights, rational, share, split, whole};

/// The part of a triangle inside the planes, each moved outwards by `offset`
/// times its scale, and all the parts that were cut off.
fn exact_parts(triangle: &[Vec4; 3], planes: &Planes, offset: f64) -> (Vec<Weights>, Vec<Vec<Weights>>) {
    let (mut inside, mut cut_off) = (whole(), Vec::new());
    for equation in planes.equations() {
        let moved = rational(offset) * scale(&equation, triangle);
        let (rest, outside) = split(&inside, &at_corners(&equation, triangle, &moved));
        cut_off.push(outside);
        inside = rest;
    }
    (inside, cut_off)
}

/// An equation's values at the corners of a triangle, plus `offset`.
fn at_corners(equation: &[f64; 5], triangle: &[Vec4; 3], offset: &BigRational) -> [BigRational; 3] {
    triangle.map(|corner| {
        let terms = corner.to_array().into_iter().zip(equation);
        let linear: BigRational = terms.map(|(x, c)| rational(x) * rational(*c)).sum();
        linear + rational(equation[4]) + offset
    })
}

/// The largest sum of magnitudes of an equation's terms among the corners: the
/// rounding in `f64` is relative to this.
fn scale(equation: &[f64; 5], triangle: &[Vec4; 3]) -> BigRational {
    let at = triangle.map(|corner| {
        let terms = corner.to_array().into_iter().zip(equation);
        let sum: BigRational = terms.map(|(x, c)| (rational(x) * rational(*c)).abs()).sum();
        sum + rational(equation[4]).abs()
    });
    at.into_iter().fold(BigRational::zero(), |a, b| if a > b { a } else { b })
}

/// The share of the triangle's area that the clipped polygon has by its weights,
/// computed without further rounding.
fn clipped_area(polygon: &ClipPolygon) -> BigRational {
    let point = |vertex: &trigon_math::ClipVertex| vertex.weights.map(rational);
    let points: Vec<Weights> = polygon.vertices().iter().map(point).collect();
    share(&points)
}

/// How far a plane may have moved, relative to its scale, when cuts are made in
/// `f64`: at most seven in a row, each with at most 16 roundings of 2⁻⁵³ in the
/// cut point, together below 2⁻⁴⁶.
const MOVED: f64 = 1.0 / (1_u64 << 46) as f64;

/// What rounding ten vertices' weights to `f32` does to an area: moving a vertex
/// by `e` changes the (doubled) area by the cross product of `e` with the
/// diagonal past it. With |e| ≤ 2⁻²⁵ per coordinate and diagonals of at most 1
/// per coordinate that is 2⁻²⁴ each, so 10 · 2⁻²⁴ in all, and the quadratic part
/// is far below; 2⁻²⁰ is 16 · 2⁻²⁴.
const ROUNDED: f64 = 1.0 / (1_u64 << 20) as f64;

/// The exact areas between which the clipped one must lie, before rounding.
fn limits(triangle: &[Vec4; 3], planes: &Planes) -> [BigRational; 2] {
    [-MOVED, MOVED].map(|offset| share(&exact_parts(triangle, planes, offset).0))
}

fn areas_agree(triangle: [Vec4; 3], planes: &Planes) {
    let got = clipped_area(&check::clip(triangle, planes));
    let [least, most] = limits(&triangle, planes);
    let rounded = rational(ROUNDED);
    assert!(
        &least - &rounded <= got && got <= &most + &rounded,
        "the area {:?} is not in [{:?}, {:?}]; {triangle:?} by {planes:?}",
        got.to_f64(),
        least.to_f64(),
        most.to_f64()
    );
}

proptest! {
    #![proptest_config(cases(400))]

    /// The oracle holds in exact arithmetic: nothing is lost and nothing counted
    /// twice.
    #[test]
    fn exact_parts_add_up_exactly(triangle in input::triangle(), planes in input::planes()) {
        let (inside, cut_off) = exact_parts(&triangle, &planes, 0.0);
        let parts = cut_off.iter().map(|part| share(part));
        prop_assert!(parts.clone().all(|part| !part.is_negative()), "a part is inside out");
        prop_assert_eq!(parts.fold(share(&inside), |a, b| a + b), BigRational::one());
    }

    #[test]
    fn the_clipped_area_is_the_exact_one_within_bounds(
        triangle in input::triangle(), planes in input::planes(),
    ) {
        areas_agree(triangle, &planes);
    }
}

/// The bounds above would be of no use if they were far apart. They are where
/// triangles lie in a plane; ordinary ones must be pinned down.
#[test]
fn the_bounds_pin_ordinary_triangles_down() {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let (mut pinned, mut cut, cases) = (0, 0, 150);
    for _ in 0..cases {
        let triangle =
            input::ordinary_triangle().new_tree(&mut runner).expect("every range yields a value").current();
        let [least, most] = limits(&triangle, &Planes::VIEW);
        pinned += usize::from(&most - &least <= rational(ROUNDED));
        cut += usize::from(most.is_positive() && most < BigRational::one());
        areas_agree(triangle, &Planes::VIEW);
    }
    assert!(pinned * 100 >= cases * 99, "only {pinned} of {cases} areas are known");
    assert!(cut * 10 >= cases, "only {cut} of {cases} triangles are cut");
}
