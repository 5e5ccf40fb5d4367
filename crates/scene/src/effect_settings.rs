//! Effects that a frame may have beyond directly lit surfaces. All except the studio that metals
//! mirror and what glass shows are off by default, and effects that are off cost nothing.

use std::sync::Arc;

use trigon_math::Vec3;

use crate::environment::Environment;
use crate::node::NodeId;

/// Effects that a frame may have beyond directly lit surfaces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EffectSettings {
    /// Whether lamps cast shadows, and how these are computed.
    pub shadows: Shadows,
    /// The shadows of lamps with an extent.
    pub soft_shadows: SoftShadows,
    /// Darkens ambient light near other surfaces.
    pub ambient_occlusion: Option<AmbientOcclusion>,
    /// Ambient light from an environment; it replaces the scene's ambient lights.
    pub environment: Option<Arc<Environment>>,
    /// What metals mirror if neither an environment nor ambient light in the scene defines their
    /// surroundings.
    pub metal_reflection: MetalReflection,
    /// The rays that show what is behind glass and in mirrors.
    pub sight: SightRays,
    /// Fog between the eye and surfaces.
    pub fog: Option<Fog>,
    /// How bright the image is.
    pub exposure: Exposure,
    /// How light brighter than the display's white is mapped.
    pub tone_mapping: ToneMapping,
    /// Drawn around nodes.
    pub outline: Option<Outline>,
}

/// How shadows are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// There are none.
    #[default]
    Off,
    /// By depth images drawn from each lamp; `docs/effects.md` explains how surfaces are kept from
    /// shadowing themselves.
    Maps {
        /// Width and height of each in texels, 16 to 8192.
        resolution: u32,
    },
    /// By a ray from each sample to each lamp, exact; to lamps with an extent by [several](SoftShadows).
    Rays,
}

/// The shadows of lamps with an [extent](crate::Light::radius), which are soft. With [`Shadows::Rays`] the fraction of the
/// rays to a lamp that arrives is the fraction of the lamp that is visible. [`Shadows::Maps`] need none of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftShadows {
    /// The [radius](crate::Light::radius) of lamps that have none of their own, the studio's among them; 0 for none.
    pub radius: f32,
    /// Rays to each of these lamps, 1 to 256: more are smoother.
    pub rays: u32,
    /// Where they start.
    pub sampling: RaySampling,
}

impl Default for SoftShadows {
    /// Of the scene's own lamps alone, with sixteen rays at every sample.
    fn default() -> Self {
        Self { radius: 0.0, rays: 16, sampling: RaySampling::Full }
    }
}

/// The rays that show what is behind glass (surfaces with [transmission](crate::Material)) and in
/// mirrors (metals without roughness). A ray that has met the maximum number of surfaces shows what
/// it would if there were no more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SightRays {
    /// None: glass is drawn as if it were opaque, and mirrors reflect nothing but light from far away.
    Off,
    /// From glass, if some is in view.
    Glass {
        /// The maximum number of surfaces that a ray meets, 1 to 16.
        bounces: u32,
    },
    /// From glass and from mirrors, and also for what glass reflects.
    All {
        /// The maximum number of surfaces that a ray meets, 1 to 16.
        bounces: u32,
    },
}

impl Default for SightRays {
    /// From glass: through two hollow bodies and on to what is behind them.
    fn default() -> Self {
        Self::Glass { bounces: 8 }
    }
}

impl SightRays {
    /// The largest useful number of surfaces.
    const MOST: u32 = 16;

    /// From glass and mirrors, or none for a maximum of 0.
    #[must_use]
    pub fn all(bounces: u32) -> Self {
        if bounces == 0 { Self::Off } else { Self::All { bounces } }
    }

    /// The maximum number of surfaces that a ray meets.
    #[must_use]
    pub fn bounces(self) -> u32 {
        match self {
            Self::Off => 0,
            Self::Glass { bounces } | Self::All { bounces } => bounces.min(Self::MOST),
        }
    }

