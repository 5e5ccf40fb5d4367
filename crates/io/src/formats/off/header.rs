//! The first lines of an OFF: the attributes of vertices, and the numbers of vertices and faces.

use crate::error::{LoadError, LoadErrorKind, Place};
use crate::import::Import;
use crate::rows::{Rows, quoted, words};

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
}

/// Whether a file starts as an OFF does.
pub(crate) fn is_off(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1 << 12)];
    Rows::without_comments(start).next().is_some_and(|line| split_keyword(line).is_some())
}

/// The letters before `OFF`, and what is behind it on the line: some files have the counts there, even
/// without a space between.
fn split_keyword(line: &[u8]) -> Option<(&[u8], &[u8])> {
    let at = line.windows(3).take(8).position(|window| window == b"OFF")?;
    let (prefix, rest) = (&line[..at], &line[at + 3..]);
    let is_end = rest.first().is_none_or(|byte| byte.is_ascii_whitespace() || byte.is_ascii_digit());
    (is_end && prefix.iter().all(|byte| b"STCN4n".contains(byte))).then_some((prefix, rest))
}

pub(super) fn read_header(import: &Import<'_>, rows: &mut Rows<'_>) -> Result<Header, LoadError> {
    let path = import.path;
    let Some(first) = rows.next() else {
        let remedy = "export the model again";
        return Err(LoadError::new(LoadErrorKind::Empty, path, "the file is empty", remedy));
    };
    let mut header = Header::default();
    // The keyword may be left out.
    let mut line = first;
    if let Some((prefix, rest)) = split_keyword(first) {
        if prefix.iter().any(|letter| b"4n".contains(letter)) || words(rest).any(|word| word == b"BINARY") {
            let what = format!("it is of the kind {}, which is not read", quoted(first));
            let remedy = "save it as text in three dimensions, or as PLY";
            return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy));
        }
        header.has_uvs = prefix.starts_with(b"ST");
        header.has_colors = prefix.contains(&b'C');
        header.has_normals = prefix.contains(&b'N');
        line = if rest.trim_ascii().is_empty() { rows.next().unwrap_or_default() } else { rest };
    }
    let mut counts =
        words(line).map(|word| std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()));
    let (Some(Some(vertices)), Some(Some(faces))) = (counts.next(), counts.next()) else {
        let what = format!("{} does not tell how many vertices and faces there are", quoted(line));
        return Err(LoadError::malformed(path, what, REMEDY).at(Place::Line(rows.line())));
    };
    (header.vertices, header.faces) = (vertices, faces);
    Ok(header)
}
