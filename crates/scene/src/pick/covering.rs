//! Pixels whose centres a face covers, hidden or not.

use std::ops::{ControlFlow, Range};

use fixedbitset::FixedBitSet;
use trigon_math::DVec2;

use super::hiding::depth_at;
use super::region::{Area, center};
use super::screen::Spot;

/// The pixels whose centres lie in a region.
pub(super) struct Centers {
    columns: Range<u32>,
    rows: Range<u32>,
    /// Row by row.
    inside: FixedBitSet,
}

impl Centers {
    pub(super) fn new(area: &Area<'_>) -> Self {
        let (columns, rows) = (area.columns.clone(), area.rows.clone());
        let mut inside = FixedBitSet::with_capacity(columns.len() * rows.len());
        for (number, row) in rows.clone().enumerate() {
            let first = number * columns.len();
            for run in area.runs(row) {
                let [start, end] = [run.start, run.end].map(|at| first + (at - columns.start) as usize);
                inside.insert_range(start..end);
            }
        }
        Self { columns, rows, inside }
    }

    /// Whether there is no pixel.
    pub(super) fn is_empty(&self) -> bool {
        self.inside.is_clear()
    }

    /// Calls `visit` with each pixel whose centre a triangle covers between the near and the far
    /// plane, and its depth there, until `visit` stops it. A centre on the outline counts as
    /// covered.
    pub(super) fn covered(
        &self,
        piece: &[Spot; 3],
        mut visit: impl FnMut([u32; 2], f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let [a, b, c] = piece.map(|spot| spot.at);
        if (b - a).perp_dot(c - a) == 0.0 {
            return ControlFlow::Continue(());
        }
        for row in pixels([a.y, b.y, c.y], 0.0, &self.rows) {
            let first = (row - self.rows.start) as usize * self.columns.len();
            let level = center(0, row).y;
            let crossings = [[a, b], [b, c], [c, a]].map(|side| crossing(side, level));
            // What is rounded there is decided at the centre; so a pixel more on each side.
            for column in pixels(crossings, 1.0, &self.columns) {
                if !self.inside.contains(first + (column - self.columns.start) as usize) {
                    continue;
                }
                match depth_at(piece, center(column, row)) {
                    Some(depth) if depth >= 0.0 => visit([column, row], depth)?,
                    _ => {}
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// The pixels with centres between the least and the greatest of some places, and `more`
/// on either side. Places that are no numbers do not count.
fn pixels(places: [f64; 3], more: f64, range: &Range<u32>) -> Range<u32> {
    let least = places.iter().fold(f64::INFINITY, |least, &place| least.min(place));
    let greatest = places.iter().fold(f64::NEG_INFINITY, |greatest, &place| greatest.max(place));
    // The casts saturate.
    let start = ((least - 0.5 - more).ceil() as u32).clamp(range.start, range.end);
    let end = ((greatest + 0.5 + more).floor() as u32).clamp(range.start, range.end);
    start..end.max(start)
}

/// Where a side crosses a horizontal line; no number where it does not.
fn crossing([from, to]: [DVec2; 2], y: f64) -> f64 {
    if (from.y >= y) == (to.y >= y) && from.y != y && to.y != y {
        return f64::NAN;
    }
    // A side along the line has a crossing of no number, but its neighbours have theirs.
    from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y))
}
