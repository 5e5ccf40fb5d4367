//! Tools started from a button or a menu: the way from there to the model must not count as movement, so they
//! wait for a press in the view. A drag from there is the whole tool; after a click it follows the pointer,
//! as when started by its key. A press of the left button may become a click.

use trigon_window::scene::math::DVec2;
use trigon_window::{Hands, Input, Modifiers, PointerButton};

/// Where a tool is between the button that started it and the movement that counts.
#[derive(Debug, Clone, Copy)]
pub(super) enum ButtonStart {
    /// The pointer's movements count.
    Over,
    /// They do not count before a press in the view.
    Waits,
    /// The press that they count from.
    Pressed(Click),
}

/// What becomes of an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Passed {
    /// It is the tool's.
    On,
    /// It means nothing to the tool.
    No,
    /// Movements count from here.
    Begins(DVec2),
    /// A drag has ended: the tool is confirmed.
    Confirms,
    /// A press beside the view: the tool is over.
    Cancels,
}

impl ButtonStart {
    /// Of a tool that starts where the pointer is.
    pub(super) fn of(is_in_view: bool) -> Self {
        if is_in_view { Self::Over } else { Self::Waits }
    }

    /// What the status line says beside the tool's own.
    pub(super) fn hint(self) -> &'static str {
        if matches!(self, Self::Waits) { "Press in the view and drag, or type a number. " } else { "" }
    }

    /// Handles an input. `scale` is the number of physical pixels per logical one.
    pub(super) fn pass(&mut self, is_in_view: bool, scale: f64, input: &Input, hands: Hands) -> Passed {
        match (*self, input) {
            (Self::Waits, Input::PointerMoved) => Passed::No,
            (Self::Waits, Input::Pressed(PointerButton::Left))
                if !hands.modifiers.contains(Modifiers::ALT) =>
            {
                let press = Click::new(hands).filter(|_| is_in_view);
                let Some(press) = press else { return Passed::Cancels };
                *self = Self::Pressed(press);
                Passed::Begins(press.at)
            }
            (Self::Pressed(press), Input::Released(PointerButton::Left)) => {
                *self = Self::Over;
                if press.is_drag(hands, scale) { Passed::Confirms } else { Passed::No }
            }
            _ => Passed::On,
        }
    }
}

/// A press that moves further than this many logical pixels is no click.
const SLOP: f64 = 4.0;

/// The left button is down.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Click {
    pub(crate) at: DVec2,
    pub(crate) modifiers: Modifiers,
}

impl Click {
    pub(crate) fn new(hands: Hands) -> Option<Self> {
        hands.pointer.map(|at| Self { at, modifiers: hands.modifiers })
    }

    /// Whether the pointer has moved too far for a click.
    pub(crate) fn is_drag(&self, hands: Hands, scale: f64) -> bool {
        hands.pointer.is_some_and(|to| to.distance(self.at) > SLOP * scale)
    }
}
