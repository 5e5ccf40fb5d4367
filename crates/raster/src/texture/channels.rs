//! From the bytes of texels to channels that can be mixed, in lanes.

use crate::simd::prelude::*;
use crate::simd::{F32, I32, LANES, Simd, U32};
use trigon_math::color::srgb8_to_linear;

/// Red, green, blue and alpha.
pub(super) type Channels<S> = [F32<S>; 4];

/// What the bytes of texels mean.
pub(super) trait Texels {
    /// The channels of texels, ready to be mixed.
    fn channels<S: Simd>(texels: U32<S>) -> Channels<S>;
}

/// [`TextureFormat::Linear`]. Each channel stays where it lies in the texel:
/// that is a factor, a power of two, which is taken out at the end without
/// rounding.
pub(super) struct Data;

impl Texels for Data {
    #[inline(always)]
    fn channels<S: Simd>(texels: U32<S>) -> Channels<S> {
        let [red, green, blue] = [texels & 0xff, texels & 0xff00, texels & 0x00ff_0000];
        [float(red), float(green), float(blue), float(texels >> 24)]
    }
}

/// [`TextureFormat::Srgb`]: linear light, and alpha as data.
pub(super) struct Color;

impl Texels for Color {
    #[inline(always)]
    fn channels<S: Simd>(texels: U32<S>) -> Channels<S> {
        let bytes = texels.to_array();
        let simd = texels.token();
        [light(simd, &bytes, 0), light(simd, &bytes, 8), light(simd, &bytes, 16), float(texels >> 24)]
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
pub(super) fn mix<S: Simd>(a: Channels<S>, b: Channels<S>, share: F32<S>) -> Channels<S> {
    let [p, q, r, s] = a;
    [p + (b[0] - p) * share, q + (b[1] - q) * share, r + (b[2] - r) * share, s + (b[3] - s) * share]
}
