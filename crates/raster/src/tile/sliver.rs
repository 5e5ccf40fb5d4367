//! The sliver kernel: one small triangle that is much longer than wide, one sample per pixel. Its *major* axis is that
//! along which its box is longer.
//!
//! In each column of pixels across the major axis, a triangle covers at most as many pixels as it is wide there.
//! So the kernel does not visit the triangle's box, but follows its longest edge. A vector holds a pixel in each
//! of eight columns side by side: the first one inside of that edge, then, if the triangle may be that wide, the
//! second one. Edge functions decide exactly which are covered; the position of the edge is only estimated.
//! Covered pixels are appended to a list, and their depths tested at the end of the eight triangles
//! ([`Covered`]).

use super::eight::{EightTriangles, Slivers};
use super::micro::{Covered, index_of};
use super::rasterizer::TileRasterizer;
use crate::simd::{F32, I32, InlineMap, LANES, Simd, greater, lane_numbers, lesser, prelude::*, widened};
use crate::stats::Counts;
use crate::tile_buffer::{BLOCKS, VisibilityBuffer};
use fearless_simd::f64x4;

/// The estimated position of the longest edge is less than this from the edge, in 1/256 pixel: its edge function is rounded
/// down by less than 1, and its steps are at least 1024 a pixel ([`LEAST`]), which makes a quarter; the numbers in f32 are
/// less than 1024 pixels, so each of their few roundings adds less than 1/64.
const SLACK: i32 = 1;

/// Slivers are at least so long, in 1/256 pixel.
const LEAST: i32 = 4 << 8;

/// Added to positions in pixels, none of which is less than -256, so that cutting rounds down.
const OFFSET: f32 = 512.0;

/// How wide a triangle may be that covers one pixel of a column, and one that covers two.
const WIDTHS: [i32; 2] = [256 - 2 * SLACK, 512 - 2 * SLACK];

/// Visiting a vector of columns takes as long as visiting so many groups of a triangle's box.
const PRICE: i32 = 1;

impl Slivers {
    /// Those that are thin enough, and of which following the longest edge takes less than visiting the box.
    #[inline(always)]
    pub(super) fn find<S: Simd>(simd: S, eight: &EightTriangles) -> Self {
        let column = |values: &[i32; LANES]| I32::simd_from(simd, *values);
        let longest = |steps: &[[i32; LANES]; 3]| {
            let [a, b, c] = steps.each_ref().each(
                #[inline(always)]
                |steps| column(steps).abs(),
            );
            a.max(b).max(c)
        };
        let (width, height) = (longest(&eight.down), longest(&eight.right));
        let steep = height.simd_gt(width);
        let length = width.max(height);
        // The sum of the edge functions at any point is twice the area, less at most 3 for their biases.
        let [a, b, c] = eight.corner.each_ref().each(column);
        let area = a + b + c + 3;
        let wide = area.simd_gt(length * WIDTHS[0]);
        let thin = area.simd_le(length * WIDTHS[1]) & length.simd_ge(I32::splat(simd, LEAST));
        let [columns, rows] = eight.pixels.each_ref().each(
            #[inline(always)]
            |ends| ends.each_ref().each(column),
        );
        let count = |[first, last]: [I32<S>; 2], shift: u32| (last >> shift) - (first >> shift) + 1;
        let groups = count(columns, 2) * count(rows, 1);
        let vectors = steep.select(count(rows, 3), count(columns, 3));
        let price = vectors * wide.select(I32::splat(simd, 2 * PRICE), I32::splat(simd, PRICE));
        let worthy = groups.simd_gt(price);
        Self {
            lanes: (thin & worthy).to_bitmask() & eight.live,
            wide: wide.to_bitmask(),
            steep: steep.to_bitmask(),
        }
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.lanes == 0
    }

    #[inline(always)]
    pub(super) fn contain(&self, lane: usize) -> bool {
        self.lanes >> lane & 1 != 0
    }
}

