//! The cost of an effect, in counts. For an effect that is off, all are zero.

use crate::effect::Effect;

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
