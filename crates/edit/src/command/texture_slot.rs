//! Where a material has pictures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::{
    Material, MetallicRoughness, NormalMap, Occlusion, Shading, TextureBinding, TextureFormat,
};

/// What a picture of a material says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TextureSlot {
    /// Its colour and alpha.
    #[default]
    BaseColor,
    /// Green: how rough it is. Blue: how metallic.
    MetallicRoughness,
    /// Directions that bend its normals.
    Normal,
    /// Red: how much light from everywhere arrives.
    Occlusion,
    /// The colour of light that it sends out.
    Emissive,
}

impl TextureSlot {
    /// Whether its pictures hold colours or data.
    pub(super) fn format(self) -> TextureFormat {
        match self {
            Self::BaseColor | Self::Emissive => TextureFormat::Srgb,
            Self::MetallicRoughness | Self::Normal | Self::Occlusion => TextureFormat::Linear,
        }
    }

    /// The picture that a material has there.
    #[must_use]
    pub fn of(self, material: &Material) -> Option<TextureBinding> {
        match self {
            Self::BaseColor => material.base_color_texture,
            Self::MetallicRoughness => match material.shading {
                Shading::MetallicRoughness(model) => model.texture,
                Shading::Unlit | Shading::Lambert | Shading::BlinnPhong { .. } => None,
            },
            Self::Normal => material.normal_map.map(|map| map.binding),
            Self::Occlusion => material.occlusion.map(|map| map.binding),
            Self::Emissive => material.emissive_texture,
        }
    }

    pub(super) fn bind(self, material: &mut Material, binding: Option<TextureBinding>) {
        match self {
            Self::BaseColor => material.base_color_texture = binding,
            Self::MetallicRoughness => bind_metallic_roughness(&mut material.shading, binding),
            Self::Normal => {
                let scale = material.normal_map.map_or(1.0, |map| map.scale);
                material.normal_map = binding.map(|binding| NormalMap { binding, scale });
            }
            Self::Occlusion => {
                let strength = material.occlusion.map_or(1.0, |map| map.strength);
                material.occlusion = binding.map(|binding| Occlusion { binding, strength });
            }
            Self::Emissive => material.emissive_texture = binding,
        }
    }
}

fn bind_metallic_roughness(shading: &mut Shading, binding: Option<TextureBinding>) {
    match shading {
        Shading::MetallicRoughness(model) => model.texture = binding,
        // The picture multiplies both.
        _ if binding.is_some() => {
            let model =
                MetallicRoughness { metallic: 1.0, roughness: 1.0, texture: binding, ..Default::default() };
            *shading = Shading::MetallicRoughness(model);
        }
        _ => {}
    }
}
