//! Keys that act for as long as they are down.
//!
//! They move in steps of a fixed time, counted from when the first of them went down. So
//! what they have moved follows from when they were pressed and released, and not from
//! when frames were drawn meanwhile: the same again when a session is replayed.

use std::time::Duration;

use crate::keymap::Motion;

use super::event::KeyCode;

/// The time that keys move by at once.
pub(crate) const STEP: Duration = Duration::from_millis(4);

/// The shortest press moves by so many steps: a frame's time.
const LEAST_STEPS: u32 = 4;

/// After a longer pause, as of a computer that slept, keys do not make up for it.
const LONGEST_PAUSE: Duration = Duration::from_secs(1);

/// The motions whose keys are down. A key keeps the motion it went down with,
/// whatever happens to the modifiers meanwhile.
#[derive(Debug, Default)]
pub(crate) struct HeldKeys {
    down: Vec<(KeyCode, Motion)>,
    /// Up to when all steps have been taken.
    stepped: Duration,
}

impl HeldKeys {
    /// A key went down for a motion, after all steps before were taken. Returns how many
    /// steps that is at once; none for a key that repeats.
    pub(crate) fn press(&mut self, code: KeyCode, motion: Motion, now: Duration) -> u32 {
        if self.down.iter().any(|&(held, _)| held == code) {
            return 0;
        }
        if self.down.is_empty() {
            self.stepped = now;
        }
        self.down.push((code, motion));
        LEAST_STEPS
    }

    /// How many steps are due, which counts as taking them.
    pub(crate) fn steps(&mut self, now: Duration) -> u32 {
        let pause = now.saturating_sub(self.stepped);
        if self.down.is_empty() || pause > LONGEST_PAUSE {
            self.stepped = now;
            return 0;
        }
        let steps = (pause.as_nanos() / STEP.as_nanos()) as u32;
        self.stepped += STEP * steps;
        steps
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
        let mut press = |code| held.press(KeyCode(code), motion, Duration::ZERO);
        assert_eq!([press(1), press(1), press(2)], [LEAST_STEPS, 0, LEAST_STEPS], "none for a repetition");
        assert_eq!(held.motions().count(), 2, "a repeating key counts once");
        held.release(KeyCode(1));
        assert_eq!(held.motions().count(), 1, "the other one is still down");
        held.clear();
        assert!(held.is_empty(), "a lost focus releases everything");
        held.release(KeyCode(2));
    }

    #[test]
    fn steps_do_not_depend_on_when_they_are_asked_for() {
        let moments = [13, 40, 41, 42, 150, 555].map(Duration::from_millis);
        let total = |asked: &[Duration]| -> u32 {
            let mut held = HeldKeys::default();
            held.press(KeyCode(1), Motion::Camera(CameraMotion::Zoom(1.0)), Duration::from_millis(10));
            asked.iter().map(|&now| held.steps(now)).sum()
        };
        assert_eq!(total(&moments), 545 / 4, "all that fit");
        assert_eq!(total(&moments[5..]), total(&moments), "at once, too");
        assert_eq!(total(&[Duration::from_secs(100)]), 0, "but a pause is none");
    }
}
