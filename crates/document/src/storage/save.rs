//! Saving a file so that at each moment either the old or the new version exists completely, with the
//! previous one as a backup.
//!
//! `trigon_io::write_atomically` writes images and exported models in the same order of steps, but
//! streams them and keeps no backup. It is not used here, because a document also needs the backup, the
//! old permissions and links, and because all steps go through [`Storage`] for the tests of crashes.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;
use trigon_io::unfinished_path;

use super::Storage;

/// Why a file was not saved.
#[derive(Debug, Error)]
#[error("{}: cannot be saved, {step} failed ({source}); {}: check that its folder is writable and has room, or save under another name", path.display(), outcome(*is_replaced))]
#[non_exhaustive]
pub struct SaveError {
    /// The file.
    pub path: PathBuf,
    /// The step that failed.
    pub step: &'static str,
    /// Whether the new file already has its name. Then only the folder was not synced: until it is, a power failure can
    /// bring the old file back.
    pub is_replaced: bool,
    /// The operating system's error.
    pub source: io::Error,
}

fn outcome(is_replaced: bool) -> &'static str {
    if is_replaced {
        "the new file is in place, but may be lost in a power failure"
    } else {
        "the file is as it was before"
    }
}

/// The path of the backup: the same name with `.bak` appended.
#[must_use]
pub fn backup_path(path: &Path) -> PathBuf {
    with_suffix(path, ".bak")
}

/// Saves a file: writes and syncs a new one next to it, keeps the old one as a backup, renames the new one,
/// and syncs the folder. A symbolic link is followed: its target is replaced. The new file has the
/// permissions of the old one; a read-only file is not replaced. If saving is interrupted anywhere, the path
/// still refers to the complete old or new contents; leftover files end in `.part`.
///
/// # Errors
/// The step that failed. The file is unchanged, unless [`SaveError::is_replaced`].
///
/// ```
/// use trigon_document::{Disk, backup_path, save};
///
/// let folder = std::env::temp_dir().join(format!("trigon-save-example-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let path = folder.join("chair.glb");
/// save(&mut Disk, &path, b"first")?;
/// save(&mut Disk, &path, b"second")?;
/// assert_eq!(std::fs::read(&path)?, b"second");
/// assert_eq!(std::fs::read(backup_path(&path))?, b"first");
/// std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn save(storage: &mut dyn Storage, path: &Path, bytes: &[u8]) -> Result<(), SaveError> {
    let target = storage.resolve(path);
    let new = write_new(storage, &target, bytes)?;
    if storage.exists(&target) {
        let copied = storage.keep_permissions(&target, &new);
        remove_on_failure(storage, &new, copied)
            .map_err(failed(path, "taking over the old file's permissions"))?;
        keep_backup(storage, &target).map_err(failed(path, "keeping the old file as a backup"))?;
    }
    give_name(storage, &new, &target)
}

/// The same without a backup.
pub(crate) fn replace(storage: &mut dyn Storage, path: &Path, bytes: &[u8]) -> Result<(), SaveError> {
    let new = write_new(storage, path, bytes)?;
    give_name(storage, &new, path)
}

fn failed(path: &Path, step: &'static str) -> impl FnOnce(io::Error) -> SaveError {
    move |source| SaveError { path: path.to_owned(), step, is_replaced: false, source }
}

/// Writes and syncs a file next to the one that it will replace.
pub(super) fn write_new(storage: &mut dyn Storage, path: &Path, bytes: &[u8]) -> Result<PathBuf, SaveError> {
    let new = unfinished_path(path);
    let written = storage.create(&new, bytes).and_then(|()| storage.sync(&new));
    remove_on_failure(storage, &new, written).map_err(failed(path, "writing the new file"))?;
    Ok(new)
}

/// Removes the new file after a failed step. If that fails too, the file does no harm.
fn remove_on_failure(storage: &mut dyn Storage, new: &Path, step: io::Result<()>) -> io::Result<()> {
    step.inspect_err(|_| drop(storage.remove(new)))
}

fn give_name(storage: &mut dyn Storage, new: &Path, path: &Path) -> Result<(), SaveError> {
    storage.rename(new, path).map_err(failed(path, "replacing the old file"))?;
    let synced = storage.sync_folder(folder_of(path)).map_err(failed(path, "syncing the folder"));
    synced.map_err(|error| SaveError { is_replaced: true, ..error })
}

pub(super) fn keep_backup(storage: &mut dyn Storage, target: &Path) -> io::Result<()> {
    let part = unfinished_path(target);
    if storage.link(target, &part).is_err() {
        // On file systems without hard links a copy takes longer, but is just as good.
        let old = storage.read(target)?;
        let copied = storage.create(&part, &old).and_then(|()| storage.sync(&part));
        remove_on_failure(storage, &part, copied)?;
    }
    let renamed = storage.rename(&part, &backup_path(target));
    remove_on_failure(storage, &part, renamed)?;
    // Where the backup is this very file already, after a save that failed later, renaming does nothing.
    if storage.exists(&part) { storage.remove(&part) } else { Ok(()) }
}

