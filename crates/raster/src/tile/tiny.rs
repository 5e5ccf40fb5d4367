//! Triangles of a few pixels to a few blocks: most triangles of most frames.

use super::area::{BLOCKS, GROUPS};
use super::buffer::VisibilityBuffer;
use super::cover::{Counts, Cover};
use super::eight::Eight;
use super::store::store_where;
use crate::samples::MAX_SAMPLES;
use crate::simd::{Each, F32, I32, LANES, Simd, greater, inlined, lane_numbers, lesser, prelude::*};
use fearless_simd::f64x4;

/// A triangle on its way through a tile: what its blocks have in common.
struct Steps<S: Simd> {
    /// Edge functions' steps within a group, to the next group, and to the next row
    /// of groups.
    lanes: [I32<S>; 3],
    right: [I32<S>; 3],
    down: [I32<S>; 3],
    /// The plane of depth, and what it is held to.
    value: f64x4<S>,
    slopes: [f64x4<S>; 2],
    low: F32<S>,
    high: F32<S>,
    place: u32,
    samples: Samples,
}

/// What the samples of a pixel add to the edge functions at the first of them, if
/// there are several, and the greatest of that.
struct Samples {
    edges: [[i32; 3]; MAX_SAMPLES],
    greatest: [i32; 3],
}

/// The part of a block within a triangle's bounding box.
struct Part {
    block: usize,
    /// The first pixel.
    pixel: [i32; 2],
    /// Columns and rows of groups in the block, ends excluded.
    columns: [i32; 2],
    rows: [i32; 2],
}

impl Cover<'_> {
    /// The triangle of one lane.
    #[inline(always)]
    pub(super) fn tiny<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (eight, lane): (&Eight, usize),
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        // Apart, so that what larger triangles need takes no registers.
        simd.vectorize(
            #[inline(always)]
            || self.tiny_apart::<S, MULTI>(simd, (eight, lane % LANES), place, buffer, counts),
        );
    }

    #[inline(always)]
    fn tiny_apart<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (eight, lane): (&Eight, usize),
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        buffer.settle();
        let offsets = if MULTI { self.offsets } else { &self.offsets[..1] };
        let steps = eight.steps(simd, lane, place, offsets);
        let high = eight.high[lane];
        let [columns, rows] = eight.pixels.each_ref().each(
            #[inline(always)]
            |range| [range[0][lane], range[1][lane]],
        );
        // Worth it where several groups may be saved.
        let refresh = columns[1] - columns[0] + rows[1] - rows[0] > 8;
        for block_y in rows[0] >> 3..(rows[1] >> 3) + 1 {
            for block_x in columns[0] >> 3..(columns[1] >> 3) + 1 {
                let block = (block_y as usize * BLOCKS + block_x as usize) % (BLOCKS * BLOCKS);
                if self.hierarchical {
                    let bounds = buffer.blocks[block];
                    let farthest =
                        if refresh && bounds.stale { buffer.farthest_in(block) } else { bounds.farthest };
                    if self.hides(farthest, high) {
                        counts.blocks_rejected += 1;
                        continue;
                    }
                }
                let part = Part::new(block, [block_x * 8, block_y * 8], [columns, rows]);
                counts.groups += part.groups();
                self.tiny_part::<S, MULTI>(simd, (eight, lane), &steps, &part, buffer);
                buffer.note_write(block, high);
            }
        }
    }

    #[inline(always)]
    fn tiny_part<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (eight, lane): (&Eight, usize),
        steps: &Steps<S>,
        part: &Part,
        buffer: &mut VisibilityBuffer,
    ) {
        let [x, y] = part.pixel;
        // Whole numbers, so that stepping along rounds nothing.
        let mut edges = [0, 1, 2].each(
            #[inline(always)]
            |k| {
                let start = eight.first[k][lane] + eight.right[k][lane] * x + eight.down[k][lane] * y;
                steps.lanes[k] + start
            },
        );
        let point = self.area.point(part.pixel, self.offsets[0]);
        let [dx, dy] = [0, 1].each(
            #[inline(always)]
            |axis| f64x4::splat(simd, f64::from(point[axis] - eight.anchor[axis][lane])),
        );
        let dx = dx + f64x4::simd_from(simd, [0.0, 256.0, 512.0, 768.0]);
        let mut dy = dy;
        for row in part.rows[0]..part.rows[1] {
            let [mut a, mut b, mut c] = edges;
            let mut dx = dx;
            for column in part.columns[0]..part.columns[1] {
                let group = part.block * GROUPS + (row * 2 + column) as usize;
                self.tiny_group::<S, MULTI>(simd, steps, ([a, b, c], [dx, dy]), group, buffer);
                a += steps.right[0];
                b += steps.right[1];
                c += steps.right[2];
                dx += 1024.0;
            }
            for (edge, step) in edges.iter_mut().zip(steps.down) {
                *edge += step;
            }
            dy += 512.0;
        }
    }

    /// One group, the edge functions and the way from the triangle's first vertex
    /// at the first samples given.
    #[inline(always)]
    fn tiny_group<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        steps: &Steps<S>,
        (edges, way): ([I32<S>; 3], [f64x4<S>; 2]),
        group: usize,
        buffer: &mut VisibilityBuffer,
    ) {
        if !MULTI {
            self.tiny_sample(simd, steps, (edges, way, [0, 0]), group * LANES, buffer);
            return;
        }
        let [a, b, c] = steps.samples.greatest;
        let [a, b, c] = [edges[0] + a, edges[1] + b, edges[2] + c];
        if !(a | b | c).simd_ge(I32::splat(simd, 0)).any_true() {
            return;
        }
        let [first, ..] = *self.offsets else { return };
        for (sample, (offset, add)) in self.offsets.iter().zip(steps.samples.edges).enumerate() {
            let edges = [edges[0] + add[0], edges[1] + add[1], edges[2] + add[2]];
            let further = [offset[0] - first[0], offset[1] - first[1]];
            let at = (group * buffer.samples + sample) * LANES;
            self.tiny_sample(simd, steps, (edges, way, further), at, buffer);
        }
    }

    /// One sample of each pixel of a group, so much further than the way leads.
    #[inline(always)]
    fn tiny_sample<S: Simd>(
        &self,
        simd: S,
        steps: &Steps<S>,
        ([a, b, c], [dx, dy], further): ([I32<S>; 3], [f64x4<S>; 2], [i32; 2]),
        at: usize,
        buffer: &mut VisibilityBuffer,
    ) {
        let covered = (a | b | c).simd_ge(I32::splat(simd, 0));
        if !covered.any_true() {
            return;
        }
        let [right, down] = steps.slopes;
        let (dx, dy) = (dx + f64::from(further[0]), dy + f64::from(further[1]));
        let across = right * dx;
        let upper = steps.value + down * dy + across;
        let lower = steps.value + down * (dy + 256.0) + across;
        let depth = simd.narrow_f64x4(upper, lower);
        let depth = lesser(greater(depth, steps.low), steps.high);
        let seen = self.seen(simd, steps.place, (covered, depth), buffer, at);
        // Where nothing is seen nothing changes: dearer than a branch that is
        // foreseen, and cheaper than one that is not.
        store_where(simd, seen, (steps.place, depth), buffer, at);
    }
}

