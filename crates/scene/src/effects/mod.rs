//! All effects beyond directly lit surfaces, one folder or file for each effect. Effects that a
//! scene does not need are neither prepared nor evaluated: [`plan`](crate::plan) decides.

mod backdrop;
mod casters;
mod counts;
mod fog;
mod lighting_environment;
mod metal_studio;
mod outline;
mod rays;
mod shadow;
mod sight;
mod sum;
mod tone;

pub(crate) use backdrop::VisibleBackdrop;
pub(crate) use casters::{Caster, Casters, ShadowSource};
pub(crate) use counts::Counts;
pub use counts::EffectCounts;
pub(crate) use fog::FogModel;
pub(crate) use lighting_environment::LightingEnvironment;
pub(crate) use metal_studio::MetalStudio;
pub(crate) use outline::draw_outline;
pub(crate) use rays::{AmbientRays, Glass, Optics, RayCache, rows};
pub(crate) use shadow::{LampPose, PlacedMap, ShadowMap, ShadowMaps, View, views};
pub(crate) use sight::{SightStart, refracted};
pub(crate) use tone::{lay_on_background, map_tones};

#[cfg(test)]
mod tests;
