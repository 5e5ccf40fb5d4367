//! Warnock's algorithm (J. E. Warnock, "A hidden surface algorithm for computer generated halftone images",
//! University of Utah, 1969). A window that shows one face, or that the nearest face fills, is painted. Any other
//! window is divided into four, down to single pixels.

use super::{Drawing, Scene, Surface};
use std::ops::Range;

pub(super) fn draw(scene: &Scene) -> Drawing {
    let surfaces = scene.faces().filter_map(|(number, face)| Some((number, Surface::new(face)?))).collect();
    let mut drawer = Drawer { scene, surfaces, drawing: Drawing::empty(scene.size()) };
    let all: Vec<usize> = (0..drawer.surfaces.len()).collect();
    let [width, height] = scene.limits();
    drawer.window(&Window { columns: 0..width, rows: 0..height }, &all);
    drawer.drawing
}

struct Drawer<'a> {
    scene: &'a Scene,
    surfaces: Vec<(u32, Surface)>,
    drawing: Drawing,
}

/// A rectangle of pixels.
struct Window {
    columns: Range<i32>,
    rows: Range<i32>,
}

impl Window {
    fn corners(&self) -> [[i32; 2]; 4] {
        let (left, right) = (self.columns.start, self.columns.end - 1);
        let (top, bottom) = (self.rows.start, self.rows.end - 1);
        [[left, top], [right, top], [left, bottom], [right, bottom]]
    }

    /// The parts that are not empty.
    fn quarters(&self) -> impl Iterator<Item = Window> {
        let halves = |range: &Range<i32>| {
            let middle = range.start + (range.end - range.start + 1) / 2;
            [range.start..middle, middle..range.end]
        };
        let (columns, rows) = (halves(&self.columns), halves(&self.rows));
        let quarters = rows
            .into_iter()
            .flat_map(move |rows| columns.clone().map(|columns| Window { columns, rows: rows.clone() }));
        quarters.filter(|window| !window.columns.is_empty() && !window.rows.is_empty())
    }

    fn is_pixel(&self) -> bool {
        self.columns.len() == 1 && self.rows.len() == 1
    }

    fn pixels(&self) -> impl Iterator<Item = [i32; 2]> {
        let columns = self.columns.clone();
        self.rows.clone().flat_map(move |y| columns.clone().map(move |x| [x, y]))
    }
}

impl Drawer<'_> {
    /// Draws a window of which only some faces can be seen.
    fn window(&mut self, window: &Window, candidates: &[usize]) {
        let corners = window.corners();
        self.drawing.tests += candidates.len() as u64;
        let meeting: Vec<usize> =
            candidates.iter().copied().filter(|&face| self.meets(face, window, &corners)).collect();
        if let [face] = meeting[..] {
            self.paint(face, window);
        } else if window.is_pixel() {
            self.paint_nearest(&meeting, corners[0]);
        } else if let Some(face) = self.filling(&meeting, &corners) {
            self.paint(face, window);
        } else if !meeting.is_empty() {
            window.quarters().for_each(|quarter| self.window(&quarter, &meeting));
        }
    }

    fn meets(&self, face: usize, window: &Window, corners: &[[i32; 2]; 4]) -> bool {
        let surface = &self.surfaces[face].1;
        let [columns, rows] = surface.bounding_box(self.scene.limits());
        let apart =
            |a: &Range<i32>, b: &std::ops::RangeInclusive<i32>| a.end <= *b.start() || *b.end() < a.start;
        !apart(&window.columns, &columns) && !apart(&window.rows, &rows) && !surface.misses(corners)
    }

    /// The face that fills the window and lies before all others at its four corners,
    /// and so, as all are flat, everywhere in it.
    fn filling(&self, meeting: &[usize], corners: &[[i32; 2]; 4]) -> Option<usize> {
        let surface = |face: usize| &self.surfaces[face].1;
        let fills = |face: usize| corners.iter().all(|&corner| surface(face).covers(corner));
        let depth = |face: usize| surface(face).depth(corners[0]);
        let filling = meeting.iter().copied().filter(|&face| fills(face));
        let nearest = filling.max_by(|&a, &b| depth(a).total_cmp(&depth(b)))?;
        let is_before = |other: usize| {
            corners.iter().all(|&corner| surface(nearest).depth(corner) >= surface(other).depth(corner))
        };
        meeting.iter().all(|&other| is_before(other)).then_some(nearest)
    }

    fn paint(&mut self, face: usize, window: &Window) {
        let (number, surface) = &self.surfaces[face];
        for pixel in window.pixels().filter(|&pixel| surface.covers(pixel)) {
            self.drawing.faces[pixel.map(|part| part as usize)] = *number;
        }
    }

    fn paint_nearest(&mut self, candidates: &[usize], pixel: [i32; 2]) {
        let surfaces = candidates.iter().map(|&face| &self.surfaces[face]);
        let covering = surfaces.filter(|(_, surface)| surface.covers(pixel));
        let nearest = covering.max_by(|(_, a), (_, b)| a.depth(pixel).total_cmp(&b.depth(pixel)));
        if let Some(&(number, _)) = nearest {
            self.drawing.faces[pixel.map(|part| part as usize)] = number;
        }
    }
}
