//! Perspective-correct weights of triangles' corners at eight points, and their
//! derivatives.
//!
//! With `E_i` the edge functions (exact, not negative within the triangle) and
//! `q_i` the vertices' 1/w, the corners' shares are `L_k = Σ_i m_ik q_i E_i`,
//! where `m` says how vertices come from corners (the identity unless the
//! triangle was cut). Each `L_k` is linear on the screen, the perspective weights
//! are `L_k / Σ L`, and the quotient rule gives their derivatives. (J. Blinn,
//! "Hyperbolic Interpolation", 1992; P. Heckbert and H. Moreton, "Interpolation
//! for Polygon Texture Mapping and Shading", 1991.)

use super::columns::Columns;
use super::records::{cold, hot};
use crate::simd::{Each, F32, I32, LANES, Mask, Row, Simd, U32, greater, inlined, lesser, prelude::*};
use fearless_simd::i16x16;

/// The largest ratio of w within a triangle that is told apart; beyond, a
/// vertex counts as this much further away. Keeps all quotients finite.
const RATIO_MAX: f32 = (1_u64 << 60) as f32;

/// The vertices' 1/w over a power of two near the largest, and that power of two.
#[inline(always)]
pub(super) fn perspective<S: Simd>(simd: S, inverse_w: [F32<S>; 3]) -> ([F32<S>; 3], F32<S>) {
    let scale = power_of_two(simd, greater(greater(inverse_w[0], inverse_w[1]), inverse_w[2]));
    let least = F32::splat(simd, 1.0 / RATIO_MAX);
    let inverse = F32::splat(simd, 1.0) / scale;
    let q = inverse_w.each(
        #[inline(always)]
        |q| greater(q * inverse, least),
    );
    (q, scale)
}

/// What the points of a lane's triangle have in common, as its record has it.
pub(crate) struct TriangleLanes<'c, S: Simd> {
    small: Small<S>,
    /// Steps of the edge functions opposite vertices 1 and 2, both through
    /// vertex 0.
    right: [I32<S>; 2],
    down: [I32<S>; 2],
    /// Instead of what is small where a triangle is wide or cut.
    wide: Option<Wide<'c, S>>,
    /// 1/w of the vertices over a power of two near the largest.
    q: [F32<S>; 3],
    cut: Option<&'c CutColumns>,
}

/// Triangles whose sides and whose distances from points of the tile fit 16 bits: two
/// numbers to a lane, x in the low half, y in the high one.
struct Small<S: Simd> {
    /// The first of the sorted vertices, from the tile's corner.
    point: I32<S>,
    /// Steps of the edge functions opposite vertices 1 and 2.
    steps: [I32<S>; 2],
}

/// What of wide triangles need not fit 16 bits, or 32.
struct Wide<'c, S: Simd> {
    /// The first of the sorted vertices, from the tile's corner.
    point: [I32<S>; 2],
    /// Twice the areas.
    areas: &'c [f64; LANES],
}

/// The weights of the corners at the vertices of cut triangles, in lanes:
/// `[vertex][corner]`.
pub(super) type CutColumns = [[[f32; LANES]; 3]; 3];

/// Eight points, and what takes longest to find there: found for the next eight pixels
/// before these are shaded, so that nobody waits for it.
#[derive(Clone, Default)]
#[repr(align(64))]
pub(super) struct Placed {
    /// In 1/256 pixel from the tile's corner.
    point: [Row; 2],
    /// Perspective-correct weights of the corners, and one over the sum of the corners'
    /// shares: bits of f32.
    weights: [Row; 3],
    inverse: Row,
}

impl Placed {
    #[inline(always)]
    pub(super) fn point<S: Simd>(&self, simd: S) -> [I32<S>; 2] {
        let [x, y] = self.point;
        [I32::simd_from(simd, x), I32::simd_from(simd, y)]
    }
}

