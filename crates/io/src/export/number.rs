//! Numbers as text that reads back as the same bits.

use std::fmt::Write;

/// The number of significant digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precision {
    /// Those of an f32: the number is rounded to one.
    Single,
    /// Those of an f64.
    Double,
}

impl Precision {
    /// The number that a reader gets.
    pub(crate) fn rounded(self, value: f64) -> f64 {
        match self {
            Self::Single => f64::from(value as f32),
            Self::Double => value,
        }
    }
}

/// Appends the shortest digits that read as the same number.
pub(crate) fn push_number(text: &mut String, value: f64, precision: Precision) {
    let start = text.len();
    if precision == Precision::Single {
        let single = value as f32;
        push_shortest(text, single, f64::from(single));
        // Readers round to f64 first. If that moves the number across the middle between two f32,
        // the digits of the f64 itself are used.
        if text[start..].parse::<f64>().is_ok_and(|read| (read as f32).to_bits() == single.to_bits()) {
            return;
        }
        text.truncate(start);
    }
    let value = precision.rounded(value);
    push_shortest(text, value, value);
}

/// With an exponent if there would be many zeros.
fn push_shortest(text: &mut String, number: impl std::fmt::Display + std::fmt::LowerExp, size: f64) {
    let size = size.abs();
    let written = if size == 0.0 || (1e-5..1e16).contains(&size) {
        write!(text, "{number}")
    } else {
        write!(text, "{number:e}")
    };
    written.expect("text takes everything");
}

/// The number as a string.
pub(crate) fn number_text(value: f64, precision: Precision) -> String {
    let mut text = String::new();
    push_number(&mut text, value, precision);
    text
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numbers::number;

    #[test]
    fn numbers_are_short() {
        let single = |value: f64| number_text(value, Precision::Single);
        assert_eq!(single(0.1_f32.into()), "0.1", "not 0.10000000149011612");
        assert_eq!(single(1e30), "1e30", "not 30 zeros");
        assert_eq!(single(-0.0), "-0", "with its sign");
        assert_eq!(number_text(10_000_000.1, Precision::Double), "10000000.1", "all digits");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn every_f32_comes_back(bits in any::<u32>()) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite());
            let text = number_text(value.into(), Precision::Single);
            let read = number(text.as_bytes()).expect("a number") as f32;
            prop_assert_eq!(read.to_bits(), bits, "{}", text);
        }

        #[test]
        fn every_f64_comes_back(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let text = number_text(value, Precision::Double);
            prop_assert_eq!(number(text.as_bytes()).expect("a number").to_bits(), bits, "{}", text);
        }
    }
}
