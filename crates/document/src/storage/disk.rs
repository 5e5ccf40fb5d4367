//! The computer's own disk.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use trigon_io::{create_unfinished, forget_unfinished, link_unfinished};

use super::Storage;

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