impl Eight {
    #[inline(always)]
    fn steps<S: Simd>(&self, simd: S, lane: usize, place: u32, offsets: &[[i32; 2]]) -> Steps<S> {
        let (x, y) = (lane_numbers(simd) & 3, lane_numbers(simd) >> 2);
        let [right, down] = [&self.right, &self.down].each(
            #[inline(always)]
            |steps| {
                steps.each_ref().each(
                    #[inline(always)]
                    |column| column[lane],
                )
            },
        );
        let groups = inlined(
            #[inline(always)]
            |(steps, pixels): ([i32; 3], i32)| {
                steps.each(
                    #[inline(always)]
                    |step| I32::splat(simd, step * pixels),
                )
            },
        );
        Steps {
            lanes: [0, 1, 2].each(
                #[inline(always)]
                |k| x * right[k] + y * down[k],
            ),
            right: groups((right, 4)),
            down: groups((down, 2)),
            value: f64x4::splat(simd, f64::from(self.value[lane])),
            slopes: self.slopes.each_ref().each(
                #[inline(always)]
                |column| f64x4::splat(simd, column[lane]),
            ),
            low: F32::splat(simd, self.low[lane]),
            high: F32::splat(simd, self.high[lane]),
            place,
            samples: self.samples(lane, offsets),
        }
    }

    /// What samples at these offsets add; nothing for a single one.
    #[inline(always)]
    fn samples(&self, lane: usize, offsets: &[[i32; 2]]) -> Samples {
        let mut samples = Samples { edges: [[0; 3]; MAX_SAMPLES], greatest: [0; 3] };
        if offsets.len() > 1 {
            for (edges, [x, y]) in samples.edges.iter_mut().zip(offsets) {
                *edges = [0, 1, 2].each(
                    #[inline(always)]
                    |k| {
                        let value = self.corner[k][lane] + self.right[k][lane] * x + self.down[k][lane] * y;
                        (value >> 8) - self.first[k][lane]
                    },
                );
                for (greatest, &edge) in samples.greatest.iter_mut().zip(&*edges) {
                    *greatest = if edge > *greatest { edge } else { *greatest };
                }
            }
        }
        samples
    }
}

impl Part {
    #[inline(always)]
    fn new(block: usize, corner: [i32; 2], [columns, rows]: [[i32; 2]; 2]) -> Self {
        let columns = ranged(columns, corner[0], 2);
        let rows = ranged(rows, corner[1], 1);
        Self { block, pixel: [corner[0] + columns[0] * 4, corner[1] + rows[0] * 2], columns, rows }
    }

    /// How many groups it has.
    #[inline(always)]
    fn groups(&self) -> u64 {
        ((self.columns[1] - self.columns[0]) * (self.rows[1] - self.rows[0])) as u64
    }
}

/// The groups of a block, `start` pixels from the tile's corner, that some pixels
/// lie in.
#[inline(always)]
fn ranged([first, last]: [i32; 2], start: i32, shift: i32) -> [i32; 2] {
    [(first.max(start) - start) >> shift, ((last.min(start + 7) - start) >> shift) + 1]
}
