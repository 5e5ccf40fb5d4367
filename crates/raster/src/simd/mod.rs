//! Vectors of eight lanes at every SIMD level, and what we need on top of them
//! that gives the same bits everywhere.
//!
//! A vector has eight lanes on every machine: narrow levels take two registers
//! for it. So nothing that is computed can depend on the lane width.

mod each;
mod gather;
mod level;

pub use each::{Each, inlined, lanes_of};
pub use fearless_simd::Simd;
pub use fearless_simd::prelude;
pub(crate) use gather::{Row, transpose, transposed};
pub use level::{SimdLevel, SimdLevelError};
pub(crate) use level::{Token, at_level};

/// Lanes of a vector.
pub const LANES: usize = 8;

/// Eight f32.
pub type F32<S> = fearless_simd::f32x8<S>;
/// Eight i32.
pub type I32<S> = fearless_simd::i32x8<S>;
/// Eight u32.
pub type U32<S> = fearless_simd::u32x8<S>;
/// Eight truth values.
pub type Mask<S> = fearless_simd::mask32x8<S>;

use fearless_simd::prelude::*;

/// The smaller of two; the second where they are equal or one is no number.
/// (`min` leaves the sign of zero and the fate of a NaN to the machine.)
#[inline(always)]
pub fn lesser<S: Simd>(a: F32<S>, b: F32<S>) -> F32<S> {
    a.simd_lt(b).select(a, b)
}

/// The larger of two; the second where they are equal or one is no number.
#[inline(always)]
pub fn greater<S: Simd>(a: F32<S>, b: F32<S>) -> F32<S> {
    a.simd_gt(b).select(a, b)
}

/// 0, 1, 2 … 7.
#[inline(always)]
pub fn lane_numbers<S: Simd>(simd: S) -> I32<S> {
    I32::simd_from(simd, [0, 1, 2, 3, 4, 5, 6, 7])
}
