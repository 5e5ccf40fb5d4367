//! Runs of pixels in one colour, in integers. Most of a user interface is painted by this.

use crate::simd::prelude::*;
use crate::simd::{LANES, U32};
use fearless_simd::{u8x32, u16x16};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paint2d::{blend, eight};
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
                eight::change(simd, &mut floats, LANES as i32, |below| blend::over(source, below));
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
