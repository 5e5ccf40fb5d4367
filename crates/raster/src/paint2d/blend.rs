//! Blending: source + destination · (1 − source alpha), for all four channels, on their stored (gamma) values.
//!
//! A value is a number of levels from 0 to 255. It is rounded once, to the nearest, when it is stored; sums above 255
//! become 255. Before rounding, the f32 result differs from the exact value by less than 1/1000 level. If the source
//! is a whole number of levels, the exact value is at least 1/510 away from a point where rounding changes, so
//! [`over`] and the integers of [`super::flat`] give the same bytes.

use crate::simd::prelude::*;
use crate::simd::{F32, I32, U32};

const TO_UNIT: f32 = 1.0 / 255.0;

/// Four channels of eight pixels in levels.
pub(super) type LevelChannels<S> = [F32<S>; 4];

/// The channels of packed pixels, the first in the lowest byte.
#[inline(always)]
pub(super) fn unpack<S: Simd>(pixels: U32<S>) -> LevelChannels<S> {
    [channel(pixels), channel(pixels >> 8), channel(pixels >> 16), channel(pixels >> 24)]
}

#[inline(always)]
fn channel<S: Simd>(pixels: U32<S>) -> F32<S> {
    F32::float_from((pixels & 0xff).bitcast::<I32<S>>())
}

/// The product of two colours.
#[inline(always)]
pub(super) fn multiply<S: Simd>(a: LevelChannels<S>, b: LevelChannels<S>) -> LevelChannels<S> {
    [a[0] * b[0] * TO_UNIT, a[1] * b[1] * TO_UNIT, a[2] * b[2] * TO_UNIT, a[3] * b[3] * TO_UNIT]
}

/// `source` over packed pixels.
///
/// Lanes where the source is no colour give anything, and not the same on every
/// machine: the caller drops them.
#[inline(always)]
pub(super) fn over<S: Simd>(source: LevelChannels<S>, below: U32<S>) -> U32<S> {
    let rest = (255.0 - source[3]) * TO_UNIT;
    let below = unpack(below);
    let [r, g, b, a] = [
        store(source[0] + below[0] * rest),
        store(source[1] + below[1] * rest),
        store(source[2] + below[2] * rest),
        store(source[3] + below[3] * rest),
    ];
    r | (g << 8) | (b << 16) | (a << 24)
}

/// Levels to a byte.
#[inline(always)]
fn store<S: Simd>(levels: F32<S>) -> U32<S> {
    // A colour's channels are above −1/2, so cutting rounds to the nearest.
    I32::truncate_from(levels + 0.5).min(255).bitcast()
}
