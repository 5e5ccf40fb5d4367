//! Where the colours of fragments are written, and in which form: linear light or bytes.

use super::fragment_lanes::FragmentLanes;
use super::lines_over::LinesOver;
use super::task::Destination;
use crate::ink::Ink;
use crate::simd::{
    F32, I32, InlineMap, LANES, Simd, U32, channels, colors_of, greater, lanes_of, lesser, prelude::*,
};
use trigon_math::{Vec4, color};

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

/// What the bytes of an image mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// The sRGB transfer function, straight alpha.
    Srgb8,
    /// Each component as it is, 0 to 1 as 0 to 255.
    Unorm8,
}

impl Encoding {
    /// A premultiplied linear colour as four bytes.
    #[inline]
    pub(crate) fn encode(self, value: Vec4) -> [u8; 4] {
        match self {
            Self::Srgb8 => {
                let straight = if value.w == 1.0 { value } else { color::unpremultiplied(value) };
                color::linear_to_srgba8(straight)
            }
            Self::Unorm8 => value.to_array().map(unorm),
        }
    }

    /// Colours as four bytes each, red in the lowest. Both lists are as long as the
    /// shorter one, in whole eights.
    #[inline(always)]
    pub(crate) fn encode_all<S: Simd>(self, simd: S, colors: &[[f32; 4]], codes: &mut [u32]) {
        let groups = colors.as_chunks::<LANES>().0;
        for (colors, codes) in groups.iter().zip(codes.as_chunks_mut::<LANES>().0) {
            *codes = self.encode_lanes(simd, channels(simd, colors.each_ref())).into();
        }
    }

    /// [`encode_lanes`](Self::encode_lanes) where something shows through.
    #[inline(never)]
    fn encode_one_by_one<S: Simd>(self, simd: S, color: [F32<S>; 4]) -> U32<S> {
        let channels: [[f32; LANES]; 4] = color.each(Into::into);
        let codes = lanes_of(|lane| {
            let [r, g, b, a] = channels.each(|channel| channel[lane]);
            u32::from_le_bytes(self.encode(Vec4::new(r, g, b, a)))
        });
        U32::simd_from(simd, codes)
    }

    /// Eight colours as four bytes each, red in the lowest.
    #[inline(always)]
    pub(crate) fn encode_lanes<S: Simd>(self, simd: S, color: [F32<S>; 4]) -> U32<S> {
        match self {
            Self::Srgb8 => {
                let [r, g, b, a] = color;
                if !a.simd_eq(F32::splat(simd, 1.0)).all_true() {
                    return self.encode_one_by_one(simd, color);
                }
                let [r, g, b] = [r, g, b].each(
                    #[inline(always)]
                    |channel| srgb_lanes(simd, channel),
                );
                r | (g << 8) | (b << 16) | 0xff00_0000
            }
            Self::Unorm8 => {
                let [r, g, b, a] = color.each(
                    #[inline(always)]
                    |channel| unorm_lanes(simd, channel),
                );
                r | (g << 8) | (b << 16) | (a << 24)
            }
        }
    }
}

/// Linear light to sRGB bytes: the bits of [`color::linear_to_srgb8`].
#[inline(always)]
fn srgb_lanes<S: Simd>(simd: S, value: F32<S>) -> U32<S> {
    let [least, greatest] = [color::SRGB8_LEAST, color::SRGB8_GREATEST].each(
        #[inline(always)]
        |end| F32::splat(simd, end),
    );
    // What is no number becomes the least.
    let value = lesser(greater(value, least), greatest);
    let bits = value.bitcast::<U32<S>>() - color::SRGB8_LEAST.to_bits();
    let cells: [u32; LANES] = (bits >> color::SRGB8_CELL_BITS).into();
    let cells = cells.each(color::srgb8_cell);
    let within = bits & ((1 << color::SRGB8_CELL_BITS) - 1);
    (U32::simd_from(simd, cells) + within) >> color::SRGB8_CELL_BITS
}

/// To the nearest of 256 steps; NaN is 0.
#[inline]
fn unorm(value: f32) -> u8 {
    // The comparison is false for NaN.
    let value = if value > 0.0 { value } else { 0.0 };
    let value = if value < 1.0 { value } else { 1.0 };
    (value * 255.0 + 0.5) as u8
}

#[inline(always)]
fn unorm_lanes<S: Simd>(simd: S, value: F32<S>) -> U32<S> {
    let value = lesser(greater(value, F32::splat(simd, 0.0)), F32::splat(simd, 1.0));
    let steps: I32<S> = (value * 255.0 + 0.5).to_int();
    steps.bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{SimdLevel, at_level};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lanes_encode_as_single_colors_do(
            any: [[f32; 8]; 3],
            light in prop::array::uniform3(prop::array::uniform8(0.0_f32..1.0)),
            alpha in prop_oneof![Just([1.0; 8]), prop::array::uniform8(0.0_f32..1.0), any::<[f32; 8]>()],
            is_light: bool,
        ) {
            let [r, g, b] = if is_light { light } else { any };
            let channels = [r, g, b, alpha];
            for encoding in [Encoding::Srgb8, Encoding::Unorm8] {
                for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                    let codes = at_level!(token, simd => {
                        let color = channels.map(|channel| F32::simd_from(simd, channel));
                        <[u32; LANES]>::from(encoding.encode_lanes(simd, color))
                    });
                    for (lane, code) in codes.into_iter().enumerate() {
                        let color = Vec4::from_array(channels.map(|channel| channel[lane]));
                        prop_assert_eq!(code.to_le_bytes(), encoding.encode(color), "{}", color);
                    }
                }
            }
        }
    }

    #[test]
    fn unorm_rounds_to_the_nearest_step() {
        for (value, code) in [(0.0, 0), (1.0, 255), (0.5, 128), (0.499 / 255.0, 0), (0.501 / 255.0, 1)] {
            assert_eq!(unorm(value), code, "{value}");
        }
        assert_eq!([f32::NAN, -1.0, 7.0].map(unorm), [0, 0, 255], "what is out of range");
    }
}
