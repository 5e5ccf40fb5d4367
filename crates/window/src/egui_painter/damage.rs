//! The damaged area: cells of the screen to repaint, and rectangles made of them.

use trigon_raster::paint2d::Rect;

use super::extent::columns;

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

    /// Marks all cells inside `clip` that a triangle comes within a pixel of: long lines that are neither level nor
    /// upright leave most of the box around them unmarked. A triangle with a position that is not a number is not
    /// painted, so it does not matter what it marks.
    pub(super) fn mark_triangle(&mut self, corners: [[f32; 2]; 3], clip: Rect) {
        let corners = corners.map(|corner| corner.map(f64::from));
        let [a, b, c] = corners;
        let around = Rect::new(
            [0, 1].map(|axis| before(a[axis].min(b[axis]).min(c[axis]))),
            [0, 1].map(|axis| after(a[axis].max(b[axis]).max(c[axis]))),
        );
        let pixels = around.intersection(clip).intersection(self.bounds);
        if self.all || pixels.is_empty() {
            return;
        }
        let [first, last] = [pixels.min[1], pixels.max[1] - 1].map(|row| row / CELL);
        if first == last || pixels.max[0] - pixels.min[0] <= CELL {
            return self.mark(pixels);
        }
        for row in first..=last {
            let rows = [row * CELL, (row + 1) * CELL];
            let [left, right] = columns(&corners, [f64::from(rows[0] - 1), f64::from(rows[1] + 1)]);
            self.mark(Rect::new([before(left), rows[0]], [after(right), rows[1]]).intersection(pixels));
        }
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

/// A pixel boundary before a place, and one after it. Positions are rounded to 1/256 pixel: anything within a pixel
/// may be touched.
fn before(coordinate: f64) -> i32 {
    (coordinate - 1.0).round() as i32
}

fn after(coordinate: f64) -> i32 {
    (coordinate + 1.0).round() as i32
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
    use proptest::prelude::*;

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

    /// Whether a pixel's centre is inside a triangle or on its edge.
    fn covers([a, b, c]: [[f64; 2]; 3], at: [f64; 2]) -> bool {
        let side = |from: [f64; 2], to: [f64; 2]| {
            (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
        };
        let sides = [side(a, b), side(b, c), side(c, a)];
        sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
    }

    proptest! {
        #[test]
        fn triangles_mark_what_they_cover(
            corners in prop::array::uniform3([-150.0..250f32, -100.0..170f32]),
            clip in [-20..120i32, -20..90, -20..120, -20..90],
        ) {
            let clip = Rect::new([clip[0], clip[1]], [clip[2], clip[3]]);
            let mut damage = damage();
            damage.mark_triangle(corners, clip);
            let marked = damage.take(BOUNDS);
            let corners = corners.map(|corner| corner.map(f64::from));
            let is_in = |rect: &Rect, at: [i32; 2]| rect.contains(Rect::new(at, at.map(|coordinate| coordinate + 1)));
            for at in (0..70).flat_map(|y| (0..100).map(move |x| [x, y])).filter(|&at| is_in(&clip, at)) {
                let is_covered = covers(corners, at.map(|coordinate| f64::from(coordinate) + 0.5));
                prop_assert!(!is_covered || marked.iter().any(|rect| is_in(rect, at)), "{at:?}, {marked:?}");
            }
        }
    }

    #[test]
    fn a_slanting_line_leaves_what_is_far_from_it_unmarked() {
        let mut damage = damage();
        damage.mark_triangle([[0.0, 0.0], [100.0, 70.0], [100.0, 71.0]], BOUNDS);
        let marked = damage.take(BOUNDS);
        let corners = [[5, 60], [90, 5]].map(|at| Rect::new(at, at.map(|coordinate| coordinate + 1)));
        for corner in corners {
            assert!(!marked.iter().any(|rect| rect.contains(corner)), "{corner:?} in {marked:?}");
        }
        damage.mark_triangle([[f32::NAN, 0.0], [50.0, f32::INFINITY], [9.0, 9.0]], BOUNDS);
        damage.take(BOUNDS);
    }

    #[test]
    fn empty_rectangles_mark_nothing() {
        let mut damage = damage();
        damage.mark(Rect::new([5, 5], [5, 9]));
        damage.mark(Rect::new([500, 5], [600, 9]));
        assert!(damage.is_empty(), "no pixel inside");
    }
}
