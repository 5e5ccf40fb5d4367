//! Which triangles each tile has to look at, in order.

use crate::setup::{SampleBounds, SetupTriangle};
use crate::tile::Edge;
use crate::viewport::Viewport;

/// The tiles of a frame: `columns * rows` squares of `size` samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) viewport: Viewport,
    pub(crate) size: u32,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
}

impl Grid {
    pub(crate) fn new(viewport: Viewport, size: u32) -> Self {
        let columns = viewport.width.div_ceil(size);
        let rows = viewport.height.div_ceil(size);
        Self { viewport, size, columns, rows }
    }
}

/// For each tile the ordinals of triangles that may cover a sample in it,
/// ascending.
#[derive(Default)]
pub(crate) struct Bins {
    /// Where each tile's entries start; one more than there are tiles.
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl Bins {
    /// Sorts the triangles `ordinals` of `triangles` into the tiles of `grid`,
    /// counting first and filling in second.
    pub(crate) fn new(grid: Grid, triangles: &[SetupTriangle], ordinals: &[u32]) -> Self {
        if ordinals.is_empty() {
            return Self::default();
        }
        let mut starts = vec![0_u32; (grid.columns * grid.rows) as usize + 1];
        for &ordinal in ordinals {
            for_each_tile(grid, &triangles[ordinal as usize], |tile| starts[tile + 1] += 1);
        }
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        let mut next = starts.clone();
        let mut entries = vec![0; starts[starts.len() - 1] as usize];
        for &ordinal in ordinals {
            for_each_tile(grid, &triangles[ordinal as usize], |tile| {
                entries[next[tile] as usize] = ordinal;
                next[tile] += 1;
            });
        }
        Self { starts, entries }
    }

    /// The triangles of the tile `index`, numbered row by row.
    pub(crate) fn tile(&self, index: usize) -> &[u32] {
        match (self.starts.get(index), self.starts.get(index + 1)) {
            (Some(&start), Some(&end)) => &self.entries[start as usize..end as usize],
            _ => &[],
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }
}

/// The tiles that a triangle may have samples in: those of its bounding box,
/// without those that lie outside one of its edges.
fn for_each_tile(grid: Grid, triangle: &SetupTriangle, mut visit: impl FnMut(usize)) {
    let Some(SampleBounds { x, y }) = triangle.sample_bounds() else {
        return;
    };
    let tiles = |[first, last]: [i32; 2], side: u32| {
        let last = last.min(side as i32 - 1);
        first.max(0) as u32 / grid.size..=last as u32 / grid.size
    };
    let (columns, rows) = (tiles(x, grid.viewport.width), tiles(y, grid.viewport.height));
    let few = (columns.end() - columns.start()) + (rows.end() - rows.start()) <= 1;
    let edges = (!few).then(|| Edge::of(triangle));
    for row in rows {
        for column in columns.clone() {
            let touched = |edges: &[Edge; 3]| {
                let corner = [(column * grid.size) as i32, (row * grid.size) as i32];
                edges.iter().all(|edge| edge.reaches(corner, grid.size))
            };
            if edges.as_ref().is_none_or(touched) {
                visit((row * grid.columns + column) as usize);
            }
        }
    }
}
