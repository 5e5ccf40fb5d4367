//! Materials: the colour of a surface and how it reflects light.
//!
//! A texture is listed once, as a row of [`MaterialTexture`], and a parameter that glTF keeps in an
//! extension once, as a row of [`Material::EXTENSION_PARAMETERS`]. Planner, renderer, importers,
//! exporters, captures and checks walk these lists.

mod css_color;
mod shading;
mod texture_row;

use trigon_math::{Vec3, Vec4};
use trigon_raster::TextureFormat;

pub use css_color::{ColorError, css_color};
pub use shading::{ExtensionParameter, MetallicRoughness, ParameterField, Shading};
pub(crate) use texture_row::DrawnIf;
pub use texture_row::{NormalMap, Occlusion, TextureBinding};
use texture_row::{TextureRow, texture_rows};

use crate::arena::Id;
use crate::effect::Effect;
use crate::texture_asset::TextureId;
use crate::work::keeps_unseen;

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
    /// The thickness of the volume under a transmissive surface, in units of the mesh; with 0
    /// (default) the surface is thin, and bends no light: KHR_materials_volume. Only a surface with
    /// open edges needs the number: within a closed one, rays find how far they go.
    pub thickness: f32,
    /// Green multiplies `thickness`; the texture holds data.
    pub thickness_texture: Option<TextureBinding>,
    /// The distance in metres within the volume after which white light has `attenuation_color`;
    /// infinite (default) in a volume that absorbs nothing.
    pub attenuation_distance: f32,
    /// Linear RGB, 0 to 1.
    pub attenuation_color: Vec3,
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
            thickness: 0.0,
            thickness_texture: None,
            attenuation_distance: f32::INFINITY,
            attenuation_color: Vec3::ONE,
            ior: 1.5,
        }
    }
}

impl Material {
    /// The default plastic in a linear RGB colour.
    #[must_use]
    pub fn from_color(color: Vec3) -> Self {
        Self { base_color: color.extend(1.0), ..Self::default() }
    }

    /// The default plastic with a texture on its first UV set.
    #[must_use]
    pub fn from_texture(texture: TextureId) -> Self {
        Self {
            base_color: Vec4::ONE,
            base_color_texture: Some(TextureBinding::new(texture)),
            ..Self::default()
        }
    }