/// Where eight points lie in their triangles.
pub(crate) struct Weights<S: Simd> {
    /// Perspective-correct weights of the corners.
    pub(crate) weights: [F32<S>; 3],
    /// Derivatives of the weights of corners 1 and 2, to the right and
    /// downwards, per pixel; that of corner 0 makes their sum 0.
    pub(crate) slopes: [[F32<S>; 2]; 2],
    /// The edge functions opposite the vertices, twice the area, and the sum of the
    /// corners' shares.
    edges: [F32<S>; 3],
    area: F32<S>,
    total: F32<S>,
    /// Distances in pixels to the edges opposite the corners.
    pub(crate) distances: [F32<S>; 3],
}

impl<'c, S: Simd> TriangleLanes<'c, S> {
    /// From the columns of records. That a lane is wide or cut never changes
    /// another's result.
    #[inline(always)]
    pub(super) fn load(simd: S, columns: &'c Columns) -> Self {
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
            small: Small { point: column(hot::POINT), steps },
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
            wide: Some(Wide { point, areas: &special.areas }),
            cut: special.cut(),
            ..small
        }
    }

    /// What is worth finding ahead at points in 1/256 pixel from the tile's corner.
    #[inline(always)]
    pub(super) fn place(&self, simd: S, point: [I32<S>; 2]) -> Placed {
        let (edges, _) = self.edges(simd, point);
        let shares = self.shares(edges);
        let inverse = F32::splat(simd, 1.0) / (shares[0] + shares[1] + shares[2]);
        let row = inlined(
            #[inline(always)]
            |value: F32<S>| value.bitcast::<I32<S>>().into(),
        );
        let [x, y] = point;
        let [a, b, c] = shares;
        Placed {
            point: [x.into(), y.into()],
            weights: [row(a * inverse), row(b * inverse), row(c * inverse)],
            inverse: row(inverse),
        }
    }

    /// The weights at points, and all else that may be asked of them.
    #[inline(always)]
    pub(super) fn at(&self, simd: S, placed: &Placed) -> Weights<S> {
        let point = placed.point(simd);
        let value = inlined(
            #[inline(always)]
            |row: &Row| I32::simd_from(simd, *row).bitcast::<F32<S>>(),
        );
        let [a, b, c] = &placed.weights;
        let (weights, inverse) = ([value(a), value(b), value(c)], value(&placed.inverse));
        let (edges, area) = self.edges(simd, point);
        let shares = self.shares(edges);
        let [share_x, share_y] = [self.right, self.down].each(
            #[inline(always)]
            |step| self.share_steps(step),
        );
        // A power of two, which rounds nothing wherever it is multiplied in.
        let pixel = F32::splat(simd, 256.0);
        let [right, down] = [share_x, share_y].each(
            #[inline(always)]
            |steps| slopes(steps, weights, inverse * pixel),
        );
        Weights {
            weights,
            slopes: [[right[0], down[0]], [right[1], down[1]]],
            edges,
            area,
            total: shares[0] + shares[1] + shares[2],
            distances: [0, 1, 2].each(
                #[inline(always)]
                |k| {
                    let (dx, dy) = (share_x[k] * pixel, share_y[k] * pixel);
                    shares[k] / (dx * dx + dy * dy).sqrt()
                },
            ),
        }
    }

    /// Which of the points lie in their triangles, by the top-left rule.
    #[inline(always)]
    pub(crate) fn covers(&self, simd: S, point: [I32<S>; 2]) -> Mask<S> {
        let (b, c) = ([self.right[0], self.down[0]], [self.right[1], self.down[1]]);
        let owned = [[-(b[0] + c[0]), -(b[1] + c[1])], b, c].each(
            #[inline(always)]
            |steps| inclusive(steps),
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

    /// The edge functions and the area, each rounded once.
    #[inline(always)]
    fn edges(&self, simd: S, point: [I32<S>; 2]) -> ([F32<S>; 3], F32<S>) {
        let Some(Wide { point: vertex, areas }) = self.wide else {
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

    /// The corners' shares for values of the edge functions.
    #[inline(always)]
    fn shares(&self, edges: [F32<S>; 3]) -> [F32<S>; 3] {
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

    /// What the shares change by in 1/256 pixel.
    #[inline(always)]
    fn share_steps(&self, steps: [I32<S>; 2]) -> [F32<S>; 3] {
        let [b, c] = steps;
        self.shares([-(b + c), b, c].each(SimdCvt::to_f32))
    }
}

impl<S: Simd> Small<S> {
    /// The edge functions and twice the area.
    #[inline(always)]
    fn edges(&self, [x, y]: [I32<S>; 2]) -> ([I32<S>; 3], I32<S>) {
        let [first, second] = self.steps;
        let way = pairs(x | (y << 16)) - pairs(self.point);
        let [b, c] = [first, second].each(
            #[inline(always)]
            |steps| pairs(steps).pairwise_dot_product(way),
        );
        // (down, -right)
        let across = (second.bitcast::<U32<S>>() >> 16).bitcast::<I32<S>>() | (-second << 16);
        let area = pairs(first).pairwise_dot_product(pairs(across)).abs();
        ([area - b - c, b, c], area)
    }
}

/// Each lane as two numbers.
#[inline(always)]
fn pairs<S: Simd>(both: I32<S>) -> i16x16<S> {
    both.bitcast()
}

impl<S: Simd> Weights<S> {
    /// The depth, within the range of the vertices'.
    #[inline(always)]
    pub(super) fn depth(&self, simd: S, cold: &[Row; cold::COUNT]) -> F32<S> {
        let [a, b, c]: [F32<S>; 3] = [0, 1, 2].each(
            #[inline(always)]
            |vertex| I32::simd_from(simd, cold[cold::DEPTH + vertex]).bitcast(),
        );
        let depth = (self.edges[0] * a + self.edges[1] * b + self.edges[2] * c) / self.area;
        lesser(greater(depth, lesser(lesser(a, b), c)), greater(greater(a, b), c))
    }

    /// 1/w.
    #[inline(always)]
    pub(super) fn inverse_w(&self, simd: S, cold: &[Row; cold::COUNT]) -> F32<S> {
        let scale: F32<S> = I32::simd_from(simd, cold[cold::SCALE]).bitcast();
        self.total * scale / self.area
    }
}

/// Derivatives of the weights of corners 1 and 2, by the quotient rule.
#[inline(always)]
fn slopes<S: Simd>(steps: [F32<S>; 3], weights: [F32<S>; 3], inverse: F32<S>) -> [F32<S>; 2] {
    let all = steps[0] + steps[1] + steps[2];
    [1, 2].each(
        #[inline(always)]
        |k| (steps[k] - weights[k] * all) * inverse,
    )
}

/// Which points on an edge with these steps belong to the triangle: those on
/// left edges and on top edges.
#[inline(always)]
fn inclusive<S: Simd>([right, down]: [I32<S>; 2]) -> Mask<S> {
    let zero = I32::splat(right.token(), 0);
    right.simd_gt(zero) | (right.simd_eq(zero) & down.simd_gt(zero))
}

/// Where an edge function is inside of its edge, which belongs to the triangle where it
/// is owned. Rounding keeps the sign, and whether it is zero.
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

/// The largest power of two not above a normal positive number.
#[inline(always)]
fn power_of_two<S: Simd>(simd: S, value: F32<S>) -> F32<S> {
    let bits: U32<S> = value.bitcast();
    (bits & U32::splat(simd, 0x7f80_0000)).bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::SMALL;
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
            way in [side(), side()],
            point in [within(), within()],
        ) {
            let vertex = [reached[0] + way[0], reached[1] + way[1]];
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
                    let small = Small {
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
