//! Shading and vertices.

use crate::kernels::{TILE, TILES};
use crate::limit::Kernel;
use fearless_simd::{Level, Simd, dispatch};
use std::hint::black_box;
use trigon_math::Vec3;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, InlineMap, LANES, greater, inlined, lane_numbers, lesser};
use trigon_raster::{Sampler, Texture};
use trigon_study::workloads::{blinn_phong as light, knot_surface, lambert_lanes};

/// Pixels of a tile's side.
const SIDE: usize = 64;

/// A tile is shaded as often as an image has tiles.
fn tiles(mut shade: impl FnMut(&mut [u32]) + 'static) -> Kernel {
    let mut codes = vec![0_u32; TILE];
    let run = move || {
        for _ in 0..TILES {
            shade(&mut codes);
            black_box(&codes);
        }
    };
    Kernel { work: (TILES * TILE) as f64 / 1e6, run: Box::new(run) }
}

pub(crate) fn blinn_phong() -> Kernel {
    // 1/w, position and normal, all over w: steps to the right and down, and the value
    // in the corner.
    let planes: [[f32; 3]; 7] = [
        [1e-5, 2e-5, 0.25],
        [1e-3, 0.0, 0.1],
        [0.0, 1e-3, 0.1],
        [1e-4, 1e-4, 0.2],
        [1e-3, 2e-3, 0.3],
        [2e-3, 1e-3, 0.4],
        [1e-3, 1e-3, 0.5],
    ];
    tiles(move |codes| dispatch!(Level::new(), simd => phong_tile(simd, black_box(&planes), codes)))
}

#[inline(always)]
fn phong_tile<S: Simd>(simd: S, planes: &[[f32; 3]; 7], codes: &mut [u32]) {
    let eye = Vec3::new(0.3, 0.4, 4.6);
    for (group, codes) in codes.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let [x, y] = place(simd, group);
        let at = inlined(
            #[inline(always)]
            |plane: usize| x * planes[plane][0] + (y * planes[plane][1] + planes[plane][2]),
        );
        let w = 1.0 / at(0);
        let [position, normal] = [[at(1) * w, at(2) * w, at(3) * w], [at(4) * w, at(5) * w, at(6) * w]];
        *codes = encoded(simd, light(simd, position, normal, eye));
    }
}

pub(crate) fn trilinear() -> Kernel {
    let texture = knot_surface();
    tiles(move |codes| dispatch!(Level::new(), simd => texture_tile(simd, black_box(&texture), codes)))
}

#[inline(always)]
fn texture_tile<S: Simd>(simd: S, texture: &Texture, codes: &mut [u32]) {
    // A texel and a half a pixel: between two levels.
    let (step, sampler) = (1.5 / 1024.0, Sampler::default());
    let (zero, steps) = (F32::splat(simd, 0.0), F32::splat(simd, step));
    for (group, codes) in codes.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let [x, y] = place(simd, group);
        let [r, g, b, _] =
            texture.sample_lanes(simd, [x * step, y * step], [steps, zero], [zero, steps], &sampler);
        *codes = encoded(simd, [r, g, b]);
    }
}

/// The centres of a group of pixels in a row of the tile.
#[inline(always)]
fn place<S: Simd>(simd: S, group: usize) -> [F32<S>; 2] {
    let left = (group * LANES % SIDE) as f32 + 0.5;
    [lane_numbers(simd).to_float::<F32<S>>() + left, F32::splat(simd, (group * LANES / SIDE) as f32 + 0.5)]
}

/// Opaque bytes.
#[inline(always)]
fn encoded<S: Simd>(simd: S, color: [F32<S>; 3]) -> [u32; LANES] {
    let [r, g, b] = color.each(
        #[inline(always)]
        |channel| {
            let held = lesser(greater(channel, F32::splat(simd, 0.0)), F32::splat(simd, 1.0));
            (held * 255.0 + 0.5).to_int::<I32<S>>()
        },
    );
    let codes: [i32; LANES] = (r | (g << 8) | (b << 16) | I32::splat(simd, 0xff << 24)).into();
    codes.each(i32::cast_unsigned)
}

pub(crate) fn vertices() -> Kernel {
    const COUNT: usize = 500_000;
    let columns: Vec<Vec<f32>> =
        (0..6).map(|k| (0..COUNT).map(|i| ((i + k) as f32).fract() + 0.5).collect()).collect();
    let mut out: Vec<Vec<f32>> = vec![vec![0.0; COUNT]; 5];
    let run = move || {
        dispatch!(Level::new(), simd => vertex_columns(simd, black_box(&columns), &mut out));
        black_box(&out);
    };
    Kernel { work: COUNT as f64 / 1e6, run: Box::new(run) }
}

#[inline(always)]
fn vertex_columns<S: Simd>(simd: S, columns: &[Vec<f32>], out: &mut [Vec<f32>]) {
    let matrix =
        [[1.2_f32, 0.1, 0.0, 0.3], [0.0, 1.7, 0.2, 0.1], [0.1, 0.0, 0.5, 0.2], [0.0, 0.1, -1.0, 5.0]];
    for first in (0..columns[0].len() - LANES + 1).step_by(LANES) {
        let column = inlined(
            #[inline(always)]
            |index: usize| F32::from_slice(simd, &columns[index][first..first + LANES]),
        );
        let (x, y, z) = (column(0), column(1), column(2));
        let row = inlined(
            #[inline(always)]
            |row: usize| {
                let [a, b, c, d] = matrix[row];
                x * a + (y * b + (z * c + d))
            },
        );
        let inverse = 1.0 / row(3);
        let light = lambert_lanes(simd, [column(3), column(4), column(5)]);
        let (left, top) = (row(0) * inverse * 960.0 + 960.0, row(1) * inverse * -540.0 + 540.0);
        let results = [left, top, row(2) * inverse, inverse, light];
        for (out, result) in out.iter_mut().zip(results) {
            result.store_slice(&mut out[first..first + LANES]);
        }
    }
}
