//! Watertight intersection of a ray with eight triangles.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, u32x8};

use super::prepared::{Axis, PreparedRays};
use super::wide::{Eight, Leaf, WIDTH};

/// Where a ray meets the plane of a triangle, as its edge functions in f64.
pub(super) struct Crossing {
    /// From the origin, in lengths of the direction; finite.
    pub(super) distance: f32,
    edges: [f64; 3],
}

impl Crossing {
    /// Barycentrics of the three corners.
    pub(super) fn weights(&self) -> [f32; 3] {
        let sum: f64 = self.edges[0] + self.edges[1] + self.edges[2];
        let [u, v, w] = self.edges;
        [(u / sum) as f32, (v / sum) as f32, (w / sum) as f32]
    }
}

/// A ray prepared for many triangles: sheared so that it runs along one axis.
#[derive(Clone, Copy)]
pub(super) struct ShearedRay {
    /// By the axes below.
    origin: [f32; 3],
    /// The last is the one along which the ray runs fastest.
    axes: [Axis; 3],
    /// By the first two axes.
    shear: [f32; 2],
    /// Of the direction along the last axis.
    inverse_speed: f32,
    /// The least distance that counts.
    pub(super) start: f32,
    /// The greatest.
    pub(super) end: f32,
}

impl ShearedRay {
    #[inline(always)]
    pub(super) fn new(rays: &PreparedRays, lane: usize) -> Self {
        let axes = rays.axes(lane);
        let [x, y, z] = [axes[0] as usize, axes[1] as usize, axes[2] as usize];
        let lane = lane % WIDTH;
        Self {
            origin: [rays.origin[x][lane], rays.origin[y][lane], rays.origin[z][lane]],
            axes,
            shear: [rays.shear[x][lane], rays.shear[y][lane]],
            inverse_speed: rays.inverse_speed[lane],
            start: rays.start[lane],
            end: rays.end[lane],
        }
    }

    /// The triangles of a leaf that the ray may hit, one bit for each: all that it hits, and few others.
    #[inline(always)]
    pub(super) fn candidates<S: Simd>(&self, simd: S, leaf: &Leaf) -> u32 {
        let [a, b, c] = [&leaf.corners[0], &leaf.corners[1], &leaf.corners[2]];
        let [a, b, c] = [self.sheared(simd, a), self.sheared(simd, b), self.sheared(simd, c)];
        let [u, v, w] = [crossed(simd, c, b), crossed(simd, a, c), crossed(simd, b, a)];
        // Where a sign is uncertain, both count. So they do where numbers overflow, which leaves NaN.
        let not_positive = u.high.simd_lt(0.0) | v.high.simd_lt(0.0) | w.high.simd_lt(0.0);
        let not_negative = u.low.simd_gt(0.0) | v.low.simd_gt(0.0) | w.low.simd_gt(0.0);
        let exists = !u32x8::simd_from(simd, leaf.numbers).simd_eq(Leaf::NONE);
        (exists & !(not_positive & not_negative)).to_bitmask() as u32
    }

    /// The hit of the ray on one triangle, if any; none if it runs parallel to it, or the distance overflows. Products
    /// of two f32 are exact in f64, so the signs of their differences are right, and barycentrics are within one f32
    /// rounding even if the triangle is seen from its edge.
    #[inline(always)]
    pub(super) fn crossing(&self, leaf: &Leaf, slot: usize) -> Option<Crossing> {
        let [a, b, c] = &leaf.corners;
        // No `map`, which is not inlined everywhere and then loses the level's instructions.
        let [a, b, c] = [self.corner(a, slot), self.corner(b, slot), self.corner(c, slot)];
        let exact =
            |p: [f32; 3], q: [f32; 3]| f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0]);
        let [u, v, w] = [exact(c, b), exact(a, c), exact(b, a)];
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let sum = u + v + w;
        if !inside || sum == 0.0 {
            return None;
        }
        let along = u * f64::from(a[2]) + v * f64::from(b[2]) + w * f64::from(c[2]);
        let distance = (along / sum * f64::from(self.inverse_speed)) as f32;
        distance.is_finite().then_some(Crossing { distance, edges: [u, v, w] })
    }

    #[inline(always)]
    fn corner(&self, corner: &[Eight; 3], slot: usize) -> [f32; 3] {
        let [x, y, z] = self.axes;
        let z = corner[z as usize][slot] - self.origin[2];
        let x = corner[x as usize][slot] - self.origin[0];
        let y = corner[y as usize][slot] - self.origin[1];
        [x - self.shear[0] * z, y - self.shear[1] * z, z]
    }

    /// The first two coordinates of eight corners.
    #[inline(always)]
    fn sheared<S: Simd>(&self, simd: S, corner: &[Eight; 3]) -> [f32x8<S>; 2] {
        let [x, y, z] = self.axes;
        let z = f32x8::simd_from(simd, corner[z as usize]) - self.origin[2];
        let x = f32x8::simd_from(simd, corner[x as usize]) - self.origin[0];
        let y = f32x8::simd_from(simd, corner[y as usize]) - self.origin[1];
        [x - z * self.shear[0], y - z * self.shear[1]]
    }
}

/// Eight edge functions, as intervals.
struct Edges<S: Simd> {
    low: f32x8<S>,
    high: f32x8<S>,
}

/// The edge function of two corners. Two products and their difference are each rounded once: the
/// error is less than 2u of one product and u of the other, and where the sign is uncertain the two
/// are nearly equal.
#[inline(always)]
fn crossed<S: Simd>(simd: S, p: [f32x8<S>; 2], q: [f32x8<S>; 2]) -> Edges<S> {
    let (first, second) = (p[0] * q[1], p[1] * q[0]);
    let least = f32x8::splat(simd, f32::MIN_POSITIVE);
    let (edge, doubt) = (first - second, first.abs() * (2.0 * f32::EPSILON) + least);
    Edges { low: edge - doubt, high: edge + doubt }
}
