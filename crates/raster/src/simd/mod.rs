//! Vectors of eight lanes at every SIMD level, and what we need on top of them
//! that gives the same bits everywhere.
//!
//! A vector has eight lanes on every machine; narrow levels use two registers
//! for it. No result can therefore depend on the lane width.

mod lanes;
mod level;

pub use fearless_simd::{Simd, prelude};
pub use lanes::{InlineMap, inlined, lanes_of};
pub(crate) use lanes::{Row, append, channels, colors_of, transpose, transposed, unzipped};
pub use level::{SimdLevel, SimdLevelError};
pub(crate) use trigon_math::at_level;
pub(crate) use trigon_math::simd::Token;
pub use trigon_math::simd::{greater, lesser};

use fearless_simd::prelude::*;

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

/// Whether a level runs AVX-512; known when it is compiled.
#[inline(always)]
fn is_avx512<S: Simd>(simd: S) -> bool {
    #[cfg(target_arch = "x86_64")]
    return matches!(simd.level(), fearless_simd::Level::Avx512(_));
    #[cfg(not(target_arch = "x86_64"))]
    {
        let _ = simd;
        false
    }
}

/// The bits of `new` where `bits` are set, of `there` elsewhere.
///
/// For what is stored where `there` was loaded: a selection would become a masked
/// store, which some processors are slow at (AMD's Zen 3 takes five times as long
/// as for this).
#[inline(always)]
pub(crate) fn blended<S: Simd>(bits: U32<S>, there: U32<S>, new: U32<S>) -> U32<S> {
    there ^ ((there ^ new) & bits)
}

/// Eight f32 as two times four f64.
#[inline(always)]
pub(crate) fn widened<S: Simd>(value: F32<S>) -> [fearless_simd::f64x4<S>; 2] {
    let (low, high) = value.token().widen_f32x8(value);
    [low, high]
}

/// 0, 1, 2 … 7.
#[inline(always)]
pub fn lane_numbers<S: Simd>(simd: S) -> I32<S> {
    I32::simd_from(simd, [0, 1, 2, 3, 4, 5, 6, 7])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lesser_and_greater_are_comparisons_at_every_level() {
        let values = [0.0, -0.0, 1.0, -2.5, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MIN_POSITIVE];
        for (token, shift) in SimdLevel::ALL
            .into_iter()
            .filter_map(SimdLevel::token)
            .flat_map(|token| (0..8).map(move |shift| (token, shift)))
        {
            let others: [f32; 8] = std::array::from_fn(|lane| values[(lane + shift) % 8]);
            let (least, greatest): ([f32; 8], [f32; 8]) = at_level!(token, simd => {
                let (a, b) = (F32::simd_from(simd, values), F32::simd_from(simd, others));
                (lesser(a, b).into(), greater(a, b).into())
            });
            for lane in 0..8 {
                let (a, b) = (values[lane], others[lane]);
                let (less, more) = (if a < b { a } else { b }, if a > b { a } else { b });
                assert_eq!(least[lane].to_bits(), less.to_bits(), "lesser of {a} and {b} at {token:?}");
                assert_eq!(greatest[lane].to_bits(), more.to_bits(), "greater of {a} and {b} at {token:?}");
            }
        }
    }
}
