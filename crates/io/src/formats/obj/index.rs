//! The corners of a face, with indices checked against the number of vertices in the file.
//!
//! Indices count from 1, or backwards from the end; 0 is invalid. A number with more digits than fit into u64
//! becomes the largest u64, so that it cannot wrap around to a valid one.

use crate::numbers::{MOST_DIGITS, digits, first_word};
use crate::warning::counted;

/// How many positions, texture coordinates and normals there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) positions: usize,
    pub(crate) coordinates: usize,
    pub(crate) normals: usize,
}

/// Stands for a coordinate or normal that a corner has not.
pub(crate) const NONE: u32 = u32::MAX;

/// One corner, indices counted from 0; [`NONE`] where it has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Corner {
    pub(crate) position: u32,
    pub(crate) coordinate: u32,
    pub(crate) normal: u32,
    /// Whether an index of a coordinate or a normal led nowhere.
    pub(crate) dropped: bool,
}

/// Reads the `v`, `v/vt`, `v//vn` or `v/vt/vn` that a text starts with; how long it
/// is comes with it. Negative indices count back from `seen`; positive ones may
/// point ahead, up to `total`, which is below [`NONE`].
pub(crate) fn parse_corner(text: &[u8], before: Counts, total: Counts) -> Result<(Corner, usize), String> {
    let (position, mut at) = index(text, 0);
    let mut optional = [Index::Absent; 2];
    for index_of in &mut optional {
        if text.get(at) == Some(&b'/') {
            (*index_of, at) = index(text, at + 1);
        }
    }
    match text.get(at) {
        Some(b'/') => return Err(describe(text, "has more than three indices")),
        Some(byte) if !byte.is_ascii_whitespace() => return Err(describe(text, "is not an index")),
        _ => {}
    }
    let position = match position.resolve(before.positions, total.positions) {
        Resolved::Known(index) => index,
        Resolved::Absent => return Err(describe(text, "has no vertex index")),
        Resolved::Zero => return Err(describe(text, "has index 0, and indices count from 1")),
        Resolved::Nowhere => return Err(leads_nowhere(text, total)),
    };
    let mut corner = Corner { position, coordinate: NONE, normal: NONE, dropped: false };
    let [coordinate, normal] = optional;
    let coordinate = coordinate.resolve(before.coordinates, total.coordinates);
    let normal = normal.resolve(before.normals, total.normals);
    for (slot, resolved) in [(&mut corner.coordinate, coordinate), (&mut corner.normal, normal)] {
        match resolved {
            Resolved::Known(index) => *slot = index,
            Resolved::Absent => {}
            Resolved::Nowhere => corner.dropped = true,
            Resolved::Zero => return Err(describe(text, "has index 0, and indices count from 1")),
        }
    }
    Ok((corner, at))
}

/// What the corners of an element have.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Corners {
    pub(crate) count: usize,
    /// How many have a texture coordinate.
    pub(crate) coordinates: usize,
    /// How many have a normal.
    pub(crate) normals: usize,
    /// How many have an index of either that led nowhere.
    pub(crate) dropped: usize,
}

/// Reads the corners of an element, up to a comment, in place of those in `corners`.
pub(crate) fn read_corners(
    text: &[u8],
    before: Counts,
    total: Counts,
    corners: &mut Vec<Corner>,
) -> Result<Corners, String> {
    corners.clear();
    let mut found = Corners::default();
    let mut at = 0;
    loop {
        while text.get(at).is_some_and(u8::is_ascii_whitespace) {
            at += 1;
        }
        if matches!(text.get(at), None | Some(b'#')) {
            break;
        }
        let (corner, length) = parse_corner(&text[at..], before, total)?;
        found.coordinates += usize::from(corner.coordinate != NONE);
        found.normals += usize::from(corner.normal != NONE);
        found.dropped += usize::from(corner.dropped);
        corners.push(corner);
        at += length;
    }
    found.count = corners.len();
    Ok(found)
}

