//! Which version of a file is on the disk: whether another program has changed it.

use std::path::Path;
use std::time::SystemTime;

/// When a file was changed last, and how long it was then.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FileVersion {
    modified: Option<SystemTime>,
    bytes: u64,
}

impl FileVersion {
    /// Of the file that is there now; `None` if there is none.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let metadata = path.metadata().ok()?;
        Some(Self { modified: metadata.modified().ok(), bytes: metadata.len() })
    }
}
