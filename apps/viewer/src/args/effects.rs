//! Flags for effects (shadows, ambient light, fog, tone mapping) and for the shading model. Names
//! follow F3D where it has them.

use std::path::PathBuf;
use std::sync::{Arc, LazyLock};

use clap::ValueEnum;
use trigon_math::Vec3;
use trigon_scene::{
    AmbientOcclusion, Background, EffectSettings, Environment, Exposure, Fog, MetalReflection, RaySampling,
    Reflection, RenderSettings, ShadingModel, Shadows, SightRays, Sky, SoftShadows, ToneMapping,
};

use super::quality::Insisted;
use super::values;

/// Default width and height of shadow maps, in texels.
const USUAL_SHADOW_RESOLUTION: u32 = 2048;

/// Default number of rays per sample for ambient occlusion.
const USUAL_OCCLUSION_RAYS: u32 = 16;

/// Flags for effects.
#[derive(Debug, clap::Args)]
pub(crate) struct EffectArgs {
    /// Compute lighting per triangle (flat), per vertex (gouraud) or per pixel (phong) [default: phong]
    #[arg(long, value_name = "MODEL", help_heading = "Effects")]
    pub(crate) shading: Option<ShadingArg>,

    /// Use this reflection model instead of those of the materials
    #[arg(long, value_name = "LAW", default_value = "material", help_heading = "Effects")]
    pub(crate) reflection: ReflectionArg,

    /// How lamps cast shadows: maps are fast, rays exact, and on follows --preset or means maps
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "on", default_value = "off", value_name = "WAY", help_heading = "Effects")]
    pub(crate) shadows: ShadowsArg,

    /// Width and height of shadow maps in texels [default: 2048, or from --preset]
    #[arg(long, value_name = "TEXELS", value_parser = values::count::<16, 8192>, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) shadow_resolution: Option<u32>,

    /// The radius of lamps for soft shadows, in metres; of directional ones at a distance of one metre: 0.00465 for
    /// the sun. Lamps with a radius of their own have that one
    #[arg(long, value_name = "RADIUS", default_value = "0", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) light_radius: f32,

    /// Rays to each lamp with a radius, for --shadows=rays [default: 16, or from --preset]
    #[arg(long, value_name = "N", value_parser = values::count::<1, 256>, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) shadow_rays: Option<u32>,

    /// Where these rays start: full is at every sample; shared takes a fraction of the time
    /// [default: full, or from --preset]
    #[arg(long, value_name = "WAY", help_heading = "Effects")]
    pub(crate) shadow_sampling: Option<RaySamplingArg>,

    /// Darken ambient light near other surfaces, by tracing rays
    #[arg(long, short = 'q', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) ambient_occlusion: Option<bool>,

    /// Rays per sample for ambient occlusion [default: 16, or from --preset]
    #[arg(long, value_name = "N", value_parser = values::count::<1, 256>, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) ambient_occlusion_rays: Option<u32>,

    /// Where these rays start: full is at every sample; shared takes a fraction of the time, and blurs a little
    /// [default: full, or from --preset]
    #[arg(long, value_name = "WAY", help_heading = "Effects")]
    pub(crate) ambient_occlusion_sampling: Option<RaySamplingArg>,

    /// The distance within which surfaces occlude ambient light, in metres
    #[arg(long, value_name = "METRES", default_value = "1", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) ambient_occlusion_distance: f32,

    /// Light the model with a clear sky
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) sky: Option<bool>,

    /// Light the model with an environment image (Radiance, .hdr)
    #[arg(long, value_name = "FILE", conflicts_with = "sky", help_heading = "Effects")]
    pub(crate) hdri_file: Option<PathBuf>,

    /// Light the model from all around, with the image of --hdri-file or else a sky; =false keeps that image
    /// from lighting it
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) hdri_ambient: Option<bool>,

    /// Show the environment behind the model: the image of --hdri-file, or the sky
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) hdri_skybox: Option<bool>,

    /// What metals mirror if there is no environment: a grey studio, or ambient light, which leaves them dark
    #[arg(long, value_name = "WHAT", default_value = "studio", help_heading = "Effects")]
    pub(crate) metal_reflection: MetalReflectionArg,

    /// Trace what mirrors (metals without roughness) reflect and what is behind glass, up to N surfaces deep; 0
    /// draws glass as if it were opaque [default: behind glass alone, 8 or from --preset]
    #[arg(long, value_name = "N", value_parser = values::count::<0, 16>, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) bounces: Option<u32>,

    /// Fog that leaves exp(-DENSITY × distance) of the colour; per metre
    #[arg(long, value_name = "DENSITY", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Effects")]
    pub(crate) fog: Option<f32>,

    /// Colour of the fog
    #[arg(long, value_name = "COLOR", default_value = "#b8bec6", value_parser = values::color, help_heading = "Effects")]
    pub(crate) fog_color: Vec3,

    /// Brighten the image by this many stops: 1 is twice as bright, and 0 leaves all lights as they are
    /// [default: a light meter dims or brightens the lamps of the model if the display could not show what they
    /// light]
    #[arg(long, value_name = "STOPS", value_parser = values::stops, allow_hyphen_values = true, help_heading = "Effects")]
    pub(crate) exposure: Option<f32>,

    /// Tone mapping: compress light brighter than white (Khronos PBR Neutral)
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Effects")]
    pub(crate) tone_mapping: Option<bool>,

    /// List the effects that the model needs and why, instead of drawing; =time adds what each of them costs
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "reasons", value_name = "WHAT", help_heading = "Effects")]
    pub(crate) explain: Option<Explanation>,
}

