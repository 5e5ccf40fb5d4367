//! The pointer of a tool: it continues when the window's pointer wraps around at a border, and slows down
//! while Shift is held.

use trigon_document::mesh::math::DVec2;

/// How much slower the pointer is while Shift is held.
const PRECISE: f64 = 0.1;

/// A pointer that only knows how far it went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct VirtualPointer {
    /// Where the window's pointer was last.
    last: Option<DVec2>,
    /// Where it was first.
    start: Option<DVec2>,
    /// How far it went since, in physical pixels; precise moves count less.
    way: DVec2,
}

impl VirtualPointer {
    /// The window's pointer moved. Whether that changes anything.
    pub(crate) fn moved(&mut self, to: Option<DVec2>, is_precise: bool) -> bool {
        let Some(to) = to else { return false };
        let Some(last) = self.last.replace(to) else {
            self.start = Some(to);
            return false;
        };
        self.way += (to - last) * if is_precise { PRECISE } else { 1.0 };
        to != last
    }

    /// The window put its pointer somewhere else: that was no movement.
    pub(crate) fn jumped(&mut self, to: DVec2) {
        self.last = Some(to);
    }

    /// How far it went, in physical pixels.
    pub(crate) fn way(&self) -> DVec2 {
        self.way
    }

    /// Where it was first; the origin until it was seen.
    pub(crate) fn start(&self) -> DVec2 {
        self.start.unwrap_or(DVec2::ZERO)
    }

    /// Where it is, as if it had never jumped or slowed down.
    pub(crate) fn place(&self) -> DVec2 {
        self.start() + self.way
    }

    /// Where the window's pointer is.
    pub(crate) fn in_window(&self) -> Option<DVec2> {
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jumps_do_not_count_and_precise_moves_count_a_tenth() {
        let mut pointer = VirtualPointer::default();
        let at = |x| Some(DVec2::new(x, 5.0));
        assert!(!pointer.moved(None, false) && !pointer.moved(at(10.0), false), "its first place is no move");
        pointer.moved(at(30.0), false);
        pointer.jumped(DVec2::new(700.0, 5.0));
        pointer.moved(at(710.0), true);
        assert_eq!(
            (pointer.way(), pointer.place()),
            (DVec2::new(21.0, 0.0), DVec2::new(31.0, 5.0)),
            "20 and 10 / 10"
        );
    }
}
