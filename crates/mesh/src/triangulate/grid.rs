//! Points of the plane in square cells, to find those near a triangle.

use trigon_math::DVec2;

/// More cells than this per side cost more to set up than they save.
const MOST_CELLS: usize = 512;

/// Fewer points than this are tested one by one.
const FEWEST_POINTS: usize = 24;

/// Indices of points, by the cell that they are in.
#[derive(Debug, Default)]
pub(super) struct Grid {
    origin: DVec2,
    /// Cells per unit of length.
    scale: DVec2,
    cells_per_side: usize,
    starts: Vec<u32>,
    points: Vec<u32>,
}

impl Grid {
    /// Fills the grid with those of the points that are named.
    pub(super) fn fill(&mut self, points: &[DVec2], named: &[u32]) {
        let side = match named.len() {
            0..FEWEST_POINTS => 1,
            many => many.isqrt().clamp(1, MOST_CELLS),
        };
        let (low, high) = bounds(points);
        self.origin = low;
        self.cells_per_side = side;
        self.scale =
            DVec2::new(cells_per_length(side, high.x - low.x), cells_per_length(side, high.y - low.y));
        self.starts.clear();
        self.starts.resize(side * side + 2, 0);
        for &point in named {
            let cell = self.cell(points[point as usize]);
            self.starts[cell + 2] += 1;
        }
        for cell in 2..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.points.clear();
        self.points.resize(named.len(), 0);
        for &point in named {
            let cell = self.cell(points[point as usize]);
            let cursor = &mut self.starts[cell + 1];
            self.points[*cursor as usize] = point;
            *cursor += 1;
        }
    }

    /// Whether the test holds for any point in the cells that the box touches.
    pub(super) fn any(&self, low: DVec2, high: DVec2, mut test: impl FnMut(u32) -> bool) -> bool {
        let [left, bottom] = self.column_and_row(low);
        let [right, top] = self.column_and_row(high);
        (bottom..=top).any(|row| {
            let first = self.starts[row * self.cells_per_side + left];
            let end = self.starts[row * self.cells_per_side + right + 1];
            let points = &self.points[first as usize..end as usize];
            points.iter().any(|&point| test(point))
        })
    }

    fn cell(&self, point: DVec2) -> usize {
        let [column, row] = self.column_and_row(point);
        row * self.cells_per_side + column
    }

    /// Monotone in each coordinate, so that a point inside a box is always in
    /// a cell between those of the box's corners, whatever was rounded.
    fn column_and_row(&self, point: DVec2) -> [usize; 2] {
        let cell = (point - self.origin) * self.scale;
        [cell.x, cell.y].map(|x| (x as usize).min(self.cells_per_side - 1))
    }
}

fn cells_per_length(cells: usize, length: f64) -> f64 {
    if length > 0.0 { cells as f64 / length } else { 0.0 }
}

fn bounds(points: &[DVec2]) -> (DVec2, DVec2) {
    let first = points.first().copied().unwrap_or(DVec2::ZERO);
    let low = points.iter().fold(first, |low, &p| low.min(p));
    let high = points.iter().fold(first, |high, &p| high.max(p));
    (low, high)
}
