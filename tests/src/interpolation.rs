//! Varyings against perspective interpolation in f64. Hard cases 21 to 23.

use crate::coverage_support::{SIDE, draw, pixel};
use crate::effort::cases;
use crate::hard_cases::slivers::sliver;
use proptest::prelude::*;
use trigon_math::{Vec4, elementary};
use trigon_raster::simd::{F32, InlineMap, Simd};
use trigon_raster::{
    Culling, Draw, Fragment, FragmentLanes, LanePipeline, Pass, Pipeline, VertexLanes, VertexOutput,
};
use trigon_study::oracle::GridPoint;

/// A triangle with a value at each corner; a fragment shows the value and its
/// derivatives.
#[derive(Clone, Debug)]
struct Probe {
    points: [GridPoint; 3],
    w: [f32; 3],
    values: [f32; 3],
}

impl Pipeline for Probe {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        VertexOutput { position: self.position(index), varyings: self.values[index] }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        Vec4::new(fragment.varyings, fragment.ddx, fragment.ddy, fragment.inverse_w)
    }
}

/// The same in lanes.
struct LaneProbe {
    /// x, y, z, w and the values of the vertices.
    columns: [[f32; 3]; 5],
}

impl LanePipeline for LaneProbe {
    const VARYINGS: usize = 1;

    fn vertex_count(&self) -> usize {
        3
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z, w, value] = self.columns.each_ref().each(
            #[inline(always)]
            |column| vertices.load(simd, column),
        );
        vertices.set(0, value);
        [x, y, z, w]
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, _: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [ddx, ddy] = fragments.gradient(0);
        [fragments.varying(0), ddx, ddy, fragments.inverse_w()]
    }
}

/// The fragments' colours with the centres of their pixels.
fn seen<P: LanePipeline>(pipeline: &P) -> Vec<([f64; 2], Vec4)> {
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(pipeline, &[[0, 1, 2]]) });
    let images = draw(&pass);
    let ids = images.triangles.expect("asked for");
    let seen = images.linear.expect("asked for").into_iter().enumerate().filter(|(i, _)| ids[*i] == 0);
    seen.map(|(index, color)| (pixel(index).map(|v| f64::from(v) + 0.5), color)).collect()
}

impl Probe {
    fn position(&self, index: usize) -> Vec4 {
        let w = self.w[index];
        let unit = f64::from(SIDE * 128);
        let [x, y] = self.points[index].map(f64::from);
        let at = |ndc: f64| (ndc * f64::from(w)) as f32;
        Vec4::new(at(x / unit - 1.0), at(1.0 - y / unit), 0.5 * w, w)
    }

    fn in_lanes(&self) -> LaneProbe {
        let column = |axis: usize| [0, 1, 2].map(|vertex| self.position(vertex)[axis]);
        LaneProbe { columns: [column(0), column(1), column(2), column(3), self.values] }
    }

    /// The same triangle with other values.
    fn with_values(&self, values: [f32; 3]) -> Self {
        Self { values, ..self.clone() }
    }

    /// The shares of the corners of a point of the screen, in pixels.
    fn weights(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let [a, b, c] = self.points.map(|point| point.map(|v| f64::from(v) / 256.0));
        let cross = |o: [f64; 2], p: [f64; 2]| (o[0] - x) * (p[1] - y) - (o[1] - y) * (p[0] - x);
        let area = cross(a, b) + cross(b, c) + cross(c, a);
        [cross(b, c) / area, cross(c, a) / area, cross(a, b) / area]
    }

    /// The value and 1/w there, by dividing interpolated v/w by interpolated 1/w.
    fn expected(&self, at: [f64; 2]) -> (f64, f64) {
        let weights = self.weights(at);
        let sum = |f: &dyn Fn(usize) -> f64| (0..3).map(|i| weights[i] * f(i)).sum::<f64>();
        let inverse_w = sum(&|i| 1.0 / f64::from(self.w[i]));
        (sum(&|i| f64::from(self.values[i]) / f64::from(self.w[i])) / inverse_w, inverse_w)
    }

    /// What a pixel to the right and one downwards add to the weights over w.
    fn share_steps(&self) -> [[f64; 3]; 2] {
        let [a, b, c] = self.points.map(|point| point.map(|v| f64::from(v) / 256.0));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let sides = [[b, c], [c, a], [a, b]];
        let over_w = |i: usize, step: f64| step / area / f64::from(self.w[i]);
        [
            [0, 1, 2].map(|i| over_w(i, sides[i][0][1] - sides[i][1][1])),
            [0, 1, 2].map(|i| over_w(i, sides[i][1][0] - sides[i][0][0])),
        ]
    }

    /// The shares of the corners in a value there: those above by 1/w.
    fn shares(&self, at: [f64; 2]) -> [f64; 3] {
        let weights = self.weights(at);
        let over_w = [0, 1, 2].map(|i| weights[i] / f64::from(self.w[i]));
        over_w.map(|share| share / over_w.iter().sum::<f64>())
    }

    /// The fragments of the scalar form, then those of the form in lanes.
    fn fragments(&self) -> Vec<([f64; 2], Vec4)> {
        let mut fragments = seen(self);
        fragments.extend(seen(&self.in_lanes()));
        fragments
    }
}

