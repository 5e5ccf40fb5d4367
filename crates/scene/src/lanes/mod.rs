//! Vectors and elementary functions for eight points at once, one in each lane.
//!
//! Each lane is independent of the others, and every operation rounds the same way on every machine.

mod power;

pub(crate) use power::{exp2, pow};

use trigon_math::{Mat3, Mat4, Vec3};
use trigon_raster::simd::{F32, I32, InlineMap, LANES, Simd, greater, lesser, prelude::*};

/// Eight vectors: their x, their y and their z.
pub(crate) type V3<S> = [F32<S>; 3];

/// The same vector in all lanes.
#[inline(always)]
pub(crate) fn splat<S: Simd>(simd: S, vector: Vec3) -> V3<S> {
    vector.to_array().each(
        #[inline(always)]
        |axis| F32::splat(simd, axis),
    )
}

#[inline(always)]
pub(crate) fn sum<S: Simd>([a, b, c]: V3<S>, [d, e, f]: V3<S>) -> V3<S> {
    [a + d, b + e, c + f]
}

#[inline(always)]
pub(crate) fn difference<S: Simd>([a, b, c]: V3<S>, [d, e, f]: V3<S>) -> V3<S> {
    [a - d, b - e, c - f]
}

/// Entry by entry: of colours.
#[inline(always)]
pub(crate) fn product<S: Simd>([a, b, c]: V3<S>, [d, e, f]: V3<S>) -> V3<S> {
    [a * d, b * e, c * f]
}

#[inline(always)]
pub(crate) fn scaled<S: Simd>([a, b, c]: V3<S>, factor: F32<S>) -> V3<S> {
    [a * factor, b * factor, c * factor]
}

/// A colour scaled by the value in each lane.
#[inline(always)]
pub(crate) fn tinted<S: Simd>(factor: F32<S>, color: Vec3) -> V3<S> {
    [factor * color.x, factor * color.y, factor * color.z]
}

#[inline(always)]
pub(crate) fn negated<S: Simd>([a, b, c]: V3<S>) -> V3<S> {
    [-a, -b, -c]
}

#[inline(always)]
pub(crate) fn dot<S: Simd>(a: V3<S>, b: V3<S>) -> F32<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross<S: Simd>(a: V3<S>, b: V3<S>) -> V3<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a` in the lanes of the mask, else `b`.
#[inline(always)]
pub(crate) fn select<S: Simd>(mask: trigon_raster::simd::Mask<S>, a: V3<S>, b: V3<S>) -> V3<S> {
    [mask.select(a[0], b[0]), mask.select(a[1], b[1]), mask.select(a[2], b[2])]
}

/// Unit vectors; zero for vectors without a direction.
#[inline(always)]
pub(crate) fn normalized<S: Simd>(vector: V3<S>) -> V3<S> {
    scaled(vector, inverse_root(dot(vector, vector)))
}

/// One over the square root; 0 unless that is a positive number.
#[inline(always)]
pub(crate) fn inverse_root<S: Simd>(square: F32<S>) -> F32<S> {
    let simd = square.token();
    let inverse = F32::splat(simd, 1.0) / square.sqrt();
    let exists = square.simd_gt(0.0) & inverse.simd_gt(0.0);
    exists.select(inverse, F32::splat(simd, 0.0))
}

/// The value, or 0 if it is negative or NaN.
#[inline(always)]
pub(crate) fn positive<S: Simd>(value: F32<S>) -> F32<S> {
    greater(value, F32::splat(value.token(), 0.0))
}

/// Clamped to 0…1; 0 for NaN.
#[inline(always)]
pub(crate) fn saturated<S: Simd>(value: F32<S>) -> F32<S> {
    lesser(positive(value), F32::splat(value.token(), 1.0))
}

/// From `a` at 0 to `b` at 1.
#[inline(always)]
pub(crate) fn mix<S: Simd>(a: F32<S>, b: F32<S>, share: F32<S>) -> F32<S> {
    a + (b - a) * share
}

/// From the vectors `a` at 0 to `b` at 1.
#[inline(always)]
pub(crate) fn mixed<S: Simd>(a: V3<S>, b: V3<S>, share: F32<S>) -> V3<S> {
    [mix(a[0], b[0], share), mix(a[1], b[1], share), mix(a[2], b[2], share)]
}

/// A matrix times vectors.
#[inline(always)]
pub(crate) fn turned<S: Simd>(matrix: &Mat3, [x, y, z]: V3<S>) -> V3<S> {
    let rows = matrix.transpose().to_cols_array_2d();
    rows.each(
        #[inline(always)]
        |[a, b, c]| x * a + y * b + z * c,
    )
}

/// An affine map of points.
#[inline(always)]
pub(crate) fn moved<S: Simd>(matrix: &Mat4, point: V3<S>) -> V3<S> {
    let [x, y, z, _] = mapped(matrix, point);
    [x, y, z]
}

/// A projective map of points.
#[inline(always)]
pub(crate) fn mapped<S: Simd>(matrix: &Mat4, [x, y, z]: V3<S>) -> [F32<S>; 4] {
    let rows = matrix.transpose().to_cols_array_2d();
    rows.each(
        #[inline(always)]
        |[a, b, c, d]| x * a + y * b + z * c + d,
    )
}

/// The fifth power.
#[inline(always)]
pub(crate) fn fifth_power<S: Simd>(value: F32<S>) -> F32<S> {
    let square = value * value;
    square * square * value
}

/// Clamped to a maximum.
#[inline(always)]
pub(crate) fn lesser_of<S: Simd>(value: F32<S>, bound: f32) -> F32<S> {
    lesser(value, F32::splat(value.token(), bound))
}

/// Positions of values from 0 to 1 in a table of `count` entries in equal steps: the index of the entry
/// before each, and the fraction of the way to the next. The last entry is the end of the last step.
#[inline(always)]
pub(crate) fn table_step<S: Simd>(value: F32<S>, count: usize) -> ([i32; LANES], F32<S>) {
    let position = saturated(value) * (count - 1) as f32;
    let first = lesser_of(position.floor(), (count - 2) as f32);
    (first.to_int::<I32<S>>().into(), position - first)
}
