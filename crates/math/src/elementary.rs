//! Elementary functions that give the same bits on every machine.
//!
//! The standard library calls the platform's C library, whose results differ in the last place
//! between systems and versions. These functions call `libm`, a Rust port of musl's library that
//! uses only IEEE additions, multiplications, divisions and square roots. A lint forbids the
//! platform's functions.
//!
//! The plain names take and return `f64`; the names that end in `_f32` take and return `f32`.
//! Errors are below one unit in the last place unless a function says otherwise. Angles are
//! radians. NaN gives NaN.

/// The sine of an angle.
#[must_use]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// The cosine of an angle.
#[must_use]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine and cosine of an angle, the same bits as [`sin`] and [`cos`].
#[must_use]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    (sin(angle), cos(angle))
}

/// The tangent of an angle.
#[must_use]
pub fn tan(angle: f64) -> f64 {
    libm::tan(angle)
}

/// The angle in `[-π/2, π/2]` whose sine is `value`; NaN outside `[-1, 1]`.
#[must_use]
pub fn asin(value: f64) -> f64 {
    libm::asin(value)
}

/// The angle in `[0, π]` whose cosine is `value`; NaN outside `[-1, 1]`.
#[must_use]
pub fn acos(value: f64) -> f64 {
    libm::acos(value)
}

/// The angle in `[-π/2, π/2]` whose tangent is `value`.
#[must_use]
pub fn atan(value: f64) -> f64 {
    libm::atan(value)
}

/// The angle in `[-π, π]` from the positive x axis to the point `(x, y)`.
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e to the power of `exponent`.
#[must_use]
pub fn exp(exponent: f64) -> f64 {
    libm::exp(exponent)
}

/// 2 to the power of `exponent`.
#[must_use]
pub fn exp2(exponent: f64) -> f64 {
    libm::exp2(exponent)
}

/// The natural logarithm; NaN below zero, `-∞` at zero.
#[must_use]
pub fn ln(value: f64) -> f64 {
    libm::log(value)
}

/// The logarithm to base 2; NaN below zero, `-∞` at zero.
#[must_use]
pub fn log2(value: f64) -> f64 {
    libm::log2(value)
}

/// The logarithm to base 10; NaN below zero, `-∞` at zero.
#[must_use]
pub fn log10(value: f64) -> f64 {
    libm::log10(value)
}

/// `base` to the power of `exponent`; NaN for a negative base with a non-integer exponent.
#[must_use]
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// The cube root; that of a negative number is negative.
#[must_use]
pub fn cbrt(value: f64) -> f64 {
    libm::cbrt(value)
}

/// The length of the vector `(x, y)` without intermediate overflow.
#[must_use]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// The sine of an angle.
#[must_use]
pub fn sin_f32(angle: f32) -> f32 {
    libm::sinf(angle)
}

/// The cosine of an angle.
#[must_use]
pub fn cos_f32(angle: f32) -> f32 {
    libm::cosf(angle)
}

/// The angle in `[0, π]` whose cosine is `value`; NaN outside `[-1, 1]`.
#[must_use]
pub fn acos_f32(value: f32) -> f32 {
    libm::acosf(value)
}

/// The angle in `[-π, π]` from the positive x axis to the point `(x, y)`.
#[must_use]
pub fn atan2_f32(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// e to the power of `exponent`.
#[must_use]
pub fn exp_f32(exponent: f32) -> f32 {
    libm::expf(exponent)
}

/// 2 to the power of `exponent`.
#[must_use]
pub fn exp2_f32(exponent: f32) -> f32 {
    libm::exp2f(exponent)
}

/// The natural logarithm; NaN below zero, `-∞` at zero.
#[must_use]
pub fn ln_f32(value: f32) -> f32 {
    libm::logf(value)
}

/// The logarithm to base 2; NaN below zero, `-∞` at zero.
#[must_use]
pub fn log2_f32(value: f32) -> f32 {
    libm::log2f(value)
}

/// `base` to the power of `exponent`; NaN for a negative base with a non-integer exponent.
#[must_use]
pub fn pow_f32(base: f32, exponent: f32) -> f32 {
    libm::powf(base, exponent)
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "the platform's functions are the oracle here")]
mod tests {
    use super::*;

