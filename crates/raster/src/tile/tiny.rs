//! The tiny kernel: one small triangle of at most 24×24 pixels in the tile at a time. Most triangles
//! of most frames are drawn here.
//!
//! First the triangle is compared with the depth bounds of the blocks that its box touches
//! (`hides_tiny`).
//!
//! A vector holds a group of 4×2 pixels: lanes 0 to 3 are the upper row, lanes 4 to 7 the lower
//! one. The kernel visits every group of the triangle's bounding box, row by row, without a
//! branch on whether the group is covered. Such a branch would save the work of empty groups,
//! but which groups of a small box are empty is hard to predict.
//!
//! Lanes that are not covered get the depth minus infinity. Then one comparison with the
//! stored depth decides coverage and visibility together: a greater depth is nearer. This is the depth
//! test of `TileRasterizer::visible_lanes`, except that samples of equal depth are only noted; they
//! are resolved after the triangle (`resolve_ties`).
//!
//! With several samples per pixel, the same steps use the loops of `multisample`.

use super::eight::EightTriangles;
use super::multisample;
use super::multisample::EdgeOrigins;
use super::rasterizer::TileRasterizer;
use crate::simd::{
    F32, I32, InlineMap, LANES, Mask, Simd, U32, greater, inlined, lane_numbers, lesser, prelude::*,
};
use crate::stats::Counts;
use crate::tile_buffer::{BLOCKS, NO_TRIANGLE, TileArea, VisibilityBuffer, name_where};
use fearless_simd::f64x4;

/// The farthest depth of a block is computed again after this many writes to it
/// (`BlockBounds::writes`): a few small triangles seldom cover enough of a block to change it.
const WRITES: u32 = 4;

/// The fixed cost of testing a triangle's samples one by one, in units of
/// [`Ties`](super::Ties).
const COVERING: u32 = 16;

/// The triangle of one lane, copied to all lanes.
pub(super) struct Tiny<S: Simd> {
    pub(super) triangle: u32,
    /// First and last columns and rows of groups.
    pub(super) columns: [usize; 2],
    pub(super) rows: [usize; 2],
    /// What each lane adds to the edge functions at the group's first pixel; the step to the
    /// next group (four pixels); the step to the next row of groups (two pixels).
    pub(super) lanes: [I32<S>; 3],
    pub(super) right: [I32<S>; 3],
    pub(super) down: [I32<S>; 3],
    /// The plane of depth at the first vertex, its slopes to the right and downwards for 1/256
    /// pixel, and the range of the vertices' depths, which no depth may leave.
    pub(super) value: f64x4<S>,
    pub(super) slopes: [f64x4<S>; 2],
    pub(super) low: F32<S>,
    pub(super) high: F32<S>,
}

/// One of eight triangles that were prepared together.
pub(super) struct PreparedTriangle<'e> {
    pub(super) eight: &'e EightTriangles,
    pub(super) origins: &'e mut EdgeOrigins,
    pub(super) lane: usize,
}

/// The first group of a triangle whose pixels have one sample.
struct Start<S: Simd> {
    /// The edge functions at the first group.
    edges: [I32<S>; 3],
    /// The offset of its lanes from the triangle's first vertex, in 1/256 pixel.
    vertex_offset: [f64x4<S>; 2],
}

impl<S: Simd> Start<S> {
    #[inline(always)]
    fn new(simd: S, tiny: &Tiny<S>, origins: &EdgeOrigins, lane: usize, offset: [i32; 2]) -> Self {
        let [dx, dy] = origins.vertex_offset(simd, lane, offset);
        let edges = origins.edges(simd, 0, lane);
        Self {
            edges: [0, 1, 2].each(
                #[inline(always)]
                |k| tiny.lanes[k] + edges[k],
            ),
            vertex_offset: [dx + f64x4::simd_from(simd, [0.0, 256.0, 512.0, 768.0]), dy],
        }
    }
}