    /// Whether mirrors have them.
    pub(crate) fn start_at_mirrors(self) -> bool {
        matches!(self, Self::All { .. }) && self.bounces() > 0
    }
}

/// What metals mirror if neither an environment nor ambient light in the scene defines their
/// surroundings. It is weighted by metalness; dielectrics look the same either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MetalReflection {
    /// The built-in studio, +Y of the world up: grey, so that metals keep their own colours, white above,
    /// and darker below. [`Lighting::Scene`](crate::Lighting::Scene) leaves it out.
    #[default]
    Studio,
    /// The ambient light, as for dielectrics: apart from the highlights of lamps, metals are nearly
    /// black.
    Ambient,
}

/// Ambient light reduced by nearby surfaces, computed with rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmbientOcclusion {
    /// Rays per pixel, 1 to 256: more are smoother.
    pub rays: u32,
    /// The distance within which surfaces count, in metres.
    pub distance: f32,
    /// Where the rays start.
    pub sampling: RaySampling,
}

impl AmbientOcclusion {
    /// With all rays at every sample. See the fields.
    #[must_use]
    pub fn new(rays: u32, distance: f32) -> Self {
        Self { rays, distance, sampling: RaySampling::Full }
    }
}

/// The largest useful number of rays of ambient occlusion, and of those to a lamp.
pub(crate) const MOST_RAYS: u32 = 256;

/// Where the rays of ambient occlusion and of soft shadows start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RaySampling {
    /// All of them at every sample.
    #[default]
    Full,
    /// At the pixels of an image of half the width and height, a sixteenth of the rays at each. Neighbours on the same
    /// surface share what they find (A. Keller and W. Heidrich, "Interleaved Sampling", 2001). It takes a fraction of
    /// the time, and occlusion narrower than a few pixels is softer. Samples whose surface the small image does not show
    /// cast a quarter of the rays themselves, and so do those at edges of shadows that are narrower than a few pixels.
    Shared,
}

/// Fog that hides distant surfaces: a surface at distance d keeps `exp(−density · d)` of its
/// colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// Linear RGB of the fog.
    pub color: Vec3,
    /// Per metre, at least 0.
    pub density: f32,
}

/// How bright an image is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// The lights are as bright as they are, unless a light meter finds that a display could not show what the
    /// scene's own lamps light: lamps in lux and candela, or very faint ones. Then these lamps, and the ambient
    /// light of the scene, are dimmed or brightened. It does not depend on the camera, so all images of a model
    /// are exposed alike. [`Scene::light_reading`](crate::Scene::light_reading) tells by how much, and
    /// [`LightReading`](crate::LightReading) how the meter decides.
    #[default]
    Metered,
    /// A factor on the whole image, in stops: 1 is twice as bright. No light is metered.
    Stops(f32),
}

/// How light brighter than the display's white is mapped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMapping {
    /// As white.
    #[default]
    None,
    /// By Khronos PBR Neutral: colours up to 0.8 are unchanged, and brighter ones are compressed
    /// and desaturated.
    KhronosPbrNeutral,
}

/// A line around nodes, such as the selected ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Around their common silhouette, where it is visible.
    pub nodes: Vec<NodeId>,
    /// Linear RGB.
    pub color: Vec3,
    /// Pixels, 1 to 16.
    pub width: u32,
}

impl EffectSettings {
    /// The factor of the exposure on the image.
    pub(crate) fn exposure_factor(&self) -> f32 {
        let Exposure::Stops(stops) = self.exposure else { return 1.0 };
        let factor = trigon_math::elementary::exp2_f32(stops);
        if factor.is_finite() { factor } else { 1.0 }
    }

    /// Whether colours are changed after shading.
    pub(crate) fn maps_tones(&self) -> bool {
        self.tone_mapping != ToneMapping::None || self.exposure_factor() != 1.0
    }
}
