//! Keys that act while they are held.
//!
//! Held keys move the camera in steps of a fixed time, counted from the first press. So the total movement follows
//! from the times of presses and releases, and not from when frames were drawn meanwhile: replaying a session
//! gives the same result.

use std::time::Duration;

use super::Motion;
use crate::input::KeyCode;

/// The length of a step.
pub(crate) const STEP: Duration = Duration::from_millis(4);

/// The shortest press moves by this many steps: one frame's time.
const LEAST_STEPS: u32 = 4;

/// After a longer pause, as of a suspended computer, keys do not catch up.
const LONGEST_PAUSE: Duration = Duration::from_secs(1);

/// The motions of the held keys. A key keeps the motion with which it was pressed, even if the
/// modifiers change.
#[derive(Debug, Default)]
pub(crate) struct HeldKeys {
    down: Vec<(KeyCode, Motion)>,
    /// The time up to which all steps have been taken.
    stepped: Duration,
}

impl HeldKeys {
    /// A key was pressed for a motion, after all previous steps were taken. Returns the number of
    /// steps to take at once; none for a key repeat.
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

    /// The number of due steps, which then count as taken.
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

    /// A key was released.
    pub(crate) fn release(&mut self, code: KeyCode) {
        self.down.retain(|&(held, _)| held != code);
    }

    /// The window lost the keyboard focus: it will not receive releases.
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
