//! Textures: images on surfaces, their mip levels, and looking them up with filters.
//!
//! In the order of a look-up:
//!
//! | file | what it does |
//! |---|---|
//! | `sampler` | the settings of a look-up: wrap modes, filters; what the bytes of texels mean |
//! | `dual` | computed texture coordinates with their derivatives |
//! | `detail` | the footprint of a fragment: **which mip level**, how many anisotropic probes |
//! | `axis` | wraps a coordinate and finds the texel and the weight of the next one, on one axis |
//! | `strips` | makes the mip levels; where texels lie in memory: **the address** of a texel; bytes to channels in lanes |
//! | `sample` | **the look-up for one point**, filter included: the definition |
//! | `lanes` | the same for eight points, bit for bit |

mod axis;
mod detail;
mod dual;
mod lanes;
#[cfg(test)]
mod same_bits;
mod sample;
mod sampler;
mod strips;

pub use dual::Dual;
pub use sampler::{Filter, MAX_ANISOTROPY, MipFilter, Sampler, TextureFormat, Wrap};

use strips::{LevelRows, Strips};
use thiserror::Error;

/// The largest width and height of a texture.
pub const MAX_TEXTURE_SIZE: u32 = 16384;

/// Why a texture cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
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

/// An RGBA image with its mip levels, down to one texel.
///
/// Coordinates: (0, 0) is the corner of the first texel, at the top left, and
/// (1, 1) the far corner of the last.
#[derive(Clone, Debug)]
pub struct Texture {
    format: TextureFormat,
    strips: Strips,
    /// Whether every texel is opaque: then alpha need not be looked up.
    opaque: bool,
}

impl Texture {
    /// A texture from row-major texels, top row first, with all its mip levels.
    ///
    /// Each level halves the one before (rounded down, at least 1) by a box filter in linear light, exact for
    /// any size. Colours are weighted by their alpha, so that what is transparent does not bleed.
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
        let opaque = texels.iter().all(|&[.., alpha]| alpha == u8::MAX);
        let base = LevelRows { width, height, texels };
        Ok(Self { format, strips: Strips::new(base, |rows| strips::halved(rows, format)), opaque })
    }

    /// Width of the base level in texels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.strips.width
    }

    /// Height of the base level in texels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.strips.height
    }

    /// How many mip levels there are, the base included.
    #[must_use]
    pub fn level_count(&self) -> usize {
        self.strips.last_level as usize + 1
    }

    /// What the bytes mean.
    #[must_use]
    pub fn format(&self) -> TextureFormat {
        self.format
    }

    /// Whether every texel is opaque. A look-up then returns an alpha of exactly 1, whatever its filter.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.opaque
    }

    /// The texels of the base level, row by row from the top: what
    /// [`Texture::new`] was given.
    pub fn texels(&self) -> impl Iterator<Item = [u8; 4]> + '_ {
        let (width, height) = (self.width(), self.height());
        (0..height).flat_map(move |y| (0..width).map(move |x| self.strips.base_texel([x, y])))
    }
}
