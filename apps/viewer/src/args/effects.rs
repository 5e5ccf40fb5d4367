//! Flags of effects: shadows, ambient light, mist, tones; and of the shading model.
//! Names follow F3D where it has such a thing.

use std::path::PathBuf;
use std::sync::Arc;

use clap::ValueEnum;
use trigon_math::Vec3;
use trigon_scene::{
    AmbientOcclusion, EffectSettings, Environment, Fog, Reflection, RenderSettings, ShadingModel, Shadows,
    Sky, ToneMapping,
};

use super::values;

/// Flags of effects.
#[derive(Debug, clap::Args)]
pub(crate) struct EffectArgs {
    /// Where on surfaces light is found: flat is once for each triangle, gouraud at its corners, phong at each pixel (not in F3D)
    #[arg(long, value_name = "MODEL", default_value = "phong", help_heading = "Effects")]
    pub(crate) shading: ShadingArg,

    /// By which law surfaces answer to light, instead of the one that their materials name (not in F3D)
    #[arg(long, value_name = "LAW", default_value = "material", help_heading = "Effects")]
    pub(crate) reflection: ReflectionArg,

    /// How lamps cast shadows: maps are quick, rays exact (not in F3D)
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "maps", default_value = "off", value_name = "WAY", help_heading = "Effects")]
    pub(crate) shadows: ShadowsArg,

    /// Width and height of shadow maps in texels (not in F3D)
    #[arg(long, value_name = "TEXELS", default_value = "2048", value_parser = clap::value_parser!(u32).range(16..=8192), allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) shadow_resolution: u32,

    /// Darken ambient light where the surroundings are near, by rays
    #[arg(long, short = 'q', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) ambient_occlusion: Option<bool>,

    /// Rays of each sample for ambient occlusion (not in F3D)
    #[arg(long, value_name = "N", default_value = "16", value_parser = clap::value_parser!(u32).range(1..=256), allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) ambient_occlusion_rays: u32,

    /// How far surroundings count for ambient occlusion, in metres (not in F3D)
    #[arg(long, value_name = "METRES", default_value = "1", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) ambient_occlusion_distance: f32,

    /// Light the model by a clear sky (not in F3D)
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) sky: Option<bool>,

    /// Light the model by a Radiance picture (.hdr) of all directions; it is not shown behind the model
    #[arg(long, value_name = "FILE", conflicts_with = "sky", help_heading = "Effects")]
    pub(crate) hdri_file: Option<PathBuf>,

    /// Follow rays of sight so many times at mirrors (metals without roughness) and through glass (not in F3D)
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u32).range(0..=16), allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) bounces: u32,

    /// Mist that leaves exp(-DENSITY × distance) of what is seen; per metre (not in F3D)
    #[arg(long, value_name = "DENSITY", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) fog: Option<f32>,

    /// Colour of the mist (not in F3D)
    #[arg(long, value_name = "COLOR", default_value = "#b8bec6", value_parser = values::color, help_heading = "Effects")]
    pub(crate) fog_color: Vec3,

    /// Make the picture brighter by so many stops; 1 is twice as bright (not in F3D)
    #[arg(long, value_name = "STOPS", default_value = "0", value_parser = values::stops, allow_hyphen_values = true, help_heading = "Effects")]
    pub(crate) exposure: f32,

    /// Show light brighter than white by Khronos PBR Neutral
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) tone_mapping: Option<bool>,

    /// Say which effects the model calls for and why, instead of drawing; with =time also what each of them costs (not in F3D)
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "reasons", value_name = "WHAT", help_heading = "Effects")]
    pub(crate) explain: Option<Explanation>,
}

/// Where light is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShadingArg {
    Flat,
    Gouraud,
    Phong,
}

/// By which law surfaces answer to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReflectionArg {
    Material,
    Lambert,
    BlinnPhong,
    MetallicRoughness,
}

/// How shadows are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShadowsArg {
    Off,
    Maps,
    Rays,
}

/// What is said about effects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Explanation {
    /// Why each is on or off
    Reasons,
    /// And how long a picture takes with and without it
    Time,
}

impl EffectArgs {
    /// Puts them into the settings.
    pub(crate) fn apply(&self, settings: &mut RenderSettings) {
        settings.shading = match self.shading {
            ShadingArg::Flat => ShadingModel::Flat,
            ShadingArg::Gouraud => ShadingModel::Gouraud,
            ShadingArg::Phong => ShadingModel::Phong,
        };
        settings.reflection = match self.reflection {
            ReflectionArg::Material => Reflection::Material,
            ReflectionArg::Lambert => Reflection::Lambert,
            ReflectionArg::BlinnPhong => Reflection::BlinnPhong,
            ReflectionArg::MetallicRoughness => Reflection::MetallicRoughness,
        };
        let on = |switch: Option<bool>| switch == Some(true);
        settings.effects = EffectSettings {
            shadows: match self.shadows {
                ShadowsArg::Off => Shadows::Off,
                ShadowsArg::Maps => Shadows::Maps { resolution: self.shadow_resolution },
                ShadowsArg::Rays => Shadows::Rays,
            },
            ambient_occlusion: on(self.ambient_occlusion).then_some(AmbientOcclusion {
                rays: self.ambient_occlusion_rays,
                distance: self.ambient_occlusion_distance,
            }),
            environment: on(self.sky).then(|| Arc::new(Environment::from_sky(&Sky::default()))),
            bounces: self.bounces,
            fog: self.fog.map(|density| Fog { color: self.fog_color, density }),
            exposure: self.exposure,
            tone_mapping: if on(self.tone_mapping) {
                ToneMapping::KhronosPbrNeutral
            } else {
                ToneMapping::None
            },
            outline: None,
        };
    }
}
