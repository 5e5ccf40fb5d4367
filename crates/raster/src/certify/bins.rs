//! Lists for each tile the contenders that may be visible there.

use super::contender::{Contenders, extent};
use crate::view::FrameView;

/// Numbers of contenders, sorted by tile.
pub(super) struct Bins {
    columns: u32,
    /// (tile, contender), ascending.
    pairs: Vec<(u32, u32)>,
}

impl Bins {
    /// Lists each contender in the tiles that its rectangle overlaps.
    pub(super) fn new(frame: &FrameView<'_>, contenders: &Contenders) -> Self {
        let grid = &frame.grid;
        let sides = [grid.viewport.width, grid.viewport.height].map(|side| side as i32);
        let mut pairs = Vec::new();
        for (number, contender) in contenders.list.iter().enumerate() {
            let extent = extent(contenders.corners_of(contender), contender.drift);
            let [Some(columns), Some(rows)] = extent.map(|range| grid.pattern.pixels_between(range)) else {
                continue;
            };
            if columns[1] < 0 || rows[1] < 0 || columns[0] >= sides[0] || rows[0] >= sides[1] {
                continue;
            }
            let tiles = grid.tiles_that_see(columns, rows);
            for row in tiles.rows {
                pairs
                    .extend(tiles.columns.clone().map(|column| (row * grid.columns + column, number as u32)));
            }
        }
        pairs.sort_unstable();
        Self { columns: grid.columns, pairs }
    }

    /// The contenders of a tile.
    pub(super) fn of(&self, [column, row]: [u32; 2]) -> impl Iterator<Item = &u32> {
        let tile = row * self.columns + column;
        let start = self.pairs.partition_point(|pair| pair.0 < tile);
        let end = self.pairs.partition_point(|pair| pair.0 <= tile);
        self.pairs[start..end].iter().map(|(_, contender)| contender)
    }
}
