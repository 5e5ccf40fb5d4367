//! Triangles that may hide points, and the quick tests that come before the exact one.
//!
//! Most points in the pixels around a triangle lie beside it or before it. Boxes in f32 that are a
//! little too large tell that of nearly all of them. Triangles that follow each other
//! mostly lie side by side: a few such look at the points around them together.

use std::ops::Range;

use super::screen::{Screen, Spot};

/// By how much a triangle's box is enlarged before points in f32 are held against it, in
/// pixels: more than what f32 rounds of coordinates up to 65,536, of both.
const ROUNDED: f64 = 1.0 / 64.0;

/// Triangles in a group.
const MOST: usize = 8;

/// What most triangles need to know of a point, rounded: it takes a third of the memory.
#[derive(Clone, Copy)]
pub(super) struct Probe {
    at: [f32; 2],
    /// Not nearer than the depth that hides the point.
    depth: f32,
}

impl Probe {
    pub(super) fn new(screen: &Screen, spot: &Spot) -> Self {
        let depth = (screen.hiding_depth(spot.depth) as f32).next_down();
        Self { at: spot.at.to_array().map(|at| at as f32), depth }
    }
}

/// What triangles hide at most.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    min: [f32; 2],
    max: [f32; 2],
    /// Not farther than the nearest corner.
    nearest: f32,
}

impl Extent {
    fn new(piece: &[Spot; 3]) -> Self {
        let [a, b, c] = piece.map(|spot| spot.at);
        let (min, max) = (a.min(b).min(c) - ROUNDED, a.max(b).max(c) + ROUNDED);
        let nearest = piece.iter().fold(f64::NEG_INFINITY, |nearest, spot| nearest.max(spot.depth));
        let [min, max] = [min, max].map(|corner| corner.to_array().map(|at| at as f32));
        Self { min, max, nearest: (nearest as f32).next_up() }
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            min: [0, 1].map(|axis| self.min[axis].min(other.min[axis])),
            max: [0, 1].map(|axis| self.max[axis].max(other.max[axis])),
            nearest: self.nearest.max(other.nearest),
        }
    }

    /// `false` is a proof that the triangles do not hide the point.
    #[inline(always)]
    pub(super) fn may_hide(&self, probe: &Probe) -> bool {
        // All of them at once: each is as likely as not.
        (probe.depth < self.nearest)
            & (probe.at[0] >= self.min[0])
            & (probe.at[0] <= self.max[0])
            & (probe.at[1] >= self.min[1])
            & (probe.at[1] <= self.max[1])
    }
}

/// Some pixels of an area, counted from its first.
#[derive(Clone)]
pub(super) struct Pixels {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
}

impl Pixels {
    fn union(&self, other: &Self) -> Self {
        let around = |a: &Range<u32>, b: &Range<u32>| a.start.min(b.start)..a.end.max(b.end);
        Self { columns: around(&self.columns, &other.columns), rows: around(&self.rows, &other.rows) }
    }

    fn count(&self) -> usize {
        self.columns.len() * self.rows.len()
    }
}

/// A triangle that may hide points.
pub(super) struct Occluder {
    pub(super) piece: [Spot; 3],
    pub(super) face: u32,
    pub(super) extent: Extent,
}

impl Occluder {
    pub(super) fn new(piece: &[Spot; 3], face: u32) -> Self {
        Self { piece: *piece, face, extent: Extent::new(piece) }
    }
}

/// All triangles of a group.
pub(super) struct Around {
    pub(super) pixels: Pixels,
    pub(super) extent: Extent,
}

/// Triangles side by side.
#[derive(Default)]
pub(super) struct Group {
    occluders: Vec<Occluder>,
    around: Option<Around>,
}

impl Group {
    pub(super) fn clear(&mut self) {
        self.occluders.clear();
        self.around = None;
    }

    /// Whether a triangle in these pixels belongs to the group: together they look at no more
    /// pixels than one after the other.
    pub(super) fn takes(&self, pixels: &Pixels) -> bool {
        let Some(around) = &self.around else { return true };
        let apart = around.pixels.count() + pixels.count();
        self.occluders.len() < MOST && around.pixels.union(pixels).count() <= apart
    }

    pub(super) fn push(&mut self, occluder: Occluder, pixels: Pixels) {
        self.around = Some(match &self.around {
            None => Around { pixels, extent: occluder.extent },
            Some(around) => {
                Around { pixels: around.pixels.union(&pixels), extent: around.extent.union(&occluder.extent) }
            }
        });
        self.occluders.push(occluder);
    }

    pub(super) fn occluders(&self) -> &[Occluder] {
        &self.occluders
    }

    /// What is around all of them; `None` of nothing.
    pub(super) fn around(&self) -> Option<&Around> {
        self.around.as_ref()
    }
}
