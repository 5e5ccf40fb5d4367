//! Endless drags: at a border of the window the pointer is moved to the opposite one, where the system lets
//! programs do that.
//!
//! The session requests a position, the shell moves the pointer there, and the first movement from there is
//! distinguished from earlier ones that arrive late. A replay takes both from its recording.

use std::time::Duration;

use trigon_math::DVec2;

use super::Session;

/// So near to a border the pointer goes to the other side, in physical pixels.
const MARGIN: f64 = 2.0;
/// Windows narrower than this are left alone.
const LEAST: f64 = 16.0 * MARGIN;

/// What is known of the pointer's way to the other side.
#[derive(Debug, Default)]
pub(super) struct Wrapping {
    /// Where the pointer is to be put, until the shell does.
    requested_position: Option<DVec2>,
    /// Where it will come from next.
    expected: Option<DVec2>,
    /// The system does not let it be put anywhere.
    is_refused: bool,
}

impl Session<'_> {
    /// Where in the window the pointer is to be put, in physical pixels.
    pub(crate) fn take_pointer_position(&mut self) -> Option<DVec2> {
        self.wrapping.requested_position.take()
    }

    /// The system does not let the pointer be put anywhere: it is not requested_position again.
    pub(crate) fn pointer_stays(&mut self) {
        self.wrapping = Wrapping { is_refused: true, ..Wrapping::default() };
    }

    /// Whether the pointer has to stay in the window.
    pub(crate) fn keeps_pointer(&self) -> bool {
        self.stage.wraps_pointer && !self.wrapping.is_refused
    }

    /// The pointer is about to move to a position.
    pub(super) fn wrap(&mut self, to: DVec2, now: Duration) {
        if !self.keeps_pointer() || self.pointer.is_held() {
            (self.wrapping.requested_position, self.wrapping.expected) = (None, None);
            return;
        }
        if let (Some(position), Some(from)) = (self.wrapping.expected, self.pointer.position()) {
            if to.distance(position) < to.distance(from) {
                self.wrapping.expected = None;
                // Those before the jump.
                self.offer_moves(now);
                self.handler.pointer_jumped(&mut self.stage, position);
            }
            return;
        }
        let position = other_side(to, self.stage.viewport().size());
        if position != to {
            (self.wrapping.requested_position, self.wrapping.expected) = (Some(position), Some(position));
        }
    }
}

/// The position across a window from a border; the same position elsewhere.
fn other_side(at: DVec2, size: DVec2) -> DVec2 {
    let across = |at: f64, size: f64| match size {
        _ if size < LEAST => at,
        _ if at < MARGIN => size - 1.0 - 2.0 * MARGIN,
        _ if at > size - 1.0 - MARGIN => 2.0 * MARGIN,
        _ => at,
    };
    DVec2::new(across(at.x, size.x), across(at.y, size.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_borders_have_another_side() {
        let size = DVec2::new(200.0, 100.0);
        assert_eq!(other_side(DVec2::new(100.0, 50.0), size), DVec2::new(100.0, 50.0));
        assert_eq!(other_side(DVec2::new(199.0, 50.0), size), DVec2::new(4.0, 50.0));
        assert_eq!(other_side(DVec2::new(0.0, 99.0), size), DVec2::new(195.0, 4.0), "a corner");
        for at in [0.0, 1.0, 198.0, 199.0] {
            let position = other_side(DVec2::new(at, 50.0), size);
            assert_eq!(other_side(position, size), position, "it does not go back at once");
        }
        assert_eq!(other_side(DVec2::ZERO, DVec2::splat(10.0)), DVec2::ZERO, "no room");
    }

    #[test]
    fn borders_are_as_wide_at_the_right_and_below_as_at_the_left_and_above() {
        for side in [32.0, 33.0, 200.0] {
            let (size, last) = (DVec2::splat(side), DVec2::splat(side - 1.0));
            let positions = (0..side as u32).map(|at| DVec2::new(at.into(), 5.0));
            let (mut moved, mut kept) = (Vec::new(), 0);
            for at in positions {
                let position = other_side(at, size);
                assert_eq!(other_side(last - at, size), last - position, "{at} of {side}");
                if position == at { kept += 1 } else { moved.push(at.x) }
            }
            assert_eq!(moved, [0.0, 1.0, side - 2.0, side - 1.0], "two at each end, not the other {kept}");
        }
    }
}
