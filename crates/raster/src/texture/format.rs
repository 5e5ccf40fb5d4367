//! What the bytes of texels mean.

use trigon_math::{Vec4, color};

/// What the bytes of a texture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureFormat {
    /// Colours: red, green and blue through the sRGB transfer function, alpha
    /// linear and straight. Decoded before filtering.
    Srgb,
    /// Data such as normals or roughness: byte / 255.
    Linear,
}

/// A texel ready to be mixed with others, alpha straight: [`full_scale`] is 1.
#[inline]
pub(super) fn decode([r, g, b, a]: [u8; 4], format: TextureFormat) -> Vec4 {
    let light = |byte: u8| match format {
        TextureFormat::Srgb => color::srgb8_to_linear(byte),
        TextureFormat::Linear => f32::from(byte),
    };
    Vec4::new(light(r), light(g), light(b), f32::from(a))
}

/// What [`decode`] gives for the largest byte. Data is mixed as whole bytes and
/// divided once, after the filter.
#[inline]
pub(super) fn full_scale(format: TextureFormat) -> Vec4 {
    match format {
        TextureFormat::Srgb => Vec4::new(1.0, 1.0, 1.0, 255.0),
        TextureFormat::Linear => Vec4::splat(255.0),
    }
}
