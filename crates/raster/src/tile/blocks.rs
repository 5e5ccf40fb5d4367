//! Sets of a tile's blocks of 8 by 8 pixels.

use crate::tile_buffer::{BLOCKS, TileArea};

/// Some blocks of a tile: bit `8 · row + column` for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Blocks(u64);

impl Blocks {
    pub(crate) const NONE: Self = Self(0);
    /// All that a tile can have.
    pub(crate) const ALL: Self = Self(u64::MAX);

    /// The blocks that a tile has a pixel of.
    pub(crate) fn of(area: &TileArea) -> Self {
        let [columns, rows] = area.size.map(|side| side.div_ceil(8));
        let row = (1 << columns) - 1;
        Self((0..rows).fold(0, |blocks, y| blocks | row << (y * BLOCKS)))
    }

    pub(crate) fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub(crate) fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    #[inline(always)]
    pub(crate) fn insert(&mut self, block: usize) {
        self.0 |= 1 << block;
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline(always)]
    pub(crate) fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    pub(crate) fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Removes up to `count` blocks and returns them.
    pub(crate) fn take(&mut self, count: usize) -> Self {
        let mut rest = *self;
        for _ in 0..count {
            rest.0 &= rest.0.wrapping_sub(1);
        }
        let taken = self.without(rest);
        *self = rest;
        taken
    }

    /// The numbers of the blocks, ascending.
    #[inline(always)]
    pub(crate) fn iter(self) -> impl Iterator<Item = usize> {
        let mut rest = self.0;
        std::iter::from_fn(move || {
            let block = rest.trailing_zeros() as usize;
            rest &= rest.wrapping_sub(1);
            (block < u64::BITS as usize).then_some(block)
        })
    }

    /// The numbers of the blocks that have a pixel in these columns and rows of
    /// the tile, ends included.
    #[inline(always)]
    pub(crate) fn within(self, columns: [i32; 2], rows: [i32; 2]) -> impl Iterator<Item = usize> {
        let rows = rows[0] >> 3..=rows[1] >> 3;
        let blocks = rows.flat_map(move |y| {
            (columns[0] >> 3..=columns[1] >> 3).map(move |x| y as usize * BLOCKS + x as usize)
        });
        blocks.filter(move |block| self.0 >> block & 1 != 0)
    }

    /// Column and row of a block's first pixel.
    #[inline(always)]
    pub(crate) fn corner(block: usize) -> [i32; 2] {
        [(block % BLOCKS * 8) as i32, (block / BLOCKS * 8) as i32]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tile_is_taken_apart_block_by_block() {
        let area = TileArea { origin: [0, 0], size: [17, 9], margin: [0, 0] };
        let mut left = Blocks::of(&area);
        assert_eq!(left.iter().collect::<Vec<_>>(), [0, 1, 2, 8, 9, 10], "three columns, two rows");
        assert_eq!(left.within([8, 15], [3, 8]).collect::<Vec<_>>(), [1, 9], "the middle column");
        let first = left.take(4);
        assert_eq!((first.len(), left.iter().collect::<Vec<_>>()), (4, vec![9, 10]), "four, then the rest");
        assert_eq!(left.take(9).len(), 2, "no more than there are");
        assert!(left.is_empty(), "nothing is left");
    }

    #[test]
    fn the_largest_tile_has_all_blocks() {
        let area = TileArea { origin: [0, 0], size: [64, 64], margin: [0, 0] };
        assert_eq!(Blocks::of(&area), Blocks::ALL, "64 of them");
        assert_eq!(Blocks::ALL.iter().count(), 64, "one after another");
    }
}
