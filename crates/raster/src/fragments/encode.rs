//! Linear light to bytes.

use crate::simd::{F32, I32, InlineMap, LANES, Simd, U32, channels, greater, lanes_of, lesser, prelude::*};
use trigon_math::{Vec4, color};

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