/// A sliver, ready to be followed along its longest edge.
///
/// All numbers are whole and fit f32: edge functions in the tile, divided by 256, are less than 2^23, their steps for a pixel
/// and offsets from the first vertex in 1/256 pixel less than 2^16.
struct Line {
    /// The edge functions at the tile's first pixel, and their steps for a pixel along the major axis, and across it.
    starts: [f32; 3],
    along: [f32; 3],
    across: [f32; 3],
    /// The position of the first candidate across the major axis at the tile's first column, plus [`OFFSET`], not yet rounded
    /// down; and its step from column to column.
    start: f32,
    slope: f32,
    /// From the first candidate of a column to the second: away from the longest edge.
    inwards: f32,
}

impl Line {
    #[inline(always)]
    fn new(eight: &EightTriangles, lane: usize, is_steep: bool) -> Self {
        let [starts, right, down] = [&eight.first, &eight.right, &eight.down].each(
            #[inline(always)]
            |values| {
                values.each_ref().each(
                    #[inline(always)]
                    |values| values[lane] as f32,
                )
            },
        );
        let (along, across) = if is_steep { (down, right) } else { (right, down) };
        let [a, b, c] = across.each(f32::abs);
        let (first, second) = if a >= b { (0, a) } else { (1, b) };
        let longest = if c > second { 2 } else { first };
        let inverse = -1.0 / across[longest];
        // The candidates lie inside of the edge. Where its function grows with the position, the first one is that after the
        // estimate, else that before it.
        let slack = SLACK as f32 / 256.0;
        let (inwards, shift) = if across[longest] > 0.0 { (1.0, 1.0 - slack) } else { (-1.0, slack) };
        let (start, slope) = (starts[longest] * inverse + (OFFSET + shift), along[longest] * inverse);
        Self { starts, along, across, start, slope, inwards }
    }
}

