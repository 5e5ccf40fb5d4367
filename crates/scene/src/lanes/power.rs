//! Powers in lanes: base-2 logarithm and exponential, by polynomials of the mantissa. Both functions need neither
//! a table nor the machine's own functions.
//!
//! The logarithm is computed from the series of the inverse hyperbolic tangent, whose relative error stays
//! small near 1, where powers with large exponents have their highlights.

use trigon_raster::simd::{F32, I32, Simd, greater, lesser, prelude::*};

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
        let simd = fearless_simd::Fallback::new();
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
