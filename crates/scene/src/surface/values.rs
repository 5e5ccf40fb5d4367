//! The varyings and their gradients at eight points.

use trigon_raster::FragmentLanes;
use trigon_raster::simd::{F32, Simd};

/// The varyings of eight points, by their index in the draw's layout.
pub(crate) trait Values<S: Simd> {
    /// The values.
    fn varying(&self, index: usize) -> F32<S>;
    /// Their change per pixel to the right, and per pixel down.
    fn gradient(&self, index: usize) -> [F32<S>; 2];
}

impl<S: Simd> Values<S> for FragmentLanes<'_, S> {
    #[inline(always)]
    fn varying(&self, index: usize) -> F32<S> {
        FragmentLanes::varying(self, index)
    }

    #[inline(always)]
    fn gradient(&self, index: usize) -> [F32<S>; 2] {
        FragmentLanes::gradient(self, index)
    }
}

/// Three varyings in a row.
#[inline(always)]
pub(crate) fn three<S: Simd>(values: &impl Values<S>, at: usize) -> [F32<S>; 3] {
    [values.varying(at), values.varying(at + 1), values.varying(at + 2)]
}