/// Whether the corners of a face, of which there is at least one, have fewer than 3
/// different vertices.
#[inline]
pub(crate) fn is_flat(corners: &[Corner]) -> bool {
    // The first three differ in nearly all faces: this is asked of each.
    if let [a, b, c, ..] = *corners
        && a.position != b.position
        && b.position != c.position
        && c.position != a.position
    {
        return false;
    }
    let first = corners[0].position;
    let mut others = corners.iter().map(|corner| corner.position).filter(|&position| position != first);
    others.next().is_none_or(|second| others.all(|position| position == second))
}

/// An index as it is written.
#[derive(Clone, Copy)]
enum Index {
    Absent,
    Forward(u64),
    Backward(u64),
}

/// The index at a place and where it ends.
#[inline]
fn index(text: &[u8], at: usize) -> (Index, usize) {
    let sign = text.get(at).filter(|sign| matches!(sign, b'+' | b'-'));
    let start = at + usize::from(sign.is_some());
    let (value, end) = digits(text, start, 0);
    let value = if end - start > MOST_DIGITS { u64::MAX } else { value };
    match sign {
        // A sign alone is left for the caller to stumble over.
        _ if end == start => (Index::Absent, at),
        Some(b'-') => (Index::Backward(value), end),
        _ => (Index::Forward(value), end),
    }
}

enum Resolved {
    Known(u32),
    Absent,
    Zero,
    Nowhere,
}

impl Index {
    #[inline]
    fn resolve(self, before: usize, total: usize) -> Resolved {
        match self {
            Self::Absent => Resolved::Absent,
            Self::Forward(0) | Self::Backward(0) => Resolved::Zero,
            Self::Forward(value) if value <= total as u64 => Resolved::Known((value - 1) as u32),
            Self::Backward(value) if value <= before as u64 => {
                Resolved::Known((before as u64 - value) as u32)
            }
            _ => Resolved::Nowhere,
        }
    }
}

#[cold]
fn leads_nowhere(text: &[u8], total: Counts) -> String {
    let word = first_word(text);
    let position = word.split(|&byte| byte == b'/').next().unwrap_or(word);
    let has = counted(total.positions, "vertex");
    format!("face index {} does not exist; the file has {has}", quote(position))
}

#[cold]
fn describe(text: &[u8], what: &str) -> String {
    format!("face corner {} {what}", quote(first_word(text)))
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
        let before = Counts { positions: 4, coordinates: 3, normals: 2 };
        let (corner, length) = parse_corner(format!("{word} 7").as_bytes(), before, TOTAL)?;
        assert_eq!(length, word.len(), "{word:?} ends at the space");
        Ok(corner)
    }

    #[test]
    fn every_form_of_a_corner_is_read() {
        let corner =
            |position, coordinate, normal| Ok(Corner { position, coordinate, normal, dropped: false });
        assert_eq!(parse("1"), corner(0, NONE, NONE), "v");
        assert_eq!(parse("5/3"), corner(4, 2, NONE), "v/vt, pointing ahead");
        assert_eq!(parse("-1//-2"), corner(3, NONE, 0), "v//vn, backwards");
        assert_eq!(parse("1/2/"), corner(0, 1, NONE), "a slash too many");
        assert_eq!(parse("+2/1/1"), corner(1, 0, 0), "v/vt/vn");
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
        for word in
            ["1/0", "1//0", "a", "1/x", "", "/1", "1/1/1/1", "-", "+", "1.5", "0x1", "1/-", "1//", "1///"]
        {
            let is_fine = word == "1//";
            assert_eq!(parse(word).is_ok(), is_fine, "{word:?}");
        }
        for word in ["1/4", "1//6148914691236517206", "1/-4/1"] {
            let corner = parse(word).expect("the position is right");
            assert!(corner.dropped, "{word}: noticed");
        }
    }
}
