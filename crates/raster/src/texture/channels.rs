//! From the bytes of texels to channels that can be mixed, in lanes.

use crate::simd::prelude::*;
use crate::simd::{F32, I32, LANES, Simd, U32};
use trigon_math::color::srgb8_to_linear;

/// Red, green, blue and alpha.
pub(super) type Channels<S> = [F32<S>; 4];

/// The last channel.
pub(super) const ALPHA: u32 = 3;

/// What the bytes of texels mean.
pub(super) trait Texels {
    /// A channel, 0 to 3, of texels, ready to be mixed.
    fn channel<S: Simd>(texels: U32<S>, channel: u32) -> F32<S>;
}

/// [`TextureFormat::Linear`]. Each channel stays where it lies in the texel:
/// that is a factor, a power of two, which is taken out at the end without
/// rounding.
pub(super) struct Data;

impl Texels for Data {
    #[inline(always)]
    fn channel<S: Simd>(texels: U32<S>, channel: u32) -> F32<S> {
        // The highest byte would make the integer negative, so alpha is shifted down instead.
        float(if channel == ALPHA { texels >> 24 } else { texels & (0xff << (8 * channel)) })
    }
}

/// [`TextureFormat::Srgb`]: linear light, and alpha as data.
pub(super) struct Color;

impl Texels for Color {
    #[inline(always)]
    fn channel<S: Simd>(texels: U32<S>, channel: u32) -> F32<S> {
        if channel == ALPHA {
            return float(texels >> 24);
        }
        light(texels.token(), &texels.to_array(), 8 * channel)
    }
}

#[inline(always)]
fn float<S: Simd>(number: U32<S>) -> F32<S> {
    number.bitcast::<I32<S>>().to_float()
}

/// The light of the bytes at a `shift`.
#[inline(always)]
fn light<S: Simd>(simd: S, texels: &[u32; LANES], shift: u32) -> F32<S> {
    F32::simd_from(simd, std::array::from_fn(|lane| srgb8_to_linear((texels[lane] >> shift) as u8)))
}

#[inline(always)]
pub(super) fn mix<S: Simd>(a: F32<S>, b: F32<S>, share: F32<S>) -> F32<S> {
    a + (b - a) * share
}
