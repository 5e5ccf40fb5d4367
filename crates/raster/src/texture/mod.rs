//! Pictures on surfaces: texels, mip levels and the ways to look them up.

mod mips;
mod sample;
mod sampler;

pub use sampler::{Filter, MipFilter, Sampler, Wrap};

use thiserror::Error;
use trigon_math::{Vec2, Vec4, color};

/// The largest width and height of a texture.
pub const MAX_TEXTURE_SIZE: u32 = 16384;

/// What the bytes of a texture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureFormat {
    /// Colours: red, green and blue through the sRGB transfer function, alpha
    /// linear and straight. Decoded before filtering.
    Srgb,
    /// Data such as normals or roughness: byte / 255.
    Linear,
}

/// Why a texture cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum TextureError {
    /// Width or height is 0 or above [`MAX_TEXTURE_SIZE`].
    #[error("a texture of {width}x{height} texels: each side must be 1 to {MAX_TEXTURE_SIZE}")]
    Size {
        /// The width given.
        width: u32,
        /// The height given.
        height: u32,
    },
    /// Not `width * height` texels.
    #[error("{given} texels for a texture that needs {needed}")]
    Length {
        /// The texels given.
        given: usize,
        /// Width times height.
        needed: usize,
    },
}

/// An RGBA picture with its mip levels, down to one texel.
///
/// Coordinates: (0, 0) is the corner of the first texel, at the top left, and
/// (1, 1) the far corner of the last.
#[derive(Clone, Debug)]
pub struct Texture {
    format: TextureFormat,
    levels: Vec<Level>,
}

/// One mip level.
#[derive(Clone, Debug)]
struct Level {
    width: u32,
    height: u32,
    texels: Vec<[u8; 4]>,
}

impl Texture {
    /// A texture from row-major texels, top row first, with all its mip levels.
    ///
    /// Each level halves the one before (rounded down, at least 1) by a box
    /// filter in linear light, exact for any size; colours are weighted by
    /// their alpha, so that what is transparent does not bleed.
    ///
    /// # Errors
    /// [`TextureError`] if a side is out of range or the number of texels wrong.
    pub fn new(
        width: u32,
        height: u32,
        texels: Vec<[u8; 4]>,
        format: TextureFormat,
    ) -> Result<Self, TextureError> {
        let sides = 1..=MAX_TEXTURE_SIZE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(TextureError::Size { width, height });
        }
        let needed = width as usize * height as usize;
        if texels.len() != needed {
            return Err(TextureError::Length { given: texels.len(), needed });
        }
        let base = Level { width, height, texels };
        Ok(Self { format, levels: mips::chain(base, format) })
    }

    /// Width of the base level in texels.
    pub fn width(&self) -> u32 {
        self.levels[0].width
    }

    /// Height of the base level in texels.
    pub fn height(&self) -> u32 {
        self.levels[0].height
    }

    /// How many mip levels there are, the base included.
    pub fn level_count(&self) -> usize {
        self.levels.len()
    }

    /// What the bytes mean.
    pub fn format(&self) -> TextureFormat {
        self.format
    }

    /// The value at `uv` in linear light, alpha straight, filtered as the
    /// `sampler` says for a footprint spanned by `ddx` and `ddy`, the change of
    /// `uv` per sample step.
    ///
    /// Any coordinate is safe: one that is not finite counts as 0, a gradient
    /// that is not finite selects the last level.
    #[inline]
    pub fn sample(&self, uv: Vec2, ddx: Vec2, ddy: Vec2, sampler: &Sampler) -> Vec4 {
        sample::sample(self, uv, ddx, ddy, sampler)
    }
}

/// One texel in linear light, alpha straight.
#[inline]
fn decode([r, g, b, a]: [u8; 4], format: TextureFormat) -> Vec4 {
    let unorm = |byte: u8| f32::from(byte) / 255.0;
    match format {
        TextureFormat::Srgb => Vec4::new(
            color::srgb8_to_linear(r),
            color::srgb8_to_linear(g),
            color::srgb8_to_linear(b),
            unorm(a),
        ),
        TextureFormat::Linear => Vec4::new(unorm(r), unorm(g), unorm(b), unorm(a)),
    }
}
