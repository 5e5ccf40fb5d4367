//! What an effect takes, in counts. Of an effect that is off, all are zero.

use super::Effect;

/// What an effect took in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EffectCounts {
    /// Numbers that each vertex hands on to be interpolated, summed over draws.
    pub attributes: u64,
    /// Textures that each pixel looks up, summed over draws.
    pub look_ups: u64,
    /// Passes over the picture, or over pictures of the effect's own.
    pub passes: u64,
    /// Rays.
    pub rays: u64,
    /// Bytes of memory for buffers and trees.
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
