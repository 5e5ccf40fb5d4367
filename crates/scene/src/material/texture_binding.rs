//! Textures as materials use them.

use trigon_math::glam::Affine2;
use trigon_raster::Sampler;

use crate::texture_asset::TextureId;

/// A texture, its coordinates, and its sampling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureBinding {
    /// The texture. Its own format (`Texture::format`) says whether its bytes are colours or data;
    /// an image used both ways is two textures.
    pub texture: TextureId,
    /// The UV set of the mesh. A mesh without it shows no texture.
    pub uv_set: usize,
    /// Applied to the coordinates before sampling (v grows downwards).
    pub transform: Affine2,
    /// Wrapping and filtering.
    pub sampler: Sampler,
}

impl TextureBinding {
    /// The texture on the first UV set, repeated and filtered.
    #[must_use]
    pub fn new(texture: TextureId) -> Self {
        Self { texture, uv_set: 0, transform: Affine2::IDENTITY, sampler: Sampler::default() }
    }
}

/// A normal map: red, green and blue, 0 to 1, stand for x, y and z from −1 to 1 along tangent, bitangent and
/// normal. Green points up in the image, against v (as in glTF 2.0, section 3.9.3). A mesh without tangents
/// gets them from the binding's UV set; beyond the eighth set there are none, and the map is not drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// The directions; the texture holds data.
    pub binding: TextureBinding,
    /// Multiplies x and y before the direction is normalized; 1 leaves them as they are, 0
    /// flattens, negative values invert bumps.
    pub scale: f32,
}

/// A map of how much ambient light reaches the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occlusion {
    /// Red is the fraction that arrives; the texture holds data. Light from lamps is not reduced.
    pub binding: TextureBinding,
    /// 0 (no effect) to 1 (as in the texture): the factor on ambient light is `1 + strength · (red
    /// − 1)`.
    pub strength: f32,
}
