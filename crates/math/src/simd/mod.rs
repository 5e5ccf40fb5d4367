//! Eight lanes with the same bits at every SIMD level.

mod level;

use fearless_simd::f32x8;
use fearless_simd::prelude::*;

pub use fearless_simd::Simd;
pub use level::{Scalar, Token};

/// The smaller of two; the second where they are equal or one is no number.
/// (`min` leaves the sign of zero and the fate of a NaN to the machine: where that
/// is x86, it does just this.)
#[inline(always)]
pub fn lesser<S: Simd>(a: f32x8<S>, b: f32x8<S>) -> f32x8<S> {
    if is_x86(a.token()) { a.min(b) } else { a.simd_lt(b).select(a, b) }
}

/// The larger of two; the second where they are equal or one is no number.
#[inline(always)]
pub fn greater<S: Simd>(a: f32x8<S>, b: f32x8<S>) -> f32x8<S> {
    if is_x86(a.token()) { a.max(b) } else { a.simd_gt(b).select(a, b) }
}

/// Whether a level runs x86's own instructions; known when it is compiled.
#[inline(always)]
fn is_x86<S: Simd>(simd: S) -> bool {
    #[cfg(target_arch = "x86_64")]
    return matches!(
        simd.level(),
        fearless_simd::Level::Sse2(_) | fearless_simd::Level::Avx2(_) | fearless_simd::Level::Avx512(_)
    );
    #[cfg(not(target_arch = "x86_64"))]
    {
        let _ = simd;
        false
    }
}
