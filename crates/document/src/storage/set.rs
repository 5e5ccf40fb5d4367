//! Saving files that refer to each other, as an OBJ with its MTL and its images: after a failure or a crash all of them
//! are the old ones, or all are the new ones.
//!
//! No file system renames several files in one step. So all new files are written beside their targets first, then a
//! journal that lists them is put beside the main file: from then on the new set counts. Each file is renamed, and the
//! journal is removed. What a crash interrupts between these, the next saving or opening finishes by the journal. A
//! failure is rolled back: each file that was renamed gets its temporary name back before the old one returns from its
//! backup, so that the journal still leads to the whole new set, until it is removed and all is as before.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;
use trigon_io::unfinished_path;

use super::Storage;
use super::save::{SaveError, backup_path, folder_of, keep_backup, replace, save, with_suffix, write_new};

const NEW: &str = ".trigon-new";
const JOURNAL: &str = ".trigon-set";

/// A file of a set.
#[derive(Debug, Clone)]
pub struct SetFile<'b> {
    /// Where it is saved.
    pub path: PathBuf,
    /// Its contents.
    pub bytes: &'b [u8],
}

/// What is on the disk after a set of files was not saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SetState {
    /// All files are as they were.
    Old,
    /// All new files are in place, but a power failure may bring the old ones back.
    New,
    /// Some files are new and some old. The next saving or opening of the main file completes the new set.
    Pending,
}

/// Why a set of files was not saved.
#[derive(Debug, Error)]
#[error("{}: cannot be saved, {step} failed ({source}); {}", path.display(), outcome(*state))]
#[non_exhaustive]
pub struct SetError {
    /// The file.
    pub path: PathBuf,
    /// The step that failed.
    pub step: &'static str,
    /// What is on the disk now.
    pub state: SetState,
    /// The operating system's error.
    pub source: io::Error,
}

fn outcome(state: SetState) -> &'static str {
    match state {
        SetState::Old => {
            "all files are as they were before: check that the folder is writable and has room, or save under another name"
        }
        SetState::New => "the new files are in place, but may be lost in a power failure: save again",
        SetState::Pending => {
            "some files are new and some are not: opening or saving it again with trigon-editor completes the new ones"
        }
    }
}

impl From<SaveError> for SetError {
    fn from(error: SaveError) -> Self {
        let state = if error.is_replaced { SetState::New } else { SetState::Old };
        Self { path: error.path, step: error.step, state, source: error.source }
    }
}

