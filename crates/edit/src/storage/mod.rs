//! Files on a disk, as saving needs them: behind a trait, so that tests can let a disk lose
//! what was not synced.

mod disk;
#[cfg(test)]
pub(crate) mod failing;
mod save;

use std::io;
use std::path::{Path, PathBuf};

pub use disk::Disk;
pub(crate) use save::replace;
pub use save::{SaveError, backup_path, save};

/// What saving asks of a disk. Nothing that was written survives a loss of power for certain until it
/// was synced: contents by [`Storage::sync`], names by [`Storage::sync_folder`].
pub trait Storage {
    /// All bytes of a file.
    ///
    /// # Errors
    /// What the system says, here and below.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// Whether there is such a file.
    fn exists(&self, path: &Path) -> bool;

    /// Where a path leads in the end: to itself where there are no symbolic links.
    fn resolve(&self, path: &Path) -> PathBuf {
        path.to_owned()
    }

    /// Gives a new file the permissions of the one that it is to replace. Does nothing where files have
    /// none.
    ///
    /// # Errors
    /// The old file is not to be written ([`io::ErrorKind::PermissionDenied`]), or what the system says.
    fn keep_permissions(&mut self, old: &Path, new: &Path) -> io::Result<()> {
        let _ = (old, new);
        Ok(())
    }

    /// Writes a file; what it held before is gone.
    ///
    /// # Errors
    /// What the system says. The file may hold a part then.
    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()>;

    /// Writes at the end of a file, which is made if there is none.
    ///
    /// # Errors
    /// What the system says. A part may be written then.
    fn append(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()>;

    /// Makes the contents of a file durable.
    ///
    /// # Errors
    /// What the system says.
    fn sync(&mut self, path: &Path) -> io::Result<()>;

    /// Gives a file a second name, which must be free.
    ///
    /// # Errors
    /// What the system says; some file systems cannot.
    fn link(&mut self, from: &Path, to: &Path) -> io::Result<()>;

    /// Gives a file another name at once; what had that name before is gone.
    ///
    /// # Errors
    /// What the system says.
    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()>;

    /// Removes a name.
    ///
    /// # Errors
    /// What the system says.
    fn remove(&mut self, path: &Path) -> io::Result<()>;

    /// Makes the names in a folder durable.
    ///
    /// # Errors
    /// What the system says.
    fn sync_folder(&mut self, folder: &Path) -> io::Result<()>;
}
