//! The micro kernel: up to eight small triangles of at most 4×4 pixels each in the tile at a time, one
//! triangle in each lane. Most triangles of a fine mesh are drawn here.
//!
//! First, triangles are dropped that lie behind the farthest depth visible in the tile; the bounds of
//! blocks are not tested. Then the kernel has two passes. The first visits the same row and column of
//! all eight bounding boxes at once, row by row. It tests the edges of all eight triangles, computes
//! their depths, and appends the covered pixels with their depths to a list. The second tests the depths of the
//! pixels in the list.
//!
//! The list ([`Covered`]) holds the pixels that up to eight triangles cover, wherever they lie in the tile. The kernels
//! `micro` and `sliver` append to it, then depths are tested pixel by pixel. Two triangles may cover the same pixel, so lanes
//! cannot be written together.
//!
//! The depth test is that of `TileRasterizer::visible_lanes`, for one pixel.

use super::eight::{EightTriangles, MICRO};
use super::rasterizer::TileRasterizer;
use crate::simd::{
    F32, I32, InlineMap, LANES, Mask, Simd, U32, greater, lane_numbers, lesser, prelude::*, widened,
};
use crate::stats::Counts;
use crate::tile_buffer::{BLOCKS, GROUPS, NO_TRIANGLE, VisibilityBuffer};
use fearless_simd::f64x4;

/// Depths of the lanes' triangles along a row of pixels: lane `i` belongs to triangle `i`.
struct Depths<S: Simd> {
    /// The planes at the row and their steps to the right. They are f64, of which a vector
    /// holds four, so lanes 0 to 3 come first and lanes 4 to 7 second.
    row: [f64x4<S>; 2],
    right: [f64x4<S>; 2],
    low: F32<S>,
    high: F32<S>,
}