impl TileRasterizer<'_> {
    /// The triangle of one lane.
    #[inline(always)]
    pub(super) fn tiny<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        of: PreparedTriangle<'_>,
        triangle: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        // A separate function, so that values which only larger triangles need take no registers.
        simd.vectorize(
            #[inline(always)]
            || self.tiny_or_multisample::<S, MULTI>(simd, of, triangle, buffer, counts),
        );
    }

    #[inline(always)]
    fn tiny_or_multisample<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        of: PreparedTriangle<'_>,
        triangle: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        let PreparedTriangle { eight, origins, lane } = of;
        let lane = lane % LANES;
        buffer.write_back();
        if self.hierarchical && self.hides_tiny(simd, eight, lane, buffer) {
            counts.tiles_rejected += 1;
            return;
        }
        let tiny = eight.tiny(simd, origins, lane, triangle);
        counts.groups += tiny.groups();
        let ties = if MULTI {
            match self.in_order {
                true => multisample::rows::<S, false>(simd, &tiny, origins, lane, buffer),
                false => multisample::rows::<S, true>(simd, &tiny, origins, lane, buffer),
            }
        } else {
            let start = Start::new(simd, &tiny, origins, lane, self.offsets[0]);
            // The usual numbers of columns need no loop. Only without ties: other combinations are rare.
            match (self.in_order, tiny.columns[1] - tiny.columns[0]) {
                (true, 0) => rows::<S, 1, false>(simd, &tiny, &start, buffer),
                (true, 1) => rows::<S, 2, false>(simd, &tiny, &start, buffer),
                (true, 2) => rows::<S, 3, false>(simd, &tiny, &start, buffer),
                (true, _) => rows::<S, 0, false>(simd, &tiny, &start, buffer),
                (false, _) => rows::<S, 0, true>(simd, &tiny, &start, buffer),
            }
        };
        if !self.in_order && ties.any_true() {
            self.resolve_ties(eight, lane, triangle, buffer);
        }
    }

    /// Makes the triangle visible at its samples where the visible triangle has the same depth and a
    /// larger key.
    #[cold]
    fn resolve_ties(
        &self,
        eight: &EightTriangles,
        lane: usize,
        triangle: u32,
        buffer: &mut VisibilityBuffer,
    ) {
        let Some(covering) = eight.covering(lane, self.offsets) else { return };
        let [columns, rows] = [covering.columns, covering.rows];
        let pixels = (columns[1] + 1 - columns[0]) * (rows[1] + 1 - rows[0]);
        if !self.may_decide(COVERING + pixels as u32 * self.offsets.len() as u32) {
            // The tile is drawn again.
            return;
        }
        for at in (rows[0]..=rows[1]).flat_map(|y| (columns[0]..=columns[1]).map(move |x| [x, y])) {
            let pixel = TileArea::index_of(at.map(|v| v as usize));
            for (sample, &offset) in self.offsets.iter().enumerate() {
                let index = buffer.index(pixel, sample);
                let visible = buffer.visible[index];
                if visible != NO_TRIANGLE
                    && covering.covers(at, sample, [0, 0])
                    && covering.depth.at(self.area.point(at, offset)) == buffer.depth[index]
                    && (self.precedes)(triangle, visible)
                {
                    buffer.visible[index] = triangle;
                }
            }
        }
    }

    /// Whether all blocks that the triangle's box touches hide it. For a block that does not, a write of the
    /// triangle's nearest depth is noted at once, so that drawing the triangle does not visit its bounds again.
    #[inline(always)]
    fn hides_tiny<S: Simd>(
        &self,
        simd: S,
        eight: &EightTriangles,
        lane: usize,
        buffer: &mut VisibilityBuffer,
    ) -> bool {
        let high = eight.high[lane];
        // A block hides the triangle if its farthest depth is at least this (a greater depth is
        // nearer): in the order of keys an equal depth is enough, otherwise the block must be
        // strictly nearer.
        let limit = F32::splat(simd, if self.in_order { high } else { high.next_up() });
        let high = F32::splat(simd, high);
        let [[left, right], [top, bottom]] = eight.pixels.each_ref().each(
            #[inline(always)]
            |[first, last]| [first[lane] >> 3, last[lane] >> 3],
        );
        let columns = lane_numbers(simd);
        let touched = columns.simd_ge(left) & columns.simd_le(right);
        let mut hidden = true;
        // The blocks of a row at once, without a branch on which of them hide it.
        for row in top as usize..bottom as usize + 1 {
            let row = row % BLOCKS;
            let [farthest, nearest] = [&buffer.blocks.farthest, &buffer.blocks.nearest].each(
                #[inline(always)]
                |bounds| F32::simd_from(simd, bounds.as_chunks().0[row]),
            );
            let writes = U32::simd_from(simd, buffer.blocks.writes.as_chunks().0[row]);
            let mut shows = touched & farthest.simd_lt(limit);
            // The farthest depth is recomputed only if the nearest one in the block lies in front of
            // the triangle. Otherwise the block cannot hide it, whatever its farthest depth is.
            let outdated = shows & writes.simd_ge(WRITES) & high.simd_lt(nearest);
            if outdated.any_true() {
                refresh_row(simd, buffer, row, outdated.to_bitmask());
                shows &= F32::simd_from(simd, buffer.blocks.farthest.as_chunks().0[row]).simd_lt(limit);
            }
            hidden &= !shows.any_true();
            buffer.note_writes(simd, row, shows, high);
        }
        hidden
    }
}

/// Recomputes the farthest depths of blocks of a row, by their bits.
#[inline(always)]
fn refresh_row<S: Simd>(simd: S, buffer: &mut VisibilityBuffer, row: usize, mut columns: u64) {
    while columns != 0 {
        let column = columns.trailing_zeros() as usize % BLOCKS;
        columns &= columns - 1;
        buffer.farthest_in(simd, row * BLOCKS + column);
    }
}

