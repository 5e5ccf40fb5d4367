//! Varyings against perspective interpolation in f64. Hard cases 21 to 23.

use crate::coverage_support::{Raw, SIDE, draw, pixel};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::{Vec4, elementary};
use trigon_raster::{Culling, Draw, Fragment, Pass, Pipeline, VertexOutput};

/// A triangle with a value at each corner; a fragment shows the value and its
/// derivatives.
#[derive(Debug)]
struct Probe {
    points: [Raw; 3],
    w: [f32; 3],
    values: [f32; 3],
}

impl Pipeline for Probe {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        let w = self.w[index];
        let unit = f64::from(SIDE * 128);
        let [x, y] = self.points[index].map(f64::from);
        let at = |ndc: f64| (ndc * f64::from(w)) as f32;
        let position = Vec4::new(at(x / unit - 1.0), at(1.0 - y / unit), 0.5 * w, w);
        VertexOutput { position, varyings: self.values[index] }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        Vec4::new(fragment.varyings, fragment.ddx, fragment.ddy, fragment.inverse_w)
    }
}

impl Probe {
    /// The shares of the corners at a point of the screen, in pixels.
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

    /// The fragments' colours with the centres of their pixels.
    fn fragments(&self) -> Vec<([f64; 2], Vec4)> {
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(self, &[[0, 1, 2]]) });
        let pictures = draw(&pass);
        let ids = pictures.triangles.expect("asked for");
        let seen = pictures.linear.expect("asked for").into_iter().enumerate().filter(|(i, _)| ids[*i] == 0);
        seen.map(|(index, color)| (pixel(index).map(|v| f64::from(v) + 0.5), color)).collect()
    }
}

fn point() -> impl Strategy<Value = Raw> {
    [-10 * 256..(SIDE + 10) * 256, -10 * 256..(SIDE + 10) * 256]
}

/// Ratios of w up to a million.
fn w() -> impl Strategy<Value = f32> {
    prop_oneof![0.5_f32..4.0, (0..7_i32).prop_map(|e| elementary::pow(10.0, f64::from(e - 3)) as f32)]
}

fn probe() -> impl Strategy<Value = Probe> {
    let value = -100.0_f32..100.0;
    ([point(), point(), point()], [w(), w(), w()], [value.clone(), value.clone(), value])
        .prop_map(|(points, w, values)| Probe { points, w, values })
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn values_are_perspective_correct(probe in probe()) {
        let largest = probe.values.iter().fold(0.0, |a: f64, &v| a.max(f64::from(v).abs()));
        for (at, color) in probe.fragments() {
            let (value, inverse_w) = probe.expected(at);
            // Six roundings on the way to each share, three for the sum, and
            // nothing cancels before the values do.
            let bound = largest * 12.0 * f64::from(f32::EPSILON);
            let error = f64::from(color.x) - value;
            prop_assert!(error.abs() <= bound, "{} instead of {value} at {at:?}", color.x);
            let error = f64::from(color.w) / inverse_w - 1.0;
            prop_assert!(error.abs() < 8.0 * f64::from(f32::EPSILON), "1/w is off by {error}");
        }
    }

    #[test]
    fn values_stay_within_the_corners(probe in probe()) {
        let low = probe.values.iter().copied().fold(f32::INFINITY, f32::min);
        let high = probe.values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        for (at, color) in probe.fragments() {
            prop_assert!(low <= color.x && color.x <= high, "{} at {at:?}", color.x);
        }
    }

    #[test]
    fn a_constant_stays_exactly_that(probe in probe(), value in -1e6_f32..1e6) {
        let probe = Probe { values: [value; 3], ..probe };
        for (_, color) in probe.fragments() {
            prop_assert_eq!(color.truncate().to_array(), [value, 0.0, 0.0]);
        }
    }

    #[test]
    fn derivatives_meet_finite_differences(probe in probe()) {
        let area = {
            let [a, b, c] = probe.points.map(|p| p.map(i64::from));
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        // Slivers have derivatives that no difference quotient resolves.
        prop_assume!(area > 200 * 65536);
        prop_assume!(probe.w.iter().all(|w| (0.1..10.0).contains(w)));
        for (at, color) in probe.fragments() {
            let step = 1e-4;
            let difference = |dx: f64, dy: f64| {
                let value = |sign: f64| probe.expected([at[0] + sign * dx, at[1] + sign * dy]).0;
                (value(1.0) - value(-1.0)) / (2.0 * step)
            };
            for (got, expected) in [(color.y, difference(step, 0.0)), (color.z, difference(0.0, step))] {
                let error = (f64::from(got) - expected).abs();
                prop_assert!(error < 1e-3 + 1e-4 * expected.abs(), "{got} instead of {expected} at {at:?}");
            }
        }
    }
}
