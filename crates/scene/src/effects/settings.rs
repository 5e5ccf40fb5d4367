//! What a picture asks for beyond surfaces in plain light. Everything but the sky that
//! metals mirror is off by default, and what is off costs nothing.

use std::sync::Arc;

use trigon_math::Vec3;

use super::Environment;
use crate::node::NodeId;

/// What a picture asks for beyond surfaces in plain light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EffectSettings {
    /// Whether lamps cast shadows, and how they are found.
    pub shadows: Shadows,
    /// Darkens ambient light where the surroundings are near.
    pub ambient_occlusion: Option<AmbientOcclusion>,
    /// Ambient light that comes from somewhere; it takes the place of the scene's
    /// ambient lights.
    pub environment: Option<Arc<Environment>>,
    /// What metals mirror where neither an environment nor ambient light of the scene's
    /// own says what is around them.
    pub metal_reflection: MetalReflection,
    /// How often a ray of sight goes on at mirrors (metals without roughness) and
    /// glass (transmission), 0 (never) to 16.
    pub bounces: u32,
    /// Mist between the eye and surfaces.
    pub fog: Option<Fog>,
    /// Factor on the picture's light, in stops: 1 is twice as bright.
    pub exposure: f32,
    /// How light brighter than the display's white is shown.
    pub tone_mapping: ToneMapping,
    /// Drawn around nodes.
    pub outline: Option<Outline>,
}

/// How shadows are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// There are none.
    #[default]
    Off,
    /// From pictures of depth that are drawn from each lamp; see `docs/effects.md`
    /// for how they are kept from shadowing their own surface.
    Maps {
        /// Width and height of each in texels, 16 to 8192.
        resolution: u32,
    },
    /// By a ray from each pixel to each lamp: exact, and sharp.
    Rays,
}

/// What metals mirror where neither an environment nor ambient light of the scene's own
/// says what is around them. Surfaces mirror so much of it as they are metallic;
/// dielectrics look the same either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MetalReflection {
    /// The built-in sky, [`Sky::default`](super::Sky::default), +Y of the world up.
    /// [`Lighting::Scene`](crate::Lighting::Scene) leaves it out.
    #[default]
    Sky,
    /// The ambient light, as dielectrics do: beside the highlights of lamps, metals are
    /// nearly black.
    Ambient,
}

/// Ambient light that does not reach where the surroundings are near, found by
/// rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmbientOcclusion {
    /// Rays of each pixel, 1 to 256: more are smoother.
    pub rays: u32,
    /// How far surroundings count, in metres.
    pub distance: f32,
}

/// Mist that hides what is far: a surface at distance d keeps `exp(−density · d)`
/// of its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// Linear RGB of the mist.
    pub color: Vec3,
    /// Per metre, at least 0.
    pub density: f32,
}

/// How light brighter than the display's white is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMapping {
    /// As white.
    #[default]
    None,
    /// By Khronos PBR Neutral: colours up to 0.8 stay what they are, and brighter
    /// ones are compressed and lose their tint.
    KhronosPbrNeutral,
}

/// A line around nodes, such as the selected ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Around their common silhouette, as far as it is seen.
    pub nodes: Vec<NodeId>,
    /// Linear RGB.
    pub color: Vec3,
    /// Pixels, 1 to 16.
    pub width: u32,
}

impl EffectSettings {
    /// The factor that the exposure means.
    pub(crate) fn exposure_factor(&self) -> f32 {
        let factor = trigon_math::elementary::exp2_f32(self.exposure);
        if factor.is_finite() { factor } else { 1.0 }
    }

    /// Whether colours are changed after they are finished.
    pub(crate) fn maps_tones(&self) -> bool {
        self.tone_mapping != ToneMapping::None || self.exposure_factor() != 1.0
    }
}
