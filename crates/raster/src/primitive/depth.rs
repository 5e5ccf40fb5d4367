//! The depth of a triangle at any point of the sub-pixel grid.

use super::triangle::SetupTriangle;
use crate::simd::{F32, InlineMap, Simd, greater, lesser, prelude::*};
use crate::vertex::ScreenVertex;
use fearless_simd::f64x4;

/// A plane through the vertices, anchored at the first of them and clamped to the
/// range of their depths. A greater depth is nearer.
///
/// In f64, so that rounding before the conversion to f32 hardly matters: with Δz the range
/// of the depths, X and Y the triangle's extents and A its area, a value lies
/// within `2^-50 · Δz · XY/A` of the exact plane, and an eighth of that and two
/// roundings of f64 for the sums, before it is rounded to f32.
/// Depths never leave the range, which also bounds the error of very thin triangles with a greater
/// XY/A, and equal depths are exactly constant. With reversed depth and an
/// infinite far plane the relative precision of f32 is kept at all distances.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DepthPlane {
    pub(crate) anchor: [i32; 2],
    pub(crate) value: f64,
    /// Steps for 1/256 pixel.
    pub(crate) right: f64,
    pub(crate) down: f64,
    /// The least and the greatest depth of the vertices.
    pub(crate) low: f32,
    pub(crate) high: f32,
}

impl DepthPlane {
    #[inline]
    pub(crate) fn of(triangle: &SetupTriangle) -> Self {
        Self::through(triangle.vertices)
    }

    /// Through vertices in their order.
    #[inline(always)]
    pub(crate) fn through(vertices: [ScreenVertex; 3]) -> Self {
        let [a, b, c] = vertices.each(ScreenVertex::raw);
        let [za, zb, zc] = vertices.each(ScreenVertex::depth);
        let low = |a: f32, b: f32| if b < a { b } else { a };
        let high = |a: f32, b: f32| if b > a { b } else { a };
        let step = |from: i32, to: i32| f64::from(to - from);
        let [right, down] = slopes(
            [step(a[0], b[0]), step(a[1], b[1])],
            [step(a[0], c[0]), step(a[1], c[1])],
            [f64::from(zb) - f64::from(za), f64::from(zc) - f64::from(za)],
        );
        Self {
            anchor: a,
            value: f64::from(za),
            right,
            down,
            low: low(low(za, zb), zc),
            high: high(high(za, zb), zc),
        }
    }

    /// The depth at a point in 1/256 pixel.
    #[inline]
    pub(crate) fn at(&self, [x, y]: [i32; 2]) -> f32 {
        let depth = self.unclamped([x, y]) as f32;
        let depth = if depth > self.low { depth } else { self.low };
        if depth < self.high { depth } else { self.high }
    }

    #[inline(always)]
    fn unclamped(&self, [x, y]: [i32; 2]) -> f64 {
        let down = self.value + self.down * f64::from(y - self.anchor[1]);
        down + self.right * f64::from(x - self.anchor[0])
    }

    /// The depths at a group of pixels, 4 by 2, whose first point is given.
    #[inline(always)]
    pub(crate) fn group<S: Simd>(&self, simd: S, [x, y]: [i32; 2]) -> F32<S> {
        let row = |y: i32| self.value + self.down * f64::from(y - self.anchor[1]);
        let columns = f64x4::simd_from(simd, [0.0, 256.0, 512.0, 768.0]);
        let columns = f64x4::splat(simd, f64::from(x - self.anchor[0])) + columns;
        let steps = f64x4::splat(simd, self.right) * columns;
        let [upper, lower] = [row(y), row(y + 256)];
        let depth = simd.narrow_f64x4(f64x4::splat(simd, upper) + steps, f64x4::splat(simd, lower) + steps);
        lesser(greater(depth, F32::splat(simd, self.low)), F32::splat(simd, self.high))
    }

    /// Bounds of the depths in a rectangle of points, ends included.
    #[inline]
    pub(crate) fn bounds(&self, low: [i32; 2], high: [i32; 2]) -> [f32; 2] {
        if self.low == self.high {
            return [self.low, self.high];
        }
        let end = |rising: bool, axis: usize| if rising { high[axis] } else { low[axis] };
        let (right, down) = (self.right > 0.0, self.down > 0.0);
        let least = self.at([end(!right, 0), end(!down, 1)]);
        let greatest = self.at([end(right, 0), end(down, 1)]);
        // Nothing is rounded beyond them: no rounding changes the order of two values.
        [least, greatest]
    }
}

/// The plane's steps from two sides of the triangle and the depths along them.
#[inline(always)]
pub(crate) fn slopes(u: [f64; 2], v: [f64; 2], z: [f64; 2]) -> [f64; 2] {
    let inverse = 1.0 / (u[0] * v[1] - u[1] * v[0]);
    [(z[0] * v[1] - z[1] * u[1]) * inverse, (z[1] * u[0] - z[0] * v[0]) * inverse]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{SimdLevel, at_level};
    use proptest::prelude::*;

    fn triangle() -> impl Strategy<Value = SetupTriangle> {
        let point = [-20_000..20_000_i32, -20_000..20_000_i32];
        let corner = (point, 0.0_f32..1.0);
        [corner.clone(), corner.clone(), corner].prop_map(|corners| {
            let mut triangle = SetupTriangle::on_grid(corners.map(|(point, _)| point));
            for (vertex, (_, depth)) in triangle.vertices.iter_mut().zip(corners) {
                *vertex = vertex.with_depth(depth);
            }
            triangle
        })
    }

    proptest! {
        #[test]
        fn a_group_agrees_with_single_points(triangle in triangle(), at in [-9000..9000_i32, -9000..9000_i32]) {
            prop_assume!(triangle.doubled_area() != 0);
            let plane = DepthPlane::of(&triangle);
            for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                let depths: [f32; 8] = at_level!(token, simd => plane.group(simd, at).into());
                for (lane, depth) in depths.into_iter().enumerate() {
                    let (dx, dy) = (lane as i32 % 4, lane as i32 / 4);
                    let point = [at[0] + dx * 256, at[1] + dy * 256];
                    prop_assert_eq!(depth.to_bits(), plane.at(point).to_bits(), "lane {}", lane);
                    let [least, greatest] = plane.bounds(at, [at[0] + 768, at[1] + 256]);
                    prop_assert!(least <= depth && depth <= greatest, "within the bounds");
                }
            }
        }
    }
}
