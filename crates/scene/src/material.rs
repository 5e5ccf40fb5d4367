//! Materials: the colour of a surface and how it reflects light.

mod shading;
mod texture_binding;

use trigon_math::{Vec3, Vec4};

pub use shading::{MetallicRoughness, Shading};
pub use texture_binding::{NormalMap, Occlusion, TextureBinding};

use crate::arena::Id;
use crate::texture_asset::TextureId;

/// Identifies a material.
pub type MaterialId = Id<Material>;

/// What the alpha of the base colour means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Ignored: the surface is opaque.
    Opaque,
    /// Below the cutoff there is a hole; elsewhere the surface is opaque.
    Mask {
        /// The smallest alpha that counts as surface, 0…1.
        cutoff: f32,
    },
    /// Alpha is coverage: the surface is blended with what lies behind it.
    Blend,
}

/// The appearance of a surface.
///
/// A factor and its texture are multiplied. Colour textures have the format `Srgb`, data textures
/// the format `Linear`.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// A display name; need not be unique.
    pub name: String,
    /// Linear RGB and straight alpha; multiplies texture and vertex colour.
    pub base_color: Vec4,
    /// RGBA multiplies the base colour; the texture holds colours.
    pub base_color_texture: Option<TextureBinding>,
    /// How the surface reflects light.
    pub shading: Shading,
    /// Linear RGB of emitted light, at least 0; 1 is the white of the display. Includes glTF's
    /// emissive strength.
    pub emissive: Vec3,
    /// RGB multiplies `emissive`; the texture holds colours.
    pub emissive_texture: Option<TextureBinding>,
    /// Perturbs the normals.
    pub normal_map: Option<NormalMap>,
    /// Reduces ambient light in crevices.
    pub occlusion: Option<Occlusion>,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Whether back faces are drawn; their normals then point towards the viewer.
    pub double_sided: bool,
    /// The fraction of light that passes through the surface instead of being diffusely reflected,
    /// 0 (default) to 1: KHR_materials_transmission. Only rays follow it.
    pub transmission: f32,
    /// Red multiplies `transmission`; the texture holds data.
    pub transmission_texture: Option<TextureBinding>,
    /// Index of refraction of a dielectric: at least 1, or 0 for a surface that reflects
    /// everything. It bends transmitted rays and determines the head-on reflectance of
    /// metallic-roughness surfaces: ((ior − 1) / (ior + 1))², 4 % with the default of 1.5.
    pub ior: f32,
}

impl Default for Material {
    /// A light grey plastic, double-sided.
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

    /// The same material with another shading.
    pub fn with_shading(self, shading: Shading) -> Self {
        Self { shading, ..self }
    }

    /// Replaces every texture by the one that `exchange` returns; `None` removes it.
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
