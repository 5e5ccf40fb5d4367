//! The micro kernel: up to eight small triangles of at most 4×4 pixels each in the tile at a time, one
//! triangle in each lane. Most triangles of a fine mesh are drawn here.
//!
//! First, triangles are dropped that lie behind the farthest depth visible in the tile; the bounds of
//! blocks are not tested. Then the kernel has two passes. The first visits the same row and column of
//! all eight bounding boxes at once, row by row. It tests the edges of all eight triangles, computes
//! their depths, and appends the covered pixels with their depths to a list. The second tests the depths of the
//! pixels in the list ([`covered`](super::covered)).

use super::covered::{Covered, index_of};
use super::eight::{EightTriangles, MICRO};
use super::rasterizer::TileRasterizer;
use crate::counts::Counts;
use crate::simd::{
    F32, I32, InlineMap, LANES, Mask, Simd, greater, lane_numbers, lesser, prelude::*, widened,
};
use crate::tile_buffer::VisibilityBuffer;
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
