//! Why a file is not opened, and which names are always refused. Git LFS pointers, which stand for a large
//! file until it is fetched, have a message of their own.

use std::io;
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

use super::error::{LoadError, LoadErrorKind};

/// Why a name was not opened.
#[derive(Debug, Error)]
pub(crate) enum Refusal {
    #[error("it has a scheme, and only files in the model's folder and data: URIs are opened")]
    Scheme,
    #[error("it is an absolute path, and only files in the model's folder are opened")]
    Absolute,
    #[error("it leads out of the model's folder")]
    Outside,
    #[error("it is not a regular file")]
    NotAFile,
    #[error("it is not a valid file name")]
    BadName,
    #[error("there is no such file")]
    Missing,
    #[error("the model came without a folder")]
    NoFolder,
    #[error("it has {0} bytes, more than the limit of {1}")]
    TooLarge(u64, u64),
    #[error("it is a Git LFS pointer, not the file itself")]
    LfsPointer,
    #[error("it cannot be read ({0})")]
    Read(io::Error),
    #[error("loading was cancelled")]
    Cancelled,
}

impl Refusal {
    pub(crate) fn from_io(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Self::Missing,
            io::ErrorKind::InvalidInput | io::ErrorKind::InvalidFilename => Self::BadName,
            _ => Self::Read(error),
        }
    }

    /// Whether a file has the name, and cannot be used.
    pub(crate) fn is_of_a_file_that_is_there(&self) -> bool {
        matches!(self, Self::TooLarge(..) | Self::LfsPointer | Self::Read(_))
    }

    pub(crate) fn is_forbidden(&self) -> bool {
        matches!(self, Self::Scheme | Self::Absolute | Self::Outside | Self::NotAFile | Self::BadName)
    }

    /// The error for a file that the user named.
    pub(crate) fn of_model(&self, path: &Path) -> LoadError {
        let (kind, remedy) = match self {
            Self::Read(error) => return LoadError::read(path, error),
            Self::Cancelled => return LoadError::cancelled(path),
            Self::TooLarge(..) => (LoadErrorKind::Limit, "raise the limit if you trust the file"),
            Self::Missing => (LoadErrorKind::Read, "check the name and the folder"),
            Self::LfsPointer => (LoadErrorKind::Malformed, REMEDY),
            _ => (LoadErrorKind::Forbidden, "name a regular file; pipe streams through `-`"),
        };
        LoadError::new(kind, path, self.to_string(), remedy)
    }

    /// The remedy for a file that a model names.
    pub(crate) fn remedy(&self) -> &'static str {
        match self {
            Self::Missing => "put the file there, or export the model again with it",
            Self::NoFolder => "load the model from a file instead of a stream, or embed everything in a GLB",
            Self::TooLarge(..) => "use a smaller file, or raise the limit",
            Self::LfsPointer => REMEDY,
            Self::Read(_) => "check that the file can be read",
            _ => "put the file beside the model and name it by its relative path",
        }
    }
}

/// The name as a path that only descends.
pub(crate) fn relative_path(name: &str) -> Result<PathBuf, Refusal> {
    if name.trim().is_empty() || name.contains('\0') {
        return Err(Refusal::BadName);
    }
    if has_drive(name) || name.starts_with(['/', '\\']) {
        return Err(Refusal::Absolute);
    }
    if has_scheme(name) {
        return Err(Refusal::Scheme);
    }
    let mut path = PathBuf::new();
    for component in Path::new(name).components() {
        match component {
            Component::Normal(part) => path.push(part),
            Component::CurDir => {}
            Component::ParentDir => return Err(Refusal::Outside),
            Component::RootDir | Component::Prefix(_) => return Err(Refusal::Absolute),
        }
    }
    if path.as_os_str().is_empty() { Err(Refusal::BadName) } else { Ok(path) }
}

/// `C:` as Windows writes it; a drive is one letter, a scheme at least two.
fn has_drive(name: &str) -> bool {
    let mut chars = name.chars();
    chars.next().is_some_and(|c| c.is_ascii_alphabetic()) && chars.next() == Some(':')
}

/// `scheme:` as RFC 3986, section 3.1 writes it.
fn has_scheme(name: &str) -> bool {
    name.split_once(':').is_some_and(|(scheme, _)| {
        scheme.starts_with(|c: char| c.is_ascii_alphabetic())
            && scheme.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'))
    })
}

/// What helps.
pub(crate) const REMEDY: &str = "fetch the real file with `git lfs pull`";

/// How a pointer begins: with the address of its specification, or with the one of the time before its release.
const STARTS: [&[u8]; 2] = [b"version https://git-lfs", b"version https://hawser"];

/// Whether a file is a pointer, whatever its name says.
pub(crate) fn is_lfs_pointer(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    STARTS.iter().any(|start| text.starts_with(start))
}
