//! Which blocks of a tile, and which groups of a block, lie outside an edge of a triangle or inside all of them: eight at
//! a time, where [`TileTriangle::block_sides`] tells it of one block.

use super::triangle::TileTriangle;
use crate::simd::{I32, InlineMap, LANES, Simd, lane_numbers, prelude::*};

/// The edge functions of a triangle at eight blocks or groups, less what leads from the tile's first pixel to the first of
/// them.
pub(super) struct Sides<S: Simd> {
    /// For the blocks in a row of the tile, at the sample of each with the greatest value.
    greatest: [I32<S>; 3],
    /// The same with the least value.
    least: [I32<S>; 3],
    /// What leads from the values at the first pixel of a group, less those of the tile's first pixel, to the sample of the
    /// group with the greatest value.
    in_group: [i32; 3],
}

/// All blocks of a row, or all groups of a block.
pub(super) const ALL: u64 = (1 << LANES) - 1;

impl<S: Simd> Sides<S> {
    /// Products and sums may wrap around, but what is compared in the end is a value of the edge in the tile, which fits
    /// 32 bits.
    #[inline(always)]
    pub(super) fn new(simd: S, covering: &TileTriangle) -> Self {
        let TileTriangle { right, down, range: [least, greatest], .. } = covering;
        let lanes = lane_numbers(simd);
        Self {
            greatest: [0, 1, 2].each(
                #[inline(always)]
                |k| {
                    let way = steps([right[k].max(0), down[k].max(0)], [7, 7]);
                    lanes * right[k].wrapping_mul(8) + greatest[k].wrapping_add(way)
                },
            ),
            least: [0, 1, 2].each(
                #[inline(always)]
                |k| {
                    let way = steps([right[k].min(0), down[k].min(0)], [7, 7]);
                    lanes * right[k].wrapping_mul(8) + least[k].wrapping_add(way)
                },
            ),
            in_group: [0, 1, 2].each(
                #[inline(always)]
                |k| greatest[k].wrapping_add(steps([right[k].max(0), down[k].max(0)], [3, 1])),
            ),
        }
    }

    /// The blocks of a row, whose first pixels lie in row `y` of the tile, that lie outside an edge; and those that lie
    /// inside all of them.
    #[inline(always)]
    pub(super) fn blocks(&self, simd: S, covering: &TileTriangle, y: i32) -> [u64; 2] {
        let [greatest, least] = [&self.greatest, &self.least].each(
            #[inline(always)]
            |values| {
                inside(
                    simd,
                    [0, 1, 2].each(
                        #[inline(always)]
                        |k| values[k] + covering.down[k].wrapping_mul(y),
                    ),
                )
            },
        );
        [greatest ^ ALL, least]
    }

    /// The groups of a block that do not lie outside an edge, from what leads to their first pixels.
    #[inline(always)]
    pub(super) fn groups(&self, simd: S, firsts: [I32<S>; 3]) -> u64 {
        inside(
            simd,
            [0, 1, 2].each(
                #[inline(always)]
                |k| firsts[k] + self.in_group[k],
            ),
        )
    }
}

/// Where no value is negative.
#[inline(always)]
fn inside<S: Simd>(simd: S, [a, b, c]: [I32<S>; 3]) -> u64 {
    (a | b | c).simd_ge(I32::splat(simd, 0)).to_bitmask()
}

/// So many steps to the right and downwards.
#[inline(always)]
pub(super) fn steps([right, down]: [i32; 2], [columns, rows]: [i32; 2]) -> i32 {
    right.wrapping_mul(columns).wrapping_add(down.wrapping_mul(rows))
}
