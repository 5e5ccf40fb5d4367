//! Decimal numbers, correctly rounded, and lines of them.
//!
//! Nearly every number in a model has few digits. f64 holds these digits as an integer exactly, and also the power
//! of ten to multiply or divide by, so only one rounding is needed (W. D. Clinger, "How to Read Floating Point
//! Numbers Accurately", 1990). All others go to the standard library.

use std::fmt::Write;

/// The numbers at the start of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Numbers<const MOST: usize> {
    /// Missing ones are 0.
    pub(crate) values: [f64; MOST],
    /// Their count.
    pub(crate) count: usize,
    /// Whether the line has more numbers, which were not read.
    pub(crate) surplus: bool,
}

/// Reads numbers up to a comment, at most `MOST`, or returns the word that is not a number.
/// Infinity, NaN and their C spellings are accepted.
pub(crate) fn read_numbers<const MOST: usize>(line: &[u8]) -> Result<Numbers<MOST>, String> {
    let mut numbers = Numbers { values: [0.0; MOST], count: 0, surplus: false };
    let mut at = 0;
    loop {
        while line.get(at).is_some_and(u8::is_ascii_whitespace) {
            at += 1;
        }
        if matches!(line.get(at), None | Some(b'#')) {
            return Ok(numbers);
        }
        if numbers.count == MOST {
            numbers.surplus = true;
            return Ok(numbers);
        }
        let (value, length) = first_number(&line[at..])?;
        numbers.values[numbers.count] = value;
        numbers.count += 1;
        at += length;
    }
}

/// The word at the start of a text as a number, and its length.
pub(crate) fn first_number(text: &[u8]) -> Result<(f64, usize), String> {
    if let Some(found) = plain(text) {
        return Ok(found);
    }
    let word = first_word(text);
    Ok((unusual(word)?, word.len()))
}

/// A word as a number.
pub(crate) fn number(word: &[u8]) -> Result<f64, String> {
    match plain(word) {
        Some((value, length)) if length == word.len() => Ok(value),
        _ => unusual(word),
    }
}

/// Up to a space or the end.
pub(crate) fn first_word(text: &[u8]) -> &[u8] {
    &text[..text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len())]
}

/// All powers of ten that f64 holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// This many digits always fit into u64.
pub(crate) const MOST_DIGITS: usize = 19;

/// The number at the start of a text and its length, if one rounding suffices.
#[inline]
pub(crate) fn plain(text: &[u8]) -> Option<(f64, usize)> {
    /// Up to here f64 holds every integer.
    const LARGEST: u64 = 1 << 53;
    let negative = text.first() == Some(&b'-');
    let start = usize::from(negative);
    let (mut mantissa, mut at) = digits(text, start, 0);
    let (mut count, mut exponent) = (at - start, 0);
    if text.get(at) == Some(&b'.') {
        let point = at + 1;
        (mantissa, at) = digits(text, point, mantissa);
        count += at - point;
        exponent = point as i64 - at as i64;
    }
    if count == 0 || count > MOST_DIGITS || mantissa > LARGEST {
        return None;
    }
    if matches!(text.get(at), Some(b'e' | b'E')) {
        let sign = text.get(at + 1).filter(|sign| matches!(sign, b'+' | b'-'));
        let start = at + 1 + usize::from(sign.is_some());
        let (power, end) = digits(text, start, 0);
        if !(1..=3).contains(&(end - start)) {
            return None;
        }
        exponent += if sign == Some(&b'-') { -(power as i64) } else { power as i64 };
        at = end;
    }
    if text.get(at).is_some_and(|byte| !byte.is_ascii_whitespace()) {
        return None;
    }
    let power = POWERS.get(exponent.unsigned_abs() as usize)?;
    let value = if exponent < 0 { mantissa as f64 / power } else { mantissa as f64 * power };
    Some((if negative { -value } else { value }, at))
}

/// Appends the digits from `at` on to a number, and returns where they end. More than 19 digits may
/// wrap around.
#[inline]
pub(crate) fn digits(text: &[u8], at: usize, mut number: u64) -> (u64, usize) {
    let mut end = at;
    for byte in &text[at..] {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        end += 1;
    }
    (number, end)
}

/// Any number in Rust or C spelling.
fn unusual(word: &[u8]) -> Result<f64, String> {
    let text = std::str::from_utf8(word).unwrap_or_default();
    match text.parse() {
        Ok(value) => Ok(value),
        Err(_) if is_c_spelling_of_non_finite(word) => Ok(f64::NAN),
        Err(_) => {
            Err(format!("\"{}\" is not a number", String::from_utf8_lossy(&word[..word.len().min(40)])))
        }
    }
}

/// `1.#INF`, `-1.#IND00`, `1.#QNAN`, `nan(ind)`, `-nan(snan)` …
fn is_c_spelling_of_non_finite(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word).to_ascii_lowercase();
    word.starts_with(b"1.#") || word.starts_with(b"nan(") || word.starts_with(b"inf")
}

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
    use super::{number, *};
    use proptest::prelude::*;

    #[test]
    fn numbers_are_read_up_to_a_comment() {
        let read = |line: &str| read_numbers::<3>(line.as_bytes()).expect("numbers");
        let numbers = |values, count, surplus| Numbers { values, count, surplus };
        assert_eq!(read(" 1 -2.5\t3"), numbers([1.0, -2.5, 3.0], 3, false), "plain");
        assert_eq!(read(" 1e-3 +2 3. 4 x"), numbers([0.001, 2.0, 3.0], 3, true), "more than fit");
        assert_eq!(read(" .5 # 2"), numbers([0.5, 0.0, 0.0], 1, false), "a comment");
        assert!(read("-0").values[0].is_sign_negative(), "the sign of zero stays");
    }

    #[test]
    fn what_is_no_number_is_named_and_what_is_infinite_is_known() {
        for word in ["1,5", "\0", "-", ".", "e5", "1e", "1e+", "--1", "1-2", "0x1", "1_000", "1#"] {
            read_numbers::<3>(word.as_bytes()).expect_err(word);
        }
        for word in ["nan", "-inf", "1e400", "1.#IND", "-nan(ind)", "1.#QNAN", "inf"] {
            let numbers = read_numbers::<3>(word.as_bytes()).expect("a spelling of no number");
            assert!(!numbers.values[0].is_finite(), "{word}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        /// The result is always the number that the standard library reads.
        #[test]
        fn every_number_is_rounded_correctly(word in "-?[0-9]{0,20}(\\.[0-9]{0,20})?([eE][+-]?[0-9]{0,4})?") {
            let ours = read_numbers::<1>(word.as_bytes()).map(|numbers| (numbers.count, numbers.values[0].to_bits()));
            match word.parse::<f64>() {
                Ok(value) => prop_assert_eq!(ours, Ok((1, value.to_bits())), "the same bits"),
                Err(_) if word.is_empty() => prop_assert_eq!(ours, Ok((0, 0)), "none at all"),
                Err(_) => prop_assert!(ours.is_err(), "{:?} is no number", word),
            }
        }
    }

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
