//! An exported model as files in memory.

use std::path::Path;

use crate::loss::Loss;
use crate::write::{WriteError, write_atomically};

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ExportedFile {
    /// Its name, without a folder.
    pub name: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// A model ready to be written.
#[derive(Clone, Debug)]
pub struct Export {
    /// The files in the order in which they are to be written: the model comes last, after the files that it
    /// refers to.
    pub files: Vec<ExportedFile>,
    pub(crate) losses: Vec<Loss>,
}

impl Export {
    /// What the scene contains and the files do not.
    #[must_use]
    pub fn what_would_be_lost(&self) -> &[Loss] {
        &self.losses
    }

    /// Writes the files into a folder, each atomically.
    ///
    /// # Errors
    /// One cannot be written; those before it were written.
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<(), WriteError> {
        self.files.iter().try_for_each(|file| {
            write_atomically(&folder.as_ref().join(&file.name), |writer| writer.write_all(&file.bytes))
        })
    }
}
