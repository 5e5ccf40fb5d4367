//! Vectors and elementary functions for eight points at once, one in each lane.
//!
//! Each lane is independent of the others, and every operation rounds the same way on every machine. Powers are computed
//! from base-2 logarithm and exponential, by polynomials of the mantissa, without a table or the machine's own functions.
//! The logarithm is the series of the inverse hyperbolic tangent, whose relative error stays small near 1, where powers
//! with large exponents have their highlights.

use trigon_math::glam::Affine3;
use trigon_math::{Mat3, Mat4, Vec3};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, InlineMap, LANES, Simd, greater, lesser};

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
pub(crate) fn moved<S: Simd>(map: &Affine3, point: V3<S>) -> V3<S> {
    sum(turned(&map.matrix3, point), splat(point[0].token(), map.translation))
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

/// 2 to the power of `exponent`, within 3 units of the last place; clamped to normal numbers: 2⁻¹²⁶ to 2¹²⁷.
#[inline(always)]
pub(crate) fn exp2<S: Simd>(exponent: F32<S>) -> F32<S> {
    let simd = exponent.token();
    let held = lesser(greater(exponent, F32::splat(simd, -126.0)), F32::splat(simd, 127.0));
    let whole = (held + 0.5).floor();
    let x = (held - whole) * std::f32::consts::LN_2;
    // Taylor's series of e^x for |x| <= ln(2) / 2; the next term is below 1e-8.
    let series = x * (1.0 / 5040.0) + 1.0 / 720.0;
    let series = series * x + 1.0 / 120.0;
    let series = series * x + 1.0 / 24.0;
    let series = series * x + 1.0 / 6.0;
    let series = (series * x + 0.5) * x + 1.0;
    let mantissa = series * x + 1.0;
    let bits = (whole.to_int::<I32<S>>() + 127) << 23;
    mantissa * bits.bitcast::<F32<S>>()
}

/// The logarithm to base 2 of a positive normal number.
#[inline(always)]
fn log2<S: Simd>(value: F32<S>) -> F32<S> {
    /// The bits of √½: mantissas are normalized to the range from there to its double.
    const ROOT_OF_HALF: i32 = 0x3f35_04f3;
    let bits: I32<S> = value.bitcast();
    let exponent = (bits - ROOT_OF_HALF) >> 23;
    let mantissa: F32<S> = (bits - (exponent << 23)).bitcast();
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let square = s * s;
    let series = square * (1.0 / 9.0) + 1.0 / 7.0;
    let series = (series * square + 1.0 / 5.0) * square + 1.0 / 3.0;
    let series = series * square + 1.0;
    exponent.to_float::<F32<S>>() + s * series * (2.0 * std::f32::consts::LOG2_E)
}

/// A base of at least 0 to the power of an exponent of at least 0; 0 where the
/// base is below the smallest normal number, and 1 where the exponent is 0.
#[inline(always)]
pub(crate) fn pow<S: Simd>(base: F32<S>, exponent: F32<S>) -> F32<S> {
    let simd = base.token();
    let least = F32::splat(simd, f32::MIN_POSITIVE);
    let power = exp2(exponent * log2(greater(base, least)));
    let nothing = base.simd_gt(least).select(power, F32::splat(simd, 0.0));
    exponent.simd_gt(0.0).select(nothing, F32::splat(simd, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::elementary;

    fn powers(base: [f32; 8], exponent: f32) -> [f32; 8] {
        let simd = crate::baseline::baseline();
        pow(F32::simd_from(simd, base), F32::splat(simd, exponent)).into()
    }

    #[test]
    fn powers_are_those_of_double_precision() {
        for exponent in [0.0, 0.5, 1.0, 5.0, 30.0, 250.0, 1000.0] {
            let base = [0.0, 1e-30, 0.3, 0.9, 0.99, 0.9999, 1.0, 1.7];
            for (base, power) in base.into_iter().zip(powers(base, exponent)) {
                let exact = elementary::pow(f64::from(base), f64::from(exponent));
                let bound = 4e-6 * exact + 1e-37;
                let error = (f64::from(power) - exact).abs();
                assert!(error <= bound || exact > 1e38, "{base} to the {exponent}: {power}, not {exact}");
            }
        }
    }
}