impl TileRasterizer<'_> {
    /// Draws triangles with one sample per pixel.
    #[inline(always)]
    pub(super) fn micro<S: Simd>(
        &self,
        simd: S,
        eight: &EightTriangles,
        pixels: &mut Covered,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        let live = self.not_hidden(simd, eight, buffer, counts);
        if !live.any_true() {
            return;
        }
        buffer.write_back();
        counts.groups += u64::from(live.to_bitmask().count_ones());
        let column = |values: &[i32; LANES]| I32::simd_from(simd, *values);
        // The bounding boxes, in pixels of the tile.
        let [left, right] = eight.pixels[0].each_ref().each(column);
        let [top, bottom] = eight.pixels[1].each_ref().each(column);
        let (steps_right, steps_down) =
            (eight.right.each_ref().each(column), eight.down.each_ref().each(column));
        // The edge functions of each triangle at the top left pixel of its bounding box.
        let mut edges = [0, 1, 2].each(
            #[inline(always)]
            |k| column(&eight.first[k]) + steps_right[k] * left + steps_down[k] * top,
        );
        for down in 0..MICRO {
            let y = top + down;
            // Boxes have different heights: lanes whose box has ended take no part.
            let in_row = live & y.simd_le(bottom);
            if !in_row.any_true() {
                break;
            }
            let depths = self.depths(simd, eight, y);
            let mut values = edges;
            for across in 0..MICRO {
                let x = left + across;
                let here = in_row & x.simd_le(right);
                if !here.any_true() {
                    break;
                }
                // A pixel is inside if no edge function is negative. The sign bit of the
                // combined value is set if that of any of the three is.
                let [a, b, c] = values;
                let covered = here & (a | b | c).simd_ge(I32::splat(simd, 0));
                let depth = self.depths_at(simd, eight, &depths, x);
                pixels.push(covered, depth, [index_of(x, y), lane_numbers(simd)]);
                for (value, step) in values.iter_mut().zip(steps_right) {
                    *value += step;
                }
            }
            for (edge, step) in edges.iter_mut().zip(steps_down) {
                *edge += step;
            }
        }
        self.scatter(eight, pixels, buffer);
    }

    /// The lanes whose triangles the tile does not hide.
    #[inline(always)]
    fn not_hidden<S: Simd>(
        &self,
        simd: S,
        eight: &EightTriangles,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) -> Mask<S> {
        let live = Mask::from_bitmask(simd, eight.live);
        if !self.hierarchical {
            return live;
        }
        let farthest = F32::splat(simd, buffer.farthest_of_all(&self.area));
        let high = F32::simd_from(simd, eight.high);
        let hidden = if self.in_order { high.simd_le(farthest) } else { high.simd_lt(farthest) };
        counts.tiles_rejected += u64::from((live & hidden).to_bitmask().count_ones());
        live & !hidden
    }

    /// The planes of depth at a row of each lane: the formula of
    /// [`DepthPlane`](crate::primitive::DepthPlane).
    #[inline(always)]
    fn depths<S: Simd>(&self, simd: S, eight: &EightTriangles, y: I32<S>) -> Depths<S> {
        let dy = self.steps(simd, y, 1, &eight.anchor);
        let value = widened(F32::simd_from(simd, eight.value));
        let slopes = eight.slopes.each_ref().each(
            #[inline(always)]
            |slopes| doubles(simd, slopes),
        );
        let [right, down] = slopes;
        Depths {
            row: [value[0] + down[0] * dy[0], value[1] + down[1] * dy[1]],
            right,
            low: F32::simd_from(simd, eight.low),
            high: F32::simd_from(simd, eight.high),
        }
    }

    #[inline(always)]
    fn depths_at<S: Simd>(&self, simd: S, eight: &EightTriangles, depths: &Depths<S>, x: I32<S>) -> F32<S> {
        let dx = self.steps(simd, x, 0, &eight.anchor);
        let [low, high] = [0, 1].each(
            #[inline(always)]
            |half| depths.row[half] + depths.right[half] * dx[half],
        );
        lesser(greater(simd.narrow_f64x4(low, high), depths.low), depths.high)
    }

    /// The distance of a pixel's sample from the first vertex of the lane's triangle, along
    /// one axis in 1/256 pixel. These are whole numbers far below 2^24, so the conversion to
    /// f32 on the way to f64 is exact.
    #[inline(always)]
    fn steps<S: Simd>(
        &self,
        simd: S,
        pixel: I32<S>,
        axis: usize,
        anchor: &[[i32; LANES]; 2],
    ) -> [f64x4<S>; 2] {
        let position = ((pixel + self.area.origin[axis]) << 8) + self.offsets[0][axis];
        widened((position - I32::simd_from(simd, anchor[axis])).to_float())
    }
}

#[inline(always)]
fn doubles<S: Simd>(simd: S, values: &[f64; LANES]) -> [f64x4<S>; 2] {
    let [a, b, c, d, e, f, g, h] = *values;
    [f64x4::simd_from(simd, [a, b, c, d]), f64x4::simd_from(simd, [e, f, g, h])]
}

/// The maximum number of pixels in the boxes of eight triangles for `micro`.
const PIXELS: usize = (MICRO * MICRO) as usize * LANES;

/// Pixels that eight triangles cover.
pub(super) struct Covered {
    count: usize,
    /// The index of each pixel in the tile, times eight, plus the lane of its triangle; and sixteen more
    /// entries, because eight are written at a time, and `sliver` writes two times eight before it asks.
    entries: [u32; PIXELS + 2 * LANES],
    depths: [f32; PIXELS + 2 * LANES],
}

impl Covered {
    pub(super) fn new() -> Self {
        Self { count: 0, entries: [0; PIXELS + 2 * LANES], depths: [0.0; PIXELS + 2 * LANES] }
    }

