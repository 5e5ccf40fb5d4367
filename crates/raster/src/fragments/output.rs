//! Where the colours of fragments are written, and in which form.

use super::encode::Encoding;
use super::fragment_lanes::FragmentLanes;
use super::lines_over::LinesOver;
use super::task::Destination;
use crate::ink::Ink;
use crate::simd::{F32, InlineMap, LANES, Simd, colors_of, prelude::*};

/// The colours of a tile's pixels or fragments.
///
/// `repr(u8)` gives the variant its own byte. Encoded in unused values of a field, it would take six
/// instructions to read, for each vector.
#[repr(u8)]
pub(crate) enum ShadeOutput<'a> {
    Codes(Codes<'a>),
    Colors(Colors<'a>),
    /// With edges and marks painted over the colours first. A separate variant, so that the loops of
    /// pipelines branch once on where colours go, and not also on whether there are edges.
    Inked(Inked<'a>),
}

/// Where colours go with what paints over them.
pub(crate) struct Inked<'a> {
    ink: &'a Ink,
    to: PlainOutput<'a>,
}

enum PlainOutput<'a> {
    Codes(Codes<'a>),
    Colors(Colors<'a>),
}

/// As bytes at once; and edge pixels of groups in linear light.
pub(crate) struct Codes<'a> {
    pub(crate) codes: &'a mut [u32],
    pub(crate) encoding: Encoding,
    pub(crate) colors: &'a mut [[f32; 4]],
}

/// In linear light.
pub(crate) struct Colors<'a>(pub(crate) &'a mut [[f32; 4]]);

impl<'a> ShadeOutput<'a> {
    /// In linear light.
    pub(crate) fn colors(colors: &'a mut [[f32; 4]]) -> Self {
        Self::Colors(Colors(colors))
    }

    /// The same with edges and marks over the colours, if there is something that paints them.
    pub(crate) fn with_ink(self, ink: Option<&'a Ink>) -> Self {
        match (self, ink) {
            (Self::Codes(codes), Some(ink)) => Self::Inked(Inked { ink, to: PlainOutput::Codes(codes) }),
            (Self::Colors(colors), Some(ink)) => Self::Inked(Inked { ink, to: PlainOutput::Colors(colors) }),
            (inked @ Self::Inked(_), _) | (inked, None) => inked,
        }
    }

    /// Writes the colours of up to eight fragments, each to its index.
    #[inline(always)]
    pub(crate) fn write<S: Simd>(&mut self, fragments: &FragmentLanes<'_, S>, color: [F32<S>; 4]) {
        let FragmentLanes { simd, context, records, columns, vector, .. } = *fragments;
        match self {
            Self::Codes(codes) => codes.write(simd, color, vector.destination),
            Self::Colors(colors) => colors.write(simd, color, vector.destination),
            Self::Inked(inked) => {
                let over = LinesOver { ink: inked.ink, context, records, columns };
                let (spots, to) = (vector.spots, vector.destination);
                // A separate function, so that it is compiled once, and frames without edges spend no
                // registers on it; it borrows nothing that others would then have to keep in memory.
                simd.vectorize(
                    #[inline(always)]
                    move || inked.write(finite(simd, over.lay(simd, spots, color)), to),
                );
            }
        }
    }
}

impl Inked<'_> {
    #[inline(always)]
    fn write<S: Simd>(&mut self, color: [F32<S>; 4], to: Destination<'_>) {
        let simd = color[0].token();
        match &mut self.to {
            PlainOutput::Codes(codes) => codes.write(simd, color, to),
            PlainOutput::Colors(colors) => colors.write(simd, color, to),
        }
    }
}

impl Codes<'_> {
    #[inline(always)]
    fn write<S: Simd>(&mut self, simd: S, color: [F32<S>; 4], to: Destination<'_>) {
        let encoded = self.encoding.encode_lanes(simd, color);
        match to {
            Destination::Group(first, has_edges) => {
                encoded.store_slice(&mut self.codes[first..first + LANES]);
                if has_edges {
                    self.colors[first..first + LANES].copy_from_slice(&colors_of(simd, color));
                }
            }
            Destination::Listed(outputs) => {
                let encoded: [u32; LANES] = encoded.into();
                for (&output, code) in outputs.iter().zip(encoded) {
                    self.codes[output as usize] = code;
                }
            }
        }
    }
}

impl Colors<'_> {
    #[inline(always)]
    fn write<S: Simd>(&mut self, simd: S, color: [F32<S>; 4], to: Destination<'_>) {
        let rows = colors_of(simd, color);
        match to {
            Destination::Group(first, _) => self.0[first..first + LANES].copy_from_slice(&rows),
            Destination::Listed(outputs) => {
                for (&output, color) in outputs.iter().zip(rows) {
                    self.0[output as usize] = color;
                }
            }
        }
    }
}

/// A colour without anything that is not finite.
#[inline(always)]
pub(crate) fn finite<S: Simd>(simd: S, color: [F32<S>; 4]) -> [F32<S>; 4] {
    let zero = F32::splat(simd, 0.0);
    // Infinity and NaN times zero are no numbers. Most often there are none.
    let [r, g, b, a] = color;
    if ((r + g + b + a) * zero).simd_eq(zero).all_true() {
        return color;
    }
    color.each(
        #[inline(always)]
        |channel| (channel * zero).simd_eq(zero).select(channel, zero),
    )
}