/// Where lighting is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShadingArg {
    Flat,
    Gouraud,
    Phong,
}

/// The reflection model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReflectionArg {
    Material,
    Lambert,
    BlinnPhong,
    MetallicRoughness,
}

/// How shadows are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShadowsArg {
    Off,
    On,
    Maps,
    Rays,
}

/// Where rays of ambient occlusion and soft shadows start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RaySamplingArg {
    Full,
    Shared,
}

impl RaySamplingArg {
    fn sampling(self) -> RaySampling {
        match self {
            Self::Full => RaySampling::Full,
            Self::Shared => RaySampling::Shared,
        }
    }
}

/// What metals mirror.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MetalReflectionArg {
    Studio,
    Ambient,
}

/// What to print about effects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Explanation {
    /// Why each one is on or off
    Reasons,
    /// Also how long an image takes with and without it
    Time,
}

/// Light from a clear sky, made once: keys and scripts change flags often.
fn clear_sky() -> Arc<Environment> {
    static SKY: LazyLock<Arc<Environment>> =
        LazyLock::new(|| Arc::new(Environment::from_sky(&Sky::default())));
    Arc::clone(&SKY)
}

impl EffectArgs {
    /// The environment behind the model, if it lights it.
    pub(crate) fn skybox(&self) -> Result<Option<Background>, String> {
        match (self.hdri_skybox, self.hdri_ambient) {
            (Some(true), Some(false)) => Err(
                "--hdri-skybox shows the environment that lights the model; leave out --hdri-ambient=false, or --hdri-skybox"
                    .to_owned(),
            ),
            (Some(true), _) => Ok(Some(Background::Environment)),
            (None | Some(false), _) => Ok(None),
        }
    }

    /// Whether a clear sky lights the model: requested directly, or by requesting light from all
    /// around without an image.
    fn is_lit_by_sky(&self) -> bool {
        let around = self.hdri_ambient == Some(true) || self.hdri_skybox == Some(true);
        self.sky == Some(true) || (around && self.hdri_file.is_none())
    }

    /// The environment image.
    pub(crate) fn environment(&self) -> Option<PathBuf> {
        self.hdri_file.clone().filter(|_| self.hdri_ambient != Some(false))
    }

    /// The quality settings among these flags.
    pub(crate) fn insisted(&self) -> Insisted {
        Insisted {
            shading: self.shading_model(),
            shadows: match self.shadows {
                ShadowsArg::Rays => Some(Shadows::Rays),
                ShadowsArg::Maps => Some(self.shadow_maps()),
                ShadowsArg::Off | ShadowsArg::On => self.shadow_resolution.map(|_| self.shadow_maps()),
            },
            occlusion_rays: self.ambient_occlusion_rays,
            occlusion_sampling: self.ambient_occlusion_sampling.map(RaySamplingArg::sampling),
            shadow_rays: self.shadow_rays,
            shadow_sampling: self.shadow_sampling.map(RaySamplingArg::sampling),
            samples: None,
        }
    }

    fn shading_model(&self) -> Option<ShadingModel> {
        Some(match self.shading? {
            ShadingArg::Flat => ShadingModel::Flat,
            ShadingArg::Gouraud => ShadingModel::Gouraud,
            ShadingArg::Phong => ShadingModel::Phong,
        })
    }

    fn shadow_maps(&self) -> Shadows {
        Shadows::Maps { resolution: self.shadow_resolution.unwrap_or(USUAL_SHADOW_RESOLUTION) }
    }

    /// Applies them to the settings.
    pub(crate) fn apply(&self, settings: &mut RenderSettings) {
        settings.shading = self.shading_model().unwrap_or_default();
        settings.reflection = match self.reflection {
            ReflectionArg::Material => Reflection::Material,
            ReflectionArg::Lambert => Reflection::Lambert,
            ReflectionArg::BlinnPhong => Reflection::BlinnPhong,
            ReflectionArg::MetallicRoughness => Reflection::MetallicRoughness,
        };
        let usual = SoftShadows::default();
        settings.effects = EffectSettings {
            shadows: match self.shadows {
                ShadowsArg::Off => Shadows::Off,
                ShadowsArg::On | ShadowsArg::Maps => self.shadow_maps(),
                ShadowsArg::Rays => Shadows::Rays,
            },
            soft_shadows: SoftShadows {
                radius: self.light_radius,
                rays: self.shadow_rays.unwrap_or(usual.rays),
                sampling: self.shadow_sampling.map_or(usual.sampling, RaySamplingArg::sampling),
            },
            ambient_occlusion: (self.ambient_occlusion == Some(true)).then_some(AmbientOcclusion {
                rays: self.ambient_occlusion_rays.unwrap_or(USUAL_OCCLUSION_RAYS),
                distance: self.ambient_occlusion_distance,
                sampling: self.ambient_occlusion_sampling.map(RaySamplingArg::sampling).unwrap_or_default(),
            }),
            environment: self.is_lit_by_sky().then(clear_sky),
            metal_reflection: match self.metal_reflection {
                MetalReflectionArg::Studio => MetalReflection::Studio,
                MetalReflectionArg::Ambient => MetalReflection::Ambient,
            },
            sight: self.bounces.map_or_else(SightRays::default, SightRays::all),
            fog: self.fog.map(|density| Fog { color: self.fog_color, density }),
            exposure: self.exposure.map_or(Exposure::Metered, Exposure::Stops),
            tone_mapping: if self.tone_mapping == Some(true) {
                ToneMapping::KhronosPbrNeutral
            } else {
                ToneMapping::None
            },
            outline: None,
        };
    }
}
