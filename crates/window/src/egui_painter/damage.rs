//! The damaged area: cells of the screen to repaint, and rectangles made of them.

use trigon_raster::paint2d::Rect;

/// The side of a cell in pixels: about two lines of text, so that a label that changes repaints
/// little besides itself, and large enough to keep the list short.
const CELL: i32 = 32;

/// Cells that differ from the screen.
#[derive(Debug, Default)]
pub(super) struct Damage {
    /// Row by row, whether each cell is marked.
    cells: Vec<bool>,
    columns: usize,
    /// Whether any is.
    some: bool,
    all: bool,
    /// The size of the last painted pixels.
    bounds: Rect,
}

impl Damage {
    pub(super) fn mark_all(&mut self) {
        self.all = true;
    }

    pub(super) fn is_empty(&self) -> bool {
        !self.all && !self.some
    }

    /// Marks all cells that contain some of these pixels.
    pub(super) fn mark(&mut self, pixels: Rect) {
        let pixels = pixels.intersection(self.bounds);
        if self.all || pixels.is_empty() {
            return;
        }
        let cells =
            |axis: usize| (pixels.min[axis] / CELL) as usize..((pixels.max[axis] - 1) / CELL) as usize + 1;
        for row in cells(1) {
            self.cells[row * self.columns..][cells(0)].fill(true);
        }
        self.some = true;
    }

    /// The marked cells as rectangles that do not overlap, inside `bounds`; clears the marks.
    /// Bounds that differ from the last ones mark everything.
    pub(super) fn take(&mut self, bounds: Rect) -> Vec<Rect> {
        let all = std::mem::take(&mut self.all) || self.bounds != bounds;
        self.bounds = bounds;
        if all {
            let [columns, rows] = bounds.max.map(|side| (side as usize).div_ceil(CELL as usize));
            self.columns = columns;
            self.cells.clear();
            self.cells.resize(columns * rows, false);
            self.some = false;
            return vec![bounds];
        }
        if !std::mem::take(&mut self.some) {
            return Vec::new();
        }
        let runs = self.cells.chunks_exact(self.columns).zip(0..).flat_map(|(cells, row)| runs(cells, row));
        let rects = merged(runs).into_iter().map(|cells| in_pixels(cells).intersection(bounds)).collect();
        self.cells.fill(false);
        rects
    }
}

/// Marked neighbours in a row as one rectangle, in cells.
fn runs(cells: &[bool], row: i32) -> impl Iterator<Item = Rect> {
    let mut start = 0;
    cells.chunk_by(|a, b| a == b).filter_map(move |run| {
        let columns = [start, start + run.len() as i32];
        start = columns[1];
        run[0].then_some(Rect::new([columns[0], row], [columns[1], row + 1]))
    })
}

/// Vertically adjacent runs with the same columns as one rectangle.
fn merged(runs: impl Iterator<Item = Rect>) -> Vec<Rect> {
    let mut merged: Vec<Rect> = Vec::new();
    for run in runs {
        let columns = |rect: &Rect| [rect.min[0], rect.max[0]];
        let above =
            merged.iter_mut().rev().find(|rect| rect.max[1] == run.min[1] && columns(rect) == columns(&run));
        match above {
            Some(rect) => rect.max[1] = run.max[1],
            None => merged.push(run),
        }
    }
    merged
}

fn in_pixels(cells: Rect) -> Rect {
    Rect::new(cells.min.map(|cell| cell * CELL), cells.max.map(|cell| cell * CELL))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect::new([0, 0], [100, 70]);

    fn damage() -> Damage {
        let mut damage = Damage::default();
        assert_eq!(damage.take(BOUNDS), [BOUNDS], "at first everything is new");
        assert!(damage.is_empty(), "and then nothing");
        damage
    }

    #[test]
    fn rectangles_cover_what_is_marked_once() {
        let mut damage = damage();
        for rect in [[[3, 5], [40, 6]], [[0, 33], [33, 34]], [[97, 60], [200, 90]], [[-9, -9], [0, 5]]] {
            damage.mark(Rect::new(rect[0], rect[1]));
        }
        let expected = [Rect::new([0, 0], [64, 64]), Rect::new([96, 32], [100, 70])];
        assert_eq!(damage.take(BOUNDS), expected, "whole cells, cut at the edges");
        assert!(damage.is_empty(), "all was taken");
        damage.mark(Rect::new([99, 69], [100, 70]));
        assert_eq!(damage.take(BOUNDS), [Rect::new([96, 64], [100, 70])], "the last pixel");
    }

    #[test]
    fn empty_rectangles_mark_nothing() {
        let mut damage = damage();
        damage.mark(Rect::new([5, 5], [5, 9]));
        damage.mark(Rect::new([500, 5], [600, 9]));
        assert!(damage.is_empty(), "no pixel inside");
    }
}
