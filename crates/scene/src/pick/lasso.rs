//! Point in polygon by the even-odd rule, without rounding.
//!
//! A horizontal ray from the point to the right crosses some sides of the polygon; the point is inside if
//! their number is odd. A side is crossed if one of its ends is above the point and the other is not, and if
//! the side passes to the right of the point, by the exact orientation of the three. So a corner counts for
//! only one of its two sides, and a point on a side belongs to only one of the two areas beside it.

use std::ops::Range;

use trigon_math::{DVec2, Orientation, orientation};

use super::region::center;

/// Sides are listed for each band of rows that they touch, with no more entries than
/// this, whatever the polygon: 32 MB. A lasso by hand needs a few thousand.
const MOST_ENTRIES: usize = 1 << 22;

/// A polygon, its sides sorted by the rows of pixels that they touch.
pub(super) struct Lasso<'r> {
    corners: &'r [DVec2],
    first_row: u32,
    /// Rows to a band.
    band: u32,
    /// For each band where its sides begin, and the end of the last one's.
    starts: Vec<usize>,
    /// Sides, by the corner at which they begin.
    sides: Vec<u32>,
}

impl<'r> Lasso<'r> {
    /// For points in these rows. All corners have to be finite.
    pub(super) fn new(corners: &'r [DVec2], rows: &Range<u32>) -> Self {
        let mut lasso =
            Self { corners, first_row: rows.start, band: 1, starts: Vec::new(), sides: Vec::new() };
        let entries =
            |lasso: &Self| -> usize { (0..corners.len()).map(|side| lasso.bands(side, rows).len()).sum() };
        while lasso.band < rows.end && entries(&lasso) > MOST_ENTRIES {
            lasso.band *= 2;
        }
        let count = rows.len().div_ceil(lasso.band as usize);
        let mut lists = vec![Vec::new(); count];
        for side in 0..corners.len() {
            lasso.bands(side, rows).for_each(|band| lists[band].push(side as u32));
        }
        lasso.starts.push(0);
        for list in lists {
            lasso.sides.extend(list);
            lasso.starts.push(lasso.sides.len());
        }
        lasso
    }

    /// The bands that a side touches.
    fn bands(&self, side: usize, rows: &Range<u32>) -> Range<usize> {
        let [from, to] = self.ends(side);
        let (upper, lower) = if from.y < to.y { (from.y, to.y) } else { (to.y, from.y) };
        if rows.is_empty() || lower < rows.start.into() || upper >= rows.end.into() {
            return 0..0;
        }
        let row = |y: f64| (y.floor() as u32).clamp(rows.start, rows.end - 1) - rows.start;
        (row(upper) / self.band) as usize..(row(lower) / self.band) as usize + 1
    }

    fn ends(&self, side: usize) -> [DVec2; 2] {
        [self.corners[side], self.corners[(side + 1) % self.corners.len()]]
    }

    /// The sides that a point in this row can have beside it.
    fn beside(&self, row: u32) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let band = ((row - self.first_row) / self.band) as usize;
        let sides = &self.sides[self.starts[band]..self.starts[band + 1]];
        sides.iter().map(|&side| self.ends(side as usize))
    }

    /// Whether a point is inside. It has to lie in the rows.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let crossed = self.beside(point.y.floor() as u32).filter(|side| is_level(side, point.y));
        crossed.filter(|side| is_right_of(side, point)).count() % 2 == 1
    }

    /// The pixels of a row whose centres are inside.
    pub(super) fn runs(&self, row: u32, columns: &Range<u32>) -> Vec<Range<u32>> {
        let level = center(0, row).y;
        let crossed = self.beside(row).filter(|side| is_level(side, level));
        // Left of each of these columns a side lies to the right, from it on it does not.
        let mut borders: Vec<u32> = crossed.map(|side| border(&side, row, columns)).collect();
        borders.sort_unstable();
        let pairs = borders.as_chunks::<2>().0;
        pairs.iter().map(|&[start, end]| start..end).filter(|run| !run.is_empty()).collect()
    }
}

/// Whether a horizontal line passes between the ends of a side.
fn is_level([from, to]: &[DVec2; 2], y: f64) -> bool {
    (from.y > y) != (to.y > y)
}

/// Whether such a side lies to the right of a point on the line.
fn is_right_of(&[from, to]: &[DVec2; 2], point: DVec2) -> bool {
    let side = if from.y < to.y { Orientation::CounterClockwise } else { Orientation::Clockwise };
    orientation(from, to, point) == side
}

/// The first of the columns whose centre has the side not to its right; the end if
/// there is none.
fn border(side: &[DVec2; 2], row: u32, columns: &Range<u32>) -> u32 {
    let Range { mut start, mut end } = *columns;
    while start < end {
        let middle = u32::midpoint(start, end);
        if is_right_of(side, center(middle, row)) {
            start = middle + 1;
        } else {
            end = middle;
        }
    }
    start
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a point is in a polygon, by the angles under which it sees the sides: the sum is a full turn or none.
    fn surrounds(corners: &[DVec2], point: DVec2) -> bool {
        let sides =
            (0..corners.len()).map(|i| [corners[i] - point, corners[(i + 1) % corners.len()] - point]);
        let turn: f64 = sides.map(|[a, b]| a.angle_to(b)).sum();
        turn.abs() > 3.0
    }

    #[test]
    fn rows_begin_and_end_where_the_polygon_does() {
        let star = [[1.3, 2.2], [17.9, 9.1], [3.7, 9.9], [18.2, 1.4], [9.6, 18.3], [-6.0, 30.0]];
        for polygon in [&star[..3], &star[1..5], &star[2..]] {
            let corners: Vec<DVec2> = polygon.iter().map(|&corner| DVec2::from_array(corner)).collect();
            for (rows, columns) in [(0..20, 0..20), (3..11, 5..9)] {
                let lasso = Lasso::new(&corners, &rows);
                for row in rows {
                    let runs = lasso.runs(row, &columns);
                    assert!(runs.iter().all(|run| !run.is_empty()), "{runs:?}");
                    for column in columns.clone() {
                        let at = center(column, row);
                        let is_inside = runs.iter().filter(|run| run.contains(&column)).count();
                        assert_eq!(is_inside, usize::from(lasso.contains(at)), "{at}: {runs:?}");
                        // Polygons that cross themselves may be surrounded twice.
                        let is_simple = polygon.len() == 3;
                        assert!(!is_simple || lasso.contains(at) == surrounds(&corners, at), "{at}");
                    }
                }
            }
        }
    }
}
