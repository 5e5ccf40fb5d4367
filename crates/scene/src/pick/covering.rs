//! Pixels whose centres a face covers, hidden or not.

use std::ops::{ControlFlow, Range};

use fixedbitset::FixedBitSet;
use trigon_math::DVec2;

use super::hiding::depth_at;
use super::region::{Area, center};
use super::screen::{Spot, doubled_area, nearer_first};

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
        if doubled_area([a, b, c]) == 0.0 {
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
fn pixels(coordinates: [f64; 3], more: f64, range: &Range<u32>) -> Range<u32> {
    let least = coordinates.iter().fold(f64::INFINITY, |least, &coordinate| least.min(coordinate));
    let greatest =
        coordinates.iter().fold(f64::NEG_INFINITY, |greatest, &coordinate| greatest.max(coordinate));
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
    let [from, to] = nearer_first([from, to], |&end| end);
    // A side along the line has a crossing of no number, but its neighbours have theirs.
    from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y))
}

#[cfg(test)]
mod tests {
    use super::super::region::Region;
    use super::*;
    use trigon_camera::Viewport;

    const SIDE: u32 = 12;

    /// Twice the area of a triangle, exact for multiples of a quarter.
    fn exact_area([a, b, c]: [DVec2; 3]) -> f64 {
        (b - a).perp_dot(c - a)
    }

    /// Corners in quarters of a pixel, of which the origin is one now and then; some triangles have no area.
    fn triangles() -> impl Iterator<Item = [DVec2; 3]> {
        let mut state = 1_u32;
        let mut quarter = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 16 & 63) * 0.25 - 2.0
        };
        let mut corner = move || DVec2::new(quarter(), quarter());
        let chance: Vec<[DVec2; 3]> = (0..200).map(|_| [corner(), corner(), corner()]).collect();
        let at_origin = chance.clone().into_iter().take(60).enumerate().map(|(number, mut triangle)| {
            triangle[number % 3] = DVec2::ZERO;
            triangle
        });
        let flat = chance.clone().into_iter().take(20).map(|[a, b, _]| [a, b, (a + b) / 2.0]);
        let level = chance.clone().into_iter().take(20).map(|[a, b, c]| [a, DVec2::new(b.x, a.y), c]);
        chance.clone().into_iter().chain(at_origin).chain(flat).chain(level)
    }

    #[test]
    fn centres_within_a_triangle_are_visited_once() {
        let whole = Region::Rectangle { min: DVec2::ZERO, max: DVec2::splat(f64::from(SIDE)) };
        let part = Region::Rectangle { min: DVec2::new(3.0, 2.0), max: DVec2::new(8.0, 10.0) };
        for region in [whole, part] {
            let area = Area::new(&region, Viewport { width: SIDE, height: SIDE });
            let centers = Centers::new(&area);
            assert!(!centers.is_empty());
            for corners in triangles() {
                // One unit deeper to the right, and a half downwards.
                let depth = |at: DVec2| 3.0 + at.x + at.y / 2.0;
                let piece = corners.map(|at| Spot { at, depth: depth(at) });
                let mut found = Vec::new();
                let end = centers.covered(&piece, |pixel, depth| {
                    found.push((pixel, depth));
                    ControlFlow::Continue(())
                });
                assert!(end.is_continue());
                let mut expected = Vec::new();
                for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
                    let at = center(x, y);
                    let [a, b, c] = corners;
                    let shares = [[at, b, c], [a, at, c], [a, b, at]].map(exact_area);
                    let is_within =
                        shares.iter().all(|share| *share >= 0.0) || shares.iter().all(|share| *share <= 0.0);
                    if is_within && exact_area(corners) != 0.0 && area.contains(at) {
                        expected.push([x, y]);
                    }
                }
                let pixels: Vec<[u32; 2]> = found.iter().map(|(pixel, _)| *pixel).collect();
                assert_eq!(pixels, expected, "{corners:?}");
                for ([x, y], found) in found {
                    assert!((found - depth(center(x, y))).abs() < 1e-9, "{found} at {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn what_lies_beyond_the_far_plane_and_after_the_end_is_not_visited() {
        let region = Region::Rectangle { min: DVec2::ZERO, max: DVec2::splat(f64::from(SIDE)) };
        let area = Area::new(&region, Viewport { width: SIDE, height: SIDE });
        let centers = Centers::new(&area);
        // Deeper than nothing from the middle on.
        let piece = [[-2.0, -3.0], [30.0, -3.0], [-2.0, 30.0]]
            .map(|at| Spot { at: DVec2::from_array(at), depth: 6.0 - at[0] });
        let mut visited = Vec::new();
        let end = centers.covered(&piece, |[x, y], depth| {
            assert!((depth - (5.5 - f64::from(x))).abs() < 1e-9);
            visited.push([x, y]);
            if visited.len() == 9 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(end.is_break());
        let expected: Vec<[u32; 2]> = (0..9).map(|i| [i % 6, i / 6]).collect();
        assert_eq!(visited, expected, "six columns, row by row, until it was enough");
    }
}
