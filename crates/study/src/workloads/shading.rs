//! The light, and the two reflection models.

use trigon_math::Vec3;
use trigon_raster::simd::{F32, Simd, greater, prelude::*};

/// Red, green and blue of lit surfaces.
pub(super) const BASE_COLOR: Vec3 = Vec3::new(0.85, 0.65, 0.40);

/// The share of light that comes from everywhere.
const AMBIENT: f32 = 0.1;

/// The strength of highlights. Their exponent is 32: five squares.
const SPECULAR: f32 = 0.4;

/// The direction towards the light: (0.4, 0.7, 0.6), of unit length. In numbers,
/// so that no vector of fragments takes a square root for it.
const LIGHT: Vec3 = Vec3::new(0.398_014_87, 0.696_526, 0.597_022_3);

/// Lambert's law with some light from everywhere: between `ambient` and 1.
pub(super) fn lambert(normal: Vec3, ambient: f32) -> f32 {
    ambient + (1.0 - ambient) * normal.dot(LIGHT).max(0.0)
}

/// Lambert's law for eight unit normals, with the light of lit surfaces: between 0.1 and 1.
#[inline(always)]
pub fn lambert_lanes<S: Simd>(simd: S, normal: [F32<S>; 3]) -> F32<S> {
    diffuse(dot(normal, splat(simd, LIGHT)))
}

/// J. F. Blinn, "Models of light reflection for computer synthesized pictures",
/// SIGGRAPH 1977: the highlight by the angle between the normal and the middle
/// of light and eye. The normal may have any length.
#[inline(always)]
pub fn blinn_phong<S: Simd>(simd: S, position: [F32<S>; 3], normal: [F32<S>; 3], eye: Vec3) -> [F32<S>; 3] {
    let light = splat(simd, LIGHT);
    let to_eye = difference(splat(simd, eye), position);
    let half = sum(light, scaled(to_eye, inverse_length(to_eye)));
    // Lengths divide the products: that is shorter than to divide the vectors.
    let shortness = inverse_length(normal);
    let mut highlight = positive(dot(normal, half) * (shortness * inverse_length(half)));
    for _ in 0..5 {
        highlight *= highlight;
    }
    let diffuse = diffuse(dot(normal, light) * shortness);
    let [r, g, b] = lit(BASE_COLOR, diffuse);
    let highlight = highlight * SPECULAR;
    [r + highlight, g + highlight, b + highlight]
}

/// A colour times a light.
#[inline(always)]
pub(super) fn lit<S: Simd>(color: Vec3, light: F32<S>) -> [F32<S>; 3] {
    [light * color.x, light * color.y, light * color.z]
}

/// By the cosine of the angle between the normal and the light.
#[inline(always)]
fn diffuse<S: Simd>(cosine: F32<S>) -> F32<S> {
    positive(cosine) * (1.0 - AMBIENT) + AMBIENT
}

#[inline(always)]
fn inverse_length<S: Simd>(vector: [F32<S>; 3]) -> F32<S> {
    1.0 / dot(vector, vector).sqrt()
}

#[inline(always)]
fn sum<S: Simd>([a, b, c]: [F32<S>; 3], [d, e, f]: [F32<S>; 3]) -> [F32<S>; 3] {
    [a + d, b + e, c + f]
}

#[inline(always)]
fn difference<S: Simd>([a, b, c]: [F32<S>; 3], [d, e, f]: [F32<S>; 3]) -> [F32<S>; 3] {
    [a - d, b - e, c - f]
}

#[inline(always)]
fn scaled<S: Simd>([a, b, c]: [F32<S>; 3], factor: F32<S>) -> [F32<S>; 3] {
    [a * factor, b * factor, c * factor]
}

#[inline(always)]
fn dot<S: Simd>(a: [F32<S>; 3], b: [F32<S>; 3]) -> F32<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn splat<S: Simd>(simd: S, vector: Vec3) -> [F32<S>; 3] {
    [F32::splat(simd, vector.x), F32::splat(simd, vector.y), F32::splat(simd, vector.z)]
}

/// 0 also for what is no number.
#[inline(always)]
fn positive<S: Simd>(value: F32<S>) -> F32<S> {
    greater(value, F32::splat(value.simd, 0.0))
}
