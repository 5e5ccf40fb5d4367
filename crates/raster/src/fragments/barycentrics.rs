//! Perspective-correct barycentric coordinates at eight points, one in each lane, and their
//! derivatives.
//!
//! Let `E_i` be the edge functions: not negative within the triangle, exact as integers, then rounded once to f32.
//! Let `q_i` be the vertices' 1/w, divided by the power of two not above the greatest, and then at least 2⁻⁶⁰ (see
//! `perspective`). The *raw weights* of the corners are `L_k = Σ_i m_ik q_i E_i`, where `m` says how vertices come
//! from corners: it is the identity unless the triangle was cut. Each `L_k` is linear on the screen, the
//! perspective-correct weights are `L_k / Σ L`, and the quotient rule gives their derivatives. `Σ L` is above 0 in
//! active lanes, where the triangle covers the point. There the `E_i` are not negative and add up to twice the
//! area, each `q_i` is above 0, and the `m_ik` of a vertex add up to 1 but for rounding.
//! [`FragmentLanes::varying`](super::FragmentLanes::varying) interpolates with these weights. (J. Blinn,
//! "Hyperbolic Interpolation", 1992; P. Heckbert and H. Moreton, "Interpolation for Polygon Texture Mapping and
//! Shading", 1991.)

use super::layout::cold;
use super::perspective::WeightedPoints;
use super::triangle_lanes::TriangleLanes;
use crate::simd::{F32, I32, InlineMap, Row, Simd, greater, inlined, lesser, prelude::*};

/// The weights of eight points in their triangles, and what follows from them.
pub(crate) struct Barycentrics<S: Simd> {
    /// Perspective-correct weights of the corners.
    pub(crate) weights: [F32<S>; 3],
    /// Derivatives of the weights of corners 1 and 2, to the right and
    /// downwards, per pixel; that of corner 0 makes their sum 0.
    pub(crate) slopes: [[F32<S>; 2]; 2],
    /// The edge functions opposite the vertices.
    edges: [F32<S>; 3],
    /// Twice the area, the sum of the edge functions.
    area: F32<S>,
    /// The sum of the raw weights.
    total: F32<S>,
    /// Distances in pixels to the edges opposite the corners.
    pub(crate) distances: [F32<S>; 3],
}

impl<S: Simd> TriangleLanes<'_, S> {
    /// The weights at points in 1/256 pixel from the tile's corner, computed ahead of shading
    /// because the division takes longest.
    #[inline(always)]
    pub(crate) fn weigh(&self, simd: S, point: [I32<S>; 2]) -> WeightedPoints {
        let (edges, _) = self.edges(simd, point);
        let raw = self.raw_weights(edges);
        // One division for all three weights.
        let inverse = F32::splat(simd, 1.0) / (raw[0] + raw[1] + raw[2]);
        let row = inlined(
            #[inline(always)]
            |value: F32<S>| value.bitcast::<I32<S>>().into(),
        );
        let [x, y] = point;
        let [a, b, c] = raw;
        WeightedPoints {
            point: [x.into(), y.into()],
            weights: [row(a * inverse), row(b * inverse), row(c * inverse)],
            inverse: row(inverse),
        }
    }

    /// The weights at points, with their derivatives and the distances to edges.
    #[inline(always)]
    pub(crate) fn at(&self, simd: S, placed: &WeightedPoints) -> Barycentrics<S> {
        let point = placed.point(simd);
        let value = inlined(
            #[inline(always)]
            |row: &Row| I32::simd_from(simd, *row).bitcast::<F32<S>>(),
        );
        let [a, b, c] = &placed.weights;
        let (weights, inverse) = ([value(a), value(b), value(c)], value(&placed.inverse));
        let (edges, area) = self.edges(simd, point);
        let raw = self.raw_weights(edges);
        // The raw weights are linear on the screen, so their steps are the same everywhere in the
        // triangle: those of the edge functions, each times its vertex's 1/w.
        let [steps_x, steps_y] = [self.right, self.down].each(
            #[inline(always)]
            |step| self.raw_weight_steps(step),
        );
        // From 1/256 pixel to pixels. Multiplying by a power of two rounds nothing.
        let pixel = F32::splat(simd, 256.0);
        let [right, down] = [steps_x, steps_y].each(
            #[inline(always)]
            |steps| slopes(steps, weights, inverse * pixel),
        );
        Barycentrics {
            weights,
            slopes: [[right[0], down[0]], [right[1], down[1]]],
            edges,
            area,
            total: raw[0] + raw[1] + raw[2],
            distances: [0, 1, 2].each(
                #[inline(always)]
                // A raw weight is zero on the edge opposite its corner and linear, so it is the
                // distance from that edge times the length of its gradient.
                |k| {
                    let (dx, dy) = (steps_x[k] * pixel, steps_y[k] * pixel);
                    raw[k] / (dx * dx + dy * dy).sqrt()
                },
            ),
        }
    }
}

impl<S: Simd> Barycentrics<S> {
    /// Known weights and slopes of points that have no place on the screen, and so neither depth nor distances to edges.
    #[inline(always)]
    pub(crate) fn of_weights(simd: S, placed: &WeightedPoints, slopes: &[[Row; 2]; 2]) -> Self {
        let [zero, one, far] = [0.0, 1.0, f32::INFINITY].each(
            #[inline(always)]
            |value| F32::splat(simd, value),
        );
        let value = inlined(
            #[inline(always)]
            |row: &Row| I32::simd_from(simd, *row).bitcast::<F32<S>>(),
        );
        let weights = placed.weights.each_ref().each(value);
        let slopes = slopes.each_ref().each(
            #[inline(always)]
            |rows| rows.each_ref().each(value),
        );
        Self { weights, slopes, edges: [zero; 3], area: one, total: one, distances: [far; 3] }
    }

    /// The depth, within the range of the vertices' depths. Depth is linear on the screen, so it
    /// is weighted by the plain edge functions.
    ///
    /// Computed in f32, so it may differ from the depth that visibility has stored (a plane in f64,
    /// `primitive/depth.rs`) by roundings. Nothing compares the two.
    #[inline(always)]
    pub(crate) fn depth(&self, simd: S, cold: &[Row; cold::COUNT]) -> F32<S> {
        let [a, b, c]: [F32<S>; 3] = [0, 1, 2].each(
            #[inline(always)]
            |vertex| I32::simd_from(simd, cold[cold::DEPTH + vertex]).bitcast(),
        );
        let depth = (self.edges[0] * a + self.edges[1] * b + self.edges[2] * c) / self.area;
        lesser(greater(depth, lesser(lesser(a, b), c)), greater(greater(a, b), c))
    }

    /// 1/w.
    #[inline(always)]
    pub(crate) fn inverse_w(&self, simd: S, cold: &[Row; cold::COUNT]) -> F32<S> {
        let scale: F32<S> = I32::simd_from(simd, cold[cold::SCALE]).bitcast();
        self.total * scale / self.area
    }
}

/// Derivatives of the weights of corners 1 and 2 along one axis, by the quotient rule: with
/// `L` a raw weight, `T` the sum of all and `w = L / T`, `w' = (L' - w T') / T`. Corner 0 needs none, as
/// the three weights add up to 1.
#[inline(always)]
fn slopes<S: Simd>(steps: [F32<S>; 3], weights: [F32<S>; 3], inverse: F32<S>) -> [F32<S>; 2] {
    let all = steps[0] + steps[1] + steps[2];
    [1, 2].each(
        #[inline(always)]
        |k| (steps[k] - weights[k] * all) * inverse,
    )
}
