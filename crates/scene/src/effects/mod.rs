//! All effects beyond directly lit surfaces, one folder or file for each effect. Effects that a
//! scene does not need are neither prepared nor evaluated.

mod casters;
mod environment;
mod fog;
mod lighting_environment;
mod metal_sky;
mod outline;
mod plan;
mod rays;
mod settings;
mod shadow;
mod tone;

pub(crate) use casters::Casters;
pub(crate) use environment::Surroundings;
pub use environment::{Environment, EnvironmentError, Sky};
pub(crate) use fog::Mist;
pub(crate) use lighting_environment::LightingEnvironment;
pub(crate) use metal_sky::MetalSky;
pub(crate) use outline::draw_outline;
pub(crate) use plan::Counts;
pub use plan::{Absence, Cause, Decision, EffectCounts, EffectPlan, Named};
pub(crate) use rays::{AmbientRays, Optics, RayCache};
pub use settings::{AmbientOcclusion, EffectSettings, Fog, MetalReflection, Outline, Shadows, ToneMapping};
pub(crate) use shadow::{LampPose, ShadowCache};
pub(crate) use tone::{lay_on_background, map_tones};

#[cfg(test)]
mod tests;