    /// The same material under another name.
    #[must_use]
    pub fn with_name(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same material with another shading.
    #[must_use]
    pub fn with_shading(self, shading: Shading) -> Self {
        Self { shading, ..self }
    }

    /// The texture in one of its places.
    #[must_use]
    pub fn texture(&self, slot: MaterialTexture) -> Option<TextureBinding> {
        (slot.row().get)(self)
    }

    /// Sets or removes the texture in one of its places. A place that the shading model does not have
    /// is left as it is.
    pub fn set_texture(&mut self, slot: MaterialTexture, binding: Option<TextureBinding>) {
        (slot.row().set)(self, binding);
    }

    /// All its textures.
    pub fn textures(&self) -> impl Iterator<Item = (MaterialTexture, TextureBinding)> {
        MaterialTexture::ALL.into_iter().filter_map(|slot| Some((slot, self.texture(slot)?)))
    }

    /// Replaces every texture by the one that `replace` returns for it, and removes those for which it
    /// returns none.
    pub(crate) fn replace_textures(&mut self, replace: impl Fn(TextureId) -> Option<TextureId>) {
        for slot in MaterialTexture::ALL {
            if let Some(binding) = self.texture(slot) {
                let replaced = replace(binding.texture);
                self.set_texture(slot, replaced.map(|texture| TextureBinding { texture, ..binding }));
            }
        }
    }

    /// All parameters that glTF keeps in extensions and that are plain numbers, colours and textures,
    /// those of one extension next to each other.
    pub const EXTENSION_PARAMETERS: &[ExtensionParameter] = &[
        ExtensionParameter::share("KHR_materials_specular", "specularFactor", |material| {
            material.shading.metallic_roughness_mut().map(|model| &mut model.specular)
        }),
        ExtensionParameter::color("KHR_materials_specular", "specularColorFactor", |material| {
            material.shading.metallic_roughness_mut().map(|model| &mut model.specular_color)
        }),
        ExtensionParameter::texture("KHR_materials_specular", "specularTexture", MaterialTexture::Specular),
        ExtensionParameter::texture(
            "KHR_materials_specular",
            "specularColorTexture",
            MaterialTexture::SpecularColor,
        ),
        ExtensionParameter::share("KHR_materials_transmission", "transmissionFactor", |material| {
            Some(&mut material.transmission)
        }),
        ExtensionParameter::texture(
            "KHR_materials_transmission",
            "transmissionTexture",
            MaterialTexture::Transmission,
        ),
        ExtensionParameter::amount("KHR_materials_volume", "thicknessFactor", |material| {
            Some(&mut material.thickness)
        }),
        ExtensionParameter::texture("KHR_materials_volume", "thicknessTexture", MaterialTexture::Thickness),
        ExtensionParameter::amount("KHR_materials_volume", "attenuationDistance", |material| {
            Some(&mut material.attenuation_distance)
        }),
        ExtensionParameter::color("KHR_materials_volume", "attenuationColor", |material| {
            Some(&mut material.attenuation_color)
        }),
    ];
}

texture_rows! {
    /// RGBA multiplies [`Material::base_color`].
    BaseColor => TextureRow {
        format: TextureFormat::Srgb,
        effect: Effect::Textures,
        drawn_if: DrawnIf::Always,
        // Its alpha shows where alpha does.
        matters: |material| {
            material.base_color.truncate() != Vec3::ZERO || material.alpha_mode != AlphaMode::Opaque
        },
        get: |material| material.base_color_texture,
        set: |material, binding| material.base_color_texture = binding,
    },
    /// RGB multiplies the highlight of [`Shading::BlinnPhong`].
    Highlight => TextureRow {
        format: TextureFormat::Srgb,
        effect: Effect::Textures,
        drawn_if: DrawnIf::LightInPixels,
        matters: |material| material.shading.has_highlight(),
        get: |material| material.shading.highlight_texture(),
        set: |material, binding| {
            if let Some(texture) = material.shading.highlight_texture_mut() {
                *texture = binding;
            }
        },
    },
    /// Green multiplies [`MetallicRoughness::roughness`], blue [`MetallicRoughness::metallic`].
    MetallicRoughness => TextureRow {
        format: TextureFormat::Linear,
        effect: Effect::Textures,
        drawn_if: DrawnIf::LightInPixels,
        matters: |material| material.shading.metallic_roughness().is_some_and(MetallicRoughness::varies_by_texture),
        get: |material| material.shading.metallic_roughness().and_then(|model| model.texture),
        set: |material, binding| {
            if let Some(model) = material.shading.metallic_roughness_mut() {
                model.texture = binding;
            }
        },
    },
    /// Alpha multiplies [`MetallicRoughness::specular`].
    Specular => TextureRow {
        format: TextureFormat::Linear,
        effect: Effect::Textures,
        drawn_if: DrawnIf::LightInPixels,
        matters: |material| material.shading.metallic_roughness().is_some_and(|model| model.specular != 0.0),
        get: |material| material.shading.metallic_roughness().and_then(|model| model.specular_texture),
        set: |material, binding| {
            if let Some(model) = material.shading.metallic_roughness_mut() {
                model.specular_texture = binding;
            }
        },
    },
    /// RGB multiplies [`MetallicRoughness::specular_color`].
    SpecularColor => TextureRow {
        format: TextureFormat::Srgb,
        effect: Effect::Textures,
        drawn_if: DrawnIf::LightInPixels,
        // An index of refraction of 1 reflects nothing.
        matters: |material| {
            let is_colored = |model: &MetallicRoughness| model.specular != 0.0 && model.specular_color != Vec3::ZERO;
            material.ior != 1.0 && material.shading.metallic_roughness().is_some_and(is_colored)
        },
        get: |material| material.shading.metallic_roughness().and_then(|model| model.specular_color_texture),
        set: |material, binding| {
            if let Some(model) = material.shading.metallic_roughness_mut() {
                model.specular_color_texture = binding;
            }
        },
    },
    /// The directions of [`Material::normal_map`].
    Normal => TextureRow {
        format: TextureFormat::Linear,
        effect: Effect::NormalMaps,
        drawn_if: DrawnIf::TangentsInPixels,
        matters: |material| material.normal_map.is_some_and(|map| map.scale != 0.0),
        get: |material| material.normal_map.map(|map| map.binding),
        set: |material, binding| {
            let scale = material.normal_map.map_or(1.0, |map| map.scale);
            material.normal_map = binding.map(|binding| NormalMap { binding, scale });
        },
    },
    /// The share of ambient light that arrives: [`Material::occlusion`].
    Occlusion => TextureRow {
        format: TextureFormat::Linear,
        effect: Effect::OcclusionMaps,
        drawn_if: DrawnIf::AmbientLightInPixels,
        matters: |material| material.occlusion.is_some_and(|map| map.strength != 0.0),
        get: |material| material.occlusion.map(|map| map.binding),
        set: |material, binding| {
            let strength = material.occlusion.map_or(1.0, |map| map.strength);
            material.occlusion = binding.map(|binding| Occlusion { binding, strength });
        },
    },
    /// Red multiplies [`Material::transmission`].
    Transmission => TextureRow {
        format: TextureFormat::Linear,
        effect: Effect::Refraction,
        drawn_if: DrawnIf::Refracting,
        matters: |material| material.transmission != 0.0,
        get: |material| material.transmission_texture,
        set: |material, binding| material.transmission_texture = binding,
    },
    /// Green multiplies [`Material::thickness`].
    Thickness => TextureRow {
        format: TextureFormat::Linear,
        effect: Effect::Refraction,
        drawn_if: DrawnIf::Refracting,
        matters: |material| material.thickness > 0.0,
        get: |material| material.thickness_texture,
        set: |material, binding| material.thickness_texture = binding,
    },
    /// RGB multiplies [`Material::emissive`].
    Emissive => TextureRow {
        format: TextureFormat::Srgb,
        effect: Effect::Emission,
        drawn_if: DrawnIf::Always,
        matters: |material| material.emissive != Vec3::ZERO,
        get: |material| material.emissive_texture,
        set: |material, binding| material.emissive_texture = binding,
    },
}