/// Saves files that belong together, the one that refers to the others last: each as [`save`] does, with a backup of the
/// old one, and all of them or none. Files whose contents are there already are left alone.
///
/// # Errors
/// The step that failed, and what is on the disk now.
pub fn save_set(storage: &mut dyn Storage, files: &[SetFile<'_>]) -> Result<(), SetError> {
    let Some(main) = files.last() else { return Ok(()) };
    finish_set(storage, &main.path)?;
    let is_other = |file: &&SetFile<'_>| storage.read(&file.path).ok().as_deref() != Some(file.bytes);
    let changed: Vec<&SetFile<'_>> = files.iter().filter(is_other).collect();
    if let [] | [_] = changed[..] {
        let saved = changed.into_iter().try_for_each(|file| save(storage, &file.path, file.bytes));
        return Ok(saved?);
    }
    let mut set = Set { journal: journal_path(storage, &main.path), replaced: Vec::new() };
    for file in changed {
        if let Err((step, source)) = set.prepare(storage, file) {
            return Err(set.give_up(storage, &file.path, step, source));
        }
    }
    if let Err(source) = set.commit(storage) {
        return Err(set.give_up(storage, &main.path, "listing the new files", source));
    }
    set.rename_all(storage)?;
    if let Err(source) = set.sync(storage) {
        let path = main.path.clone();
        return Err(SetError { path, step: "syncing the folder", state: SetState::New, source });
    }
    // Without files to rename it leads to nothing.
    let _ = storage.remove(&set.journal);
    Ok(())
}

/// Completes the set that belongs to a main file, if saving it was interrupted. Returns whether it was.
///
/// # Errors
/// A file could not be renamed. The next call goes on.
pub fn finish_set(storage: &mut dyn Storage, main: &Path) -> Result<bool, SetError> {
    let journal = journal_path(storage, main);
    if !storage.exists(&journal) {
        return Ok(false);
    }
    let failed = |path: &Path, source: io::Error| {
        let step = "completing what was interrupted";
        SetError { path: path.to_owned(), step, state: SetState::Pending, source }
    };
    let bytes = storage.read(&journal).map_err(|source| failed(&journal, source))?;
    // Another program's file of that name leads to nothing.
    let Ok(names) = serde_json::from_slice::<Vec<String>>(&bytes) else { return Ok(false) };
    let folder = folder_of(&journal).to_owned();
    for new in names.iter().map(|name| folder.join(name)) {
        let name = new.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Some(target) = name.strip_suffix(NEW).map(|name| new.with_file_name(name)) else { continue };
        if storage.exists(&new) {
            storage.rename(&new, &target).map_err(|source| failed(&target, source))?;
            storage.sync_folder(folder_of(&target)).map_err(|source| failed(&target, source))?;
        }
    }
    storage.remove(&journal).map_err(|source| failed(&journal, source))?;
    Ok(true)
}

fn journal_path(storage: &dyn Storage, main: &Path) -> PathBuf {
    with_suffix(&storage.resolve(main), JOURNAL)
}

/// A file of the set that has its temporary name.
struct Replaced {
    target: PathBuf,
    new: PathBuf,
    /// Whether there is an old one.
    was_there: bool,
}

struct Set {
    journal: PathBuf,
    replaced: Vec<Replaced>,
}

type Step = (&'static str, io::Error);

impl Set {
    /// Writes a new file beside its target, and keeps the old one as a backup.
    fn prepare(&mut self, storage: &mut dyn Storage, file: &SetFile<'_>) -> Result<(), Step> {
        let target = storage.resolve(&file.path);
        let new = with_suffix(&target, NEW);
        let part = write_new(storage, &target, file.bytes).map_err(|error| (error.step, error.source))?;
        let was_there = storage.exists(&target);
        let mut prepared = Ok(());
        if was_there {
            let retained = storage.keep_permissions(&target, &part);
            prepared =
                retained.map_err(|error| ("taking over the old file's permissions", error)).and_then(|()| {
                    let retained = keep_backup(storage, &target);
                    retained.map_err(|error| ("keeping the old file as a backup", error))
                });
        }
        // From here on it is no temporary file any more, which a signal would remove.
        let renamed = prepared
            .and_then(|()| storage.rename(&part, &new).map_err(|error| ("writing the new file", error)));
        renamed.inspect_err(|_| drop(storage.remove(&part)))?;
        self.replaced.push(Replaced { target, new, was_there });
        Ok(())
    }

    /// Writes the journal: now the new set counts.
    fn commit(&self, storage: &mut dyn Storage) -> io::Result<()> {
        self.sync(storage)?;
        let folder = folder_of(&self.journal);
        let name = |file: &Replaced| {
            let name =
                if folder_of(&file.new) == folder { Path::new(file.new.file_name()?) } else { &file.new };
            name.to_str().map(str::to_owned)
        };
        let names: Option<Vec<String>> = self.replaced.iter().map(name).collect();
        let text = names.and_then(|names| serde_json::to_vec(&names).ok());
        let text =
            text.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "a name is no Unicode text"))?;
        replace(storage, &self.journal, &text).map_err(|error| error.source)
    }

    fn rename_all(&self, storage: &mut dyn Storage) -> Result<(), SetError> {
        for (done, file) in self.replaced.iter().enumerate() {
            let Err(source) = storage.rename(&file.new, &file.target) else { continue };
            if !storage.exists(&file.new) && storage.exists(&file.target) {
                // Another program that opened the set has completed it.
                continue;
            }
            let is_back = self.roll_back(storage, done).is_ok();
            let state = if is_back { SetState::Old } else { SetState::Pending };
            let (path, step) = (file.target.clone(), "replacing the old file");
            return Err(SetError { path, step, state, source });
        }
        Ok(())
    }

    /// Gives the first files their temporary names back, restores the old ones, and forgets the new set.
    fn roll_back(&self, storage: &mut dyn Storage, done: usize) -> io::Result<()> {
        for file in self.replaced[..done].iter().rev() {
            storage.rename(&file.target, &file.new)?;
            if file.was_there {
                restore(storage, &file.target)?;
            }
        }
        self.sync(storage)?;
        self.forget(storage)
    }

    /// Removes the journal, and then the new files.
    fn forget(&self, storage: &mut dyn Storage) -> io::Result<()> {
        if storage.exists(&self.journal) {
            storage.remove(&self.journal)?;
            storage.sync_folder(folder_of(&self.journal))?;
        }
        // If that fails they do no harm.
        self.replaced.iter().for_each(|file| drop(storage.remove(&file.new)));
        Ok(())
    }

    /// Before anything was renamed.
    fn give_up(
        &self,
        storage: &mut dyn Storage,
        path: &Path,
        step: &'static str,
        source: io::Error,
    ) -> SetError {
        let state = if self.forget(storage).is_ok() { SetState::Old } else { SetState::Pending };
        SetError { path: path.to_owned(), step, state, source }
    }

    fn sync(&self, storage: &mut dyn Storage) -> io::Result<()> {
        let mut folders: Vec<&Path> = self.replaced.iter().map(|file| folder_of(&file.target)).collect();
        folders.dedup();
        folders.into_iter().try_for_each(|folder| storage.sync_folder(folder))
    }
}

