//! All effects beyond directly lit surfaces, one folder or file for each effect. Effects that a
//! scene does not need are neither prepared nor evaluated: [`plan`](crate::plan) decides.
//!
//! [`EffectCounts`] is the cost of an effect, in counts. For an effect that is off, all counts are zero.

mod casters;
mod finish;
mod lamp_visibility;
mod lighting_environment;
mod metal_studio;
mod penumbra;
mod rays;
mod shadow;
mod sight;
mod sum;

use crate::effect::Effect;

pub(crate) use casters::{Caster, Casters, ShadowSource};
pub(crate) use finish::{draw_outline, encode, lay_on_background, map_tones};
pub(crate) use lighting_environment::{FogModel, LightingEnvironment, VisibleBackdrop};
pub(crate) use metal_studio::MetalStudio;
pub(crate) use penumbra::NearestDepths;
pub(crate) use rays::{
    AmbientRays, Glass, LampRays, OpennessBuffer, OpennessOf, Optics, RayCache, RayPart, RayStarts,
    SmallImage, SmallView, rows,
};
pub(crate) use shadow::{LampPose, LampView, PlacedMap, ShadowMap, ShadowMaps, View, views};
pub(crate) use sight::{SightStart, refracted};

/// The cost of an effect in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct EffectCounts {
    /// Interpolated varyings per vertex, summed over draws.
    pub attributes: u64,
    /// Texture look-ups per pixel, summed over draws.
    pub look_ups: u64,
    /// Passes over the image, or over images of the effect's own.
    pub passes: u64,
    /// Rays.
    pub rays: u64,
    /// Bytes of memory for buffers and BVHs.
    pub bytes: u64,
}

/// The counts of all effects.
#[derive(Clone, Debug, Default)]
pub(crate) struct Counts([EffectCounts; Effect::ALL.len()]);

impl Counts {
    pub(crate) fn of(&mut self, effect: Effect) -> &mut EffectCounts {
        &mut self.0[effect as usize]
    }

    pub(crate) fn get(&self, effect: Effect) -> EffectCounts {
        self.0[effect as usize]
    }
}

#[cfg(test)]
mod tests;
