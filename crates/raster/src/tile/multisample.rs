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

use super::edge_origins::EdgeOrigins;
use super::store::name_where;
use super::tiny::Tiny;
use crate::samples::MAX_SAMPLES;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, greater, lesser, prelude::*};
use crate::tile_buffer::{TileArea, VisibilityBuffer};
use fearless_simd::{f64x4, f64x8};

/// What each sample of one triangle's pixels adds, copied to all lanes.
pub(super) struct MultisampleOrigins {
    /// For each sample the edge functions less the greatest of all samples.
    edges: [[[i32; LANES]; 3]; MAX_SAMPLES],
    /// For each sample the plane of depth at the start of a row of groups: four lanes for the
    /// upper row of pixels, four for the lower.
    planes: [[f64; LANES]; MAX_SAMPLES],
    /// The samples' offsets from the pixel's corner in 1/256 pixel, each axis in four lanes.
    offsets: [[[f64; 4]; 2]; MAX_SAMPLES],
}

impl MultisampleOrigins {
    pub(super) fn new(offsets: &[[i32; 2]]) -> Self {
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
