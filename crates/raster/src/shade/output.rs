//! Where colours go.

use super::Encoding;
use super::task::Destination;
use crate::simd::{F32, LANES, Simd, colors_of, prelude::*};

/// The colours of a tile's pixels or fragments.
pub(crate) enum ShadeOutput<'a> {
    /// As bytes at once; and edge pixels of groups in linear light.
    Codes(&'a mut [u32], Encoding, &'a mut [[f32; 4]]),
    /// In linear light.
    Colors(&'a mut [[f32; 4]]),
}

impl ShadeOutput<'_> {
    /// Writes up to eight colours, each to its place.
    #[inline(always)]
    pub(super) fn write<S: Simd>(&mut self, simd: S, color: [F32<S>; 4], to: Destination<'_>) {
        match self {
            Self::Codes(codes, encoding, colors) => {
                let encoded = encoding.encode_lanes(simd, color);
                match to {
                    Destination::Group(first, has_edges) => {
                        encoded.store_slice(&mut codes[first..first + LANES]);
                        if has_edges {
                            colors[first..first + LANES].copy_from_slice(&colors_of(simd, color));
                        }
                    }
                    Destination::Listed(outputs) => {
                        let encoded: [u32; LANES] = encoded.into();
                        for (&output, code) in outputs.iter().zip(encoded) {
                            codes[output as usize] = code;
                        }
                    }
                }
            }
            Self::Colors(colors) => {
                let rows = colors_of(simd, color);
                match to {
                    Destination::Group(first, _) => colors[first..first + LANES].copy_from_slice(&rows),
                    Destination::Listed(outputs) => {
                        for (&output, color) in outputs.iter().zip(rows) {
                            colors[output as usize] = color;
                        }
                    }
                }
            }
        }
    }
}
