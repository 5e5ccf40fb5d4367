//! Atomic writing of files that can be made again: images, outputs, captures, exported models.
//!
//! The editor's documents are saved by `trigon_document::save` instead. It keeps a backup and the
//! permissions, and goes through a trait, so that tests can make a disk lose what was not synced. Here the
//! contents are streamed into a temporary file and never held in memory as a whole.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::unfinished::{create_unfinished, forget_unfinished, unfinished_path};

/// Why an image, an output, a capture or a model was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The sizes do not match, or are zero.
    #[error("an image of {width}×{height} pixels does not fit {length} values; pass width × height pixels")]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// The number of values passed.
        length: usize,
    },
    /// The frame does not contain the requested output.
    #[error("the frame has no {what}; request it in RenderSettings::outputs")]
    Absent {
        /// The output.
        what: &'static str,
    },
    /// The format cannot hold the values.
    #[error("{output} cannot be written as a PNG of 16 bits: {what}; write it as .npy or .exr")]
    Unfit {
        /// The output.
        output: &'static str,
        /// What does not fit.
        what: String,
    },
    /// The format is read but not written.
    #[error("{name}: the format is not written; name a file with one of these endings: {writers}")]
    Unwritten {
        /// The name of the file.
        name: String,
        /// The extensions of those that are written.
        writers: String,
    },
    /// A vertex or an object lies farther away than the numbers of the file can say.
    #[error(
        "node \"{node}\" lies or reaches beyond 3.4e38, the largest number of a coordinate; move or scale it back"
    )]
    Overflow {
        /// The name of the node.
        node: String,
    },
    /// The file would be too large for its format.
    #[error("the file would have {bytes} bytes, and its format cannot exceed 4 GiB; save fewer meshes in it")]
    TooLarge {
        /// The size that the file would have, in bytes.
        bytes: u64,
    },
    /// The folder or the disk refused.
    #[error("{}: cannot be written ({source}); check that the folder exists, is writable and has room", path.display())]
    File {
        /// The file to write.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The writer failed.
    #[error("the image cannot be written ({0}); check that the receiving program is still running")]
    Stream(#[from] io::Error),
}

/// Runs `write` on a new file that takes the name `path` when all went well: `path` is the old file or the whole new
/// one, also when the program or the machine stops meanwhile. Where it is a symbolic link, the file that this leads to is
/// replaced, and the link stays. What is no file, such as `/dev/null` or a named pipe, is written to.
///
/// # Errors
/// When the old file is write-protected, the folder is missing, not writable or full, or `write` fails. The old file
/// stays then.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let target = followed(path);
    let done = if is_passage(path) {
        pass(path, write)
    } else {
        refuse_protected(&target).and_then(|()| replace(&target, write))
    };
    done.map_err(|source| WriteError::File { path: path.to_owned(), source })
}

/// Where a link leads, also if nothing is there yet.
fn followed(path: &Path) -> PathBuf {
    /// Longer chains are circles.
    const MOST: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST {
        let Ok(target) = fs::read_link(&path) else { break };
        path = path.parent().map_or(target.clone(), |folder| folder.join(&target));
    }
    path
}

/// A new file may take the place of one that nobody may write to; that is not what was meant.
fn refuse_protected(path: &Path) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.permissions().readonly() => {
            Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is write-protected"))
        }
        _ => Ok(()),
    }
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let new = NewFile::beside(path)?;
    written(&new.file, write)?;
    new.file.sync_all()?;
    new.replace(path)?;
    sync_folder(folder)
}

/// A temporary file that is removed again unless it gets its name.
struct NewFile {
    file: fs::File,
    path: PathBuf,
}

impl NewFile {
    fn beside(path: &Path) -> io::Result<Self> {
        let path = unfinished_path(path);
        Ok(Self { file: create_unfinished(&path)?, path })
    }

    fn replace(&self, path: &Path) -> io::Result<()> {
        fs::rename(&self.path, path)
    }
}

impl Drop for NewFile {
    fn drop(&mut self) {
        // There is none where it has got its name.
        let _ = fs::remove_file(&self.path);
        forget_unfinished(&self.path);
    }
}

fn written(file: &fs::File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(file);
    write(&mut writer)?;
    writer.flush()
}

/// A device or a pipe, such as `/dev/null`, stays what it is: the contents go through it.
fn is_passage(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

fn pass(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    written(&fs::OpenOptions::new().write(true).open(path)?, write)
}

/// Makes the new name durable, if the system can.
fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) { fs::File::open(folder)?.sync_all() } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_leaves_the_old_file() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("a.png");
        fs::write(&path, "old").expect("a file");
        let failed = write_atomically(&path, |_| Err(io::Error::other("the disk is full")));
        failed.expect_err("reported");
        assert_eq!(fs::read(&path).expect("a file"), b"old", "untouched");
        assert_eq!(fs::read_dir(dir.path()).expect("a folder").count(), 1, "no temporary file");
    }

    #[test]
    fn a_write_protected_file_is_not_replaced() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("a.png");
        fs::write(&path, "old").expect("a file");
        let mut permissions = fs::metadata(&path).expect("a file").permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).expect("it is ours");
        let refused = write_atomically(&path, |file| file.write_all(b"new")).expect_err("refused");
        assert!(
            refused.to_string().contains("a.png: cannot be written (it is write-protected)"),
            "{refused}"
        );
        assert_eq!(fs::read(&path).expect("a file"), b"old", "untouched");
    }

    /// Everything that writes a file goes this way, and must tell that the device is full.
    #[cfg(target_os = "linux")]
    #[test]
    fn devices_stay_devices_and_a_full_one_is_an_error() {
        let full = write_atomically(Path::new("/dev/full"), |file| file.write_all(b"new"));
        let message = full.expect_err("nothing fits").to_string();
        assert!(message.starts_with("/dev/full: cannot be written (No space left on device"), "{message}");
        write_atomically(Path::new("/dev/null"), |file| file.write_all(b"new")).expect("it takes everything");
        let dir = tempfile::tempdir().expect("a temporary folder");
        let link = dir.path().join("a.png");
        std::os::unix::fs::symlink("/dev/null", &link).expect("a link");
        write_atomically(&link, |file| file.write_all(b"new")).expect("through a link");
        for device in [Path::new("/dev/full"), Path::new("/dev/null"), &link] {
            assert!(!fs::metadata(device).expect("there").is_file(), "{} is what it was", device.display());
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_also_to_where_nothing_is() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        fs::create_dir(dir.path().join("real")).expect("a folder");
        let (link, target) = (dir.path().join("a.png"), dir.path().join("real/b.png"));
        std::os::unix::fs::symlink("real/b.png", &link).expect("a link");
        for text in ["first", "second"] {
            write_atomically(&link, |file| file.write_all(text.as_bytes())).expect("written");
            assert_eq!(fs::read_to_string(&target).expect("there"), text, "the target");
            assert!(link.is_symlink(), "the link stays");
        }
    }
}
