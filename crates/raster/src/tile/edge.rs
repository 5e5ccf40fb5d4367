//! Edge functions: on which side of an edge a sample lies, exactly.
//!
//! After J. Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988, in
//! integers on the sub-sample grid.

use crate::setup::SetupTriangle;
use trigon_math::FixedPoint;

/// The edge opposite one vertex as a linear function of the sample: zero on the
/// edge, twice the triangle's area at the vertex, positive inside.
///
/// All in units of the grid squared. With coordinates within ±2^24 (the guard
/// band) and the
/// widest lines no value exceeds 2^53.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// At the centre of sample (0, 0).
    pub(crate) origin: i64,
    /// The step from one sample to the next to the right, over 256.
    pub(crate) right: i32,
    /// The step downwards, over 256.
    pub(crate) down: i32,
}

impl Edge {
    /// The edges opposite the three vertices.
    #[inline]
    pub(crate) fn of(triangle: &SetupTriangle) -> [Self; 3] {
        let [a, b, c] = triangle.vertices.map(|v| v.point);
        let edges = [Self::through(b, c), Self::through(c, a), Self::through(a, b)];
        if triangle.doubled_area() < 0 { edges.map(Self::reversed) } else { edges }
    }

    #[inline]
    fn through(from: FixedPoint, to: FixedPoint) -> Self {
        let (x, y) = (to.x.raw() - from.x.raw(), to.y.raw() - from.y.raw());
        let sample = |raw: i32| i64::from(128 - raw);
        let origin = i64::from(x) * sample(from.y.raw()) - i64::from(y) * sample(from.x.raw());
        Self { origin, right: -y, down: x }
    }

    #[inline]
    fn reversed(self) -> Self {
        Self { origin: -self.origin, right: -self.right, down: -self.down }
    }

    /// The value at a sample.
    #[inline]
    pub(crate) fn at(&self, [x, y]: [i32; 2]) -> i64 {
        let steps = i64::from(self.right) * i64::from(x) + i64::from(self.down) * i64::from(y);
        self.origin + steps * 256
    }

    /// -1 if samples exactly on the edge are outside, 0 if they belong to the
    /// triangle: those on a left edge, and those on a top edge (horizontal, the
    /// triangle below it). So of two triangles on both sides of an edge exactly
    /// one has it.
    #[inline]
    pub(crate) fn bias(&self) -> i64 {
        let inclusive = self.right > 0 || (self.right == 0 && self.down > 0);
        if inclusive { 0 } else { -1 }
    }

    /// The least and the greatest value in a square of `size` samples whose
    /// first is at `corner`.
    #[inline]
    pub(crate) fn range(&self, corner: [i32; 2], size: u32) -> [i64; 2] {
        let reach = i64::from(size - 1) * 256;
        let span = |step: i32| {
            let far = i64::from(step) * reach;
            if far < 0 { [far, 0] } else { [0, far] }
        };
        let (x, y) = (span(self.right), span(self.down));
        let value = self.at(corner);
        [value + x[0] + y[0], value + x[1] + y[1]]
    }
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
            for sample in [[0, 0], [3, 3], [-50, 7]] {
                let sum: i64 = edges.iter().map(|edge| edge.at(sample)).sum();
                assert_eq!(sum, triangle.doubled_area().abs(), "at {sample:?}");
            }
            assert!(edges.iter().all(|edge| edge.at([3, 3]) > 0), "positive inside");
        }
    }

    #[test]
    fn range_bounds_every_sample() {
        for edge in Edge::of(&triangle([(0, 0), (8, 1), (2, 9)])) {
            let values: Vec<i64> = (0..64).map(|i| edge.at([5 + i % 8, 2 + i / 8])).collect();
            let range = edge.range([5, 2], 8);
            assert_eq!(range[0], *values.iter().min().unwrap(), "the least");
            assert_eq!(range[1], *values.iter().max().unwrap(), "the greatest");
        }
    }
}
