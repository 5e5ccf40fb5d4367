//! Functions that are linear across the screen: on which side of an edge a point of the sub-pixel grid lies, exactly,
//! and the depth of a triangle at any point.
//!
//! Edge functions are those of J. Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988, in integers.

use super::quad::Quad;
use super::triangle::SetupTriangle;
use crate::simd::{F32, I32, InlineMap, Mask, Simd, greater, lesser, prelude::*};
use crate::vertex::ScreenVertex;
use fearless_simd::f64x4;

/// The edge opposite one vertex as a linear function of a point in 1/256 pixel:
/// zero on the edge, twice the triangle's area at the vertex, positive inside.
///
/// All in units of the grid squared. With coordinates within ±2^24 (the guard
/// band) and the widest lines no value exceeds 2^53.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Edge {
    /// At (0, 0).
    pub(crate) origin: i64,
    /// The step of one unit to the right.
    pub(crate) right: i32,
    /// The step of one unit downwards.
    pub(crate) down: i32,
}

impl Edge {
    /// The edges opposite the three vertices.
    #[inline]
    pub(crate) fn of(triangle: &SetupTriangle) -> [Self; 3] {
        let [a, b, c] = triangle.vertices.map(ScreenVertex::raw);
        let edges = [Self::through(b, c), Self::through(c, a), Self::through(a, b)];
        if triangle.doubled_area() < 0 { edges.map(Self::reversed) } else { edges }
    }

    /// The two sides of a line or a point along it, positive inside.
    #[inline]
    pub(crate) fn sides(quad: &Quad) -> [Self; 2] {
        let [near, far, ..] = Self::around(quad);
        [near, far]
    }

    /// The edges of a line or a point, positive inside: its two sides along it, its two ends;
    /// and the diagonal between its triangles, positive in the first of them.
    #[inline]
    pub(crate) fn around(quad: &Quad) -> [Self; 5] {
        // Once around: a, b, c, d. The triangles are a, b, c and a, c, d.
        let [[a, b], [d, c]] = quad.corners;
        let [ab, ac] = [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]];
        let area = i64::from(ab[0]) * i64::from(ac[1]) - i64::from(ab[1]) * i64::from(ac[0]);
        let edges = [
            Self::through(d, a),
            Self::through(b, c),
            Self::through(a, b),
            Self::through(c, d),
            Self::through(c, a),
        ];
        if area < 0 { edges.map(Self::reversed) } else { edges }
    }

    #[inline]
    fn through(from: [i32; 2], to: [i32; 2]) -> Self {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let origin = i64::from(y) * i64::from(from[0]) - i64::from(x) * i64::from(from[1]);
        Self { origin, right: -y, down: x }
    }

    #[inline]
    fn reversed(self) -> Self {
        Self { origin: -self.origin, right: -self.right, down: -self.down }
    }

    /// The value at a point.
    #[inline]
    pub(crate) fn at(&self, [x, y]: [i32; 2]) -> i64 {
        self.origin + i64::from(self.right) * i64::from(x) + i64::from(self.down) * i64::from(y)
    }

    /// What is added to the value so that "not negative" means inside, by the top-left rule: 0 if
    /// points exactly on the edge belong to the triangle, else -1.
    ///
    /// They belong to it on a left edge (the value grows to the right) and on a top edge
    /// (horizontal, the triangle below). The triangle on the other side of the same edge has
    /// both steps negated, so exactly one of the two owns the edge.
    ///
    /// [`owns_boundary`] is the same rule in lanes.
    #[inline]
    pub(crate) fn bias(&self) -> i64 {
        let inclusive = self.right > 0 || (self.right == 0 && self.down > 0);
        if inclusive { 0 } else { -1 }
    }

    /// The least and the greatest value in a rectangle, ends included.
    #[inline]
    pub(crate) fn range(&self, low: [i32; 2], high: [i32; 2]) -> [i64; 2] {
        let span = |step: i32, axis: usize| {
            let far = i64::from(step) * i64::from(high[axis] - low[axis]);
            if far < 0 { [far, 0] } else { [0, far] }
        };
        let (x, y) = (span(self.right, 0), span(self.down, 1));
        let value = self.at(low);
        [value + x[0] + y[0], value + x[1] + y[1]]
    }
}

/// The top-left rule of [`Edge::bias`] in lanes: whether points exactly on an edge with these steps to
/// the right and downwards belong to the triangle.
#[inline(always)]
pub(crate) fn owns_boundary<S: Simd>(right: I32<S>, down: I32<S>) -> Mask<S> {
    let zero = I32::splat(right.token(), 0);
    right.simd_gt(zero) | (right.simd_eq(zero) & down.simd_gt(zero))
}

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

    /// A triangle at whole pixels.
    fn triangle(points: [(i32, i32); 3]) -> SetupTriangle {
        SetupTriangle::on_grid(points.map(|(x, y)| [x * 256, y * 256]))
    }

    #[test]
    fn values_add_up_to_the_area() {
        for points in [[(0, 0), (8, 1), (2, 9)], [(0, 0), (2, 9), (8, 1)]] {
            let triangle = triangle(points);
            let edges = Edge::of(&triangle);
            for point in [[128, 128], [900, 896], [-13_000, 1000]] {
                let sum: i64 = edges.iter().map(|edge| edge.at(point)).sum();
                assert_eq!(sum, triangle.doubled_area().abs(), "at {point:?}");
            }
            assert!(edges.iter().all(|edge| edge.at([900, 900]) > 0), "positive inside");
        }
    }

    #[test]
    fn range_bounds_every_point() {
        for edge in Edge::of(&triangle([(0, 0), (8, 1), (2, 9)])) {
            let values: Vec<i64> = (0..64).map(|i| edge.at([5 + i % 8, 2 + i / 8])).collect();
            let range = edge.range([5, 2], [12, 9]);
            assert_eq!(range[0], *values.iter().min().unwrap(), "the least");
            assert_eq!(range[1], *values.iter().max().unwrap(), "the greatest");
        }
    }

    fn any_triangle() -> impl Strategy<Value = SetupTriangle> {
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
        fn a_group_agrees_with_single_points(triangle in any_triangle(), at in [-9000..9000_i32, -9000..9000_i32]) {
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
