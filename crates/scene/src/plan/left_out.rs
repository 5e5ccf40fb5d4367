//! The same scene and settings without one of their effects, to see what it adds and costs.

use trigon_math::Vec3;

use crate::effect::Effect;
use crate::effect_settings::{Exposure, MetalReflection, Shadows, SightRays, ToneMapping};
use crate::material::{Material, MaterialTexture};
use crate::node::{Node, NodeId};
use crate::scene::Scene;
use crate::settings::{Background, Reflection, RenderSettings, Style};

impl Effect {
    /// The same scene and settings without the effect; `None` for an effect that is part of the
    /// scene itself.
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
            Self::MetalStudio => effects.metal_reflection = MetalReflection::Ambient,
            Self::ShadowMaps | Self::ShadowRays => effects.shadows = Shadows::Off,
            Self::SoftShadows => {
                effects.soft_shadows.radius = 0.0;
                make_lamps_points(&mut scene);
            }
            Self::AmbientOcclusion => effects.ambient_occlusion = None,
            Self::Reflection => {
                effects.sight = match effects.sight {
                    SightRays::All { bounces } => SightRays::Glass { bounces },
                    other => other,
                };
            }
            Self::Refraction => each_material(&mut scene, |material| material.transmission = 0.0),
            Self::Fog => effects.fog = None,
            Self::LightMeter => effects.exposure = Exposure::Stops(0.0),
            Self::ToneMapping => {
                effects.tone_mapping = ToneMapping::None;
                if let Exposure::Stops(stops) = &mut effects.exposure {
                    *stops = 0.0;
                }
            }
            Self::Outline => effects.outline = None,
            Self::Edges => settings.style = Style::Surface,
            Self::Textures => each_material(&mut scene, strip_textures),
            Self::NormalMaps => each_material(&mut scene, |material| material.normal_map = None),
            Self::OcclusionMaps => each_material(&mut scene, |material| material.occlusion = None),
            Self::Emission => each_material(&mut scene, |material| {
                (material.emissive, material.emissive_texture) = (Vec3::ZERO, None);
            }),
            Self::Lamps
            | Self::AmbientLight
            | Self::VertexColors
            | Self::Masks
            | Self::Transparency
            | Self::Poses => return None,
        }
        Some((scene, settings))
    }
}

fn make_lamps_points(scene: &mut Scene) {
    let has_extent = |node: &Node| node.light.as_ref().is_some_and(|light| light.radius != 0.0);
    let soft: Vec<NodeId> =
        scene.nodes().iter().filter(|(_, node)| has_extent(node)).map(|(id, _)| id).collect();
    for id in soft {
        if let Some(light) = scene.node_mut(id).and_then(|node| node.light.as_mut()) {
            light.radius = 0.0;
        }
    }
}

fn each_material(scene: &mut Scene, change: impl Fn(&mut Material)) {
    scene.materials.iter_mut().for_each(|(_, material)| change(material));
}

/// Removes all textures except normal and occlusion maps, which are separate effects.
fn strip_textures(material: &mut Material) {
    for slot in MaterialTexture::ALL {
        if !matches!(slot.row().effect, Effect::NormalMaps | Effect::OcclusionMaps) {
            material.set_texture(slot, None);
        }
    }
}
