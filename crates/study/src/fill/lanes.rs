//! Eight pixels of a row at a time: the same edges, boxes and pixels as [`float`] and
//! [`fixed`], which take one pixel at a time.

use super::{FillCanvas, Triangle, fixed, float};
use fearless_simd::Simd;
use std::ops::RangeInclusive;
use trigon_math::at_level;
use trigon_math::simd::Token;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, LANES, inlined, lane_numbers};

/// In `f32`, as [`float::fill_hoisted`].
pub(super) fn fill_float(triangles: &[Triangle], canvas: &mut FillCanvas) {
    at_level!(Token::best(), simd => canvas.each(triangles, #[inline(always)] |triangle, canvas| {
        float_edges(simd, triangle, canvas);
    }));
}

/// On a grid of 1/256 pixel, as [`fixed::fill`] with eight bits.
pub(super) fn fill_fixed(triangles: &[Triangle], canvas: &mut FillCanvas) {
    at_level!(Token::best(), simd => canvas.each(triangles, #[inline(always)] |triangle, canvas| {
        fixed_edges(simd, triangle, canvas);
    }));
}

#[inline(always)]
fn float_edges<S: Simd>(simd: S, triangle: &Triangle, canvas: &mut FillCanvas) {
    let edges = float::Edges::new(*triangle);
    let [columns, rows] = float::bounding_box(triangle, canvas.limits());
    let numbers = lane_numbers(simd).to_float::<F32<S>>();
    for y in rows {
        for first in groups(&columns) {
            let x = numbers + first as f32;
            let is_inside = inlined(
                #[inline(always)]
                |i: usize| {
                    let [start, across, down] = edges.values[i];
                    (x * across + start + down * y as f32).simd_ge(F32::splat(simd, edges.least[i]))
                },
            );
            let covered = is_inside(0) & is_inside(1) & is_inside(2);
            paint(canvas, [first, y], covered.to_bitmask());
        }
    }
}

#[inline(always)]
fn fixed_edges<S: Simd>(simd: S, triangle: &Triangle, canvas: &mut FillCanvas) {
    let Some(edges) = fixed::edges(triangle, 8) else { return };
    let [columns, rows] = edges.bounding_box(canvas.limits());
    // Whole pixels change a value by multiples of 256, so dropping eight bits keeps its sign.
    let first = [*columns.start(), *rows.start()];
    let last = [*columns.end() + LANES as i32, *rows.end()];
    let Some(planes) = edges.planes(first, last) else { return fixed::fill_edges(&edges, canvas) };
    let numbers = lane_numbers(simd);
    for y in rows {
        for x in groups(&columns) {
            let value = inlined(
                #[inline(always)]
                |i: usize| {
                    let [start, across, down] = planes[i];
                    numbers * across + (start + across * (x - first[0]) + down * (y - first[1]))
                },
            );
            // The sign of all three: negative as soon as one is.
            let covered = (value(0) | value(1) | value(2)).simd_ge(I32::splat(simd, 0));
            paint(canvas, [x, y], covered.to_bitmask());
        }
    }
}

/// The first columns of groups of eight that hold all columns.
fn groups(columns: &RangeInclusive<i32>) -> impl Iterator<Item = i32> {
    columns.clone().step_by(LANES)
}

/// Paints those of eight pixels whose bits are set in the mask.
#[inline(always)]
fn paint(canvas: &mut FillCanvas, [x, y]: [i32; 2], covered: u64) {
    let mut covered = covered;
    while covered != 0 {
        canvas.paint(x + covered.trailing_zeros() as i32, y);
        covered &= covered - 1;
    }
}
