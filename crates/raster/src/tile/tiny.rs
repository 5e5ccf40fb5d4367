//! Triangles of a few pixels to a few blocks, with one sample to a pixel: most
//! triangles of most frames.

use super::area::{BLOCKS, GROUPS};
use super::buffer::VisibilityBuffer;
use super::cover::{Counts, Cover};
use super::eight::Tiny;
use super::store::store_where;
use crate::simd::{Each, I32, LANES, Simd, lane_numbers, prelude::*};

impl Cover<'_> {
    /// A triangle of a few blocks, with one sample to a pixel.
    #[inline(always)]
    pub(super) fn tiny<S: Simd>(
        &self,
        simd: S,
        tiny: &Tiny,
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        buffer.settle();
        let [columns, rows] = [tiny.columns, tiny.rows];
        // Worth it where several groups may be saved.
        let refresh = columns[1] - columns[0] + rows[1] - rows[0] > 8;
        for block_y in rows[0] >> 3..(rows[1] >> 3) + 1 {
            for block_x in columns[0] >> 3..(columns[1] >> 3) + 1 {
                let block = block_y as usize * BLOCKS + block_x as usize;
                if self.hierarchical {
                    let bounds = buffer.blocks[block];
                    let farthest =
                        if refresh && bounds.stale { buffer.farthest_in(block) } else { bounds.farthest };
                    if self.hides(farthest, tiny.depth.high) {
                        counts.blocks_rejected += 1;
                        continue;
                    }
                }
                let groups = [ranged(columns, block_x * 8, 2), ranged(rows, block_y * 8, 1)];
                self.tiny_block(simd, tiny, place, buffer, (block, [block_x * 8, block_y * 8], groups));
                counts.groups +=
                    groups.iter().map(|[first, last]| (last - first + 1) as u64).product::<u64>();
                buffer.note_write(block, tiny.depth.high);
            }
        }
    }

    /// Some groups of a block: columns and rows, ends included.
    #[inline(always)]
    fn tiny_block<S: Simd>(
        &self,
        simd: S,
        tiny: &Tiny,
        place: u32,
        buffer: &mut VisibilityBuffer,
        (block, corner, [columns, rows]): (usize, [i32; 2], [[i32; 2]; 2]),
    ) {
        let (x, y) = (lane_numbers(simd) & 3, lane_numbers(simd) >> 2);
        let first = [corner[0] + columns[0] * 4, corner[1] + rows[0] * 2];
        // Whole numbers, so that stepping along rounds nothing.
        let mut edges = [0, 1, 2].each(
            #[inline(always)]
            |k| {
                let start = tiny.start[k] + tiny.right[k] * first[0] + tiny.down[k] * first[1];
                x * tiny.right[k] + y * tiny.down[k] + start
            },
        );
        let zero = I32::splat(simd, 0);
        for row in rows[0]..rows[1] + 1 {
            let [mut a, mut b, mut c] = edges;
            let mut depths = tiny.depth.row(simd, self.point([first[0], corner[1] + row * 2], 0));
            for column in columns[0]..columns[1] + 1 {
                let covered = (a | b | c).simd_ge(zero);
                if covered.any_true() {
                    let depth = depths.here(simd);
                    let at = (block * GROUPS + (row * 2 + column) as usize) * LANES;
                    let seen = self.seen(simd, place, (covered, depth), buffer, at);
                    // Where nothing is seen nothing changes: dearer than a branch
                    // that is foreseen, and cheaper than one that is not.
                    store_where(simd, seen, (place, depth), buffer, at);
                }
                a += tiny.right[0] * 4;
                b += tiny.right[1] * 4;
                c += tiny.right[2] * 4;
                depths.step(simd);
            }
            edges = [0, 1, 2].each(
                #[inline(always)]
                |k| edges[k] + tiny.down[k] * 2,
            );
        }
    }
}

/// The groups of a block, `start` pixels from the tile's corner, that some pixels
/// lie in.
#[inline(always)]
fn ranged([first, last]: [i32; 2], start: i32, shift: i32) -> [i32; 2] {
    [(first.max(start) - start) >> shift, (last.min(start + 7) - start) >> shift]
}
