//! Depth queries: where a masked or translucent triangle is in front of the visible triangles of a
//! tile, eight samples at a time. A lane is one pixel of a group of 4×2. Nothing is stored: the caller
//! gets the visible lanes and their depths. The depth test is that of `TileRasterizer::visible_lanes`.
//!
//! [`Blocks`] are sets of a tile's blocks of 8×8 pixels.

use super::{Ties, TileTriangle};
use crate::bin::TriangleRef;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, lane_numbers, prelude::*};
use crate::tile_buffer::{BLOCKS, NO_TRIANGLE, TileArea, VisibilityBuffer};
use crate::view::FrameView;

/// A tile whose opaque triangles are drawn.
#[derive(Clone, Copy)]
pub(crate) struct TileView<'t> {
    pub(crate) frame: &'t FrameView<'t>,
    pub(crate) area: &'t TileArea,
    pub(crate) buffer: &'t VisibilityBuffer,
    /// The tile's triangles.
    pub(crate) triangles: &'t [TriangleRef],
    pub(crate) ties: &'t Ties,
}

/// A triangle with its index among the tile's.
#[derive(Clone, Copy)]
pub(crate) struct Candidate<'c> {
    pub(crate) covering: &'c TileTriangle,
    pub(crate) triangle: u32,
}

/// The samples of one number in a group of pixels: four columns, two rows.
#[derive(Clone, Copy)]
pub(crate) struct SampleGroup {
    /// The index of the group in the tile.
    pub(crate) group: usize,
    pub(crate) sample: usize,
    /// Column and row of its first pixel in the tile.
    first: [i32; 2],
    /// The position of its first sample in 1/256 pixel.
    pub(crate) point: [i32; 2],
}

impl SampleGroup {
    /// The index of a lane's pixel in the tile.
    #[inline(always)]
    pub(crate) fn pixel(&self, lane: usize) -> usize {
        self.group * LANES + lane
    }
}

