//! Shading models (how a surface reflects light), and the parameters that glTF keeps in extensions.

use trigon_math::Vec3;

use super::{Material, MaterialTexture, TextureBinding};

/// How a surface reflects light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shading {
    /// The base colour, independent of light.
    Unlit,
    /// Diffuse reflection: base colour × N·L (Lambert 1760).
    Lambert,
    /// Lambert plus a highlight `specular · (N·H)^shininess · N·L`
    /// (Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977).
    BlinnPhong {
        /// Linear RGB of the highlight; may exceed 1 for sharp highlights.
        specular: Vec3,
        /// The exponent: 0 is as wide as diffuse light, 1000 a tiny spot.
        shininess: f32,
        /// RGB multiplies `specular`; the texture holds colours.
        specular_texture: Option<TextureBinding>,
    },
    /// A microfacet surface between metal and dielectric: GGX specular over
    /// Lambert diffuse, as glTF 2.0 defines it (appendix B).
    MetallicRoughness(MetallicRoughness),
}

impl Shading {
    /// Blinn-Phong without a texture.
    #[must_use]
    pub fn blinn_phong(specular: Vec3, shininess: f32) -> Self {
        Self::BlinnPhong { specular, shininess, specular_texture: None }
    }

    /// The model between metal and dielectric, if it is that.
    #[must_use]
    pub fn metallic_roughness(&self) -> Option<&MetallicRoughness> {
        match self {
            Self::MetallicRoughness(model) => Some(model),
            Self::Unlit | Self::Lambert | Self::BlinnPhong { .. } => None,
        }
    }

    /// The model between metal and dielectric, if it is that.
    #[must_use]
    pub fn metallic_roughness_mut(&mut self) -> Option<&mut MetallicRoughness> {
        match self {
            Self::MetallicRoughness(model) => Some(model),
            Self::Unlit | Self::Lambert | Self::BlinnPhong { .. } => None,
        }
    }

    /// Whether it has a highlight of Blinn's.
    pub(super) fn has_highlight(&self) -> bool {
        matches!(self, Self::BlinnPhong { specular, .. } if *specular != Vec3::ZERO)
    }

    /// The texture of Blinn's highlight.
    pub(super) fn highlight_texture(&self) -> Option<TextureBinding> {
        match self {
            Self::BlinnPhong { specular_texture, .. } => *specular_texture,
            Self::Unlit | Self::Lambert | Self::MetallicRoughness(_) => None,
        }
    }

    /// The texture of Blinn's highlight.
    pub(super) fn highlight_texture_mut(&mut self) -> Option<&mut Option<TextureBinding>> {
        match self {
            Self::BlinnPhong { specular_texture, .. } => Some(specular_texture),
            Self::Unlit | Self::Lambert | Self::MetallicRoughness(_) => None,
        }
    }
}

/// The metallic-roughness model of glTF 2.0 with KHR_materials_specular. The index of refraction,
/// which determines the head-on reflectance of dielectrics, belongs to the material, because
/// refraction also needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// 0 is a dielectric, 1 a metal; the base colour of a metal is that of its highlights.
    pub metallic: f32,
    /// Perceptual roughness, 0 (a mirror) to 1 (matt); the α of GGX is its square.
    pub roughness: f32,
    /// Green multiplies `roughness`, blue `metallic`; the texture holds data.
    pub texture: Option<TextureBinding>,
    /// The strength of a dielectric's highlight, 0 to 1.
    pub specular: f32,
    /// Alpha multiplies `specular`; the texture holds data.
    pub specular_texture: Option<TextureBinding>,
    /// Linear RGB of a dielectric's highlight seen head-on; at least 0, and limited so that no more
    /// light is reflected than arrives.
    pub specular_color: Vec3,
    /// RGB multiplies `specular_color`; the texture holds colours.
    pub specular_color_texture: Option<TextureBinding>,
}

impl MetallicRoughness {
    /// Whether it reflects like Lambert's surface: neither metal nor dielectric highlights show.
    pub(crate) fn is_matt(&self) -> bool {
        self.metallic == 0.0 && self.specular == 0.0
    }

    /// Whether its factors leave anything of its texture of roughness and metalness to be seen. The roughness shows in
    /// highlights alone.
    pub(super) fn varies_by_texture(&self) -> bool {
        self.metallic != 0.0 || self.roughness != 0.0 && !self.is_matt()
    }
}

impl Default for MetallicRoughness {
    /// A dielectric, half rough.
    fn default() -> Self {
        Self {
            metallic: 0.0,
            roughness: 0.5,
            texture: None,
            specular: 1.0,
            specular_texture: None,
            specular_color: Vec3::ONE,
            specular_color_texture: None,
        }
    }
}

/// A parameter of a material that glTF keeps in an extension: its name there, and its field here.
#[derive(Clone, Copy, Debug)]
pub struct ExtensionParameter {
    /// As `KHR_materials_transmission`.
    pub extension: &'static str,
    /// The member of the extension's object, as `transmissionFactor`.
    pub name: &'static str,
    /// Where it is in a material.
    pub field: ParameterField,
}

/// The field that a parameter is. It is `None` where the shading model does not have it.
#[derive(Clone, Copy, Debug)]
pub enum ParameterField {
    /// A number from 0 to 1.
    Share(fn(&mut Material) -> Option<&mut f32>),
    /// A number of at least 0; one that is infinite has no member.
    Amount(fn(&mut Material) -> Option<&mut f32>),
    /// Linear RGB, at least 0.
    Color(fn(&mut Material) -> Option<&mut Vec3>),
    /// A texture.
    Texture(MaterialTexture),
}

impl ExtensionParameter {
    pub(super) const fn share(
        extension: &'static str,
        name: &'static str,
        field: fn(&mut Material) -> Option<&mut f32>,
    ) -> Self {
        Self { extension, name, field: ParameterField::Share(field) }
    }

    pub(super) const fn amount(
        extension: &'static str,
        name: &'static str,
        field: fn(&mut Material) -> Option<&mut f32>,
    ) -> Self {
        Self { extension, name, field: ParameterField::Amount(field) }
    }

    pub(super) const fn color(
        extension: &'static str,
        name: &'static str,
        field: fn(&mut Material) -> Option<&mut Vec3>,
    ) -> Self {
        Self { extension, name, field: ParameterField::Color(field) }
    }

    pub(super) const fn texture(extension: &'static str, name: &'static str, slot: MaterialTexture) -> Self {
        Self { extension, name, field: ParameterField::Texture(slot) }
    }
}