    /// The distance of `value` from `expected` in units in the last place of `expected`.
    fn ulps(value: f64, expected: f64) -> f64 {
        let unit = expected.abs().next_up() - expected.abs();
        (value - expected).abs() / unit
    }

    #[test]
    fn functions_agree_with_the_platform_within_two_units() {
        for i in -400_i32..=400 {
            let x = f64::from(i) * 0.037;
            let pairs = [
                (sin(x), x.sin()),
                (cos(x), x.cos()),
                (tan(x), x.tan()),
                (atan(x), x.atan()),
                (exp(x), x.exp()),
                (exp2(x), x.exp2()),
                (cbrt(x), x.cbrt()),
                (atan2(x, 0.7), x.atan2(0.7)),
                (hypot(x, 1.3), x.hypot(1.3)),
                (asin(x / 15.0), (x / 15.0).asin()),
                (acos(x / 15.0), (x / 15.0).acos()),
                (ln(x.abs() + 0.01), (x.abs() + 0.01).ln()),
                (log2(x.abs() + 0.01), (x.abs() + 0.01).log2()),
                (log10(x.abs() + 0.01), (x.abs() + 0.01).log10()),
                (pow(x.abs(), 2.4), x.abs().powf(2.4)),
            ];
            for (index, (ours, platform)) in pairs.into_iter().enumerate() {
                assert!(ulps(ours, platform) <= 2.0, "function {index} at {x}: {ours} is not {platform}");
            }
        }
    }

    #[test]
    fn single_precision_agrees_with_double_precision() {
        let close =
            |single: f32, double: f64| (f64::from(single) - double).abs() <= 1.2e-7 * double.abs() + 1e-45;
        for i in -300_i16..=300 {
            let x = f32::from(i) * 0.043;
            let (d, p) = (f64::from(x), x.abs() + 0.01);
            let c = x / 13.0;
            let pairs = [
                (sin_f32(x), sin(d)),
                (cos_f32(x), cos(d)),
                (acos_f32(c), acos(f64::from(c))),
                (atan2_f32(x, 0.5), atan2(d, 0.5)),
                (exp_f32(x), exp(d)),
                (exp2_f32(x), exp2(d)),
                (ln_f32(p), ln(f64::from(p))),
                (log2_f32(p), log2(f64::from(p))),
                (pow_f32(p, 2.5), pow(f64::from(p), 2.5)),
            ];
            for (index, (single, double)) in pairs.into_iter().enumerate() {
                assert!(close(single, double), "function {index} at {x}: {single} is not {double}");
            }
        }
    }

    /// Fixed bits: a change here means that images change.
    #[test]
    fn bits_are_those_recorded() {
        let recorded = [
            (sin(1.0), 0x3fea_ed54_8f09_0cee_u64),
            (cos(1.0), 0x3fe1_4a28_0fb5_068c),
            (tan(1.0), 0x3ff8_eb24_5cbe_e3a6),
            (exp(1.0), 0x4005_bf0a_8b14_576a),
            (ln(10.0), 0x4002_6bb1_bbb5_5516),
            (pow(0.5, 2.4), 0x3fc8_4060_03b2_ae5d),
        ];
        for (value, bits) in recorded {
            assert_eq!(value.to_bits(), bits, "the bits of {value} have moved");
        }
    }

    #[test]
    fn outside_the_domain_there_is_no_number() {
        assert!(asin(1.5).is_nan(), "no angle has a sine of 1.5");
        assert!(acos(f64::NAN).is_nan(), "NaN passes through");
        assert!(ln(-1.0).is_nan(), "no real logarithm below zero");
        assert_eq!(ln(0.0), f64::NEG_INFINITY, "the limit at zero");
    }
}
