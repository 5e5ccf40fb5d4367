//! The start of an OFF: the attributes of vertices, and the numbers of vertices and faces.

use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::rows::{Rows, Words, quoted, words};

/// What helps against most faults.
pub(super) const REMEDY: &str = "fix the line, or export the model again";

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Header {
    pub(super) has_normals: bool,
    pub(super) has_colors: bool,
    pub(super) has_uvs: bool,
    pub(super) vertices: u64,
    pub(super) faces: u64,
}

impl Header {
    /// How many numbers a vertex has at least.
    pub(super) fn least_numbers(&self) -> usize {
        let count = |is_there: bool, numbers: usize| if is_there { numbers } else { 0 };
        3 + count(self.has_normals, 3) + count(self.has_colors, 3) + count(self.has_uvs, 2)
    }

    /// How many it has where no line ends it: a colour has its alpha then.
    pub(super) fn all_numbers(&self) -> usize {
        self.least_numbers() + usize::from(self.has_colors)
    }
}

/// Whether a file starts as an OFF does.
pub(crate) fn is_off(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1 << 12)];
    // Words of people may begin with a small "off".
    let is_keyword =
        |line: &[u8]| line.windows(3).any(|word| word == b"OFF") && split_keyword(line).is_some();
    Rows::without_comments(start).next().is_some_and(is_keyword)
}

/// The letters before `OFF`, and how many bytes both are: some files have the counts behind them, even
/// without a space between.
fn split_keyword(line: &[u8]) -> Option<(Vec<u8>, usize)> {
    let at = line.windows(3).take(8).position(|window| window.eq_ignore_ascii_case(b"OFF"))?;
    let (prefix, rest) = (&line[..at], &line[at + 3..]);
    // A small n before large letters counts dimensions.
    let prefix = if &line[at..at + 3] == b"off" { prefix.to_ascii_uppercase() } else { prefix.to_vec() };
    let is_end = rest.first().is_none_or(|byte| byte.is_ascii_whitespace() || byte.is_ascii_digit());
    (is_end && prefix.iter().all(|byte| b"STCN4n".contains(byte))).then_some((prefix, at + 3))
}

pub(super) fn read_header(import: &Import<'_>, text: &mut Words<'_>) -> Result<Header, LoadError> {
    let path = import.path;
    let first = text.line_ahead();
    if first.is_empty() {
        let remedy = "export the model again";
        return Err(LoadError::new(LoadErrorKind::Empty, path, "the file is empty", remedy));
    }
    let mut header = Header::default();
    // The keyword may be left out.
    if let Some((prefix, length)) = split_keyword(first) {
        text.pass_in_line(length);
        if prefix.iter().any(|letter| b"4n".contains(letter))
            || words(text.rest_of_line()).any(|word| word == b"BINARY")
        {
            let what = format!("it is of the kind {}, which is not read", quoted(first));
            let remedy = "save it as text in three dimensions, or as PLY";
            return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy));
        }
        header.has_uvs = prefix.starts_with(b"ST");
        header.has_colors = prefix.contains(&b'C');
        header.has_normals = prefix.contains(&b'N');
    }
    header.vertices = read_count(import, text)?;
    let line = text.line();
    header.faces = read_count(import, text)?;
    pass_edge_count(text, line);
    Ok(header)
}

fn read_count(import: &Import<'_>, text: &mut Words<'_>) -> Result<u64, LoadError> {
    let word = text.next().unwrap_or_default();
    count(word).ok_or_else(|| {
        let what = format!("{} does not tell how many vertices and faces there are", quoted(word));
        LoadError::malformed(import.path, what, REMEDY).at(Location::Line(text.line()))
    })
}

fn count(word: &[u8]) -> Option<u64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Some files leave the number of edges out, which nothing uses. `line` is that of the number of vertices.
fn pass_edge_count(text: &mut Words<'_>, line: u64) {
    let mut ahead = text.clone();
    let is_on_line = !text.rest_of_line().is_empty();
    let is_number = ahead.next().and_then(count).is_some();
    // On the next line it stands alone.
    let is_alone = ahead.rest_of_line().is_empty();
    if is_number && (is_on_line || line != text.line() || is_alone) {
        *text = ahead;
    }
}
