//! The triangles of eight pixels: their edge functions at any points, and the raw weights of their
//! corners.
//!
//! These edge functions have no bias and are not divided by 256, unlike those of the same name in `tile`: they are
//! zero on the edge. The values are exact as integers, and then rounded once to f32.
//!
//! Edge functions of small triangles are computed from products of 16-bit numbers. A lane of 32 bits holds two numbers of 16, x in the low half and y in the high one. An edge
//! function through the first vertex is the dot product of the steps (right, down) with the offset
//! from that vertex, which is one instruction for eight lanes.

use super::columns::Columns;
use super::layout::{CutColumns, cold, hot};
use crate::primitive::owns_boundary;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, U32, inlined, prelude::*};
use fearless_simd::i16x16;

/// The triangle of each lane, from its record: what all its points have in common.
pub(crate) struct TriangleLanes<'c, S: Simd> {
    small: SmallTriangles<S>,
    /// Steps of the edge functions opposite vertices 1 and 2, both through
    /// vertex 0.
    pub(crate) right: [I32<S>; 2],
    pub(crate) down: [I32<S>; 2],
    /// Replaces `small` if one of the triangles is wide or cut.
    wide: Option<WideTriangles<'c, S>>,
    /// 1/w of the vertices, divided by the largest power of two not above the greatest of them.
    q: [F32<S>; 3],
    cut: Option<&'c CutColumns>,
}

/// The numbers that for wide triangles may not fit 16 bits, or 32.
struct WideTriangles<'c, S: Simd> {
    /// The first of the sorted vertices, from the tile's corner.
    point: [I32<S>; 2],
    /// Twice the areas.
    areas: &'c [f64; LANES],
}

impl<'c, S: Simd> TriangleLanes<'c, S> {
    /// Loads the columns of records.
    ///
    /// A lane's result does not depend on whether others are wide or cut. With and without `wide`, edge
    /// functions are exact integers before they are rounded to f32. With `cut`, the weights at the
    /// vertices of a triangle that is not cut are 1 and 0, and a · 1 + b · 0 + c · 0 = a.
    #[inline(always)]
    pub(crate) fn load(simd: S, columns: &'c Columns) -> Self {
        let column = inlined(
            #[inline(always)]
            |column: usize| I32::simd_from(simd, columns.hot()[column]),
        );
        let low = inlined(
            #[inline(always)]
            |both: I32<S>| (both << 16) >> 16,
        );
        let steps = [column(hot::STEPS), column(hot::STEPS + 1)];
        let small = Self {
            small: SmallTriangles { point: column(hot::POINT), steps },
            right: [low(steps[0]), low(steps[1])],
            down: [steps[0] >> 16, steps[1] >> 16],
            wide: None,
            q: [0, 1, 2].each(
                #[inline(always)]
                |vertex| column(hot::Q + vertex).bitcast(),
            ),
            cut: None,
        };
        let Some(special) = columns.special() else { return small };
        let column = inlined(
            #[inline(always)]
            |column: usize| I32::simd_from(simd, special.cold[column]),
        );
        let point = [column(cold::POINT), column(cold::POINT + 1)];
        Self {
            right: [column(cold::RIGHT), column(cold::RIGHT + 1)],
            down: [column(cold::DOWN), column(cold::DOWN + 1)],
            wide: Some(WideTriangles { point, areas: &special.areas }),
            cut: special.cut(),
            ..small
        }
    }

