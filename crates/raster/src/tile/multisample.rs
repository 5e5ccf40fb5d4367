//! The multisample kernel: the tiny kernel's loops for pixels with several samples.
//!
//! A vector holds one sample of each pixel in a group of 4×2. Sample `s` of all eight pixels
//! lies at the same offset from its pixel, so each of its edge functions differs from that of
//! sample 0 by a constant. All samples of a group are processed before the next group, so that the
//! group's address is computed once.
//!
//! Each edge function is kept as its greatest value at any sample plus a difference (zero or
//! negative) for each sample. The greatest values of the three edges may belong to different samples,
//! so they are a bound: if even they are outside, no sample of the group is covered and the group is
//! skipped. That branch pays here, unlike in the kernel for one sample,
//! because it saves up to sixteen samples.
//!
//! [`EdgeOrigins`] are the edge functions of eight small triangles, evaluated once where each triangle's first group of
//! pixels begins, and the offset of that group from the triangle's first vertex, from which depths are
//! computed. The kernels step from there from group to group.
//!
//! Arrays hold one number for each of the eight triangles. The kernels copy one triangle's
//! number to all lanes.

use super::eight::EightTriangles;
use super::rasterizer::TileRasterizer;
use super::tiny::Tiny;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, greater, inlined, lesser, prelude::*, widened};
use crate::tile_buffer::{TileArea, VisibilityBuffer, name_where};
use crate::viewport::MAX_SAMPLES;
use fearless_simd::{f64x4, f64x8};

/// What each sample of one triangle's pixels adds, copied to all lanes.
struct MultisampleOrigins {
    /// For each sample the edge functions less the greatest of all samples.
    edges: [[[i32; LANES]; 3]; MAX_SAMPLES],
    /// For each sample the plane of depth at the start of a row of groups: four lanes for the
    /// upper row of pixels, four for the lower.
    planes: [[f64; LANES]; MAX_SAMPLES],
    /// The samples' offsets from the pixel's corner in 1/256 pixel, each axis in four lanes.
    offsets: [[[f64; 4]; 2]; MAX_SAMPLES],
}

impl MultisampleOrigins {
    fn new(offsets: &[[i32; 2]]) -> Self {
        let mut splat = [[[0.0; 4]; 2]; MAX_SAMPLES];
        for (splat, offset) in splat.iter_mut().zip(offsets) {
            *splat = offset.map(|axis| [f64::from(axis); 4]);
        }
        Self { edges: [[[0; LANES]; 3]; MAX_SAMPLES], planes: [[0.0; LANES]; MAX_SAMPLES], offsets: splat }
    }
}

/// Where a row of groups starts.
struct RowStart<S: Simd> {
    row: usize,
    /// The greatest edge functions of any sample at the first group.
    edges: [I32<S>; 3],
    /// The horizontal offset of its lanes from the triangle's first vertex, in 1/256 pixel.
    dx: f64x4<S>,
}

/// Tests and stores all samples of all groups in the triangle's box. Returns the lanes in which
/// any group holds the same depth already, if `TIES` is set.
#[inline(always)]
pub(super) fn rows<S: Simd, const TIES: bool>(
    simd: S,
    tiny: &Tiny<S>,
    starts: &mut EdgeOrigins,
    lane: usize,
    buffer: &mut VisibilityBuffer,
) -> Mask<S> {
    let samples = buffer.samples;
    let EdgeOrigins { edges, greatest, multisample, .. } = &mut *starts;
    for (edges, starts) in multisample.edges.iter_mut().zip(&edges[..samples]) {
        for (edge, start) in edges.iter_mut().zip(starts) {
            *edge = I32::splat(simd, start[lane]).into();
        }
    }
    let mut edges = [0, 1, 2].each(
        #[inline(always)]
        |k| tiny.lanes[k] + greatest[k][lane],
    );
    let [dx, mut dy] = starts.vertex_offset(simd, lane, [0, 0]);
    let dx = dx + f64x4::simd_from(simd, [0.0, 256.0, 512.0, 768.0]);
    let mut ties = Mask::splat(simd, false);
    for row in tiny.rows[0]..tiny.rows[1] + 1 {
        let MultisampleOrigins { planes, offsets, .. } = &mut starts.multisample;
        for (planes, offset) in planes.iter_mut().zip(&offsets[..samples]) {
            let dy = dy + f64x4::simd_from(simd, offset[1]);
            let [upper, lower] = [dy, dy + 256.0].each(
                #[inline(always)]
                |dy| tiny.value + tiny.slopes[1] * dy,
            );
            // Stored as one vector, because it is soon loaded as one: loading what two smaller
            // stores have written stalls.
            *planes = upper.combine(lower).into();
        }
        ties |= columns::<S, TIES>(simd, tiny, RowStart { row, edges, dx }, &starts.multisample, buffer);
        for (edge, step) in edges.iter_mut().zip(tiny.down) {
            *edge += step;
        }
        dy += 512.0;
    }
    ties
}

/// The same for one row of groups.
#[inline(always)]
fn columns<S: Simd, const TIES: bool>(
    simd: S,
    tiny: &Tiny<S>,
    start: RowStart<S>,
    multisample: &MultisampleOrigins,
    buffer: &mut VisibilityBuffer,
) -> Mask<S> {
    let RowStart { row, mut edges, mut dx } = start;
    let samples = buffer.samples;
    let mut ties = Mask::splat(simd, false);
    for column in tiny.columns[0]..tiny.columns[1] + 1 {
        let (here, at) = (edges, dx);
        for (edge, step) in edges.iter_mut().zip(tiny.right) {
            *edge += step;
        }
        dx += 1024.0;
        // If not even the greatest values are inside all edges, no sample is.
        if !inside(simd, here).any_true() {
            continue;
        }
        let group = TileArea::group_of([column, row]) * samples;
        let depths = &mut buffer.depth.as_chunks_mut::<LANES>().0[group..group + samples];
        let visible = &mut buffer.visible.as_chunks_mut::<LANES>().0[group..group + samples];
        let there = depths.iter_mut().zip(visible);
        let starts = multisample.edges.iter().zip(&multisample.planes).zip(&multisample.offsets);
        for ((there, visible), ((starts, planes), offset)) in there.zip(starts) {
            let across = tiny.slopes[0] * (at + f64x4::simd_from(simd, offset[0]));
            let (upper, lower) = (f64x8::simd_from(simd, *planes) + across.combine(across)).split();
            let depth = lesser(greater(simd.narrow_f64x4(upper, lower), tiny.low), tiny.high);
            let covered = inside(
                simd,
                [0, 1, 2].each(
                    #[inline(always)]
                    |k| here[k] + I32::simd_from(simd, starts[k]),
                ),
            );
            // Uncovered lanes lie behind everything, so the depth test below, which is that of
            // `tiny`, rejects them.
            let depth = covered.select(depth, F32::splat(simd, f32::NEG_INFINITY));
            let before = F32::simd_from(simd, *there);
            if TIES {
                ties |= depth.simd_eq(before);
            }
            *there = greater(depth, before).into();
            name_where(simd, depth.simd_gt(before), tiny.triangle, visible);
        }
    }
    ties
}

/// Which pixels lie inside of all edges.
#[inline(always)]
fn inside<S: Simd>(simd: S, [a, b, c]: [I32<S>; 3]) -> Mask<S> {
    (a | b | c).simd_ge(I32::splat(simd, 0))
}

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
    multisample: MultisampleOrigins,
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
