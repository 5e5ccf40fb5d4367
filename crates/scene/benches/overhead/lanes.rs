//! Vectors for eight points at once, one in each lane. All have a direction, which the scene renderer must not assume.

use trigon_raster::simd::{F32, InlineMap, Simd, greater, prelude::*};
use trigon_scene::math::{Mat3, Vec3};

/// Their x, their y and their z.
pub(crate) type V3<S> = [F32<S>; 3];

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
pub(crate) fn scaled<S: Simd>([a, b, c]: V3<S>, factor: F32<S>) -> V3<S> {
    [a * factor, b * factor, c * factor]
}

#[inline(always)]
pub(crate) fn dot<S: Simd>(a: V3<S>, b: V3<S>) -> F32<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross<S: Simd>(a: V3<S>, b: V3<S>) -> V3<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub(crate) fn normalized<S: Simd>(vector: V3<S>) -> V3<S> {
    let inverse = F32::splat(vector[0].token(), 1.0) / dot(vector, vector).sqrt();
    scaled(vector, inverse)
}

/// At least 0; 0 for NaN.
#[inline(always)]
pub(crate) fn positive<S: Simd>(value: F32<S>) -> F32<S> {
    greater(value, F32::splat(value.token(), 0.0))
}

/// From `a` at 0 to `b` at 1.
#[inline(always)]
pub(crate) fn mix<S: Simd>(a: F32<S>, b: F32<S>, share: F32<S>) -> F32<S> {
    a + (b - a) * share
}

/// A matrix times vectors.
#[inline(always)]
pub(crate) fn turned<S: Simd>(matrix: &Mat3, [x, y, z]: V3<S>) -> V3<S> {
    matrix.transpose().to_cols_array_2d().each(
        #[inline(always)]
        |[a, b, c]| x * a + y * b + z * c,
    )
}
