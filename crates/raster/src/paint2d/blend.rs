//! Blending: source + destination · (1 − source alpha), for all four channels, on their stored (gamma) values.
//!
//! A value is a number of levels from 0 to 255. It is rounded once, to the nearest, when it is stored; sums above 255
//! become 255. Before rounding, the f32 result differs from the exact value by less than 1/1000 level. If the source
//! is a whole number of levels, the exact value is at least 1/510 away from a point where rounding changes, so
//! [`over`] and the integers of [`Flat`] give the same bytes.
//!
//! Eight pixels are blended at a time, also at the end of a row, where fewer are left. Runs of one colour are painted
//! in integers ([`Flat`]): most of a user interface. Glyphs, icons and the image of a 3D view are copied, one texel to
//! a pixel.

use super::{Canvas, Image, Rect};
use crate::simd::{F32, I32, LANES, U32, lane_numbers, prelude::*};
use fearless_simd::{u8x32, u16x16};

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

/// The first eight of `pixels`, packed; what is beyond the end is transparent.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, pixels: &[[u8; 4]]) -> U32<S> {
    if let Some(eight) = pixels.first_chunk::<LANES>() {
        return u8x32::from_slice(simd, eight.as_flattened()).bitcast();
    }
    let mut eight = [[0; 4]; LANES];
    eight[..pixels.len()].copy_from_slice(pixels);
    u8x32::from_slice(simd, eight.as_flattened()).bitcast()
}

/// Changes the first `count` of `pixels`, or eight if there are more.
///
/// `change` is called with the pixels that follow `count`, too, and what it makes
/// of them is dropped.
#[inline(always)]
pub(super) fn change<S: Simd>(
    simd: S,
    pixels: &mut [[u8; 4]],
    count: i32,
    change: impl FnOnce(U32<S>) -> U32<S>,
) {
    let below = load(simd, pixels);
    let changed = lane_numbers(simd).simd_lt(I32::splat(simd, count));
    let result: u8x32<S> = changed.select(change(below), below).bitcast();
    if let Some(eight) = pixels.first_chunk_mut::<LANES>() {
        result.store_slice(eight.as_flattened_mut());
    } else {
        let mut eight = [[0; 4]; LANES];
        result.store_slice(eight.as_flattened_mut());
        pixels.copy_from_slice(&eight[..pixels.len()]);
    }
}

/// One colour of whole levels, no channel above alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Flat {
    color: [u8; 4],
}

impl Flat {
    /// No colour: leaves all pixels as they are.
    pub(super) const NOTHING: Self = Self { color: [0; 4] };

    /// `None` if a channel is above alpha: sums may exceed 255 then.
    pub(super) fn new(color: [u8; 4]) -> Option<Self> {
        color.into_iter().all(|channel| channel <= color[3]).then_some(Self { color })
    }

    /// Paints over a run of pixels.
    #[inline(always)]
    pub(super) fn paint<S: Simd>(self, simd: S, pixels: &mut [[u8; 4]]) {
        match self.color[3] {
            0 => {}
            255 => pixels.fill(self.color),
            _ => {
                let (eights, rest) = pixels.as_chunks_mut::<LANES>();
                for eight in eights {
                    self.over_eight(simd, eight.as_flattened_mut());
                }
                for pixel in rest {
                    self.over_one(pixel);
                }
            }
        }
    }

    /// Even and odd bytes apart, in 16 bits.
    #[inline(always)]
    fn over_eight<S: Simd>(self, simd: S, pixels: &mut [u8]) {
        let color = u32::from_le_bytes(self.color);
        let color: u8x32<S> = U32::splat(simd, color).bitcast();
        let below: u16x16<S> = u8x32::from_slice(simd, pixels).bitcast();
        let rest = u16::from(255 - self.color[3]);
        let below = div_255((below & 0xff) * rest) | (div_255((below >> 8) * rest) << 8);
        (color + below.bitcast::<u8x32<S>>()).store_slice(pixels);
    }

    #[inline(always)]
    fn over_one(self, pixel: &mut [u8; 4]) {
        let rest = u16::from(255 - self.color[3]);
        for (below, color) in pixel.iter_mut().zip(self.color) {
            let product = u16::from(*below) * rest + 128;
            *below = color + ((product + (product >> 8)) >> 8) as u8;
        }
    }
}

/// A product of two bytes, divided by 255 and rounded to the nearest: exact (J.
/// Blinn, "Three Wrongs Make a Right", 1995).
#[inline(always)]
fn div_255<S: Simd>(product: u16x16<S>) -> u16x16<S> {
    let product = product + 128;
    (product + (product >> 8)) >> 8
}

/// Paints `pixels`, which are inside the canvas, with the texels `offset` from
/// them, which are inside the image, times a colour.
#[inline(always)]
pub(super) fn blit<S: Simd>(
    simd: S,
    canvas: &mut Canvas<'_>,
    pixels: Rect,
    image: &Image,
    offset: [i32; 2],
    color: [u8; 4],
) {
    let white = color == [255; 4];
    let [r, g, b, a] = color.map(f32::from);
    let tint = [F32::splat(simd, r), F32::splat(simd, g), F32::splat(simd, b), F32::splat(simd, a)];
    for y in pixels.min[1]..pixels.max[1] {
        for x in (pixels.min[0]..pixels.max[0]).step_by(LANES) {
            let count = (pixels.max[0] - x).min(LANES as i32);
            let texels: U32<S> = load(simd, image.texels_from(x + offset[0], y + offset[1]));
            if texels.simd_eq(0).all_true() {
                continue;
            }
            let opaque = white && (texels & OPAQUE).simd_eq(OPAQUE).all_true();
            change(
                simd,
                canvas.pixels_from(x, y),
                count,
                #[inline(always)]
                |below| {
                    if opaque { texels } else { over(multiply(tint, unpack(texels)), below) }
                },
            );
        }
    }
}

/// Full alpha.
const OPAQUE: u32 = 0xff00_0000;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{F32, SimdLevel, at_level};

    /// Eight pixels of each level, painted by the integers and by f32.
    fn check(color: [u8; 4]) {
        let token = SimdLevel::best().token().unwrap();
        let flat = Flat::new(color).unwrap();
        at_level!(token, simd => {
            let source = color.map(|channel| F32::splat(simd, f32::from(channel)));
            for level in 0..=255 {
                let [mut integers, mut floats] = [[[level; 4]; LANES]; 2];
                flat.paint(simd, &mut integers);
                change(simd, &mut floats, LANES as i32, |below| over(source, below));
                assert_eq!(integers, floats, "{color:?} over {level}");
                let mut one = [level; 4];
                flat.over_one(&mut one);
                assert_eq!(one, integers[0], "{color:?} over one pixel of {level}");
            }
        });
    }

    #[test]
    fn integers_and_floats_agree_for_every_alpha_and_level() {
        for alpha in 0..=255 {
            check([0, alpha / 3, alpha - alpha / 7, alpha]);
        }
    }

    #[test]
    fn channels_above_alpha_are_not_flat() {
        assert_eq!(Flat::new([0, 9, 0, 8]), None, "sums could exceed 255");
        assert_eq!(Flat::new([0; 4]), Some(Flat::NOTHING), "nothing is flat");
    }
}
