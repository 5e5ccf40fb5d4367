//! Where colours go.

use super::{Encoding, Work};
use crate::simd::{Each, F32, LANES, Simd};

/// The colours of a tile's pixels or fragments.
pub(crate) enum ShadeOutput<'a> {
    /// As bytes at once: nothing is blended or averaged.
    Codes(&'a mut [u32], Encoding),
    /// In linear light.
    Colors(&'a mut [[f32; 4]]),
}

impl ShadeOutput<'_> {
    /// Writes up to eight colours, each to its place.
    #[inline(always)]
    pub(super) fn write<S: Simd>(&mut self, simd: S, color: [F32<S>; 4], work: &[Work]) {
        match self {
            Self::Codes(codes, encoding) => {
                for (work, code) in work.iter().zip(encoding.encode_lanes(simd, color)) {
                    codes[work.output as usize] = code;
                }
            }
            Self::Colors(colors) => {
                let channels: [[f32; LANES]; 4] = color.each(Into::into);
                for (lane, work) in work.iter().enumerate() {
                    colors[work.output as usize] = channels.each(
                        #[inline(always)]
                        |channel| channel[lane],
                    );
                }
            }
        }
    }

    /// Writes the first lane's color to many places.
    #[inline(always)]
    pub(super) fn fill<S: Simd>(&mut self, simd: S, color: [F32<S>; 4], work: &[Work]) {
        match self {
            Self::Codes(codes, encoding) => {
                let [code, ..] = encoding.encode_lanes(simd, color);
                work.iter().for_each(|work| codes[work.output as usize] = code);
            }
            Self::Colors(colors) => {
                let color = color.each(
                    #[inline(always)]
                    |channel| channel[0],
                );
                work.iter().for_each(|work| colors[work.output as usize] = color);
            }
        }
    }
}
