//! Triangles of a few pixels to a few blocks: most triangles of most frames.
//!
//! Rows of groups are gone through from end to end, with nothing to be decided on
//! the way: what a branch would save here, it loses by being hard to foresee.

use super::area::{BLOCKS, TileArea};
use super::buffer::{NOBODY, VisibilityBuffer};
use super::counts::Counts;
use super::cover::Cover;
use super::eight::Eight;
use super::several;
use super::starts::Starts;
use super::store::name_where;
use crate::simd::{Each, F32, I32, LANES, Mask, Simd, greater, inlined, lane_numbers, lesser, prelude::*};
use fearless_simd::f64x4;

/// A block is asked for its farthest depth again after so many triangles: until
/// it is covered anew, the answer stays the same.
const WRITES: u32 = 4;

/// What finding the samples of a triangle one by one takes before the first of them, in units
/// of [`Ties`](super::Ties).
const COVERING: u32 = 16;

/// A triangle on its way through a tile.
pub(super) struct Tiny<S: Simd> {
    pub(super) place: u32,
    /// First and last columns and rows of groups.
    pub(super) columns: [usize; 2],
    pub(super) rows: [usize; 2],
    /// Edge functions' steps within a group, to the next group, and to the next row
    /// of groups.
    pub(super) lanes: [I32<S>; 3],
    pub(super) right: [I32<S>; 3],
    pub(super) down: [I32<S>; 3],
    /// The plane of depth, and what it is held to.
    pub(super) value: f64x4<S>,
    pub(super) slopes: [f64x4<S>; 2],
    pub(super) low: F32<S>,
    pub(super) high: F32<S>,
}

/// Where the one sample of a triangle's pixels begins.
struct Start<S: Simd> {
    /// The edge functions at the first group.
    edges: [I32<S>; 3],
    /// From the triangle's first vertex to the first group, in 1/256 pixel.
    way: [f64x4<S>; 2],
}

impl<S: Simd> Start<S> {
    #[inline(always)]
    fn new(simd: S, tiny: &Tiny<S>, (starts, lane): (&Starts, usize), offset: [i32; 2]) -> Self {
        let [dx, dy] = starts.way(simd, lane, offset);
        let edges = starts.edges(simd, 0, lane);
        Self {
            edges: [0, 1, 2].each(
                #[inline(always)]
                |k| tiny.lanes[k] + edges[k],
            ),
            way: [dx + f64x4::simd_from(simd, [0.0, 256.0, 512.0, 768.0]), dy],
        }
    }
}

impl Cover<'_> {
    /// The triangle of one lane.
    #[inline(always)]
    pub(super) fn tiny<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (eight, starts, lane): (&Eight, &mut Starts, usize),
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        // Apart, so that what larger triangles need takes no registers.
        simd.vectorize(
            #[inline(always)]
            || self.tiny_apart::<S, MULTI>(simd, (eight, starts, lane % LANES), place, buffer, counts),
        );
    }

    #[inline(always)]
    fn tiny_apart<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (eight, starts, lane): (&Eight, &mut Starts, usize),
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        buffer.settle();
        if self.hierarchical && self.hides_tiny(simd, (eight, lane), buffer) {
            counts.tiles_rejected += 1;
            return;
        }
        let tiny = eight.tiny(simd, (starts, lane), place);
        counts.groups += tiny.groups();
        let ties = if MULTI {
            match self.in_order {
                true => several::rows::<S, false>(simd, &tiny, (starts, lane), buffer),
                false => several::rows::<S, true>(simd, &tiny, (starts, lane), buffer),
            }
        } else {
            let start = Start::new(simd, &tiny, (starts, lane), self.offsets[0]);
            // As many columns as most have without a loop, where ties need not be known.
            match (self.in_order, tiny.columns[1] - tiny.columns[0]) {
                (true, 0) => rows::<S, 1, false>(simd, &tiny, &start, buffer),
                (true, 1) => rows::<S, 2, false>(simd, &tiny, &start, buffer),
                (true, 2) => rows::<S, 3, false>(simd, &tiny, &start, buffer),
                (true, _) => rows::<S, 0, false>(simd, &tiny, &start, buffer),
                (false, _) => rows::<S, 0, true>(simd, &tiny, &start, buffer),
            }
        };
        if !self.in_order && ties.any_true() {
            self.win_ties((eight, lane), place, buffer);
        }
    }

    /// Gives a triangle those of its samples that others hold at the same depth
    /// with a larger key.
    #[cold]
    fn win_ties(&self, (eight, lane): (&Eight, usize), place: u32, buffer: &mut VisibilityBuffer) {
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
                let winner = buffer.winner[index];
                if winner != NOBODY
                    && covering.covers(at, sample, [0, 0])
                    && covering.depth.at(self.area.point(at, offset)) == buffer.depth[index]
                    && (self.precedes)(place, winner)
                {
                    buffer.winner[index] = place;
                }
            }
        }
    }

    /// Whether all blocks that the triangle reaches over hide it. Of those of others
    /// the bounds are widened, as if it were seen in each.
    #[inline(always)]
    fn hides_tiny<S: Simd>(
        &self,
        simd: S,
        (eight, lane): (&Eight, usize),
        buffer: &mut VisibilityBuffer,
    ) -> bool {
        let high = eight.high[lane];
        // The least of what hides it.
        let limit = if self.in_order { high } else { high.next_up() };
        let [[left, width], [top, height]] = eight.pixels.each_ref().each(
            #[inline(always)]
            |[first, last]| [first[lane] >> 3, (last[lane] >> 3) + 1 - (first[lane] >> 3)],
        );
        let (mut hidden, mut column) = (true, 0);
        let mut block = (top * BLOCKS as i32 + left) as usize;
        // One loop, whose end is foreseen wrongly once, instead of one in the other.
        for _ in 0..width * height {
            block %= BLOCKS * BLOCKS;
            let bounds = buffer.blocks[block];
            // What lies before all of a block cannot be hidden by it.
            let farthest = if (bounds.writes >= WRITES) & (high < bounds.nearest) {
                buffer.farthest_in(simd, block)
            } else {
                bounds.farthest
            };
            if farthest < limit {
                hidden = false;
                buffer.note_write(block, high);
            }
            column += 1;
            let ends = column == width;
            block += if ends { BLOCKS + 1 - width as usize } else { 1 };
            column = if ends { 0 } else { column };
        }
        hidden
    }
}

