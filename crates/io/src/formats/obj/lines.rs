//! The text of an OBJ or of its library as logical lines, and cut into pieces that are read in parallel.
//!
//! A line may have any ending, and continuations are joined. Lines are bytes, so a stray Latin-1 letter in a comment
//! does no harm. A piece ends at the end of a logical line and knows how many lines and vertices come before it.

use std::borrow::Cow;

use super::index::Counts;

/// The logical lines of a text, with their numbers, counted from 1.
pub(crate) struct Lines<'a> {
    text: &'a [u8],
    at: usize,
    number: u64,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Self { text, at: 0, number: 0 }
    }

    /// How many bytes have been passed.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// How many lines have been passed.
    pub(crate) fn passed(&self) -> u64 {
        self.number
    }

    /// The next physical line without its ending: `\n`, `\r\n` or `\r`.
    fn physical(&mut self) -> Option<&'a [u8]> {
        let rest = self.text.get(self.at..).filter(|rest| !rest.is_empty())?;
        self.number += 1;
        let Some(end) = memchr::memchr2(b'\n', b'\r', rest) else {
            self.at = self.text.len();
            return Some(rest);
        };
        let ending = if rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.at += end + ending;
        Some(&rest[..end])
    }

    /// The rest of a line that ended in a backslash.
    fn continued(&mut self, first: &[u8]) -> Vec<u8> {
        let mut joined = first.to_vec();
        while let Some(next) = self.physical() {
            joined.push(b' ');
            match continues(next) {
                Some(start) => joined.extend_from_slice(start),
                None => {
                    joined.extend_from_slice(next);
                    break;
                }
            }
        }
        joined
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (u64, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.physical()?;
        let number = self.number;
        Some(match continues(line) {
            Some(start) => (number, Cow::Owned(self.continued(start))),
            None => (number, Cow::Borrowed(line)),
        })
    }
}

/// The line without its backslash, when it ends in one. A comment does not go on:
/// `# C:\models\` must not take the vertex on the next line with it.
fn continues(line: &[u8]) -> Option<&[u8]> {
    let before = match line.last() {
        Some(b'\\') => Some(&line[..line.len() - 1]),
        Some(b' ' | b'\t') => line.trim_ascii_end().strip_suffix(b"\\"),
        _ => None,
    };
    before.filter(|text| text.trim_ascii_start().first() != Some(&b'#'))
}

/// The first word of a line and what follows it; `None` for blank lines and
/// comments.
pub(crate) fn split_keyword(line: &[u8]) -> Option<(&[u8], &[u8])> {
    let line = line.trim_ascii_start();
    if line.is_empty() || line[0] == b'#' {
        return None;
    }
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    Some((&line[..end], &line[end..]))
}

/// The words up to a comment.
pub(crate) fn words(rest: &[u8]) -> impl Iterator<Item = &[u8]> {
    rest.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).take_while(|word| word[0] != b'#')
}

/// A name as text: UTF-8, or Latin-1 where it is not.
pub(crate) fn decode_name(bytes: &[u8]) -> String {
    let bytes = bytes.trim_ascii();
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

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
    use super::*;
    use proptest::prelude::*;

    fn lines(text: &str) -> Vec<(u64, String)> {
        Lines::new(text.as_bytes())
            .map(|(number, line)| (number, String::from_utf8_lossy(&line).into_owned()))
            .collect()
    }

    #[test]
    fn every_line_ending_ends_a_line() {
        let expected = [(1, "a".to_owned()), (2, String::new()), (3, "b".to_owned())];
        for text in ["a\n\nb", "a\r\n\r\nb\r\n", "a\r\rb\r"] {
            assert_eq!(lines(text), expected, "{text:?}");
        }
    }

    #[test]
    fn continuations_are_joined_and_numbers_go_on() {
        assert_eq!(
            lines("f 1 \\\n 2 \\ \r\n3\nv"),
            [(1, "f 1   2  3".to_owned()), (4, "v".to_owned())],
            "joined"
        );
        assert_eq!(lines("f\\"), [(1, "f".to_owned())], "a backslash at the end of the file");
    }

    #[test]
    fn a_comment_that_ends_in_a_backslash_takes_no_line_with_it() {
        let expected = [(1, " # C:\\models\\".to_owned()), (2, "v".to_owned())];
        assert_eq!(lines(" # C:\\models\\\nv"), expected, "a path in a comment");
        assert_eq!(
            lines("f 1 \\\n# \\\nv"),
            [(1, "f 1  # \\".to_owned()), (3, "v".to_owned())],
            "in a line that went on"
        );
    }

    #[test]
    fn names_in_other_encodings_are_read() {
        assert_eq!(decode_name(b" caf\xe9 "), "café", "Latin-1");
    }

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
