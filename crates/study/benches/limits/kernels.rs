//! Memory, arithmetic and depth tests.

use crate::limit::Kernel;
use fearless_simd::{Level, Simd, dispatch};
use std::hint::black_box;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, LANES, U32, greater};

/// Numbers of 32 bits in 8 MB.
const IMAGE: usize = 2 << 20;
/// Pixels of a tile.
pub(crate) const TILE: usize = 64 * 64;
/// Tiles of 1920 by 1080 pixels.
pub(crate) const TILES: usize = 510;
/// Layers of W1a and W1b.
const LAYERS: usize = 64;

pub(crate) fn store() -> Kernel {
    let mut memory = vec![1_u32; IMAGE];
    let run = move || {
        memory.fill(black_box(7));
        black_box(&memory);
    };
    Kernel { work: 4.0 * IMAGE as f64 / 1e9, run: Box::new(run) }
}

pub(crate) fn load() -> Kernel {
    let memory = vec![1_u32; IMAGE];
    let run = move || {
        let sum = dispatch!(Level::new(), simd => all_bits(simd, black_box(&memory)));
        black_box(sum);
    };
    Kernel { work: 4.0 * IMAGE as f64 / 1e9, run: Box::new(run) }
}

#[inline(always)]
fn all_bits<S: Simd>(simd: S, memory: &[u32]) -> u32 {
    let mut bits = [U32::splat(simd, 0); 4];
    for row in memory.as_chunks::<{ 4 * LANES }>().0 {
        for (bits, row) in bits.iter_mut().zip(row.as_chunks::<LANES>().0) {
            *bits ^= U32::simd_from(simd, *row);
        }
    }
    let [a, b, c, d] = bits;
    <[u32; LANES]>::from(a ^ b ^ c ^ d).into_iter().fold(0, |all, lane| all ^ lane)
}

pub(crate) fn arithmetic() -> Kernel {
    const STEPS: usize = 1 << 20;
    const CHAINS: usize = 12;
    let run = move || {
        let end = dispatch!(Level::new(), simd => chains::<_, CHAINS>(simd, STEPS));
        black_box(end);
    };
    Kernel { work: (2 * LANES * CHAINS * STEPS) as f64 / 1e9, run: Box::new(run) }
}

#[inline(always)]
fn chains<S: Simd, const CHAINS: usize>(simd: S, steps: usize) -> f32 {
    let (factor, summand) = (F32::splat(simd, black_box(0.999)), F32::splat(simd, black_box(0.001)));
    let mut values = [F32::splat(simd, 1.0); CHAINS];
    for _ in 0..steps {
        for value in &mut values {
            *value = *value * factor + summand;
        }
    }
    let mut sum = values[0];
    for value in &values[1..] {
        sum += *value;
    }
    sum[0]
}

/// Layers over every tile of an image, each before those that were there, or behind.
pub(crate) fn fill(passes: bool) -> Kernel {
    let (mut depths, mut codes) = (vec![0.0_f32; TILE], vec![0_u32; TILE]);
    let run = move || {
        for _ in 0..TILES {
            depths.fill(if passes { 0.0 } else { 1.0 });
            for layer in 0..LAYERS {
                let depth = 0.1 + layer as f32 * 0.01;
                if passes {
                    dispatch!(Level::new(), simd => pass(simd, &mut depths, &mut codes, depth, layer as u32));
                } else {
                    let seen = dispatch!(Level::new(), simd => any_passes(simd, black_box(&depths), depth));
                    black_box(seen);
                }
            }
            black_box((&depths, &codes));
        }
    };
    Kernel { work: (TILES * TILE * LAYERS) as f64 / 1e9, run: Box::new(run) }
}

#[inline(always)]
fn pass<S: Simd>(simd: S, depths: &mut [f32], codes: &mut [u32], depth: f32, code: u32) {
    let (depth, code) = (F32::splat(simd, depth), U32::splat(simd, code));
    let groups = depths.as_chunks_mut::<LANES>().0.iter_mut();
    for (depths, codes) in groups.zip(codes.as_chunks_mut::<LANES>().0) {
        let there = F32::simd_from(simd, *depths);
        let bits = depth.simd_gt(there).select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
        *depths = greater(depth, there).into();
        let old = U32::simd_from(simd, *codes);
        *codes = (old ^ ((old ^ code) & bits)).into();
    }
}

#[inline(always)]
fn any_passes<S: Simd>(simd: S, depths: &[f32], depth: f32) -> bool {
    let depth = F32::splat(simd, depth);
    let mut seen = false;
    for pair in depths.as_chunks::<{ 2 * LANES }>().0 {
        let [a, b] = [0, LANES].each(
            #[inline(always)]
            |at| depth.simd_gt(F32::from_slice(simd, &pair[at..at + LANES])),
        );
        seen |= (a | b).any_true();
    }
    seen
}
