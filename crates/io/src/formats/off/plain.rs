//! Plain rows, as nearly all are: places of vertices, and faces without colours, nothing else on the line.
//! All threads read them, a piece of the text each. A piece with any other row is left to the reader of
//! single rows, which knows all kinds and all faults.

use rayon::prelude::*;
use trigon_math::DVec3;

use crate::numbers::{MOST_DIGITS, digits, plain};

/// Pieces have so many bytes, up to the end of the row there.
const PIECE: usize = 1 << 16;

/// So many pieces for each thread are read before the caller is asked again whether to go on.
const PIECES_PER_THREAD: usize = 8;

/// What is in a piece of the text.
pub(super) struct Piece<T> {
    pub(super) bytes: usize,
    pub(super) lines: u64,
    pub(super) rows: T,
}

/// Faces: how many corners each has, and their vertices.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) sizes: Vec<u32>,
    pub(super) vertices: Vec<u32>,
}

/// The places in the next pieces of a text; `None` for a piece with a row that is no plain place.
pub(super) fn positions(text: &[u8]) -> Vec<Option<Piece<Vec<DVec3>>>> {
    read_all(text, |row, positions: &mut Vec<DVec3>| {
        let (x, rest) = number(row)?;
        let (y, rest) = number(rest)?;
        let (z, rest) = number(rest)?;
        positions.push(DVec3::new(x, y, z));
        Some(rest)
    })
}

/// The same for faces of at least three corners, with vertices below a number.
pub(super) fn faces(text: &[u8], vertices: u64) -> Vec<Option<Piece<Faces>>> {
    read_all(text, |row, faces: &mut Faces| {
        let (size, mut rest) = index(row)?;
        // No piece has room for more.
        let corners = 3..=PIECE as u64;
        if !corners.contains(&size) {
            return None;
        }
        faces.sizes.push(size as u32);
        for _ in 0..size {
            let (vertex, after) = index(rest)?;
            if vertex >= vertices {
                return None;
            }
            // There are fewer vertices than a u32 can number.
            faces.vertices.push(vertex as u32);
            rest = after;
        }
        Some(rest)
    })
}

/// Reads pieces of a text with all threads. `row` adds the row at the start of a text, and returns what follows it.
fn read_all<T: Default + Send>(
    text: &[u8],
    row: impl for<'a> Fn(&'a [u8], &mut T) -> Option<&'a [u8]> + Sync,
) -> Vec<Option<Piece<T>>> {
    let pieces = cut(text, PIECES_PER_THREAD * rayon::current_num_threads());
    pieces.into_par_iter().map(|piece| read(piece, &row)).collect()
}

/// The first pieces of a text. The last of all may lack the end of its row.
fn cut(text: &[u8], most: usize) -> Vec<&[u8]> {
    let (mut pieces, mut rest) = (Vec::with_capacity(most), text);
    while pieces.len() < most && !rest.is_empty() {
        let end = rest.get(PIECE..).map_or(Some(rest.len()), |after| {
            memchr::memchr(b'\n', &after[..after.len().min(PIECE)]).map(|end| PIECE + end + 1)
        });
        // A longer row is no plain one.
        let Some(end) = end else { break };
        let (piece, after) = rest.split_at(end);
        pieces.push(piece);
        rest = after;
    }
    pieces
}

fn read<T: Default>(
    piece: &[u8],
    row: impl for<'a> Fn(&'a [u8], &mut T) -> Option<&'a [u8]>,
) -> Option<Piece<T>> {
    let (mut rows, mut rest, mut lines) = (T::default(), piece, 0);
    while !rest.is_empty() {
        rest = blanks_skipped(rest);
        if !matches!(rest.first(), None | Some(b'\n' | b'\r')) {
            rest = blanks_skipped(row(rest, &mut rows)?);
        }
        rest = match rest {
            [] => &[],
            [b'\n', after @ ..] | [b'\r', b'\n', after @ ..] => after,
            _ => return None,
        };
        lines += 1;
    }
    Some(Piece { bytes: piece.len(), lines, rows })
}