    /// Whether pixels must not be appended more than twice.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.count > PIXELS
    }

    /// Appends the pixels whose lanes are set, from their indices in the tile and the lanes of their triangles.
    ///
    /// `compress` moves the set lanes to the front. All eight are stored, and the count grows
    /// by those that were set, so the next call overwrites the rest: no branch depends on how
    /// many pixels are covered, which a processor could not predict.
    #[inline(always)]
    pub(super) fn push<S: Simd>(&mut self, lanes: Mask<S>, depth: F32<S>, [index, of]: [I32<S>; 2]) {
        let entries = ((index << 3) + of).bitcast::<U32<S>>();
        let count = self.count;
        entries.compress(lanes).store_slice(&mut self.entries[count..count + LANES]);
        depth.compress(lanes).store_slice(&mut self.depths[count..count + LANES]);
        self.count += lanes.to_bitmask().count_ones() as usize;
    }

    /// Drops pixels that are hidden by what is in the buffer, without a branch on whether they are.
    #[inline(never)]
    pub(super) fn drop_hidden(&mut self, buffer: &VisibilityBuffer) {
        let mut count = 0;
        // A limit that the compiler knows, so that it checks no index.
        for index in 0..self.count.min(self.entries.len()) {
            let (entry, depth) = (self.entries[index], self.depths[index]);
            (self.entries[count], self.depths[count]) = (entry, depth);
            count += usize::from(depth >= buffer.depth[entry as usize / LANES]);
        }
        self.count = count;
    }
}

impl TileRasterizer<'_> {
    /// Tests the depths of the covered pixels and stores those that are visible.
    ///
    /// Not inlined, so that the first pass can use all registers.
    #[inline(never)]
    pub(super) fn scatter(
        &self,
        eight: &EightTriangles,
        pixels: &mut Covered,
        buffer: &mut VisibilityBuffer,
    ) {
        let count = std::mem::take(&mut pixels.count);
        for (&entry, &depth) in pixels.entries[..count].iter().zip(&pixels.depths) {
            // The list packs a pixel's index and its lane into one value. With one sample per
            // pixel the index is also that of the sample in the buffer.
            let (at, lane) = (entry as usize / LANES, entry as usize % LANES);
            let (there, triangle) = (buffer.depth[at], eight.index + lane as u32);
            if depth > there || (depth == there && self.precedes_at_tie(triangle, buffer.visible[at])) {
                buffer.depth[at] = depth;
                buffer.visible[at] = triangle;
                buffer.note_write(at / (GROUPS * LANES), eight.high[lane]);
            }
        }
    }

    /// Whether a triangle is visible rather than another at the same depth.
    ///
    /// Of two triangles in the same eight the later one may come first: `micro` lists pixel by pixel of the boxes, not
    /// triangle by triangle, and slivers are drawn after the other triangles of the eight. That is why numbers are
    /// compared even when triangles are drawn in the order of their keys.
    #[cold]
    fn precedes_at_tie(&self, triangle: u32, visible: u32) -> bool {
        if self.in_order {
            visible != NO_TRIANGLE && triangle < visible
        } else {
            self.may_decide(1) && visible != NO_TRIANGLE && (self.precedes)(triangle, visible)
        }
    }
}

/// The indices of pixels in the tile: see
/// [`TileArea::index_of`](crate::tile_buffer::TileArea::index_of).
#[inline(always)]
pub(super) fn index_of<S: Simd>(x: I32<S>, y: I32<S>) -> I32<S> {
    // Blocks of 8×8 pixels row by row; in each block eight groups of 4×2, two to a row.
    let block = (y >> 3) * BLOCKS as i32 + (x >> 3);
    let group = (y & 6) + ((x >> 2) & 1);
    (((block << 3) + group) << 3) + ((y & 1) << 2) + (x & 3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{SimdLevel, at_level};
    use crate::tile_buffer::TileArea;

    #[test]
    fn numbers_of_pixels_agree() {
        let token = SimdLevel::best().token().expect("the best level is there");
        for y in 0..64 {
            for x in 0..64 {
                let index = at_level!(token, simd => index_of(I32::splat(simd, x), I32::splat(simd, y))[0]);
                assert_eq!(index as usize, TileArea::index_of([x as usize, y as usize]), "{x} {y}");
            }
        }
    }
}
