//! Eight pixels at a time, also at the end of a row, where fewer are left.

use crate::simd::prelude::*;
use crate::simd::{I32, LANES, U32, lane_numbers};
use fearless_simd::u8x32;

/// The first eight of `pixels`, packed; what is beyond the end is transparent.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, pixels: &[[u8; 4]]) -> U32<S> {
    if let Some(eight) = pixels.first_chunk::<LANES>() {
        return u8x32::from_slice(simd, eight.as_flattened()).bitcast();
    }
    let mut eight = [[0; 4]; LANES];
    eight[..pixels.len()].copy_from_slice(pixels);
    u8x32::from_slice(simd, eight.as_flattened()).bitcast()
}

/// Changes the first `count` of `pixels`, or eight if there are more.
///
/// `change` is called with the pixels that follow `count`, too, and what it makes
/// of them is dropped.
#[inline(always)]
pub(super) fn change<S: Simd>(
    simd: S,
    pixels: &mut [[u8; 4]],
    count: i32,
    change: impl FnOnce(U32<S>) -> U32<S>,
) {
    let below = load(simd, pixels);
    let changed = lane_numbers(simd).simd_lt(I32::splat(simd, count));
    let result: u8x32<S> = changed.select(change(below), below).bitcast();
    if let Some(eight) = pixels.first_chunk_mut::<LANES>() {
        result.store_slice(eight.as_flattened_mut());
    } else {
        let mut eight = [[0; 4]; LANES];
        result.store_slice(eight.as_flattened_mut());
        pixels.copy_from_slice(&eight[..pixels.len()]);
    }
}
