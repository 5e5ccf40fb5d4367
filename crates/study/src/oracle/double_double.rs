//! Numbers of 106 bits: unevaluated sums of two `f64`.
//!
//! T. J. Dekker, *A floating-point technique for extending the available
//! precision*, Numerische Mathematik 18 (1971); sums by D. E. Knuth's exact
//! addition. Products are split instead of fused, so that every machine computes
//! the same bits.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number `high + low`, where `low` is the rounding error of `high`.
///
/// The error of products and quotients is at most 2⁻¹⁰⁰ of the result, that of sums 2⁻¹⁰⁰ of the larger term,
/// as long as nothing exceeds 2⁹⁷⁰ or falls below 2⁻⁹⁰⁰. A division by zero gives NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Zero.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl From<f32> for DoubleDouble {
    fn from(value: f32) -> Self {
        f64::from(value).into()
    }
}

/// `a + b`, exactly.
fn exact_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let from_b = high - a;
    DoubleDouble { high, low: (a - (high - from_b)) + (b - from_b) }
}

/// Two halves of a number, of at most 26 bits each.
fn halves(a: f64) -> [f64; 2] {
    const SPLIT: f64 = (1_u64 << 27) as f64 + 1.0;
    let scaled = SPLIT * a;
    let high = scaled - (scaled - a);
    [high, a - high]
}

/// `a * b`, exactly.
fn exact_product(a: f64, b: f64) -> DoubleDouble {
    let high = a * b;
    let ([a1, a2], [b1, b2]) = (halves(a), halves(b));
    DoubleDouble { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let [high, low] = [exact_sum(self.high, other.high), exact_sum(self.low, other.low)];
        let sum = exact_sum(high.high, high.low + low.high);
        exact_sum(sum.high, sum.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = exact_product(self.high, other.high);
        exact_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// Long division: each digit is a quotient in `f64` of the remainder.
    fn div(self, other: Self) -> Self {
        let digit = |rest: Self| Self::from(rest.high / other.high);
        let first = digit(self);
        let rest = self - first * other;
        let second = digit(rest);
        first + second + digit(rest - second * other)
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            decided => decided,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::area::rational;
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;
    use trigon_math::elementary::exp2;

    fn exact(number: DoubleDouble) -> BigRational {
        rational(number.high) + rational(number.low)
    }

    /// A number with digits in both halves.
    fn number() -> impl Strategy<Value = DoubleDouble> {
        let part =
            || (-1.0_f64..1.0, -60..60_i32).prop_map(|(digits, exponent)| digits * exp2(f64::from(exponent)));
        (part(), part()).prop_map(|(a, b)| DoubleDouble::from(a) * b.into() + a.into())
    }

    fn is_close(found: DoubleDouble, expected: BigRational, scale: BigRational) {
        let error = (exact(found) - &expected).abs();
        assert!(error <= scale * rational(exp2(-100.0)), "{found:?} instead of {expected}");
        assert_eq!(found.high + found.low, found.high, "the low half is what the high one was rounded by");
    }

    proptest! {
        #[test]
        fn operations_keep_100_bits(a in number(), b in number()) {
            prop_assume!(b.high != 0.0);
            let (x, y) = (exact(a), exact(b));
            is_close(a + b, &x + &y, x.abs() + y.abs());
            is_close(a - b, &x - &y, x.abs() + y.abs());
            is_close(a * b, &x * &y, (&x * &y).abs());
            is_close(a / b, &x / &y, (&x / &y).abs());
            prop_assert_eq!(a.partial_cmp(&b), x.partial_cmp(&y));
            prop_assert_eq!(exact(a.abs()), x.abs());
        }
    }

    #[test]
    fn what_one_half_cannot_hold_the_other_does() {
        let one: DoubleDouble = 1.0_f64.into();
        let tiny: DoubleDouble = exp2(-80.0).into();
        assert_eq!((one + tiny).to_f64(), 1.0, "f64 ends at 2^-53");
        assert_eq!(one + tiny - one, tiny, "but nothing is lost");
        assert!(one < one + tiny && one - tiny < one, "and it counts in comparisons");
    }
}