impl TileView<'_> {
    /// Calls `visit` for all samples of some blocks at which a triangle would be visible:
    /// group by group, sample by sample, with those lanes and the depths.
    #[inline(always)]
    pub(crate) fn for_each_visible<S: Simd>(
        &self,
        simd: S,
        candidate: Candidate<'_>,
        blocks: Blocks,
        mut visit: impl FnMut(SampleGroup, Mask<S>, F32<S>),
    ) {
        let covering = candidate.covering;
        for block in blocks.within(covering.columns, covering.rows) {
            let corner = Blocks::corner(block);
            let [outside, inside] = covering.block_sides(corner);
            if outside || self.hides_block(block, covering) {
                continue;
            }
            for (row, column) in groups(covering, corner) {
                let first = [corner[0] + column * 4, corner[1] + row * 2];
                for (sample, &offset) in self.frame.grid.pattern.offsets().iter().enumerate() {
                    let group = block * 8 + (row * 2 + column) as usize;
                    let group = SampleGroup { group, sample, first, point: self.area.point(first, offset) };
                    let covered = match inside {
                        true => self.within_image(simd, first),
                        false => self.covered(simd, covering, group),
                    };
                    if let Some((visible, depth)) = self.visible_lanes(simd, candidate, covered, group) {
                        visit(group, visible, depth);
                    }
                }
            }
        }
    }

    /// The lanes of a group in which a triangle would be visible, with its depths; `None`
    /// if there are none.
    #[inline(always)]
    pub(crate) fn look<S: Simd>(
        &self,
        simd: S,
        candidate: Candidate<'_>,
        group: SampleGroup,
    ) -> Option<(Mask<S>, F32<S>)> {
        let covered = self.covered(simd, candidate.covering, group);
        self.visible_lanes(simd, candidate, covered, group)
    }

    /// Whether a triangle at this depth would be visible at a sample of the buffer.
    #[inline]
    pub(super) fn is_visible(&self, index: usize, depth: f32, triangle: u32) -> bool {
        let there = self.buffer.depth[index];
        depth > there || (depth == there && self.precedes_at_tie(triangle, self.buffer.visible[index]))
    }

    fn precedes_at_tie(&self, triangle: u32, visible: u32) -> bool {
        visible != NO_TRIANGLE && self.ties.compare(self.frame, self.triangles, [triangle, visible]).is_lt()
    }

    #[inline(always)]
    fn hides_block(&self, block: usize, covering: &TileTriangle) -> bool {
        self.frame.hierarchical && self.buffer.blocks.farthest[block] > covering.depth.high
    }

    /// The lanes of a group that lie in the image.
    #[inline(always)]
    fn within_image<S: Simd>(&self, simd: S, [x, y]: [i32; 2]) -> Mask<S> {
        let [width, height] = self.area.size.each(
            #[inline(always)]
            |side| side as i32,
        );
        if x + 4 <= width && y + 2 <= height {
            return Mask::splat(simd, true);
        }
        let (columns, rows) = columns_and_rows(simd);
        columns.simd_lt(I32::splat(simd, width - x)) & rows.simd_lt(I32::splat(simd, height - y))
    }

    /// The lanes of a group that a triangle covers, in the image.
    #[inline(always)]
    fn covered<S: Simd>(&self, simd: S, covering: &TileTriangle, group: SampleGroup) -> Mask<S> {
        let covered = match &covering.special {
            None => {
                let (columns, rows) = columns_and_rows(simd);
                let [a, b, c] = [0, 1, 2].each(
                    #[inline(always)]
                    |k| {
                        // Partial sums may wrap around; the sum fits.
                        let start = covering.starts[group.sample][k]
                            .wrapping_add(covering.right[k].wrapping_mul(group.first[0]))
                            .wrapping_add(covering.down[k].wrapping_mul(group.first[1]));
                        columns * covering.right[k] + rows * covering.down[k] + start
                    },
                );
                (a | b | c).simd_ge(I32::splat(simd, 0))
            }
            Some(special) => special.covers_group(simd, group.point),
        };
        covered & self.within_image(simd, group.first)
    }

    /// The covered lanes in which a triangle would be visible.
    #[inline(always)]
    fn visible_lanes<S: Simd>(
        &self,
        simd: S,
        candidate: Candidate<'_>,
        covered: Mask<S>,
        group: SampleGroup,
    ) -> Option<(Mask<S>, F32<S>)> {
        if !covered.any_true() {
            return None;
        }
        let depth = candidate.covering.depth.group(simd, group.point);
        let index = (group.group * self.buffer.samples + group.sample) * LANES;
        let there = F32::from_slice(simd, &self.buffer.depth[index..index + LANES]);
        let mut visible = covered & depth.simd_gt(there);
        let ties = covered & depth.simd_eq(there);
        if ties.any_true() {
            let won = self.preceded_ties(candidate.triangle, ties.to_bitmask(), index);
            visible |= Mask::from_bitmask(simd, won);
        }
        visible.any_true().then_some((visible, depth))
    }

    /// In which of the lanes of equal depth the triangle has the smaller key.
    #[cold]
    fn preceded_ties(&self, triangle: u32, ties: u64, index: usize) -> u64 {
        let wins = |lane: &usize| {
            ties >> lane & 1 != 0 && self.precedes_at_tie(triangle, self.buffer.visible[index + lane])
        };
        (0..LANES).filter(wins).fold(0, |won, lane| won | 1 << lane)
    }
}

/// The columns and rows of the lanes in their group.
#[inline(always)]
fn columns_and_rows<S: Simd>(simd: S) -> (I32<S>, I32<S>) {
    (lane_numbers(simd) & 3, lane_numbers(simd) >> 2)
}

/// Rows and columns of the groups of a block that a triangle may touch.
#[inline(always)]
fn groups(covering: &TileTriangle, [left, top]: [i32; 2]) -> impl Iterator<Item = (i32, i32)> {
    let clip = |[first, last]: [i32; 2], start: i32, shift: i32| {
        ((first.max(start) - start) >> shift)..=((last.min(start + 7) - start) >> shift)
    };
    let columns = clip(covering.columns, left, 2);
    clip(covering.rows, top, 1).flat_map(move |row| columns.clone().map(move |column| (row, column)))
}

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
