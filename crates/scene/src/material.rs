//! Materials: the colour of a surface and how it answers to light.

use trigon_math::glam::Affine2;
use trigon_math::{Vec3, Vec4};
use trigon_raster::Sampler;

use crate::scene::TextureId;

/// How a surface answers to light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shading {
    /// The base colour as it is; light does not matter.
    Unlit,
    /// Diffuse reflection: base colour × N·L (Lambert 1760).
    Lambert,
    /// Lambert plus a highlight `specular · (N·H)^shininess · N·L`
    /// (Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977).
    BlinnPhong {
        /// Linear RGB of the highlight; may exceed 1 for sharp highlights.
        specular: Vec3,
        /// The exponent: 0 is as wide as the diffuse light, 1000 a pinprick.
        shininess: f32,
    },
}

/// What the alpha of the base colour means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Nothing: the surface is opaque.
    Opaque,
    /// Below the cutoff there is a hole, elsewhere the surface is opaque.
    Mask {
        /// The smallest alpha that is still surface, 0…1.
        cutoff: f32,
    },
    /// Alpha is coverage: what lies behind shows through.
    Blend,
}

/// A texture, how its coordinates are found, and how it is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureBinding {
    /// The picture.
    pub texture: TextureId,
    /// Which of the mesh's UV sets.
    pub uv_set: usize,
    /// Applied to the coordinates before sampling (v grows downwards).
    pub transform: Affine2,
    /// Wrapping and filtering.
    pub sampler: Sampler,
}

impl TextureBinding {
    /// The texture on the first UV set, repeated and filtered.
    pub fn new(texture: TextureId) -> Self {
        Self { texture, uv_set: 0, transform: Affine2::IDENTITY, sampler: Sampler::default() }
    }
}

/// The look of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// For people; need not be unique.
    pub name: String,
    /// Linear RGB and straight alpha; multiplies texture and vertex colour.
    pub base_color: Vec4,
    /// Multiplies the base colour.
    pub base_color_texture: Option<TextureBinding>,
    /// The answer to light.
    pub shading: Shading,
    /// Linear RGB that the surface sends out by itself.
    pub emissive: Vec3,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Whether back faces are drawn; their normals then point at the viewer.
    pub double_sided: bool,
}

impl Default for Material {
    /// A light grey plastic, drawn from both sides.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: Vec4::new(0.8, 0.8, 0.8, 1.0),
            base_color_texture: None,
            shading: Shading::BlinnPhong { specular: Vec3::splat(0.2), shininess: 30.0 },
            emissive: Vec3::ZERO,
            alpha_mode: AlphaMode::Opaque,
            double_sided: true,
        }
    }
}

impl Material {
    /// The default plastic in a linear RGB colour.
    pub fn from_color(color: Vec3) -> Self {
        Self { base_color: color.extend(1.0), ..Self::default() }
    }

    /// The default plastic with a texture on its first UV set.
    pub fn from_texture(texture: TextureId) -> Self {
        Self {
            base_color: Vec4::ONE,
            base_color_texture: Some(TextureBinding::new(texture)),
            ..Self::default()
        }
    }

    /// The same material under another name.
    pub fn with_name(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same material with another answer to light.
    pub fn with_shading(self, shading: Shading) -> Self {
        Self { shading, ..self }
    }
}
