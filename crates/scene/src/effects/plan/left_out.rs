//! Pictures without one of their effects: what the effect adds, and what it costs.

use trigon_math::Vec3;

use super::super::{Shadows, ToneMapping};
use super::Effect;
use crate::background::Background;
use crate::material::{Material, Shading};
use crate::scene::Scene;
use crate::settings::{Reflection, RenderSettings, Style};

impl Effect {
    /// The same scene and settings without the effect; `None` for one that is the
    /// scene itself and not something on top of it.
    pub fn left_out(self, scene: &Scene, settings: &RenderSettings) -> Option<(Scene, RenderSettings)> {
        let (mut scene, mut settings) = (scene.clone(), settings.clone());
        let effects = &mut settings.effects;
        match self {
            Self::Highlights => settings.reflection = Reflection::Lambert,
            Self::Environment => {
                effects.environment = None;
                if settings.background == Background::Environment {
                    settings.background = Background::default();
                }
            }
            Self::ShadowMaps | Self::ShadowRays => effects.shadows = Shadows::Off,
            Self::AmbientOcclusion => effects.ambient_occlusion = None,
            Self::Reflection | Self::Refraction => effects.bounces = 0,
            Self::Fog => effects.fog = None,
            Self::ToneMapping => (effects.exposure, effects.tone_mapping) = (0.0, ToneMapping::None),
            Self::Outline => effects.outline = None,
            Self::Edges => settings.style = Style::Surface,
            Self::Textures | Self::NormalMaps | Self::OcclusionMaps | Self::Emission => {
                scene.materials.iter_mut().for_each(|(_, material)| self.strip(material));
            }
            Self::Lamps
            | Self::AmbientLight
            | Self::VertexColors
            | Self::Masks
            | Self::Transparency
            | Self::Poses => return None,
        }
        Some((scene, settings))
    }

    /// Takes from a material what an effect of materials needs.
    fn strip(self, material: &mut Material) {
        match self {
            Self::NormalMaps => material.normal_map = None,
            Self::OcclusionMaps => material.occlusion = None,
            Self::Emission => (material.emissive, material.emissive_texture) = (Vec3::ZERO, None),
            _ => {
                (material.base_color_texture, material.emissive_texture) = (None, None);
                material.transmission_texture = None;
                strip_shading(&mut material.shading);
            }
        }
    }
}

fn strip_shading(shading: &mut Shading) {
    match shading {
        Shading::Unlit | Shading::Lambert => {}
        Shading::BlinnPhong { specular_texture, .. } => *specular_texture = None,
        Shading::MetallicRoughness(model) => {
            (model.texture, model.specular_texture, model.specular_color_texture) = (None, None, None);
        }
    }
}