fn blanks_skipped(text: &[u8]) -> &[u8] {
    let blanks = text.iter().take_while(|byte| matches!(byte, b' ' | b'\t'));
    &text[blanks.count()..]
}

/// The number after blanks, and what follows it.
fn number(text: &[u8]) -> Option<(f64, &[u8])> {
    let text = blanks_skipped(text);
    let (value, length) = plain(text)?;
    Some((value, &text[length..]))
}

/// The whole number after blanks, and what follows it.
fn index(text: &[u8]) -> Option<(u64, &[u8])> {
    let text = blanks_skipped(text);
    let (value, length) = digits(text, 0, 0);
    let is_number = (1..=MOST_DIGITS).contains(&length);
    let rest = &text[length..];
    let is_end = rest.first().is_none_or(u8::is_ascii_whitespace);
    (is_number && is_end).then_some((value, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only<T>(pieces: Vec<Option<Piece<T>>>) -> Option<Piece<T>> {
        assert_eq!(pieces.len(), 1, "a short text is one piece");
        pieces.into_iter().next().flatten()
    }

    #[test]
    fn plain_rows_are_read_whatever_ends_them() {
        let piece = only(positions(b"1 2 3\r\n\n\t-0.5 1e2 .25 \n 4\t5  6")).expect("plain");
        let expected = [[1.0, 2.0, 3.0], [-0.5, 100.0, 0.25], [4.0, 5.0, 6.0]].map(DVec3::from_array);
        assert_eq!((piece.rows.as_slice(), piece.lines), (expected.as_slice(), 4), "one line is empty");
        let piece = only(faces(b"3 0 1 2\n4 9 8 7 6\n", 10)).expect("plain");
        assert_eq!(piece.rows.sizes, [3, 4], "a triangle and a quad");
        assert_eq!(piece.rows.vertices, [0, 1, 2, 9, 8, 7, 6], "and their vertices");
    }

    #[test]
    fn other_rows_are_left_to_the_reader_of_single_rows() {
        for row in ["1 2", "1 2 3 4", "1 2 3 # four", "1 2 x", "1 2 3\r4 5 6", "nan 0 0", "1 2 3\u{c}"] {
            assert!(only(positions(format!("7 8 9\n{row}\n").as_bytes())).is_none(), "{row}");
        }
        for row in ["2 0 1", "3 0 1", "3 0 1 2 255 0 0", "3 0 1 4", "3 0 1 2.0", "3 0 1 -1", "x", "3 0 1 2 #"]
        {
            assert!(only(faces(format!("3 0 1 2\n{row}\n").as_bytes(), 4)).is_none(), "{row}");
        }
        let many = format!("3 0 1 {}", "0".repeat(MOST_DIGITS + 1));
        assert!(only(faces(many.as_bytes(), 4)).is_none(), "more digits than are read");
    }

    #[test]
    fn pieces_end_where_rows_end() {
        let row = "0.125 0.25 0.5\n";
        let text = row.repeat(3 * PIECE / row.len());
        let pieces = positions(text.as_bytes());
        let read: Vec<&Piece<_>> = pieces.iter().flatten().collect();
        assert_eq!(read.len(), pieces.len(), "all are plain");
        assert!(read.len() > 2, "there are several");
        assert_eq!(read.iter().map(|piece| piece.bytes).sum::<usize>(), text.len(), "all of the text");
        let rows = read.iter().map(|piece| piece.rows.len() as u64).sum::<u64>();
        let lines = read.iter().map(|piece| piece.lines).sum::<u64>();
        assert_eq!(rows, lines, "one for each line");
        let endless = "1 ".repeat(2 * PIECE);
        assert!(positions(endless.as_bytes()).is_empty(), "a row longer than a piece");
    }
}