    /// Which of the points lie in their triangles, by the top-left rule.
    #[inline(always)]
    pub(crate) fn covers(&self, simd: S, point: [I32<S>; 2]) -> Mask<S> {
        let (b, c) = ([self.right[0], self.down[0]], [self.right[1], self.down[1]]);
        let owned = [[-(b[0] + c[0]), -(b[1] + c[1])], b, c].each(
            #[inline(always)]
            |[right, down]: [I32<S>; 2]| owns_boundary(right, down),
        );
        if self.wide.is_some() {
            let (edges, _) = self.edges(simd, point);
            return is_inside(edges[0], owned[0])
                & is_inside(edges[1], owned[1])
                & is_inside(edges[2], owned[2]);
        }
        let ([a, b, c], _) = self.small.edges(point);
        // One less where the edge itself is not inside: then the signs decide.
        let [i, j, k] = owned.each(
            #[inline(always)]
            |owned| owned.select(I32::splat(simd, 0), I32::splat(simd, -1)),
        );
        ((a + i) | (b + j) | (c + k)).simd_ge(I32::splat(simd, 0))
    }

    /// The edge functions and twice the area, each exact up to one rounding to f32.
    #[inline(always)]
    pub(crate) fn edges(&self, simd: S, point: [I32<S>; 2]) -> ([F32<S>; 3], F32<S>) {
        let Some(WideTriangles { point: vertex, areas }) = self.wide else {
            let (edges, area) = self.small.edges(point);
            return (edges.each(SimdCvt::to_f32), area.to_f32());
        };
        let [dx, dy]: [[i32; LANES]; 2] = [(point[0] - vertex[0]).into(), (point[1] - vertex[1]).into()];
        let mut edges = [[0.0_f32; LANES]; 3];
        let right: [[i32; LANES]; 2] = self.right.each(Into::into);
        let down: [[i32; LANES]; 2] = self.down.each(Into::into);
        for lane in 0..LANES {
            // Whole numbers below 2^53: exact.
            let (x, y) = (f64::from(dx[lane]), f64::from(dy[lane]));
            let b = f64::from(right[0][lane]) * x + f64::from(down[0][lane]) * y;
            let c = f64::from(right[1][lane]) * x + f64::from(down[1][lane]) * y;
            edges[0][lane] = (areas[lane] - b - c) as f32;
            edges[1][lane] = b as f32;
            edges[2][lane] = c as f32;
        }
        let area = areas.each(
            #[inline(always)]
            |area| area as f32,
        );
        let edges = edges.each(
            #[inline(always)]
            |edge| F32::simd_from(simd, edge),
        );
        (edges, F32::simd_from(simd, area))
    }

    /// The raw weights of the corners for values of the edge functions: perspective-correct weights
    /// before they are divided by their sum.
    #[inline(always)]
    pub(crate) fn raw_weights(&self, edges: [F32<S>; 3]) -> [F32<S>; 3] {
        let [a, b, c] = [edges[0] * self.q[0], edges[1] * self.q[1], edges[2] * self.q[2]];
        match &self.cut {
            None => [a, b, c],
            Some(cut) => [0, 1, 2].each(
                #[inline(always)]
                |k| {
                    let [m, n, o] = cut.each_ref().each(
                        #[inline(always)]
                        |vertex| F32::simd_from(a.token(), vertex[k]),
                    );
                    a * m + b * n + c * o
                },
            ),
        }
    }

    /// The steps of the raw weights for 1/256 pixel.
    #[inline(always)]
    pub(crate) fn raw_weight_steps(&self, steps: [I32<S>; 2]) -> [F32<S>; 3] {
        let [b, c] = steps;
        self.raw_weights([-(b + c), b, c].each(SimdCvt::to_f32))
    }
}

/// In which lanes a point is inside an edge, given the edge function there and whether points on the
/// edge belong to the triangle. Rounding keeps the sign, and whether it is zero.
#[inline(always)]
fn is_inside<S: Simd>(edge: F32<S>, owned: Mask<S>) -> Mask<S> {
    let zero = F32::splat(edge.token(), 0.0);
    edge.simd_gt(zero) | (edge.simd_eq(zero) & owned)
}

/// Conversion that rounds to nearest, named so that it can be passed on.
trait SimdCvt<S: Simd> {
    fn to_f32(self) -> F32<S>;
}

