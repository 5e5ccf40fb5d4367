//! The weights of eight pixels in their triangles. The weights are computed before the pixels are shaded.

use crate::simd::{I32, Row, Simd, prelude::*};

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
