//! The edge functions of eight small triangles, evaluated once where each triangle's first group of
//! pixels begins, and the offset of that group from the triangle's first vertex, from which depths are
//! computed. The kernels step from there from group to group.
//!
//! Arrays hold one number for each of the eight triangles. The kernels copy one triangle's
//! number to all lanes.

use super::eight::EightTriangles;
use super::multisample::MultisampleOrigins;
use super::rasterizer::TileRasterizer;
use crate::samples::MAX_SAMPLES;
use crate::simd::{F32, I32, InlineMap, LANES, Simd, inlined, prelude::*, widened};
use fearless_simd::f64x4;

/// Edge functions and offsets are whole numbers, so adding steps to them rounds nothing. Depths are
/// evaluated from the offset at each group, never added up.
pub(super) struct EdgeOrigins {
    /// The edge functions at each sample of the first group's first pixel, divided by 256. With
    /// several samples, less the greatest of all samples.
    pub(super) edges: [[[i32; LANES]; 3]; MAX_SAMPLES],
    /// The greatest edge functions of any sample, where there are several.
    pub(super) greatest: [[i32; LANES]; 3],
    /// The offset of that pixel's corner from the triangle's first vertex, in 1/256 pixel.
    pub(super) vertex_offset: [[f64; LANES]; 2],
    /// Depths of the first vertices.
    pub(super) value: [f64; LANES],
    /// Room for one of the triangles, where pixels have several samples.
    pub(super) multisample: MultisampleOrigins,
}

impl EdgeOrigins {
    pub(super) fn new(offsets: &[[i32; 2]]) -> Self {
        Self {
            edges: [[[0; LANES]; 3]; MAX_SAMPLES],
            greatest: [[0; LANES]; 3],
            vertex_offset: [[0.0; LANES]; 2],
            value: [0.0; LANES],
            multisample: MultisampleOrigins::new(offsets),
        }
    }

    /// Finds them for eight triangles.
    #[inline(always)]
    pub(super) fn find<S: Simd, const MULTI: bool>(
        &mut self,
        simd: S,
        rasterizer: &TileRasterizer<'_>,
        eight: &EightTriangles,
    ) {
        let column = |values: &[i32; LANES]| I32::simd_from(simd, *values);
        // The first pixel of the first group: groups are 4×2 pixels, so the lowest bits of the
        // column and the row are cleared.
        let pixel = [column(&eight.pixels[0][0]) & !3, column(&eight.pixels[1][0]) & !1];
        for k in 0..3 {
            let (right, down) = (column(&eight.right[k]), column(&eight.down[k]));
            let along = right * pixel[0] + down * pixel[1];
            if !MULTI {
                self.edges[0][k] = (along + column(&eight.first[k])).into();
                continue;
            }
            let corner = column(&eight.corner[k]);
            let at = inlined(
                #[inline(always)]
                |[x, y]: [i32; 2]| (corner + right * x + down * y) >> 8,
            );
            let greatest = rasterizer.offsets.iter().fold(
                at(rasterizer.offsets[0]),
                #[inline(always)]
                |greatest, offset| greatest.max(at(*offset)),
            );
            self.greatest[k] = (along + greatest).into();
            for (edges, offset) in self.edges.iter_mut().zip(rasterizer.offsets) {
                edges[k] = (at(*offset) - greatest).into();
            }
        }
        let axes = pixel.into_iter().zip(rasterizer.area.origin).zip(&eight.anchor);
        for (distance, ((pixel, origin), anchor)) in self.vertex_offset.iter_mut().zip(axes) {
            let corner = (pixel + origin) << 8;
            // A small triangle's box lies near the tile, so these are below 2^24 and exact in f32.
            store((corner - column(anchor)).to_float::<F32<S>>(), distance);
        }
        store(F32::simd_from(simd, eight.value), &mut self.value);
    }

    /// The same for a sample of one triangle's pixels, in all lanes.
    #[inline(always)]
    pub(super) fn edges<S: Simd>(&self, simd: S, sample: usize, lane: usize) -> [I32<S>; 3] {
        self.edges[sample % MAX_SAMPLES].each_ref().each(
            #[inline(always)]
            |column| I32::splat(simd, column[lane]),
        )
    }

    /// The offset from the triangle's first vertex of the point that lies at `offset` from the first
    /// pixel's corner.
    #[inline(always)]
    pub(super) fn vertex_offset<S: Simd>(&self, simd: S, lane: usize, offset: [i32; 2]) -> [f64x4<S>; 2] {
        [0, 1].each(
            #[inline(always)]
            |axis| f64x4::splat(simd, self.vertex_offset[axis][lane]) + f64::from(offset[axis]),
        )
    }
}

#[inline(always)]
fn store<S: Simd>(value: F32<S>, to: &mut [f64; LANES]) {
    let [low, high] = widened(value);
    low.store_slice(&mut to[..4]);
    high.store_slice(&mut to[4..]);
}
