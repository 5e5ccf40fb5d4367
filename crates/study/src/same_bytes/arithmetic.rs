//! Two operations that the renderer avoids, and what it uses instead.

use trigon_raster::simd::{F32, Simd, prelude::*};

/// How products are added, and how reciprocals are found.
pub(super) trait Arithmetic {
    /// `a * b + c`.
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S>;

    /// `1 / a`.
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S>;
}

/// Each operation rounded by itself: the same bits everywhere.
pub(super) struct Ours;

/// Fused where the processor can.
pub(super) struct Fused;

/// Fused, with the processor's estimates of reciprocals: about 12 bits on x86, 8 on aarch64.
pub(super) struct Fast;

impl Arithmetic for Ours {
    #[inline(always)]
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S> {
        a * b + c
    }

    #[inline(always)]
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S> {
        1.0 / a
    }
}

impl Arithmetic for Fused {
    #[inline(always)]
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S> {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S> {
        1.0 / a
    }
}

impl Arithmetic for Fast {
    #[inline(always)]
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S> {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S> {
        a.approximate_recip()
    }
}
