//! The cells of a square grid that an island touches.
//!
//! All cells that a triangle has a point in common with are marked, so that islands whose cells are apart are apart by
//! at least as much.

use trigon_math::DVec2;

/// Some cells, from the lower left corner of their bounding rectangle.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Mask {
    /// In cells, at least 1.
    pub(super) width: usize,
    pub(super) height: usize,
    /// Cells next to one another in a row; those of one row do not touch. Those that follow one another lie far apart,
    /// so that the first of them meet most of what is in the way.
    pub(super) runs: Vec<CellRun>,
    /// The longest of them.
    pub(super) widest: CellRun,
}

/// Cells `from..to` of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct CellRun {
    pub(super) row: usize,
    pub(super) from: usize,
    pub(super) to: usize,
}

/// What is less than this part of a cell is rounding.
const ROUNDING: f64 = 1e-9;

impl Mask {
    /// The cells of this size that triangles touch, of which no coordinate is below 0. There is at least one point.
    pub(super) fn new(points: &[DVec2], triangles: &[[u32; 3]], cell: f64) -> Self {
        let high = points.iter().fold(DVec2::ZERO, |high, &point| high.max(point)) / cell;
        let [width, height] = [high.x, high.y].map(|extent| 1 + last_cell(extent));
        let mut rows = vec![Vec::new(); height];
        for triangle in triangles {
            let corners = triangle.map(|vertex| points[vertex as usize] / cell);
            let [low, high] = [f64::min, f64::max].map(|select| {
                let [a, b, c] = corners.map(|corner| corner.y);
                select(select(a, b), c)
            });
            // One along the line between two rows lies in the lower one: there may be none above.
            let last = last_cell(high);
            let first = first_cell(low).min(last);
            for (row, cells) in (first..).zip(&mut rows[first..=last]) {
                cells.push(cells_in_row(&corners, row));
            }
        }
        let runs: Vec<CellRun> =
            rows.into_iter().enumerate().flat_map(|(row, cells)| joined(row, cells)).collect();
        Self::with_runs(width, height, runs)
    }

    fn with_runs(width: usize, height: usize, runs: Vec<CellRun>) -> Self {
        let longest = runs.iter().copied().max_by_key(|run| run.to - run.from);
        let widest = longest.unwrap_or(CellRun { row: 0, from: 0, to: 1 });
        Self { width, height, runs: far_apart(&runs), widest }
    }

    /// The cells after a quarter turn counter-clockwise.
    pub(super) fn turned(&self) -> Self {
        // What was a column from the top is a row from the right.
        let mut columns = vec![Vec::new(); self.width];
        let mut runs = self.runs.clone();
        runs.sort_unstable_by_key(|run| std::cmp::Reverse(run.row));
        for run in runs {
            let at = self.height - 1 - run.row;
            for column in &mut columns[run.from..run.to] {
                match column.last_mut() {
                    Some((_, to)) if *to == at => *to = at + 1,
                    _ => column.push((at, at + 1)),
                }
            }
        }
        let row_runs = |(row, column): (usize, Vec<(usize, usize)>)| {
            column.into_iter().map(move |(from, to)| CellRun { row, from, to })
        };
        let runs: Vec<CellRun> = columns.into_iter().enumerate().flat_map(row_runs).collect();
        Self::with_runs(self.height, self.width, runs)
    }

    /// How many cells are marked.
    pub(super) fn count(&self) -> usize {
        self.runs.iter().map(|run| run.to - run.from).sum()
    }
}

fn first_cell(at: f64) -> usize {
    (at + ROUNDING).max(0.0) as usize
}

/// The cell below a coordinate, even if that is its upper end.
fn last_cell(at: f64) -> usize {
    ((at - ROUNDING).ceil() - 1.0).max(0.0) as usize
}

/// Which cells of a row a triangle touches: the part of it within the row is convex.
fn cells_in_row(corners: &[DVec2; 3], row: usize) -> CellRun {
    let [bottom, top] = [row as f64 - ROUNDING, (row + 1) as f64 + ROUNDING];
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut add = |x: f64| (low, high) = (low.min(x), high.max(x));
    for side in 0..3 {
        let (a, b) = (corners[side], corners[(side + 1) % 3]);
        if (bottom..=top).contains(&a.y) {
            add(a.x);
        }
        for line in [bottom, top] {
            if (a.y < line) != (b.y < line) {
                let t = (line - a.y) / (b.y - a.y);
                add(a.x + t * (b.x - a.x));
            }
        }
    }
    let last = last_cell(high);
    CellRun { row, from: first_cell(low).min(last), to: last + 1 }
}

/// Runs that touch become one.
fn joined(row: usize, mut cells: Vec<CellRun>) -> Vec<CellRun> {
    cells.sort_unstable();
    let mut runs: Vec<CellRun> = Vec::new();
    for run in cells {
        match runs.last_mut() {
            Some(last) if run.from <= last.to => last.to = last.to.max(run.to),
            _ => runs.push(CellRun { row, ..run }),
        }
    }
    runs
}

/// Halves, quarters, eighths… come first.
fn far_apart(runs: &[CellRun]) -> Vec<CellRun> {
    let bits = runs.len().next_power_of_two().trailing_zeros();
    let reversed = |i: usize| if bits == 0 { i } else { i.reverse_bits() >> (usize::BITS - bits) };
    (1usize..=1 << bits).filter_map(|i| runs.get(reversed(i % (1 << bits))).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It was looked for in the row above, of which there is none.
    #[test]
    fn a_flat_triangle_along_the_border_lies_in_the_last_cells() {
        let corner = |x: f64, y: f64| DVec2::new(x, y);
        let points =
            [corner(0.0, 0.0), corner(4.0, 0.0), corner(0.0, 4.0), corner(2.0, 4.0), corner(4.0, 4.0)];
        for triangles in [[[0, 1, 2], [2, 3, 4]], [[0, 1, 2], [4, 1, 4]]] {
            let mask = Mask::new(&points, &triangles, 1.0);
            assert_eq!((mask.width, mask.height), (4, 4));
            assert!(mask.runs.iter().all(|run| run.row < 4 && run.to <= 4), "{:?}", mask.runs);
            let covers = |x: usize, y: usize| {
                mask.runs.iter().any(|run| run.row == y && (run.from..run.to).contains(&x))
            };
            assert!(covers(3, 3) && covers(0, 0), "its last cell, and the first one: {:?}", mask.runs);
        }
    }
}