fn point() -> impl Strategy<Value = GridPoint> {
    [-10 * 256..(SIDE + 10) * 256, -10 * 256..(SIDE + 10) * 256]
}

/// Ratios of w up to a million.
fn w() -> impl Strategy<Value = f32> {
    prop_oneof![0.5_f32..4.0, (0..7_i32).prop_map(|e| elementary::pow(10.0, f64::from(e - 3)) as f32)]
}

fn probe() -> impl Strategy<Value = Probe> {
    let value = -100.0_f32..100.0;
    let points = prop_oneof![3 => [point(), point(), point()], 1 => sliver()];
    (points, [w(), w(), w()], [value.clone(), value.clone(), value]).prop_map(|(points, w, values)| Probe {
        points,
        w,
        values,
    })
}

/// What one rounding to f32 is off by at most, relative.
const UNIT: f64 = 1.0 / (1 << 24) as f64;

/// What a corner's share is off by at most, relative, since nothing is subtracted:
/// one rounding each for the edge function, for 1/w and for their product; one more
/// in each of two sums; one in the reciprocal of the sum and one in the product
/// with it: 3 and 3 + 2 + 1 + 1. The half is for products of errors.
const ROUNDED: f64 = 10.5 * UNIT;

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn values_are_perspective_correct(probe in probe()) {
        let largest = probe.values.iter().fold(0.0, |a: f64, &v| a.max(f64::from(v).abs()));
        for (at, color) in probe.fragments() {
            let (value, inverse_w) = probe.expected(at);
            // Each share is within ROUNDED; then come a product and two sums.
            let bound = largest * (ROUNDED + 3.0 * UNIT);
            let error = f64::from(color.x) - value;
            prop_assert!(error.abs() <= bound, "{} instead of {value} at {at:?}", color.x);
            // Five roundings in the sum of the shares, that of the area, and two in
            // the product and the quotient.
            let error = f64::from(color.w) / inverse_w - 1.0;
            prop_assert!(error.abs() <= 8.5 * UNIT, "1/w is off by {error}");
        }
    }

    /// A value that is 1 at one corner and 0 at the others is that corner's share.
    #[test]
    fn values_are_convex_combinations(probe in probe()) {
        let of = |values| probe.with_values(values).fragments();
        let drawn = [of([1.0, 0.0, 0.0]), of([0.0, 1.0, 0.0]), of([0.0, 0.0, 1.0])];
        for (fragment, &(at, _)) in drawn[0].iter().enumerate() {
            let shares = drawn.each_ref().map(|fragments| f64::from(fragments[fragment].1.x));
            for (share, expected) in shares.into_iter().zip(probe.shares(at)) {
                let error = (share - expected).abs();
                prop_assert!(error <= ROUNDED * expected, "{share} instead of {expected} at {at:?}");
            }
            let excess = shares.iter().sum::<f64>() - 1.0;
            prop_assert!(excess.abs() <= ROUNDED, "the shares at {at:?} sum to 1 + {excess}");
        }
    }

    #[test]
    fn values_stay_within_the_corners(probe in probe(), other in 0..4_usize) {
        // Two corners alike, so that most values are at an end of the range.
        let alike = |i: usize| other < 3 && i != other;
        let [first, second, _] = probe.values;
        let values = [0, 1, 2].map(|i| if alike(i) { first } else if other < 3 { second } else { probe.values[i] });
        let probe = probe.with_values(values);
        let low = probe.values.iter().copied().fold(f32::INFINITY, f32::min);
        let high = probe.values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        for (at, color) in probe.fragments() {
            prop_assert!(low <= color.x && color.x <= high, "{} at {at:?}", color.x);
        }
    }

    #[test]
    fn a_constant_stays_exactly_that(probe in probe(), value in -1e6_f32..1e6) {
        let probe = probe.with_values([value; 3]);
        for (_, color) in probe.fragments() {
            prop_assert_eq!(color.truncate().to_array(), [value, 0.0, 0.0]);
        }
    }

    /// By the quotient rule, where `s` are the steps of the shares that have no common sum
    /// yet and S is theirs.
    ///
    /// A share's step is off by 3 roundings and S by 5 of the sum of their sizes. With the
    /// share's own 10.5, products, the difference and the reciprocal, a corner's slope is
    /// off by 28 roundings of the larger of `|s|` and of that sum times the share. Two of them
    /// times differences of values are summed: 56 of both together.
    #[test]
    fn derivatives_are_those_of_the_quotient_rule(probe in probe()) {
        let values = probe.values.map(f64::from);
        let spread = values.iter().fold(0.0, |most: f64, value| most.max((value - values[0]).abs()));
        let steps = probe.share_steps();
        for (at, color) in probe.fragments() {
            let (value, inverse_w) = probe.expected(at);
            for (got, steps) in [color.y, color.z].into_iter().zip(&steps) {
                let expected = (0..3).map(|i| steps[i] * (values[i] - value)).sum::<f64>() / inverse_w;
                let size = steps.iter().map(|step| step.abs()).sum::<f64>() / inverse_w;
                let error = (f64::from(got) - expected).abs();
                prop_assert!(error <= 56.0 * UNIT * spread * size, "{got} instead of {expected} at {at:?}");
            }
        }
    }
}
