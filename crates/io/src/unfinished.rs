//! Files that are written under a temporary name, so that a program that is told to end leaves none of them;
//! and whether two names are the same file.

use std::fs::{File, OpenOptions};
use std::hash::{BuildHasher, RandomState};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::{fs, io};

static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn list() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Creates a file that must not exist yet, not even as a link, and that [`end_on_signals`]
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

/// From now on, a program that is interrupted (Ctrl+C), terminated or hung up removes its [temporary
/// files](crate::create_unfinished) before it ends as it would have ended anyway. A shell sees the exit codes
/// 130, 143 and 129. Signals that the program was started to ignore stay ignored. For programs, not for
/// libraries; to be called once, at their start. Does nothing where there are no such signals.
///
/// # Errors
/// The system refuses to tell of signals, or has no room for a thread.
pub fn end_on_signals() -> io::Result<()> {
    #[cfg(unix)]
    unix::end_on_signals()?;
    Ok(())
}

#[cfg(unix)]
mod unix {
    use std::{io, thread};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    use super::remove_unfinished;

    pub(super) fn end_on_signals() -> io::Result<()> {
        let ignored = ignored();
        let is_ignored = |signal: i32| ignored >> (signal - 1) & 1 == 1;
        let wanted = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|&signal| !is_ignored(signal));
        let mut signals = Signals::new(wanted)?;
        let end = move || {
            for signal in signals.forever() {
                // Nothing is finished or created any more while the program ends.
                let _nothing_more = remove_unfinished();
                // It fails for signals only that do not exist.
                let _ = emulate_default_handler(signal);
            }
        };
        thread::Builder::new().name("trigon-signals".into()).spawn(end).map(drop)
    }

    /// A bit for each signal that is ignored, such as hang-ups under `nohup`. Where the system does not tell it in this
    /// file, none counts as ignored.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }
}

/// What a file is, whatever names it has. While the file exists, no other one is equal.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FileIdentity(Identity);

/// The device and the number of the file on it.
#[cfg(unix)]
type Identity = [u64; 2];

/// The path without links: a second name of the same file is not recognized.
#[cfg(not(unix))]
type Identity = PathBuf;

impl FileIdentity {
    /// Of the file that a path leads to.
    ///
    /// # Errors
    /// There is none, or an error of the operating system.
    pub fn of(path: &Path) -> io::Result<Self> {
        identity(path).map(Self)
    }
}

#[cfg(unix)]
fn identity(path: &Path) -> io::Result<Identity> {
    use std::os::unix::fs::MetadataExt;
    let metadata = fs::metadata(path)?;
    Ok([metadata.dev(), metadata.ino()])
}

#[cfg(not(unix))]
fn identity(path: &Path) -> io::Result<Identity> {
    fs::canonicalize(path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

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

    #[test]
    fn all_names_of_a_file_are_one_identity() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| dir.path().join(name);
        fs::create_dir(at("folder")).expect("a folder");
        fs::write(at("a"), "same").expect("a file");
        fs::write(at("b"), "same").expect("a file");
        let identity = |name: &str| FileIdentity::of(&at(name)).expect("it is there");
        assert_ne!(identity("a"), identity("b"), "equal contents are no identity");
        assert_eq!(identity("a"), identity("folder/../a"), "another way there");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("../a", at("folder/link")).expect("a link");
            fs::hard_link(at("a"), at("folder/second")).expect("a second name");
            assert_eq!(identity("a"), identity("folder/link"), "through a link");
            assert_eq!(identity("a"), identity("folder/second"), "by another name");
        }
        FileIdentity::of(&at("c")).expect_err("nothing is there");
    }
}
