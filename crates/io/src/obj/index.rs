//! The corners of a face: indices checked against what the file holds.
//!
//! An index counts from 1, or from the end backwards; 0 does not exist. All
//! arithmetic is on i64 with checks, so no absurd number wraps around into a
//! valid one.

use crate::warning::counted;

/// How many positions, texture coordinates and normals there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) positions: usize,
    pub(crate) coordinates: usize,
    pub(crate) normals: usize,
}

/// One corner, indices counted from 1; 0 where it has none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Corner {
    pub(crate) position: usize,
    pub(crate) coordinate: usize,
    pub(crate) normal: usize,
    /// Whether an index of a coordinate or a normal led nowhere.
    pub(crate) dropped: bool,
}

/// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`. Negative indices count back from
/// `seen`; positive ones may point ahead, up to `total`.
pub(crate) fn parse_corner(word: &[u8], seen: Counts, total: Counts) -> Result<Corner, String> {
    let mut parts = word.split(|&byte| byte == b'/');
    let mut next = || parts.next().filter(|part| !part.is_empty());
    let position = next().ok_or_else(|| describe(word, "has no vertex index"))?;
    let (coordinate, normal) = (next(), next());
    if parts.next().is_some() {
        return Err(describe(word, "has more than three indices"));
    }
    let position = match resolve(position, seen.positions, total.positions) {
        Resolved::Index(index) => index,
        Resolved::Zero => return Err(describe(word, "has index 0, and indices count from 1")),
        Resolved::NotANumber => return Err(describe(word, "is not an index")),
        Resolved::Nowhere => {
            return Err(format!(
                "face index {} leads nowhere; the file has {}",
                quote(position),
                counted(total.positions, "vertex")
            ));
        }
    };
    let mut corner = Corner { position, ..Corner::default() };
    let optional = [(coordinate, seen.coordinates, total.coordinates), (normal, seen.normals, total.normals)];
    for (slot, (part, seen, total)) in [&mut corner.coordinate, &mut corner.normal].into_iter().zip(optional)
    {
        let Some(part) = part else { continue };
        match resolve(part, seen, total) {
            Resolved::Index(index) => *slot = index,
            Resolved::Nowhere => corner.dropped = true,
            Resolved::Zero => return Err(describe(word, "has index 0, and indices count from 1")),
            Resolved::NotANumber => return Err(describe(word, "is not an index")),
        }
    }
    Ok(corner)
}

enum Resolved {
    Index(usize),
    Zero,
    Nowhere,
    NotANumber,
}

fn resolve(part: &[u8], seen: usize, total: usize) -> Resolved {
    let (negative, digits) = match part {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Resolved::NotANumber;
    }
    let value = digits
        .iter()
        .try_fold(0usize, |value, digit| value.checked_mul(10)?.checked_add(usize::from(digit - b'0')));
    match value {
        Some(0) => Resolved::Zero,
        Some(value) if negative && value <= seen => Resolved::Index(seen - value + 1),
        Some(value) if !negative && value <= total => Resolved::Index(value),
        _ => Resolved::Nowhere,
    }
}

fn describe(word: &[u8], what: &str) -> String {
    format!("face corner {} {what}", quote(word))
}

fn quote(word: &[u8]) -> String {
    let short = &word[..word.len().min(40)];
    format!("\"{}\"", String::from_utf8_lossy(short))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOTAL: Counts = Counts { positions: 5, coordinates: 3, normals: 2 };

    fn parse(word: &str) -> Result<Corner, String> {
        parse_corner(word.as_bytes(), Counts { positions: 4, coordinates: 3, normals: 2 }, TOTAL)
    }

    #[test]
    fn every_form_of_a_corner_is_read() {
        let corner =
            |position, coordinate, normal| Ok(Corner { position, coordinate, normal, dropped: false });
        assert_eq!(parse("1"), corner(1, 0, 0), "v");
        assert_eq!(parse("5/3"), corner(5, 3, 0), "v/vt, pointing ahead");
        assert_eq!(parse("-1//-2"), corner(4, 0, 1), "v//vn, backwards");
        assert_eq!(parse("1/2/"), corner(1, 2, 0), "a slash too many");
        assert_eq!(parse("+2/1/1"), corner(2, 1, 1), "v/vt/vn");
    }

    #[test]
    fn no_number_wraps_into_a_valid_index() {
        for word in [
            "0",
            "-5",
            "6",
            "4294967297",
            "18446744073709551617",
            "-9223372036854775808",
            "9223372036854775808",
            "99999999999999999999999",
        ] {
            parse(word).expect_err(word);
        }
        for word in ["1/0", "1//0", "a", "1/x", "", "/1", "1/1/1/1", "-", "+", "1.5", "0x1"] {
            parse(word).expect_err(word);
        }
        for word in ["1/4", "1//6148914691236517206", "1/-4/1"] {
            let corner = parse(word).expect("the position is right");
            assert!(corner.dropped, "{word}: noticed");
        }
    }
}