/// Puts the backup of a file in its place, and keeps the backup.
fn restore(storage: &mut dyn Storage, target: &Path) -> io::Result<()> {
    let (backup, part) = (backup_path(target), unfinished_path(target));
    if storage.link(&backup, &part).is_err() {
        let old = storage.read(&backup)?;
        storage.create(&part, &old).and_then(|()| storage.sync(&part))?;
        storage.keep_permissions(&backup, &part)?;
    }
    storage.rename(&part, target)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::ffi::OsString;

    use super::super::failing::{FailingDisk, Files, crashes};
    use super::*;

    const NAMES: [&str; 3] = ["/models/red.png", "/models/chair.mtl", "/models/chair.obj"];

    fn set(version: &'static str) -> Vec<SetFile<'static>> {
        // The image of the third version is the second's.
        let bytes = |name: &str| -> &'static [u8] {
            match (version, name.ends_with(".png")) {
                ("first", true) => b"an image",
                (_, true) => b"another one",
                ("first", false) if name.ends_with(".mtl") => b"library of the first",
                ("first", false) => b"model of the first",
                ("second", false) if name.ends_with(".mtl") => b"the second library",
                ("second", false) => b"the second model",
                (_, false) if name.ends_with(".mtl") => b"library 3",
                (_, false) => b"model 3",
            }
        };
        NAMES.map(|name| SetFile { path: name.into(), bytes: bytes(name) }).to_vec()
    }

    /// Which version is on the disk; panics at a mixture.
    fn version(files: &Files, occasion: &str) -> Option<&'static str> {
        let found: Vec<Option<&Vec<u8>>> = NAMES.iter().map(|name| files.get(Path::new(name))).collect();
        if found.iter().all(Option::is_none) {
            return None;
        }
        let is = |version: &&'static str| {
            let version = set(version);
            found.iter().zip(&version).all(|(found, file)| found.is_some_and(|bytes| bytes == file.bytes))
        };
        let known = ["first", "second", "third"].into_iter().find(is);
        Some(known.unwrap_or_else(|| panic!("{occasion}: a mixture of versions: {found:?}")))
    }

    fn main() -> &'static Path {
        Path::new(NAMES[2])
    }

    /// What is there after the program is started again on these files.
    fn reopened(files: &Files, occasion: &str) -> Option<&'static str> {
        let mut disk = FailingDisk::with_files(files);
        finish_set(&mut disk, main()).expect("nothing fails");
        let leftover = disk.files().keys().any(|path| path.to_string_lossy().ends_with(JOURNAL));
        assert!(!leftover, "{occasion}: the journal is gone");
        version(&disk.files(), occasion)
    }

    #[test]
    fn every_crash_leaves_the_old_set_or_the_new_one() {
        let mut disk = FailingDisk::default();
        let mut saved_after = Vec::new();
        for version in ["first", "second", "third"] {
            save_set(&mut disk, &set(version)).expect("nothing fails");
            saved_after.push(disk.log().len());
        }
        let mut seen = BTreeSet::new();
        for steps in 0..=disk.log().len() {
            let certain = saved_after.iter().filter(|&&end| end <= steps).count();
            for files in crashes(&disk.log()[..steps]) {
                let found = reopened(&files, &format!("after {steps} steps"));
                let index = ["first", "second", "third"].iter().position(|version| Some(*version) == found);
                assert!(index.map_or(0, |index| index + 1) >= certain, "after {steps} steps: {found:?}");
                seen.insert(found);
            }
        }
        assert_eq!(seen.len(), 4, "nothing, and each version: {seen:?}");
    }

    #[test]
    fn finishing_is_interrupted_anywhere_and_done_again() {
        let mut disk = FailingDisk::default();
        save_set(&mut disk, &set("first")).expect("nothing fails");
        let start = disk.log().len();
        save_set(&mut disk, &set("second")).expect("nothing fails");
        for steps in start..disk.log().len() {
            for files in crashes(&disk.log()[..steps]) {
                let mut again = FailingDisk::with_files(&files);
                let before = again.log().len();
                let _ = finish_set(&mut again, main());
                for stop in before..again.log().len() {
                    for files in crashes(&again.log()[..stop]) {
                        reopened(&files, &format!("after {steps} steps and {stop} of finishing"));
                    }
                }
            }
        }
    }

    /// `fails` prepares the disk to fail from a step on, or at it alone.
    fn check_failures(fails: fn(&mut FailingDisk, usize), start: fn() -> FailingDisk) -> BTreeSet<String> {
        let mut states = BTreeSet::new();
        for step in 0.. {
            let mut disk = start();
            save_set(&mut disk, &set("first")).expect("nothing fails");
            let first = disk.log().len();
            fails(&mut disk, first + step);
            let saved = save_set(&mut disk, &set("second"));
            let files = disk.files();
            let occasion = format!("failed at step {step}");
            let found = reopened(&files, &occasion);
            match &saved {
                Ok(()) => assert_eq!(found, Some("second"), "{occasion}: what is said to be saved is saved"),
                Err(error) => {
                    states.insert(format!("{:?}", error.state));
                    let expected = if error.state == SetState::Old { "first" } else { "second" };
                    assert_eq!(found, Some(expected), "{occasion}: {error}");
                    if error.state != SetState::Pending {
                        assert_eq!(version(&files, &occasion), found, "{occasion}: at once");
                    }
                }
            }
            // A power failure after the failure.
            for files in crashes(disk.log()) {
                reopened(&files, &occasion);
            }
            if saved.is_ok() && !disk.has_failed() {
                assert!(step > 15, "{step} steps can fail");
                break;
            }
        }
        states
    }

    #[test]
    fn whatever_step_fails_the_message_tells_which_set_is_there() {
        let states = check_failures(FailingDisk::fail_at, FailingDisk::default);
        assert!(states.contains("Old") && states.contains("New"), "{states:?}");
        check_failures(FailingDisk::fail_at, FailingDisk::without_links);
    }

    #[test]
    fn whenever_the_disk_dies_the_next_start_finds_a_whole_set() {
        let states = check_failures(FailingDisk::die_at, FailingDisk::default);
        assert!(states.contains("Pending"), "{states:?}");
    }

    #[test]
    fn a_set_on_a_real_disk_is_replaced_with_backups_and_no_leftovers() {
        let folder = std::env::temp_dir().join(format!("trigon-set-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let files = |texts: [&'static str; 2]| -> Vec<SetFile<'static>> {
            let file =
                |name: &str, text: &'static str| SetFile { path: folder.join(name), bytes: text.as_bytes() };
            vec![file("a.mtl", texts[0]), file("a.obj", texts[1])]
        };
        for texts in [["one", "1"], ["two", "2"]] {
            save_set(&mut super::super::Disk, &files(texts)).expect("saved");
        }
        let listed = std::fs::read_dir(&folder).expect("there");
        let names: BTreeSet<OsString> = listed.map(|entry| entry.expect("an entry").file_name()).collect();
        let expected = ["a.mtl", "a.mtl.bak", "a.obj", "a.obj.bak"].map(OsString::from);
        assert_eq!(names, expected.into(), "nothing else");
        assert_eq!(std::fs::read(folder.join("a.obj.bak")).expect("retained"), b"1");
        assert_eq!(std::fs::read(folder.join("a.mtl")).expect("there"), b"two");
        std::fs::remove_dir_all(&folder).expect("ours");
    }
}
