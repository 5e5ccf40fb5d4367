//! Writing lanes to the visibility buffer.

use super::buffer::VisibilityBuffer;
use crate::simd::{F32, LANES, Mask, Simd, U32, prelude::*};

/// Writes all lanes.
#[inline(always)]
pub(super) fn store<S: Simd>(simd: S, place: u32, depth: F32<S>, buffer: &mut VisibilityBuffer, at: usize) {
    depth.store_slice(&mut buffer.depth[at..at + LANES]);
    U32::splat(simd, place).store_slice(&mut buffer.winner[at..at + LANES]);
}

/// Writes some lanes.
///
/// A selection followed by a store would become a masked store, which some
/// processors are slow at (AMD's Zen 3 takes five times as long as for this).
#[inline(always)]
pub(super) fn store_where<S: Simd>(
    simd: S,
    mask: Mask<S>,
    (place, depth): (u32, F32<S>),
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    let bits = mask.select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
    let there = F32::from_slice(simd, &buffer.depth[at..at + LANES]);
    let depth: F32<S> = blended(bits, there.bitcast(), depth.bitcast()).bitcast();
    depth.store_slice(&mut buffer.depth[at..at + LANES]);
    let there = U32::from_slice(simd, &buffer.winner[at..at + LANES]);
    let winner = blended(bits, there, U32::splat(simd, place));
    winner.store_slice(&mut buffer.winner[at..at + LANES]);
}

/// The bits of `new` where `bits` are set, of `there` elsewhere.
#[inline(always)]
fn blended<S: Simd>(bits: U32<S>, there: U32<S>, new: U32<S>) -> U32<S> {
    there ^ ((there ^ new) & bits)
}
