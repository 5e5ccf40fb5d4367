//! What can go wrong.

use std::path::{Path, PathBuf};

#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    #[error("{0}")]
    Usage(String),
    #[error("{path}: {error}")]
    File { path: PathBuf, error: std::io::Error },
    #[error("{path}: {error}")]
    Json { path: PathBuf, error: serde_json::Error },
    #[error("{program} failed: {message}")]
    Program { program: String, message: String },
    #[error("{path}: {error}")]
    Source { path: String, error: syn::Error },
    /// Errors of the compiler at a place without a mutant.
    #[error("the mutated workspace does not compile:\n{0}")]
    Compile(String),
}

pub(crate) type Result<T> = std::result::Result<T, Error>;

/// Says which file an error is about.
pub(crate) fn at<T>(path: &Path, result: std::io::Result<T>) -> Result<T> {
    result.map_err(|error| Error::File { path: path.to_owned(), error })
}
