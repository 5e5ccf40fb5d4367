//! Load errors: the file, the location in it, what is wrong, and a remedy.
//!
//! A message is one line for people: `cube.obj, line 12: face index 9 …; …`. Names from files are
//! made printable first, so that no file can write escape sequences to a terminal or break the
//! line.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A location in a file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub enum Location {
    /// The file as a whole.
    #[default]
    Whole,
    /// A line of text, counted from 1 as in editors.
    Line(u64),
    /// An offset from the start of the file.
    Byte(u64),
    /// A numbered object of a glTF file, counted from 0 as in the format: `accessor 3`.
    Item(&'static str, usize),
    /// Anything else with a name: `material "wood"`, `mesh 2, primitive 0`.
    Named(String),
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Line(line) => write!(f, ", line {line}"),
            Self::Byte(byte) => write!(f, ", byte {byte}"),
            Self::Item(kind, index) => write!(f, ", {kind} {index}"),
            Self::Named(name) => write!(f, ", {name}"),
        }
    }
}

/// The kinds of failure, for programs that distinguish them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LoadErrorKind {
    /// The file, or another one that it needs, could not be read.
    Read,
    /// The file's format, or an extension that it requires, is not supported.
    Unsupported,
    /// The contents violate the format.
    Malformed,
    /// A reference points out of the model's folder, or to something other than a regular file.
    Forbidden,
    /// A limit is exceeded.
    Limit,
    /// A valid file with nothing to draw.
    Empty,
    /// The progress callback cancelled loading.
    Cancelled,
}

/// Why a file could not be loaded. Its `Display` is one line: the file, the location in it, what is
/// wrong, and the remedy.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}{location}: {what}; {remedy}", printable(&file.display().to_string()))]
#[non_exhaustive]
pub struct LoadError {
    /// The kind of failure.
    pub kind: LoadErrorKind,
    /// The faulty file, as the caller or the model named it.
    pub file: PathBuf,
    /// The location in that file.
    pub location: Location,
    /// What is wrong.
    pub what: String,
    /// A remedy for people.
    pub remedy: String,
}

impl LoadError {
    pub(crate) fn new(
        kind: LoadErrorKind,
        file: &Path,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        let (what, remedy) = (printable(&what.into()), printable(&remedy.into()));
        Self { kind, file: file.to_owned(), location: Location::Whole, what, remedy }
    }

    pub(crate) fn malformed(file: &Path, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(LoadErrorKind::Malformed, file, what, remedy)
    }

    pub(crate) fn limit(file: &Path, what: impl Into<String>) -> Self {
        Self::new(LoadErrorKind::Limit, file, what, "raise the limit if you trust the file")
    }

    pub(crate) fn read(file: &Path, error: &io::Error) -> Self {
        let remedy = match error.kind() {
            io::ErrorKind::NotFound => "check the name and the folder",
            io::ErrorKind::PermissionDenied => "change its permissions",
            _ => "check the disk or the connection and try again",
        };
        Self::new(LoadErrorKind::Read, file, format!("cannot be read ({error})"), remedy)
    }

    pub(crate) fn cancelled(file: &Path) -> Self {
        Self::new(LoadErrorKind::Cancelled, file, "loading was cancelled", "load it again when you want it")
    }

    pub(crate) fn at(self, location: Location) -> Self {
        Self { location, ..self }
    }
}

/// The longest piece of a file that a message quotes.
const QUOTE_LIMIT: usize = 400;

/// The text on one line, without control characters, and truncated if it is very long.
pub(crate) fn printable(text: &str) -> String {
    let mut clean: String =
        text.chars().take(QUOTE_LIMIT).map(|c| if is_unprintable(c) { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(QUOTE_LIMIT).is_some() {
        clean.push('…');
    }
    clean
}

/// Control characters, and the invisible ones that reorder or break lines.
fn is_unprintable(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{2028}' | '\u{2029}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_one_line_with_file_place_and_remedy() {
        let error = LoadError::malformed(Path::new("a\nb.obj"), "bad\u{1b}[31m name", "mend it")
            .at(Location::Line(3));
        assert_eq!(
            error.to_string(),
            "a\u{fffd}b.obj, line 3: bad\u{fffd}[31m name; mend it",
            "no control characters"
        );
    }

    #[test]
    fn a_quoted_megabyte_is_shortened() {
        let error = LoadError::malformed(Path::new("a.obj"), "x".repeat(1 << 20), "mend it");
        assert!(error.to_string().len() < 1000, "{} bytes", error.to_string().len());
    }
}
