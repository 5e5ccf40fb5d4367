//! The mouse as a state machine: drags belong to the button that began them, and a press that
//! hardly moves is a click.

use trigon_math::DVec2;

use super::event::Press;
use super::key::{Modifiers, PointerButton};

/// A press that moves less than this many logical pixels is a click.
const CLICK_SLOP: f64 = 4.0;

/// The meaning of a pointer event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Gesture {
    /// Moved with a button down, from one position to the other. The modifiers are those of the
    /// press.
    Drag { button: PointerButton, modifiers: Modifiers, from: DVec2, to: DVec2 },
    /// Pressed and released at one position.
    Click { button: PointerButton, modifiers: Modifiers, at: DVec2 },
    /// A drag ended, and with it everything that depends on its button.
    Released,
}

#[derive(Debug, Clone, Copy)]
struct Held {
    button: PointerButton,
    modifiers: Modifiers,
    start: DVec2,
    moved: bool,
}

/// The position of the pointer and the button it holds.
#[derive(Debug, Default)]
pub(crate) struct Pointer {
    position: Option<DVec2>,
    held: Option<Held>,
}

impl Pointer {
    /// The last known position, in physical pixels.
    pub(crate) fn position(&self) -> Option<DVec2> {
        self.position
    }

    /// Whether a button is held: then its owner receives all further events.
    pub(crate) fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// The pointer moved; `scale` is physical pixels per logical one.
    pub(crate) fn moved(&mut self, to: DVec2, scale: f64) -> Option<Gesture> {
        let from = self.position.replace(to)?;
        let held = self.held.as_mut()?;
        if !held.moved && held.start.distance(to) < CLICK_SLOP * scale {
            return None;
        }
        // The distance before the drag was recognized is added at once.
        let from = if held.moved { from } else { held.start };
        held.moved = true;
        Some(Gesture::Drag { button: held.button, modifiers: held.modifiers, from, to })
    }

    /// A button was pressed or released.
    pub(crate) fn button(
        &mut self,
        button: PointerButton,
        press: Press,
        modifiers: Modifiers,
    ) -> Option<Gesture> {
        match (press, self.held) {
            (Press::Down, None) => {
                let start = self.position?;
                self.held = Some(Held { button, modifiers, start, moved: false });
                None
            }
            (Press::Up, Some(held)) if held.button == button => {
                self.held = None;
                Some(match held {
                    Held { moved: true, .. } => Gesture::Released,
                    Held { modifiers, start, .. } => Gesture::Click { button, modifiers, at: start },
                })
            }
            // Other buttons wait for their turn.
            _ => None,
        }
    }

    /// The window lost the pointer: nothing is held any more.
    pub(crate) fn cancel(&mut self) {
        self.held = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use PointerButton::{Left, Right};

    const AT: DVec2 = DVec2::new(100.0, 50.0);

    fn pressed() -> Pointer {
        let mut pointer = Pointer::default();
        pointer.moved(AT, 1.0);
        assert_eq!(pointer.button(Left, Press::Down, Modifiers::SHIFT), None, "a press alone means nothing");
        pointer
    }

    #[test]
    fn a_press_that_hardly_moves_is_a_click() {
        let mut pointer = pressed();
        assert_eq!(pointer.moved(AT + DVec2::X * 3.0, 1.0), None, "within the slop");
        let click = pointer.button(Left, Press::Up, Modifiers::NONE);
        let expected = Gesture::Click { button: Left, modifiers: Modifiers::SHIFT, at: AT };
        assert_eq!(click, Some(expected), "with the modifiers of the press");
    }

    #[test]
    fn a_drag_covers_the_whole_way_once() {
        let mut pointer = pressed();
        let mut way = DVec2::ZERO;
        for step in 1..=10 {
            let to = AT + DVec2::new(2.0, 1.0) * f64::from(step);
            if let Some(Gesture::Drag { from, to, .. }) = pointer.moved(to, 1.0) {
                way += to - from;
            }
        }
        assert_eq!(way, DVec2::new(20.0, 10.0), "no pixel of it is lost");
        let up = pointer.button(Left, Press::Up, Modifiers::NONE);
        assert_eq!(up, Some(Gesture::Released), "and no click follows");
        assert_eq!(pointer.moved(AT, 1.0), None, "the pointer is free again");
    }

    #[test]
    fn a_drag_belongs_to_the_button_that_began_it() {
        let mut pointer = pressed();
        assert_eq!(pointer.button(Right, Press::Down, Modifiers::NONE), None, "another press waits");
        assert_eq!(pointer.button(Right, Press::Up, Modifiers::NONE), None, "and ends nothing");
        let moved = pointer.moved(AT + DVec2::X * 50.0, 1.0);
        assert!(moved.is_some(), "the first button still drags");
        pointer.cancel();
        assert_eq!(pointer.button(Left, Press::Up, Modifiers::NONE), None, "after a lost focus: no click");
    }

    #[test]
    fn the_slop_grows_with_the_scale() {
        let mut pointer = pressed();
        assert_eq!(pointer.moved(AT + DVec2::X * 7.0, 2.0), None, "3.5 logical pixels");
        assert!(pointer.moved(AT + DVec2::X * 9.0, 2.0).is_some(), "4.5 logical pixels");
    }
}