/// Tests and stores the samples of all groups in the triangle's box, where pixels have one
/// sample. `WIDTH` is the number of columns of groups if that is known when compiling, else 0.
/// Returns the lanes in which any group holds the same depth already, if `TIES` is set.
///
/// Everything is inlined: a call would spill registers.
#[inline(always)]
fn rows<S: Simd, const WIDTH: usize, const TIES: bool>(
    simd: S,
    tiny: &Tiny<S>,
    start: &Start<S>,
    buffer: &mut VisibilityBuffer,
) -> Mask<S> {
    let width = if WIDTH > 0 { WIDTH } else { tiny.columns[1] - tiny.columns[0] + 1 };
    let (depths, visible) =
        (buffer.depth.as_chunks_mut::<LANES>().0, buffer.visible.as_chunks_mut::<LANES>().0);
    // Equal lengths, so that one bounds check serves both.
    let visible = &mut visible[..depths.len()];
    let Start { mut edges, vertex_offset: [first, mut dy] } = *start;
    let [right, down] = tiny.slopes;
    let mut ties = Mask::splat(simd, false);
    for row in tiny.rows[0]..tiny.rows[1] + 1 {
        // The plane at the start of the two rows of pixels in this row of groups, in f64: the
        // first four lanes are the upper row, the others the lower one, 256 units below.
        let plane = (tiny.value + down * dy).combine(tiny.value + down * (dy + 256.0));
        let [mut a, mut b, mut c] = edges;
        let mut dx = first;
        for column in 0..width {
            // The depth's change to the right is the same in both rows, so it is computed once.
            let across = right * dx;
            let (upper, lower) = (plane + across.combine(across)).split();
            let depth = simd.narrow_f64x4(upper, lower);
            let depth = lesser(greater(depth, tiny.low), tiny.high);
            // Inside if no edge function is negative: the sign bit of the combined value is set
            // if any of the three is negative. Uncovered lanes lie behind everything.
            let covered = (a | b | c).simd_ge(I32::splat(simd, 0));
            let depth = covered.select(depth, F32::splat(simd, f32::NEG_INFINITY));
            let at = TileArea::group_of([tiny.columns[0] + column, row]);
            let there = F32::simd_from(simd, depths[at]);
            if TIES {
                ties |= depth.simd_eq(there);
            }
            // The nearer depth stays. Where that is the new one, the visible triangle is replaced.
            depths[at] = greater(depth, there).into();
            name_where(simd, depth.simd_gt(there), tiny.triangle, &mut visible[at]);
            // Four pixels to the right.
            a += tiny.right[0];
            b += tiny.right[1];
            c += tiny.right[2];
            dx += 1024.0;
        }
        // Two pixels down.
        for (edge, step) in edges.iter_mut().zip(tiny.down) {
            *edge += step;
        }
        dy += 512.0;
    }
    ties
}

impl EightTriangles {
    #[inline(always)]
    fn tiny<S: Simd>(&self, simd: S, origins: &EdgeOrigins, lane: usize, triangle: u32) -> Tiny<S> {
        let (x, y) = (lane_numbers(simd) & 3, lane_numbers(simd) >> 2);
        let [right, down] = [&self.right, &self.down].each(
            #[inline(always)]
            |steps| {
                steps.each_ref().each(
                    #[inline(always)]
                    |column| I32::splat(simd, column[lane]),
                )
            },
        );
        let ends = inlined(
            #[inline(always)]
            |(axis, shift): (usize, u32)| {
                let [first, last] = &self.pixels[axis];
                [(first[lane] >> shift) as usize, (last[lane] >> shift) as usize]
            },
        );
        Tiny {
            triangle,
            columns: ends((0, 2)),
            rows: ends((1, 1)),
            lanes: [0, 1, 2].each(
                #[inline(always)]
                |k| x * right[k] + y * down[k],
            ),
            right: right.each(
                #[inline(always)]
                |step| step << 2,
            ),
            down: down.each(
                #[inline(always)]
                |step| step << 1,
            ),
            value: f64x4::splat(simd, origins.value[lane]),
            slopes: self.slopes.each_ref().each(
                #[inline(always)]
                |column| f64x4::splat(simd, column[lane]),
            ),
            low: F32::splat(simd, self.low[lane]),
            high: F32::splat(simd, self.high[lane]),
        }
    }
}

impl<S: Simd> Tiny<S> {
    /// The number of groups in its bounding box.
    #[inline(always)]
    fn groups(&self) -> u64 {
        let [columns, rows] = [self.columns, self.rows].each(
            #[inline(always)]
            |[first, last]| last - first + 1,
        );
        (columns * rows) as u64
    }
}
