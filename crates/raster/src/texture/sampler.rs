//! The settings of a texture look-up, and what the bytes of texels mean.

use trigon_math::{Vec4, color};

/// The most probes that [`MipFilter::Anisotropic`] takes.
pub const MAX_ANISOTROPY: u8 = 16;

/// What lies beyond the edges of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The texture again.
    #[default]
    Repeat,
    /// The texture mirrored, then again.
    MirroredRepeat,
    /// Its outermost texels.
    ClampToEdge,
}

/// How texels of one level become a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The texel that the coordinate lies in.
    Nearest,
    /// The four nearest, weighted by distance.
    #[default]
    Linear,
}

/// How mip levels are chosen when the texture is reduced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MipFilter {
    /// Only the base level: sharp, and it shimmers.
    None,
    /// The nearest level.
    Nearest,
    /// The two nearest levels, weighted ("trilinear" with [`Filter::Linear`]).
    #[default]
    Linear,
    /// Up to this many look-ups like [`Self::Linear`] along the longer side of the footprint, each as sharp
    /// as the shorter side allows: surfaces at grazing angles stay sharp, at the cost of that many look-ups.
    /// 1 (or 0) is the same as `Linear`; more than 16 counts as 16.
    Anisotropic(u8),
}

/// How a texture is looked up; the default repeats and is trilinear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Beyond the left and right edge.
    pub wrap_u: Wrap,
    /// Beyond the top and bottom edge.
    pub wrap_v: Wrap,
    /// Filter where a texel is larger than an internal pixel; with several probes, than the part of
    /// it that one of them covers.
    pub magnification: Filter,
    /// Filter within a level where it is smaller.
    pub minification: Filter,
    /// Choice of levels where it is smaller.
    pub mip: MipFilter,
}

impl Sampler {
    /// Whether a look-up depends on the size of the footprint at all.
    #[inline]
    pub(super) fn needs_detail(&self) -> bool {
        self.mip != MipFilter::None || self.magnification != self.minification
    }

    /// The most probes along the longer side of a footprint.
    #[inline]
    pub(super) fn most_probes(&self) -> f32 {
        match self.mip {
            MipFilter::Anisotropic(most) => f32::from(most.clamp(1, MAX_ANISOTROPY)),
            _ => 1.0,
        }
    }
}

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
