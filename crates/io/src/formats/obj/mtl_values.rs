//! The numbers of an MTL statement. Words that are not used cause a warning.

use super::lines::{decode_name, words};

/// What a statement says, and the line that says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stated<T> {
    pub(super) line: u64,
    pub(super) value: T,
}

/// Three channels, or one for all of them: `Kd 1 0 0`, `Kd 0.5`. Says whether there
/// are more numbers, which were not read.
pub(super) fn read_color(rest: &[u8]) -> Result<([f32; 3], bool), String> {
    match words(rest).next() {
        Some(b"spectral") => return Err("names a spectral curve, which is not read".to_owned()),
        Some(b"xyz") => return Err("is in CIE XYZ, which is not read".to_owned()),
        _ => {}
    }
    match *finite_numbers(rest)?.as_slice() {
        [] => Err("has no number".to_owned()),
        [grey] => Ok(([grey; 3], false)),
        [_, _] => Err("has 2 numbers and needs 1 or 3".to_owned()),
        [red, green, blue, ref more @ ..] => Ok(([red, green, blue], !more.is_empty())),
    }
}

/// One number. Says whether there are more, which were not read.
pub(super) fn read_number(rest: &[u8]) -> Result<(f32, bool), String> {
    match *finite_numbers(rest)?.as_slice() {
        [] => Err("has no number".to_owned()),
        [value, ref more @ ..] => Ok((value, !more.is_empty())),
    }
}

/// All words up to a comment, which must be finite numbers.
fn finite_numbers(rest: &[u8]) -> Result<Vec<f32>, String> {
    let number = |word: &[u8]| {
        let text = decode_name(word);
        let value = text.parse().ok().filter(|value: &f32| value.is_finite());
        value.ok_or_else(|| format!("has \"{text}\", which is not a finite number"))
    };
    words(rest).map(number).collect()
}
