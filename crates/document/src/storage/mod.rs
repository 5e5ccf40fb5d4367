//! File operations that saving needs, behind a trait, so that tests can make a disk lose unsynced
//! data.

mod save;
mod set;

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

use trigon_io::{create_unfinished, forget_unfinished, link_unfinished};

pub(crate) use save::replace;
pub use save::{SaveError, backup_path, save};
pub use set::{SetError, SetFile, SetState, finish_set, save_set};

#[cfg(test)]
pub(crate) mod failing;

/// The operations of a disk that saving needs. Data survives a power failure for certain only after it was
/// synced: contents by [`Storage::sync`], names by [`Storage::sync_folder`].
pub trait Storage {
    /// All bytes of a file.
    ///
    /// # Errors
    /// The operating system's error, here and below.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// Whether the file exists.
    fn exists(&self, path: &Path) -> bool;

    /// The final target of a path: itself if there are no symbolic links.
    fn resolve(&self, path: &Path) -> PathBuf {
        path.to_owned()
    }

    /// Gives a new file the permissions of the one that it will replace. Does nothing on systems without
    /// permissions.
    ///
    /// # Errors
    /// The old file is read-only ([`io::ErrorKind::PermissionDenied`]), or an error of the operating system.
    fn keep_permissions(&mut self, old: &Path, new: &Path) -> io::Result<()> {
        let _ = (old, new);
        Ok(())
    }

    /// Writes a new file under a temporary name. Until it is [renamed](Storage::rename) or [removed](Storage::remove),
    /// it is also removed if the program is told to end.
    ///
    /// # Errors
    /// There is a file of that name, or a link, or an error of the operating system. The file may then be incomplete.
    fn create(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()>;

    /// Appends to a file, which is created if it does not exist.
    ///
    /// # Errors
    /// An error of the operating system. A part may then be written.
    fn append(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()>;

    /// Makes the contents of a file durable.
    ///
    /// # Errors
    /// An error of the operating system.
    fn sync(&mut self, path: &Path) -> io::Result<()>;

    /// Gives a file a second name, which must not exist and is temporary, as that of a [created](Storage::create) file.
    ///
    /// # Errors
    /// An error of the operating system; some file systems cannot do this.
    fn link(&mut self, from: &Path, to: &Path) -> io::Result<()>;

    /// Renames a file in one step; a file with the new name is replaced.
    ///
    /// # Errors
    /// An error of the operating system.
    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()>;

    /// Removes a name.
    ///
    /// # Errors
    /// An error of the operating system.
    fn remove(&mut self, path: &Path) -> io::Result<()>;

    /// Makes the names in a folder durable.
    ///
    /// # Errors
    /// An error of the operating system.
    fn sync_folder(&mut self, folder: &Path) -> io::Result<()>;
}

/// Files of the operating system.
#[derive(Debug, Clone, Copy, Default)]
pub struct Disk;

impl Storage for Disk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        fs::read(path)
    }

    fn exists(&self, path: &Path) -> bool {
        path.exists()
    }

    fn resolve(&self, path: &Path) -> PathBuf {
        /// The number of links that Linux follows.
        const MOST_LINKS: usize = 40;
        let mut path = path.to_owned();
        for _ in 0..MOST_LINKS {
            // A link may point to a file that does not exist yet.
            let Ok(target) = fs::read_link(&path) else { break };
            path = path.parent().map_or_else(|| target.clone(), |folder| folder.join(&target));
        }
        path
    }

    fn keep_permissions(&mut self, old: &Path, new: &Path) -> io::Result<()> {
        let metadata = fs::metadata(old)?;
        if !metadata.is_file() {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                "it is a device or a folder, and no file",
            ));
        }
        let permissions = metadata.permissions();
        if permissions.readonly() {
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is read-only"));
        }
        fs::set_permissions(new, permissions)
    }

    fn create(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        create_unfinished(path)?.write_all(bytes)
    }

    fn append(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        OpenOptions::new().create(true).append(true).open(path)?.write_all(bytes)
    }

    fn sync(&mut self, path: &Path) -> io::Result<()> {
        // Some systems sync only files that were opened for writing.
        OpenOptions::new().write(true).open(path)?.sync_all()
    }

    fn link(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        link_unfinished(from, to)
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)?;
        forget_unfinished(from);
        Ok(())
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)?;
        forget_unfinished(path);
        Ok(())
    }

    fn sync_folder(&mut self, folder: &Path) -> io::Result<()> {
        // Elsewhere folders cannot be opened, and renames are durable by themselves.
        if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
    }
}