pub(super) fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.file_name().map_or_else(OsString::new, OsString::from);
    name.push(suffix);
    path.with_file_name(name)
}

pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::Disk;
    use super::super::failing::{FailingDisk, crashes};
    use super::*;

    /// Saves several versions one after another, and checks every state in which a crash can leave
    /// the disk.
    fn check_all_crashes(versions: &[Vec<u8>]) {
        let path = Path::new("/models/chair.glb");
        let mut disk = FailingDisk::default();
        let mut saved_after = Vec::new();
        for version in versions {
            save(&mut disk, path, version).expect("nothing fails");
            saved_after.push(disk.log().len());
        }
        for steps in 0..=disk.log().len() {
            // The number of versions that were certainly saved, with their folders synced.
            let certain = saved_after.iter().filter(|&&end| end <= steps).count();
            for state in crashes(&disk.log()[..steps]) {
                match state.get(path) {
                    None => assert_eq!(certain, 0, "after {steps} steps nothing is there"),
                    Some(bytes) => {
                        let found = versions.iter().position(|version| version == bytes);
                        let found = found.unwrap_or_else(|| panic!("after {steps} steps: a torn file"));
                        assert!(found + 1 >= certain, "after {steps} steps: version {found} of {certain}");
                    }
                }
                if let Some(backup) = state.get(&backup_path(path)) {
                    assert!(versions.contains(backup), "after {steps} steps: a torn backup");
                }
            }
        }
    }

    #[test]
    fn every_prefix_of_the_log_reopens_to_the_last_saved_or_a_newer_version() {
        check_all_crashes(&[b"first version".to_vec(), b"second".to_vec(), b"and a third one".to_vec()]);
    }

    #[test]
    fn a_disk_without_links_keeps_a_copy_as_backup() {
        let path = Path::new("/models/chair.glb");
        let mut disk = FailingDisk::without_links();
        save(&mut disk, path, b"first").expect("nothing fails");
        save(&mut disk, path, b"second").expect("nothing fails");
        assert_eq!(disk.read(&backup_path(path)).expect("there"), b"first", "the one before");
    }

    #[test]
    fn whatever_step_fails_the_old_file_is_there() {
        let path = Path::new("/models/chair.glb");
        let mut failures = 0;
        // More than there are; if the failed step was a hard link, a copy takes its place.
        for step in 0..12 {
            let mut disk = FailingDisk::default();
            save(&mut disk, path, b"first").expect("nothing fails");
            disk.fail_at(disk.log().len() + step);
            let saved = save(&mut disk, path, b"second");
            let bytes = disk.read(path).expect("there");
            assert!(bytes == b"first" || bytes == b"second", "one of both, whole");
            if let Err(error) = saved {
                failures += 1;
                let message = error.to_string();
                assert!(message.contains("chair.glb") && message.contains("failed"), "{message}");
                assert_eq!(bytes == b"second", error.is_replaced, "the error tells which of both is there");
            } else {
                assert_eq!(bytes, b"second", "what is said to be saved is saved");
            }
        }
        assert!(failures >= 5, "{failures} steps can fail");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_stay_and_read_only_files_are_not_replaced() {
        use std::fs::{self, Permissions};
        use std::os::unix::fs::{PermissionsExt, symlink};

        let folder = std::env::temp_dir().join(format!("trigon-permissions-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let (path, link) = (folder.join("chair.glb"), folder.join("link.glb"));
        symlink("chair.glb", &link).expect("a link");
        save(&mut Disk, &link, b"first").expect("a link may lead to where no file is yet");
        fs::set_permissions(&path, Permissions::from_mode(0o640)).expect("it exists");
        save(&mut Disk, &link, b"second").expect("through the link");
        assert_eq!(fs::read(&path).expect("saved"), b"second");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink(), "the link stays one");
        assert_eq!(fs::metadata(&path).expect("saved").permissions().mode() & 0o777, 0o640);
        fs::set_permissions(&path, Permissions::from_mode(0o440)).expect("it exists");
        let refused = save(&mut Disk, &path, b"third").expect_err("it is read-only");
        assert_eq!(refused.source.kind(), io::ErrorKind::PermissionDenied);
        assert_eq!(fs::read(&path).expect("still there"), b"second");
        assert_eq!(fs::read_dir(&folder).expect("there").count(), 3, "no new file is left over");
        fs::remove_dir_all(&folder).expect("ours");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn random_versions_survive_every_crash(
            versions in prop::collection::hash_set(prop::collection::vec(any::<u8>(), 1..40), 1..5),
        ) {
            check_all_crashes(&versions.into_iter().collect::<Vec<_>>());
        }
    }
}