/// Lets the only sample of the pixels in all rows compete: of `WIDTH` columns of groups
/// if that is not 0. Tells where something lies at the same depth, if `TIES` asks for it.
///
/// Nothing is called from here: no register has to be given up.
#[inline(always)]
fn rows<S: Simd, const WIDTH: usize, const TIES: bool>(
    simd: S,
    tiny: &Tiny<S>,
    start: &Start<S>,
    buffer: &mut VisibilityBuffer,
) -> Mask<S> {
    let width = if WIDTH > 0 { WIDTH } else { tiny.columns[1] - tiny.columns[0] + 1 };
    let (depths, winners) =
        (buffer.depth.as_chunks_mut::<LANES>().0, buffer.winner.as_chunks_mut::<LANES>().0);
    // As many: what one comparison finds in the one is in the other, too.
    let winners = &mut winners[..depths.len()];
    let Start { mut edges, way: [first, mut dy] } = *start;
    let [right, down] = tiny.slopes;
    let mut ties = Mask::splat(simd, false);
    for row in tiny.rows[0]..tiny.rows[1] + 1 {
        let plane = (tiny.value + down * dy).combine(tiny.value + down * (dy + 256.0));
        let [mut a, mut b, mut c] = edges;
        let mut dx = first;
        for column in 0..width {
            let across = right * dx;
            let (upper, lower) = (plane + across.combine(across)).split();
            let depth = simd.narrow_f64x4(upper, lower);
            let depth = lesser(greater(depth, tiny.low), tiny.high);
            // What is not covered lies behind everything.
            let covered = (a | b | c).simd_ge(I32::splat(simd, 0));
            let depth = covered.select(depth, F32::splat(simd, f32::NEG_INFINITY));
            let at = TileArea::group_of([tiny.columns[0] + column, row]);
            let there = F32::simd_from(simd, depths[at]);
            if TIES {
                ties |= depth.simd_eq(there);
            }
            depths[at] = greater(depth, there).into();
            name_where(simd, depth.simd_gt(there), tiny.place, &mut winners[at]);
            a += tiny.right[0];
            b += tiny.right[1];
            c += tiny.right[2];
            dx += 1024.0;
        }
        for (edge, step) in edges.iter_mut().zip(tiny.down) {
            *edge += step;
        }
        dy += 512.0;
    }
    ties
}

impl Eight {
    #[inline(always)]
    fn tiny<S: Simd>(&self, simd: S, (starts, lane): (&Starts, usize), place: u32) -> Tiny<S> {
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
            place,
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
            value: f64x4::splat(simd, starts.value[lane]),
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
    /// How many groups of pixels it reaches over.
    #[inline(always)]
    fn groups(&self) -> u64 {
        let [columns, rows] = [self.columns, self.rows].each(
            #[inline(always)]
            |[first, last]| last - first + 1,
        );
        (columns * rows) as u64
    }
}
