//! Text formats with one record per line (PLY, OFF and text STL), in any Unicode encoding.

use std::borrow::Cow;

/// The non-empty lines of a text with their numbers, counted from 1. Lines end in `\n`, `\r\n` or
/// `\r`; surrounding spaces are removed.
#[derive(Clone)]
pub(crate) struct Rows<'a> {
    text: &'a [u8],
    at: usize,
    number: u64,
    /// The start of a comment, in formats that have them.
    comment: Option<u8>,
}

impl<'a> Rows<'a> {
    /// The lines of a text, with a number of lines already read.
    pub(crate) fn after(lines: u64, text: &'a [u8]) -> Self {
        Self { text, at: 0, number: lines, comment: None }
    }

    /// All lines, without what follows a `#`.
    pub(crate) fn without_comments(text: &'a [u8]) -> Self {
        Self { comment: Some(b'#'), ..Self::after(0, text) }
    }

    /// The number of the line that was returned last.
    pub(crate) fn line(&self) -> u64 {
        self.number
    }

    /// What has not been read.
    pub(crate) fn rest(&self) -> &'a [u8] {
        &self.text[self.at..]
    }

    /// Goes past text with so many bytes and lines.
    pub(crate) fn pass(&mut self, bytes: usize, lines: u64) {
        self.at += bytes;
        self.number += lines;
    }

    /// The number of bytes read, and of bytes left.
    pub(crate) fn progress(&self) -> (usize, usize) {
        (self.at, self.text.len() - self.at)
    }

    /// The next line as it is, without its ending.
    fn physical(&mut self) -> Option<&'a [u8]> {
        let rest = self.text.get(self.at..).filter(|rest| !rest.is_empty())?;
        self.number += 1;
        let end = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let ending = if rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.at = (self.at + end + ending).min(self.text.len());
        Some(&rest[..end])
    }
}

impl<'a> Iterator for Rows<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = self.physical()?;
            let end = self.comment.and_then(|comment| memchr::memchr(comment, line)).unwrap_or(line.len());
            let line = line[..end].trim_ascii();
            if !line.is_empty() {
                return Some(line);
            }
        }
    }
}

/// The words of a text, whatever lines they stand on.
#[derive(Clone)]
pub(crate) struct Words<'a> {
    rows: Rows<'a>,
    /// What is left of a line: it begins with a word, or is empty.
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(crate) fn of(rows: Rows<'a>) -> Self {
        Self { rows, rest: &[] }
    }

    /// The number of the line of the word that was returned last.
    pub(crate) fn line(&self) -> u64 {
        self.rows.line()
    }

    /// What is left of the line of the last word.
    pub(crate) fn rest_of_line(&self) -> &'a [u8] {
        self.rest
    }

    /// Goes past some bytes of the rest of the line.
    pub(crate) fn pass_in_line(&mut self, bytes: usize) {
        self.rest = self.rest[bytes..].trim_ascii_start();
    }

    /// The rest of the line, or the next line if nothing is left of it; empty at the end of the text.
    pub(crate) fn line_ahead(&mut self) -> &'a [u8] {
        if self.rest.is_empty() {
            self.rest = self.rows.next().unwrap_or_default();
        }
        self.rest
    }

    /// Takes what [`Self::line_ahead`] returns.
    pub(crate) fn take_line(&mut self) -> Option<&'a [u8]> {
        let line = self.line_ahead();
        self.rest = &[];
        (!line.is_empty()).then_some(line)
    }

    /// The rows that follow, unless something is left of a line.
    pub(crate) fn whole_rows(&mut self) -> Option<&mut Rows<'a>> {
        self.rest.is_empty().then_some(&mut self.rows)
    }

    /// The number of bytes read, and of bytes left.
    pub(crate) fn progress(&self) -> (usize, usize) {
        let (read, left) = self.rows.progress();
        (read - self.rest.len().min(read), left + self.rest.len())
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.line_ahead();
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        self.pass_in_line(end);
        (end > 0).then(|| &line[..end])
    }
}

/// The words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A word as quoted in messages.
pub(crate) fn quoted(word: &[u8]) -> String {
    format!("\"{}\"", String::from_utf8_lossy(&word[..word.len().min(40)]))
}

/// A text as bytes of an ASCII superset, without its byte order mark. Without a mark they stay as they are.
pub(crate) fn plain_text(bytes: &[u8]) -> Cow<'_, [u8]> {
    let from_units = |read: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|pair| read([pair[0], pair[1]]));
        let text: String =
            char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        Cow::Owned(text.into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, ..] => from_units(u16::from_le_bytes),
        [0xfe, 0xff, ..] => from_units(u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_do_not_care_for_lines() {
        let mut words = Words::of(Rows::without_comments(b"a  b # c\n\n d\te\n#\nf"));
        let mut found = Vec::new();
        while let Some(word) = words.next() {
            found.push((words.line(), String::from_utf8_lossy(word).into_owned()));
        }
        let expected = [(1, "a"), (1, "b"), (3, "d"), (3, "e"), (5, "f")];
        assert_eq!(found, expected.map(|(line, word)| (line, word.to_owned())), "each with its line");
        let mut words = Words::of(Rows::after(0, b"a b c\nd"));
        assert_eq!(words.next(), Some(&b"a"[..]), "the first");
        assert_eq!(
            (words.rest_of_line(), words.whole_rows().is_some()),
            (&b"b c"[..], false),
            "within a line"
        );
        assert_eq!((words.take_line(), words.take_line()), (Some(&b"b c"[..]), Some(&b"d"[..])), "lines");
        assert_eq!((words.take_line(), words.progress()), (None, (7, 0)), "the end");
    }

    #[test]
    fn lines_are_numbered_whatever_ends_them() {
        let mut rows = Rows::without_comments(b"OFF # x\r\n\n# y\r 1 2 \r3");
        let mut found = Vec::new();
        while let Some(line) = rows.next() {
            found.push((rows.line(), String::from_utf8_lossy(line).into_owned()));
        }
        let expected = [(1, "OFF"), (4, "1 2"), (5, "3")].map(|(line, text)| (line, text.to_owned()));
        assert_eq!(found, expected, "without comments and blank lines");
        assert_eq!(rows.progress().1, 0, "to the end");
    }

    #[test]
    fn text_in_other_encodings_is_read() {
        let units = || "\u{feff}v 1".encode_utf16();
        let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
        for text in [&little[..], &big, b"\xef\xbb\xbfv 1", b"v 1"] {
            assert_eq!(&*plain_text(text), b"v 1", "{text:?}");
        }
    }
}
