//! The kernel of points that are drawn from their vertices: eight are made ready at once, one in each
//! lane; then each is drawn group by group, one pixel in each lane.
//!
//! A square is the pixels from one column and row to another, and a disc those whose samples are
//! near enough to its centre, so no edge functions are needed.

use super::rasterizer::{GroupSamples, TileRasterizer};
use crate::bin::TriangleRef;
use crate::geometry::Shape;
use crate::point::{PlainPoints, sampled_pixels};
use crate::primitive::Column;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, U32, lane_numbers, lanes_of, prelude::*};
use crate::stats::Counts;
use crate::tile_buffer::{GROUPS, TileArea, VisibilityBuffer, store_where};
use crate::vertex::nearer_lanes;
use crate::view::FrameView;
use crate::viewport::SamplePattern;

/// What the kernel needs of eight points of one draw.
pub(super) struct EightPoints {
    /// The points' coordinates from the tile's corner, in 1/256 pixel.
    center: [[i32; LANES]; 2],
    half: [i32; LANES],
    depth: [f32; LANES],
    /// First and last columns and rows with a sample.
    pixels: [[[i32; LANES]; 2]; 2],
    /// The lanes that may have samples in the tile.
    live: u64,
    are_round: bool,
}

/// Eight points of which the first `count` are drawn.
struct Squares<S: Simd> {
    vertices: Column<S>,
    half: I32<S>,
    count: usize,
}

/// A point that is being drawn.
struct PointWalk {
    center: [i32; 2],
    half: i32,
    depth: f32,
    is_round: bool,
    index: u32,
}

impl EightPoints {
    /// Of up to eight points of one draw.
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        simd: S,
        frame: &FrameView<'_>,
        area: &TileArea,
        pattern: SamplePattern,
        points: &[TriangleRef],
    ) -> Option<Self> {
        let draw = frame.draw_view(frame.draw_of(points[0]));
        let (plain, Shape::Points { points: indices, sizes, .. }) = (draw.points?, &draw.geometry.shape)
        else {
            return None;
        };
        let primitives = lanes_of(
            #[inline(always)]
            |lane| points.get(lane).unwrap_or(&points[0]).ordinal - draw.first,
        );
        let vertices = primitives.each(
            #[inline(always)]
            |primitive| draw.vertices.get(indices[primitive as usize]),
        );
        let half = plain.half_sizes(simd, sizes, primitives);
        let squares = Squares { vertices: Column::new(simd, vertices, 0), half, count: points.len() };
        Some(Self::at(simd, area, pattern, plain, &squares))
    }

    /// Of the squares that are drawn.
    #[inline(always)]
    fn at<S: Simd>(
        simd: S,
        area: &TileArea,
        pattern: SamplePattern,
        plain: &PlainPoints,
        &Squares { ref vertices, half, count }: &Squares<S>,
    ) -> Self {
        let mut live = Mask::from_bitmask(simd, (1 << count) - 1);
        let center = [vertices.x - area.origin[0] * 256, vertices.y - area.origin[1] * 256];
        let pixels = [0, 1].each(
            #[inline(always)]
            |axis| {
                let [first, last] = sampled_pixels(center[axis], half, pattern.reach());
                let end = I32::splat(simd, area.padded()[axis] as i32 - 1);
                let [first, last] = [first.max(I32::splat(simd, 0)), last.min(end)];
                live &= first.simd_le(last);
                [first.into(), last.into()]
            },
        );
        Self {
            center: center.each(Into::into),
            half: half.into(),
            depth: nearer_lanes(simd, vertices.depth(), plain.depth_bias()).into(),
            pixels,
            live: live.to_bitmask(),
            are_round: plain.are_round(),
        }
    }

    /// The first and last column or row of a lane.
    #[inline(always)]
    fn pixels(&self, axis: usize, lane: usize) -> [i32; 2] {
        self.pixels[axis].each_ref().each(
            #[inline(always)]
            |ends| ends[lane],
        )
    }
}

impl TileRasterizer<'_> {
    /// Draws points, the first of which has number `first`.
    #[inline(always)]
    pub(super) fn points<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        eight: &EightPoints,
        first: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        let mut live = eight.live;
        if self.hierarchical {
            let farthest = F32::splat(simd, buffer.farthest_of_all(&self.area));
            let depth = F32::simd_from(simd, eight.depth);
            let hidden = if self.in_order { depth.simd_le(farthest) } else { depth.simd_lt(farthest) };
            counts.tiles_rejected += u64::from((live & hidden.to_bitmask()).count_ones());
            live &= !hidden.to_bitmask();
        }
        if live != 0 {
            buffer.write_back();
        }
        while live != 0 {
            let lane = live.trailing_zeros() as usize % LANES;
            live &= live - 1;
            let [columns, rows] = [eight.pixels(0, lane), eight.pixels(1, lane)];
            let walk = PointWalk {
                center: [eight.center[0][lane], eight.center[1][lane]],
                half: eight.half[lane],
                depth: eight.depth[lane],
                is_round: eight.are_round,
                index: first + lane as u32,
            };
            for column in columns[0] >> 2..(columns[1] >> 2) + 1 {
                for row in rows[0] >> 1..(rows[1] >> 1) + 1 {
                    self.group_of_point::<S, MULTI>(simd, &walk, [column, row], buffer, counts);
                }
            }
        }
    }

    /// Tests and stores the samples of a group, given by its column and row.
    #[inline(always)]
    fn group_of_point<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        walk: &PointWalk,
        [column, row]: [i32; 2],
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        let group = TileArea::group_of([column as usize, row as usize]);
        let block = group / GROUPS;
        if self.hierarchical && self.hides(buffer.blocks.farthest[block], walk.depth) {
            return;
        }
        counts.groups += 1;
        let depth = F32::splat(simd, walk.depth);
        let mut wrote = false;
        let samples = if MULTI { buffer.samples } else { 1 };
        for (sample, offset) in self.offsets[..samples].iter().enumerate() {
            let covered = walk.covers(simd, [column * 4, row * 2], *offset);
            let at = (group * samples + sample) * LANES;
            let visible =
                self.visible_lanes(simd, GroupSamples { index: walk.index, covered, depth }, buffer, at);
            if visible.any_true() {
                store_where(simd, visible, walk.index, depth, buffer, at);
                wrote = true;
            }
        }
        if wrote {
            buffer.note_write(block, walk.depth);
        }
    }
}

impl PointWalk {
    /// Which pixels of a group have the sample at this offset in the square or the disc. Samples
    /// exactly on the circle are not in the disc.
    #[inline(always)]
    fn covers<S: Simd>(&self, simd: S, first: [i32; 2], offset: [i32; 2]) -> Mask<S> {
        let lanes = [lane_numbers(simd) & 3, lane_numbers(simd) >> 2];
        let [x, y] = [0, 1].each(
            #[inline(always)]
            |axis| (lanes[axis] << 8) + (first[axis] * 256 + offset[axis] - self.center[axis]),
        );
        if self.is_round {
            return (x * x + y * y).simd_lt(I32::splat(simd, self.half * self.half));
        }
        // −half <= way < half, in one comparison: as unsigned numbers, those below −half become the largest.
        let size = U32::splat(simd, 2 * self.half as u32);
        let within = [x, y].each(
            #[inline(always)]
            |way| (way + self.half).bitcast::<U32<S>>().simd_lt(size),
        );
        within[0] & within[1]
    }
}
