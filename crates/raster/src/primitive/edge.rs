//! Edge functions: on which side of an edge a point lies, exactly.
//!
//! After J. Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988, in
//! integers on the sub-pixel grid.

use super::quad::Quad;
use super::triangle::SetupTriangle;
use crate::simd::{I32, Mask, Simd, prelude::*};
use crate::vertex::ScreenVertex;

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
