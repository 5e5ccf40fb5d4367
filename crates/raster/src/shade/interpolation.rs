//! Perspective-correct weights of a triangle's corners, and their derivatives.
//!
//! With `b` the weights of the set-up triangle's vertices in the plane of the
//! screen (edge function over area: exact, not negative) and `q` the vertices'
//! 1/w, the corners' shares are `L_k = Σ_i m_ik q_i b_i`, where `m` says how
//! vertices come from corners (the identity unless the triangle was cut). Each
//! `L_k` is linear on the screen, the perspective weights are `L_k / Σ L`, and
//! the quotient rule gives their derivatives. (J. Blinn, "Hyperbolic
//! Interpolation", 1992; P. Heckbert and H. Moreton, "Interpolation for Polygon
//! Texture Mapping and Shading", 1991.)

use crate::setup::{Corners, CutWeights, Kind, SetupTriangle};
use crate::tile::{DepthPlane, Edge};

/// The largest ratio of w within a triangle that is told apart; beyond, a
/// vertex counts as this much further away. Keeps all quotients finite.
const RATIO_MAX: f32 = (1_u64 << 60) as f32;

/// What a triangle's fragments have in common.
pub(crate) struct Interpolation {
    pub(crate) edges: [Edge; 3],
    depth: DepthPlane,
    /// 1/w of the vertices over the largest of them.
    q: [f32; 3],
    largest: f32,
    cut: Option<CutWeights>,
    /// Derivatives of the shares to the right and downwards.
    share_x: [f32; 3],
    share_y: [f32; 3],
    /// Pixels for each unit of a share; infinite if there is no edge to measure
    /// a distance to.
    distance: [f32; 3],
    /// The corner that share `k` belongs to.
    pub(crate) corners: [u8; 3],
}

/// Where one sample lies in its triangle.
pub(crate) struct Place {
    /// Perspective-correct weights of the corners, in the order of
    /// [`Interpolation::corners`].
    pub(crate) weights: [f32; 3],
    /// Their derivatives per sample step.
    pub(crate) ddx: [f32; 3],
    pub(crate) ddy: [f32; 3],
    pub(crate) depth: f32,
    pub(crate) inverse_w: f32,
    /// Distances in pixels to the edges `[i, i + 1]` of the primitive.
    pub(crate) edge_distances: [f32; 3],
}

impl Interpolation {
    #[inline(always)]
    pub(crate) fn new(triangle: &SetupTriangle, table: &[CutWeights], samples_per_axis: f32) -> Self {
        let edges = Edge::of(triangle);
        let inverse_w = triangle.vertices.map(|v| v.inverse_w);
        let largest = inverse_w.into_iter().fold(0.0, |a: f32, b| if b > a { b } else { a });
        let q = inverse_w.map(|inverse| {
            let ratio = inverse / largest;
            if ratio > 1.0 / RATIO_MAX { ratio } else { 1.0 / RATIO_MAX }
        });
        let (corners, cut) = match triangle.corners {
            Corners::Whole(corners) => (corners, None),
            Corners::Cut { weights, order } => (order, Some(table[weights as usize])),
        };
        let depth = DepthPlane::new(triangle);
        let step = |edge: i32| (i64::from(edge) * 256) as f32;
        let mut this = Self {
            share_x: [0.0; 3],
            share_y: [0.0; 3],
            distance: [f32::INFINITY; 3],
            depth,
            edges,
            q,
            largest,
            cut,
            corners,
        };
        this.share_x = this.shares(this.depth.weights(edges.map(|edge| step(edge.right))));
        this.share_y = this.shares(this.depth.weights(edges.map(|edge| step(edge.down))));
        if triangle.kind == Kind::Triangle {
            this.distance = std::array::from_fn(|k| {
                let (x, y) = (this.share_x[k], this.share_y[k]);
                1.0 / ((x * x + y * y).sqrt() * samples_per_axis)
            });
        }
        this
    }

    /// The corners' shares for weights of the vertices.
    #[inline(always)]
    fn shares(&self, b: [f32; 3]) -> [f32; 3] {
        let hyperbolic = [self.q[0] * b[0], self.q[1] * b[1], self.q[2] * b[2]];
        match &self.cut {
            None => hyperbolic,
            Some(weights) => std::array::from_fn(|corner| {
                hyperbolic[0] * weights[0][corner]
                    + hyperbolic[1] * weights[1][corner]
                    + hyperbolic[2] * weights[2][corner]
            }),
        }
    }

    /// The place of the sample where the edge functions have these values.
    #[inline(always)]
    pub(crate) fn at(&self, edges: [i64; 3]) -> Place {
        let b = self.depth.weights(edges.map(|edge| edge as f32));
        let shares = self.shares(b);
        let sum = |v: [f32; 3]| v[0] + v[1] + v[2];
        let total = sum(shares);
        let inverse = 1.0 / total;
        let weights = shares.map(|share| share * inverse);
        let derivative = |steps: [f32; 3]| -> [f32; 3] {
            let all = sum(steps);
            std::array::from_fn(|k| (steps[k] - weights[k] * all) * inverse)
        };
        let mut edge_distances = [f32::INFINITY; 3];
        for k in 0..3 {
            if self.distance[k] < f32::INFINITY {
                // Opposite to corner k lies the edge from k + 1 to k + 2.
                edge_distances[(usize::from(self.corners[k]) + 1) % 3] = shares[k] * self.distance[k];
            }
        }
        Place {
            weights,
            ddx: derivative(self.share_x),
            ddy: derivative(self.share_y),
            depth: self.depth.at(b),
            inverse_w: total * self.largest,
            edge_distances,
        }
    }
}
