//! Where colours go.

use super::Encoding;
use super::task::Destination;
use crate::simd::{Each, F32, LANES, Simd, lanes_of, prelude::*};

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
                            colors[first..first + LANES].copy_from_slice(&rows(color));
                        }
                    }
                    Destination::Listed(fragments) => {
                        let encoded: [u32; LANES] = encoded.into();
                        for (fragment, code) in fragments.iter().zip(encoded) {
                            codes[fragment.work.output as usize] = code;
                        }
                    }
                }
            }
            Self::Colors(colors) => {
                let rows = rows(color);
                match to {
                    Destination::Group(first, _) => colors[first..first + LANES].copy_from_slice(&rows),
                    Destination::Listed(fragments) => {
                        for (fragment, color) in fragments.iter().zip(rows) {
                            colors[fragment.work.output as usize] = color;
                        }
                    }
                }
            }
        }
    }
}

/// Channels in lanes as colours one after the other.
#[inline(always)]
fn rows<S: Simd>(color: [F32<S>; 4]) -> [[f32; 4]; LANES] {
    let channels: [[f32; LANES]; 4] = color.each(Into::into);
    lanes_of(
        #[inline(always)]
        |lane| {
            channels.each(
                #[inline(always)]
                |channel| channel[lane],
            )
        },
    )
}
