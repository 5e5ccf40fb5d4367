//! Writing lanes to the visibility buffer.

use crate::simd::{F32, LANES, Mask, Simd, U32, blended, prelude::*};
use crate::tile_buffer::VisibilityBuffer;

/// Writes one triangle to all lanes.
#[inline(always)]
pub(super) fn store<S: Simd>(
    simd: S,
    triangle: u32,
    depth: F32<S>,
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    depth.store_slice(&mut buffer.depth[at..at + LANES]);
    U32::splat(simd, triangle).store_slice(&mut buffer.visible[at..at + LANES]);
}

/// Writes one triangle to some lanes.
#[inline(always)]
pub(super) fn store_where<S: Simd>(
    simd: S,
    mask: Mask<S>,
    triangle: u32,
    depth: F32<S>,
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    store_each_where(simd, mask, U32::splat(simd, triangle), depth, buffer, at);
}

/// Writes some lanes, each with its own triangle.
#[inline(always)]
pub(super) fn store_each_where<S: Simd>(
    simd: S,
    mask: Mask<S>,
    triangles: U32<S>,
    depth: F32<S>,
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    let bits = mask.select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
    let there = F32::from_slice(simd, &buffer.depth[at..at + LANES]);
    let depth: F32<S> = blended(bits, there.bitcast(), depth.bitcast()).bitcast();
    depth.store_slice(&mut buffer.depth[at..at + LANES]);
    let visible = buffer.visible[at..].first_chunk_mut().expect("groups are whole");
    *visible = blended(bits, U32::simd_from(simd, *visible), triangles).into();
}

/// Makes a triangle the visible one in some lanes, without writing its depth.
#[inline(always)]
pub(super) fn name_where<S: Simd>(simd: S, mask: Mask<S>, triangle: u32, visible: &mut [u32; LANES]) {
    let bits = mask.select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
    *visible = blended(bits, U32::simd_from(simd, *visible), U32::splat(simd, triangle)).into();
}