impl TileRasterizer<'_> {
    /// Draws those of eight triangles that are slivers, after all others of them.
    #[inline(always)]
    pub(super) fn slivers<S: Simd>(
        &self,
        simd: S,
        eight: &EightTriangles,
        pixels: &mut Covered,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        // A separate function, so that it takes no registers from the other kernels.
        simd.vectorize(
            #[inline(always)]
            || {
                buffer.write_back();
                let slivers = &eight.slivers;
                let mut rest = slivers.lanes;
                while rest != 0 {
                    let lane = rest.trailing_zeros() as usize % LANES;
                    rest &= rest - 1;
                    // Also in the order of keys only by what is nearer: at equal depth one of the same eight
                    // that comes later may be in front.
                    if self.hierarchical && eight.high[lane] < buffer.farthest_of_all(&self.area) {
                        counts.tiles_rejected += 1;
                        continue;
                    }
                    let wide = slivers.wide >> lane & 1 != 0;
                    counts.groups += match (slivers.steep >> lane & 1 != 0, wide) {
                        (false, false) => self.sliver::<S, false, 1>(simd, eight, lane, pixels, buffer),
                        (false, true) => self.sliver::<S, false, 2>(simd, eight, lane, pixels, buffer),
                        (true, false) => self.sliver::<S, true, 1>(simd, eight, lane, pixels, buffer),
                        (true, true) => self.sliver::<S, true, 2>(simd, eight, lane, pixels, buffer),
                    };
                }
                pixels.drop_hidden(buffer);
                self.scatter(eight, pixels, buffer);
            },
        );
    }

    /// Lists the pixels of one of eight triangles. If the list is full, the depths of those in it are tested. Returns how
    /// many vectors of pixels were tested.
    #[inline(always)]
    fn sliver<S: Simd, const STEEP: bool, const CANDIDATES: usize>(
        &self,
        simd: S,
        eight: &EightTriangles,
        lane: usize,
        pixels: &mut Covered,
        buffer: &mut VisibilityBuffer,
    ) -> u64 {
        let line = Line::new(eight, lane, STEEP);
        let [major, minor] = if STEEP { [1, 0] } else { [0, 1] };
        let [start, end] = [0, 1].each(
            #[inline(always)]
            |end| eight.pixels[major][end][lane] >> 3,
        );
        let [low, high] = [0, 1].each(
            #[inline(always)]
            |end| F32::splat(simd, eight.pixels[minor][end][lane] as f32),
        );
        let plane = SliverDepth::new(simd, eight, lane);
        // From a pixel's column or row to the offset of its sample from the first vertex.
        let offset = [0, 1].each(
            #[inline(always)]
            |axis| (self.area.origin[axis] * 256 + self.offsets[0][axis] - eight.anchor[axis][lane]) as f32,
        );
        let numbers = lane_numbers(simd) + (start << 3);
        let mut column = numbers.to_float::<F32<S>>();
        let mut index = if STEEP {
            index_of(I32::splat(simd, 0), numbers)
        } else {
            index_of(numbers, I32::splat(simd, 0))
        };
        let mut edges = [0, 1, 2].each(
            #[inline(always)]
            |k| column * line.along[k] + line.starts[k],
        );
        for _ in start..end + 1 {
            if pixels.is_full() {
                pixels.drop_hidden(buffer);
                self.scatter(eight, pixels, buffer);
            }
            let along = plane.term(column * 256.0 + offset[major], major);
            let mut numbers = I32::truncate_from(column * line.slope + line.start) - OFFSET as i32;
            let mut row = numbers.to_float::<F32<S>>();
            for candidate in 0..CANDIDATES {
                if candidate > 0 {
                    row += line.inwards;
                    numbers += line.inwards as i32;
                }
                let [a, b, c] = [0, 1, 2].each(
                    #[inline(always)]
                    |k| edges[k] + row * line.across[k],
                );
                let inside = lesser(lesser(a, b), c).simd_ge(F32::splat(simd, 0.0));
                let covered = inside & row.simd_ge(low) & row.simd_le(high);
                let across = plane.term(row * 256.0 + offset[minor], minor);
                let depth =
                    if STEEP { plane.at(simd, [across, along]) } else { plane.at(simd, [along, across]) };
                let zero = I32::splat(simd, 0);
                let own = if STEEP { index_of(numbers, zero) } else { index_of(zero, numbers) };
                pixels.push(covered, depth, [index + own, I32::splat(simd, lane as i32)]);
            }
            column += LANES as f32;
            // A block further.
            index += if STEEP { (LANES * LANES * BLOCKS) as i32 } else { (LANES * LANES) as i32 };
            for (edge, step) in edges.iter_mut().zip(line.along) {
                *edge += step * LANES as f32;
            }
        }
        CANDIDATES as u64 * (end + 1 - start) as u64
    }
}

/// The depths of one triangle: the formula of [`DepthPlane`](crate::primitive::DepthPlane).
struct SliverDepth<S: Simd> {
    value: f64x4<S>,
    slopes: [f64x4<S>; 2],
    low: F32<S>,
    high: F32<S>,
}

impl<S: Simd> SliverDepth<S> {
    #[inline(always)]
    fn new(simd: S, eight: &EightTriangles, lane: usize) -> Self {
        Self {
            value: f64x4::splat(simd, f64::from(eight.value[lane])),
            slopes: eight.slopes.each_ref().each(
                #[inline(always)]
                |slopes| f64x4::splat(simd, slopes[lane]),
            ),
            low: F32::splat(simd, eight.low[lane]),
            high: F32::splat(simd, eight.high[lane]),
        }
    }

    /// What offsets from the first vertex on an axis add to its depth.
    #[inline(always)]
    fn term(&self, offsets: F32<S>, axis: usize) -> [f64x4<S>; 2] {
        widened(offsets).each(
            #[inline(always)]
            |offsets| self.slopes[axis] * offsets,
        )
    }

    /// The depths, from what offsets to the right and downwards add.
    #[inline(always)]
    fn at(&self, simd: S, [right, down]: [[f64x4<S>; 2]; 2]) -> F32<S> {
        let [low, high] = [0, 1].each(
            #[inline(always)]
            |half| (self.value + down[half]) + right[half],
        );
        lesser(greater(simd.narrow_f64x4(low, high), self.low), self.high)
    }
}
