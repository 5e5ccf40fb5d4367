//! A model that is ready to be written, as files in memory.

use std::path::Path;

use crate::loss::Loss;
use crate::write::{WriteError, write_atomically};

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its name, without a folder.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// A model that is ready to be written.
#[derive(Clone, Debug)]
pub struct Export {
    /// The files in the order in which they are to be written: what a model refers to comes before the
    /// model, which is the last.
    pub files: Vec<ExportedFile>,
    pub(super) losses: Vec<Loss>,
}

impl Export {
    /// What the scene holds and the files do not.
    pub fn what_would_be_lost(&self) -> &[Loss] {
        &self.losses
    }

    /// Writes the files into a folder, each whole or not at all.
    ///
    /// # Errors
    /// When one cannot be written; those before it are there.
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<(), WriteError> {
        self.files.iter().try_for_each(|file| {
            write_atomically(&folder.as_ref().join(&file.name), |writer| writer.write_all(&file.bytes))
        })
    }
}
