//! Materials: the colour of a surface and how it answers to light.

mod shading;
mod texture_binding;

use trigon_math::{Vec3, Vec4};

pub use shading::{MetallicRoughness, Shading};
pub use texture_binding::{NormalMap, Occlusion, TextureBinding};

use crate::arena::Id;
use crate::texture_asset::TextureId;

/// Names a material.
pub type MaterialId = Id<Material>;

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

/// The look of a surface.
///
/// A factor and its texture multiply each other. A texture of colours is one
/// in the format `Srgb`, a texture of data one in the format `Linear`.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// For people; need not be unique.
    pub name: String,
    /// Linear RGB and straight alpha; multiplies texture and vertex colour.
    pub base_color: Vec4,
    /// RGBA multiplies the base colour; the picture holds colours.
    pub base_color_texture: Option<TextureBinding>,
    /// The answer to light.
    pub shading: Shading,
    /// Linear RGB that the surface sends out by itself, at least 0; 1 is the
    /// white of the display. glTF's emissive strength is multiplied in.
    pub emissive: Vec3,
    /// RGB multiplies `emissive`; the picture holds colours.
    pub emissive_texture: Option<TextureBinding>,
    /// Bends the normals.
    pub normal_map: Option<NormalMap>,
    /// Keeps ambient light from crevices.
    pub occlusion: Option<Occlusion>,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Whether back faces are drawn; their normals then point at the viewer.
    pub double_sided: bool,
    /// The share of light that passes through the surface instead of being
    /// diffusely reflected, 0 (default) to 1: KHR_materials_transmission. Only
    /// rays follow it.
    pub transmission: f32,
    /// Red multiplies `transmission`; the picture holds data.
    pub transmission_texture: Option<TextureBinding>,
    /// Index of refraction of a dielectric: at least 1, or 0 for a surface
    /// that reflects everything. It bends transmitted rays and sets what
    /// metallic-roughness reflects head-on: ((ior − 1) / (ior + 1))², 4 % with
    /// the default of 1.5.
    pub ior: f32,
}

impl Default for Material {
    /// A light grey plastic, drawn from both sides.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: Vec4::new(0.8, 0.8, 0.8, 1.0),
            base_color_texture: None,
            shading: Shading::blinn_phong(Vec3::splat(0.2), 30.0),
            emissive: Vec3::ZERO,
            emissive_texture: None,
            normal_map: None,
            occlusion: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: true,
            transmission: 0.0,
            transmission_texture: None,
            ior: 1.5,
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

    /// Exchanges every texture for the one that `exchange` names; one for
    /// which it names none is taken off.
    pub(crate) fn exchange_textures(&mut self, exchange: impl Fn(TextureId) -> Option<TextureId>) {
        let exchanged = |binding: TextureBinding| {
            exchange(binding.texture).map(|texture| TextureBinding { texture, ..binding })
        };
        let mut optional =
            vec![&mut self.base_color_texture, &mut self.emissive_texture, &mut self.transmission_texture];
        optional.extend(self.shading.textures_mut());
        for binding in optional {
            *binding = binding.and_then(exchanged);
        }
        self.normal_map = self
            .normal_map
            .and_then(|map| exchanged(map.binding).map(|binding| NormalMap { binding, ..map }));
        self.occlusion =
            self.occlusion.and_then(|map| exchanged(map.binding).map(|binding| Occlusion { binding, ..map }));
    }
}