impl<S: Simd> SimdCvt<S> for I32<S> {
    #[inline(always)]
    fn to_f32(self) -> F32<S> {
        self.to_float()
    }
}

/// Triangles whose sides and whose distances from points of the tile fit 16 bits: two
/// numbers to a lane, x in the low half, y in the high one.
pub(crate) struct SmallTriangles<S: Simd> {
    /// The first of the sorted vertices, from the tile's corner.
    pub(crate) point: I32<S>,
    /// Steps of the edge functions opposite vertices 1 and 2.
    pub(crate) steps: [I32<S>; 2],
}

impl<S: Simd> SmallTriangles<S> {
    /// The edge functions and twice the area.
    #[inline(always)]
    pub(crate) fn edges(&self, [x, y]: [I32<S>; 2]) -> ([I32<S>; 3], I32<S>) {
        let [first, second] = self.steps;
        let offset = pairs(x | (y << 16)) - pairs(self.point);
        let [b, c] = [first, second].each(
            #[inline(always)]
            |steps| pairs(steps).pairwise_dot_product(offset),
        );
        // Twice the area is the edge function opposite vertex 1, evaluated at vertex 1. The offset from
        // vertex 0 to vertex 1 is perpendicular to the steps of the other edge: (down, -right), or
        // its negative if the steps were negated to make the triangle positive inside. Hence `abs`.
        let across = (second.bitcast::<U32<S>>() >> 16).bitcast::<I32<S>>() | (-second << 16);
        let area = pairs(first).pairwise_dot_product(pairs(across)).abs();
        // The three edge functions add up to twice the area everywhere, so `area - b - c` is the third.
        // All three are below 2^30 and `area` is below 2^28, so nothing overflows.
        ([area - b - c, b, c], area)
    }
}

/// Each lane as two numbers.
#[inline(always)]
fn pairs<S: Simd>(both: I32<S>) -> i16x16<S> {
    both.bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::SMALL;
    use crate::simd::{SimdLevel, at_level};
    use proptest::prelude::*;

    /// Less than a small triangle's side, often as near to it as can be.
    fn side() -> impl Strategy<Value = i32> {
        prop_oneof![-SMALL + 1..SMALL, Just(-SMALL + 1), Just(SMALL - 1)]
    }

    /// Within a tile of 64 pixels, often at its ends.
    fn within() -> impl Strategy<Value = i32> {
        prop_oneof![0..64 * 256, Just(0), Just(64 * 256 - 1)]
    }

    proptest! {
        /// Of triangles that reach into the tile, at any of its points.
        #[test]
        fn products_of_16_bits_are_exact(
            steps in [[side(), side()], [side(), side()]],
            reached in [within(), within()],
            offset in [side(), side()],
            point in [within(), within()],
        ) {
            let vertex = [reached[0] + offset[0], reached[1] + offset[1]];
            let product = |a: [i32; 2], b: [i32; 2]| {
                i64::from(a[0]) * i64::from(b[0]) + i64::from(a[1]) * i64::from(b[1])
            };
            let to_point = [point[0] - vertex[0], point[1] - vertex[1]];
            let [b, c] = steps.map(|steps| product(steps, to_point));
            let area = product(steps[0], [steps[1][1], -steps[1][0]]).abs();
            // What is added up has to fit, too.
            prop_assume!(i32::try_from(area - b - c).is_ok());
            let packed = |[x, y]: [i32; 2]| (x & 0xffff) | y << 16;
            for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                let found = at_level!(token, simd => {
                    let small = SmallTriangles {
                        point: I32::splat(simd, packed(vertex)),
                        steps: steps.map(|steps| I32::splat(simd, packed(steps))),
                    };
                    let (edges, area) = small.edges(point.map(|v| I32::splat(simd, v)));
                    [edges[0][0], edges[1][0], edges[2][0], area[0]]
                });
                prop_assert_eq!(found.map(i64::from), [area - b - c, b, c, area], "{:?}", token);
            }
        }
    }
}
