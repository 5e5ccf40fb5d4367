//! Splits an OBJ into pieces that can be read in parallel. Each piece ends at the end of a logical line and
//! knows how many lines and vertices come before it.

use super::index::Counts;
use super::lines::{Lines, split_keyword};

/// A piece of the text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chunk<'a> {
    pub(crate) text: &'a [u8],
    /// How many lines of the file come before.
    pub(crate) lines_before: u64,
    /// How many vertices, coordinates and normals come before.
    pub(crate) before: Counts,
}

/// What one piece holds by itself.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Census {
    lines: u64,
    counts: Counts,
}

/// Cuts the text into pieces of at least `size` bytes, but for the last. A line
/// stays whole, together with the lines that continue it.
pub(crate) fn cut(text: &[u8], size: usize) -> Vec<&[u8]> {
    let mut pieces = Vec::with_capacity(text.len() / size.max(1) + 1);
    let mut rest = text;
    while !rest.is_empty() {
        let (piece, after) = rest.split_at(line_end(rest, size));
        pieces.push(piece);
        rest = after;
    }
    pieces
}

/// Where the logical line ends that has the byte at `size`.
fn line_end(text: &[u8], size: usize) -> usize {
    let Some(before) = text.get(..size) else { return text.len() };
    let mut start = memchr::memrchr2(b'\n', b'\r', before).map_or(0, |end| end + 1);
    if start > 0 && text[start - 1..].starts_with(b"\r\n") {
        // One ending, not two.
        start += 1;
    }
    let mut lines = Lines::new(&text[start..]);
    lines.next();
    start + lines.position()
}

/// Counts the lines of a piece, and its vertices, coordinates and normals.
pub(crate) fn census(text: &[u8]) -> Census {
    let mut counts = Counts::default();
    let mut lines = Lines::new(text);
    for (_, line) in lines.by_ref() {
        match split_keyword(&line) {
            Some((b"v", _)) => counts.positions += 1,
            Some((b"vt", _)) => counts.coordinates += 1,
            Some((b"vn", _)) => counts.normals += 1,
            _ => {}
        }
    }
    Census { lines: lines.passed(), counts }
}

/// Tells each piece what comes before it; what the whole file has comes with
/// them.
pub(crate) fn number<'a>(pieces: &[&'a [u8]], censuses: &[Census]) -> (Vec<Chunk<'a>>, Counts) {
    let (mut lines_before, mut before) = (0, Counts::default());
    let mut locate = |(&text, census): (&&'a [u8], &Census)| {
        let chunk = Chunk { text, lines_before, before };
        lines_before += census.lines;
        before.positions += census.counts.positions;
        before.coordinates += census.counts.coordinates;
        before.normals += census.counts.normals;
        chunk
    };
    let chunks = pieces.iter().zip(censuses).map(&mut locate).collect();
    (chunks, before)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn pieces_end_where_lines_end() {
        let text = b"v 1\r\nf 1 \\\r\n 2 \\ \n3\nv\rv";
        let cut =
            |size| cut(text, size).iter().map(|piece| piece.escape_ascii().to_string()).collect::<Vec<_>>();
        let lines = [r"v 1\r\n", r"f 1 \\\r\n 2 \\ \n3\n", r"v\r", "v"];
        assert_eq!(cut(1), lines, "as small as can be");
        assert_eq!(
            cut(5),
            [lines[0].to_owned() + lines[1], lines[2].to_owned() + lines[3]],
            "at least five bytes"
        );
        assert_eq!(cut(100), [lines.concat()], "in one piece");
    }

    proptest! {
        /// However the text is cut, the pieces have its lines, in its order.
        #[test]
        fn cutting_loses_no_line(text in "[vf \\\\\r\n\t]{0,60}", size in 0usize..20) {
            let whole: Vec<_> = Lines::new(text.as_bytes()).collect();
            let pieces = cut(text.as_bytes(), size);
            let censuses: Vec<Census> = pieces.iter().map(|piece| census(piece)).collect();
            let (chunks, total) = number(&pieces, &censuses);
            let numbered = chunks.iter().flat_map(|chunk| Lines::new(chunk.text).map(|(line, text)| (chunk.lines_before + line, text)));
            prop_assert_eq!(numbered.collect::<Vec<_>>(), whole, "the lines with their numbers");
            prop_assert_eq!(total, census(text.as_bytes()).counts, "and what they count");
        }
    }
}
