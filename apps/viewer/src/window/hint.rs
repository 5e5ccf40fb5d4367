//! One line that says how to begin, until somebody has begun.

use trigon_window::{Corner, Input, Stage};

/// What a newcomer needs first.
const LINE: &str =
    "Drag: orbit   Wheel: zoom   Shift+drag: pan   Right click: menu   Ctrl+O: open   H: all keys";

/// The line in the corner where messages are.
#[derive(Debug, Default)]
pub(super) struct Hint {
    is_over: bool,
}

impl Hint {
    pub(super) fn start(&self, stage: &mut Stage) {
        stage.overlay.set(Corner::BottomLeft, [LINE]);
    }

    /// Something was done by hand: whoever presses or turns something knows how.
    pub(super) fn input(&mut self, stage: &mut Stage, input: &Input) {
        let begins =
            matches!(input, Input::Pressed(_) | Input::Wheel(_) | Input::Pinch(_) | Input::Key { .. });
        if begins && !std::mem::replace(&mut self.is_over, true) {
            stage.overlay.clear(Corner::BottomLeft);
        }
    }
}
