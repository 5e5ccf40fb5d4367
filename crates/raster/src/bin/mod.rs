//! Which triangles each tile has to look at, in order.

use crate::setup::{SampleBounds, SetupTriangle};
use crate::tile::Edge;
use crate::viewport::Viewport;
use std::ops::Range;

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
    starts: Vec<usize>,
    entries: Vec<u32>,
}

impl Bins {
    /// Sorts the triangles `ordinals` of `triangles` into the tiles of `grid`,
    /// counting first and filling in second.
    pub(crate) fn new(grid: Grid, triangles: &[SetupTriangle], ordinals: &[u32]) -> Self {
        if ordinals.is_empty() {
            return Self::default();
        }
        let mut starts = vec![0_usize; (grid.columns * grid.rows) as usize + 1];
        for &ordinal in ordinals {
            for_each_tile(grid, &triangles[ordinal as usize], |tile| starts[tile + 1] += 1);
        }
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        let mut next = starts.clone();
        let mut entries = vec![0; starts[starts.len() - 1]];
        for &ordinal in ordinals {
            for_each_tile(grid, &triangles[ordinal as usize], |tile| {
                entries[next[tile]] = ordinal;
                next[tile] += 1;
            });
        }
        Self { starts, entries }
    }

    /// The triangles of the tile `index`, numbered row by row.
    pub(crate) fn tile(&self, index: usize) -> &[u32] {
        match (self.starts.get(index), self.starts.get(index + 1)) {
            (Some(&start), Some(&end)) => &self.entries[start..end],
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
        first.max(0) as u32 / grid.size..last as u32 / grid.size + 1
    };
    let (columns, rows) = (tiles(x, grid.viewport.width), tiles(y, grid.viewport.height));
    let few = columns.len() + rows.len() <= 3;
    let edges = (!few).then(|| Edge::of(triangle));
    for row in rows {
        let columns = match &edges {
            None => columns.clone(),
            Some(edges) => columns_inside(edges, grid, columns.clone(), row),
        };
        for column in columns {
            visit((row * grid.columns + column) as usize);
        }
    }
}

/// Those tiles of a row that lie outside none of the edges.
///
/// The greatest value of an edge in a tile grows by the same step from tile to
/// tile, so its sign changes at one column, which a division finds exactly: a
/// long thin triangle costs as much as the tiles that it crosses, not as those
/// of its bounding box.
fn columns_inside(edges: &[Edge; 3], grid: Grid, columns: Range<u32>, row: u32) -> Range<u32> {
    let (mut first, mut last) = (i64::from(columns.start), i64::from(columns.end) - 1);
    for edge in edges {
        let greatest = edge.range([0, (row * grid.size) as i32], grid.size)[1] + edge.bias();
        let step = i64::from(edge.right) * 256 * i64::from(grid.size);
        match step.signum() {
            1 => first = first.max(-greatest.div_euclid(step)),
            -1 => last = last.min(greatest.div_euclid(-step)),
            _ if greatest < 0 => last = -1,
            _ => {}
        }
    }
    if first <= last { first as u32..last as u32 + 1 } else { 0..0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = [i32; 2]> {
        let (near, far) = (-20_000..60_000, -(1 << 23)..1 << 24);
        prop_oneof![3 => [near.clone(), near], 1 => [far.clone(), far]]
    }

    proptest! {
        /// Asking every tile of the picture whether it lies outside an edge.
        #[test]
        fn a_triangle_is_in_the_tiles_that_no_edge_shuts_out(
            points in [point(), point(), point()],
            size in prop_oneof![Just(8_u32), Just(63), Just(64)],
        ) {
            let triangle = SetupTriangle::on_grid(points);
            prop_assume!(triangle.doubled_area() != 0);
            let grid = Grid::new(Viewport { width: 200, height: 150 }, size);
            let mut binned = Vec::new();
            let Some(SampleBounds { x, y }) = triangle.sample_bounds() else { return Ok(()) };
            prop_assume!(x[1] >= 0 && y[1] >= 0 && x[0] < 200 && y[0] < 150);
            for_each_tile(grid, &triangle, |tile| binned.push(tile as u32));
            for tile in 0..grid.columns * grid.rows {
                let corner = [tile % grid.columns, tile / grid.columns].map(|v| (v * size) as i32);
                let reached = |edge: &Edge| edge.range(corner, size)[1] + edge.bias() >= 0;
                let inside = Edge::of(&triangle).iter().all(reached);
                let meets = |[first, last]: [i32; 2], at: i32| first < at + size as i32 && at <= last;
                let expected = inside && meets(x, corner[0]) && meets(y, corner[1]);
                let found = binned.contains(&tile);
                prop_assert!(found || !expected, "tile {} is missing", tile);
                prop_assert!(expected || !found || binned.len() <= 2, "tile {} is in vain", tile);
            }
        }
    }
}
