//! Keys that act for as long as they are down.

use crate::keymap::Motion;

use super::event::KeyCode;

/// The motions whose keys are down. A key keeps the motion it went down with,
/// whatever happens to the modifiers meanwhile.
#[derive(Debug, Default)]
pub(crate) struct HeldKeys {
    down: Vec<(KeyCode, Motion)>,
}

impl HeldKeys {
    /// A key went down for a motion. Again, for a key that repeats: no effect.
    pub(crate) fn press(&mut self, code: KeyCode, motion: Motion) {
        if !self.down.iter().any(|&(held, _)| held == code) {
            self.down.push((code, motion));
        }
    }

    /// A key came up.
    pub(crate) fn release(&mut self, code: KeyCode) {
        self.down.retain(|&(held, _)| held != code);
    }

    /// The window lost the keyboard: it will not hear of releases.
    pub(crate) fn clear(&mut self) {
        self.down.clear();
    }

    /// Whether anything is held.
    pub(crate) fn is_empty(&self) -> bool {
        self.down.is_empty()
    }

    /// The motions in the order of their presses.
    pub(crate) fn motions(&self) -> impl Iterator<Item = Motion> {
        self.down.iter().map(|&(_, motion)| motion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::CameraMotion;

    #[test]
    fn keys_are_held_until_released_or_forgotten() {
        let motion = Motion::Camera(CameraMotion::Zoom(1.0));
        let mut held = HeldKeys::default();
        held.press(KeyCode(1), motion);
        held.press(KeyCode(1), motion);
        held.press(KeyCode(2), motion);
        assert_eq!(held.motions().count(), 2, "a repeating key counts once");
        held.release(KeyCode(1));
        assert_eq!(held.motions().count(), 1, "the other one is still down");
        held.clear();
        assert!(held.is_empty(), "a lost focus releases everything");
        held.release(KeyCode(2));
    }
}
