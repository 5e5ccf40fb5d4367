//! The texture slots of a material.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::{
    Material, MetallicRoughness, NormalMap, Occlusion, Shading, TextureBinding, TextureFormat,
};

/// The use of a texture in a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TextureSlot {
    /// Colour and alpha.
    #[default]
    BaseColor,
    /// Green: roughness. Blue: metalness.
    MetallicRoughness,
    /// A normal map.
    Normal,
    /// Red: the fraction of ambient light that arrives.
    Occlusion,
    /// The colour of emitted light.
    Emissive,
}

impl TextureSlot {
    /// Whether its textures hold colours or data.
    pub(super) fn format(self) -> TextureFormat {
        match self {
            Self::BaseColor | Self::Emissive => TextureFormat::Srgb,
            Self::MetallicRoughness | Self::Normal | Self::Occlusion => TextureFormat::Linear,
        }
    }

    /// The texture of a material in this slot.
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
        // The texture multiplies both.
        _ if binding.is_some() => {
            let model =
                MetallicRoughness { metallic: 1.0, roughness: 1.0, texture: binding, ..Default::default() };
            *shading = Shading::MetallicRoughness(model);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use trigon_scene::{Scene, Texture};

    use super::*;

    #[test]
    fn a_texture_of_metalness_leaves_the_factors_of_a_metal_as_they_are() {
        let metal = MetallicRoughness { metallic: 0.25, roughness: 0.75, ..Default::default() };
        let texture = Texture::new(1, 1, vec![[0, 128, 128, 255]], TextureFormat::Linear).expect("one texel");
        let binding = TextureBinding::new(Scene::new().add_texture("metal", texture));
        for (shading, factors) in
            [(Shading::MetallicRoughness(metal), [0.25, 0.75]), (Shading::Lambert, [1.0, 1.0])]
        {
            let mut material = Material { shading, ..Material::default() };
            TextureSlot::MetallicRoughness.bind(&mut material, Some(binding));
            assert_eq!(TextureSlot::MetallicRoughness.of(&material), Some(binding), "{shading:?}");
            let Shading::MetallicRoughness(model) = material.shading else {
                panic!("{shading:?} has no metal")
            };
            assert_eq!([model.metallic, model.roughness], factors, "{shading:?}");
        }
    }
}
