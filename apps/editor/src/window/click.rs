//! A press of the left button that may become a click.

use trigon_window::scene::math::DVec2;
use trigon_window::{Hands, Modifiers};

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
