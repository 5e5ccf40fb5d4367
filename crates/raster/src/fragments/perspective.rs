//! The factors that make weights perspective-correct, and the weights of eight pixels in their triangles. Weights are
//! computed before the pixels are shaded.

use crate::simd::{F32, I32, InlineMap, Row, Simd, U32, greater, prelude::*};

/// Bounds the ratio of w within a triangle: the 1/w of a vertex is clamped to at least the largest
/// power of two not above the greatest one, divided by this. Keeps all quotients finite.
const RATIO_MAX: f32 = (1_u64 << 60) as f32;

/// The vertices' 1/w divided by the largest power of two not above the greatest of them, and that power
/// of two.
///
/// Weights are quotients in which a common factor cancels. Scaling by a power of two rounds
/// nothing, and prevents overflow and underflow in products and sums.
#[inline(always)]
pub(crate) fn perspective<S: Simd>(simd: S, inverse_w: [F32<S>; 3]) -> ([F32<S>; 3], F32<S>) {
    let scale = power_of_two(simd, greater(greater(inverse_w[0], inverse_w[1]), inverse_w[2]));
    let least = F32::splat(simd, 1.0 / RATIO_MAX);
    let inverse = F32::splat(simd, 1.0) / scale;
    let q = inverse_w.each(
        #[inline(always)]
        |q| greater(q * inverse, least),
    );
    (q, scale)
}

/// The largest power of two not above a normal positive number.
#[inline(always)]
fn power_of_two<S: Simd>(simd: S, value: F32<S>) -> F32<S> {
    let bits: U32<S> = value.bitcast();
    (bits & U32::splat(simd, 0x7f80_0000)).bitcast()
}

/// Eight points with the results that take longest to compute. They are computed for the next
/// eight pixels before the current eight are shaded, so that shading does not wait for them.
#[derive(Clone, Default)]
#[repr(align(64))]
pub(crate) struct WeightedPoints {
    /// In 1/256 pixel from the tile's corner.
    pub(crate) point: [Row; 2],
    /// Perspective-correct weights of the corners, and one over the sum of the raw weights: bits of
    /// f32.
    pub(crate) weights: [Row; 3],
    pub(crate) inverse: Row,
}

impl WeightedPoints {
    #[inline(always)]
    pub(crate) fn point<S: Simd>(&self, simd: S) -> [I32<S>; 2] {
        let [x, y] = self.point;
        [I32::simd_from(simd, x), I32::simd_from(simd, y)]
    }
}
