//! Files that are being written under a temporary name, so that a program that is told to end leaves none of them
//! behind.
//!
//! Their names are random and the files are new: nobody else can have put a file, or a link to one, in their place.
//! A crash or a power failure may still leave one; it ends in `.part`.

use std::fs::{self, File, OpenOptions};
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn list() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Creates a file that must not exist yet, not even as a link, and that [`end_on_signals`](crate::end_on_signals)
/// removes until [`forget_unfinished`] is called.
///
/// # Errors
/// There is a file of that name ([`io::ErrorKind::AlreadyExists`]), or an error of the operating system.
pub fn create_unfinished(path: &Path) -> io::Result<File> {
    listed(path, || OpenOptions::new().write(true).create_new(true).open(path))
}

/// The same for a second name of a file.
///
/// # Errors
/// As [`create_unfinished`]; some file systems cannot do this.
pub fn link_unfinished(from: &Path, to: &Path) -> io::Result<()> {
    listed(to, || fs::hard_link(from, to))
}

/// Lists what is created. The list is held meanwhile, so that whoever removes what it contains does not miss a file that
/// is just being created.
fn listed<T>(path: &Path, create: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
    let mut list = list();
    let created = create()?;
    list.push(path.to_owned());
    Ok(created)
}

/// Takes a file off the list: it has its final name, or was removed.
pub fn forget_unfinished(path: &Path) {
    list().retain(|unfinished| unfinished != path);
}

/// A name for a new file next to another one, which nobody can guess.
#[must_use]
pub fn unfinished_path(beside: &Path) -> PathBuf {
    // The keys of a new state come from the system's random numbers.
    let number = RandomState::new().hash_one(beside);
    beside.with_file_name(format!(".trigon-{number:016x}.part"))
}

/// Removes all files that are not finished. None is created or finished while the result exists.
#[cfg_attr(not(unix), expect(dead_code, reason = "there are no signals"))]
pub(crate) fn remove_unfinished() -> impl Sized {
    let mut list = list();
    for path in list.drain(..) {
        // One that is gone, or cannot be removed, leaves nothing to be done.
        let _ = fs::remove_file(path);
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_file_is_taken_for_a_new_one() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let (path, other) = (dir.path().join("a.part"), dir.path().join("other"));
        fs::write(&path, "somebody's").expect("a file");
        let refused = create_unfinished(&path).expect_err("it is there");
        assert_eq!(refused.kind(), io::ErrorKind::AlreadyExists);
        fs::remove_file(&path).expect("it was there");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&other, &path).expect("a link to nowhere");
            let refused = create_unfinished(&path).expect_err("a link is there");
            assert_eq!(refused.kind(), io::ErrorKind::AlreadyExists);
        }
        assert!(!other.exists(), "the link was not followed");
    }

    #[test]
    fn names_lie_beside_the_file_and_differ() {
        let [one, two] = [(); 2].map(|()| unfinished_path(Path::new("a/b.png")));
        assert_ne!(one, two, "nobody can guess them");
        assert_eq!(one.parent(), Some(Path::new("a")), "renamed within the folder");
        assert_eq!(unfinished_path(Path::new("b.png")).parent(), Some(Path::new("")), "here");
    }
}
