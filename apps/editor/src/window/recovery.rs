//! Recovery files: written in the background while somebody edits, and found after a crash.
//!
//! Each open document has a recovery file and a lock file that this process holds. If that lock is free, the
//! process that held it ended without closing its document. The lock file names the document's file, and says how
//! many events that file holds already.

use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use trigon_document::{Disk, Document, Event, RecoveryLog, RecoveryWriter};
use trigon_io::{FileIdentity, LoadOptions};
use trigon_window::{path_from_line, path_to_line};

/// The recovery file of the document that is open.
#[derive(Debug)]
pub(crate) struct Recovery {
    writer: Option<RecoveryWriter>,
    lock: PathBuf,
    /// The lock file, held for as long as the document is open.
    held: File,
    /// How many events were written down, and how many of them when the running save began.
    events: usize,
    in_save: usize,
    /// Whether somebody was told that nothing is written any more.
    has_reported: bool,
    /// The document's file, and whether somebody was told that another editor has it.
    document: Option<PathBuf>,
    has_reported_other: bool,
}

/// A document that was open when the editor ended without closing it.
#[derive(Debug)]
pub(crate) struct Left {
    file: PathBuf,
    lock: PathBuf,
    /// The file that the document had, if it had one.
    pub(crate) document: Option<PathBuf>,
    /// How many actions can be recovered that its file does not hold.
    pub(crate) actions: usize,
    /// Whether the last actions are missing because the end of the file is damaged or incomplete.
    pub(crate) is_cut_off: bool,
    _held: File,
}

impl Recovery {
    /// Starts to write down what is done to a document, in this folder. `None` if no file can be made there.
    pub(crate) fn start(folder: &Path, document: &mut Document, path: Option<&Path>) -> Option<Self> {
        let base = document.to_native().encode().ok()?.to_bytes();
        // From now on the document remembers its events.
        drop(document.take_events());
        Self::write(folder, RecoveryLog { base, events: Vec::new(), is_cut_off: false }, path)
    }

    /// Goes on with what was recovered: later events may undo those before, and build on what they selected.
    pub(crate) fn resume(
        folder: &Path,
        document: &mut Document,
        log: RecoveryLog,
        path: Option<&Path>,
    ) -> Option<Self> {
        drop(document.take_events());
        Self::write(folder, log, path)
    }

    fn write(folder: &Path, log: RecoveryLog, path: Option<&Path>) -> Option<Self> {
        fs::create_dir_all(folder).ok()?;
        let (name, mut held) = free_name(folder)?;
        let lock = folder.join(format!("{name}.lock"));
        write_lock(&mut held, 0, path).ok()?;
        let events = log.events.len();
        let file = folder.join(format!("{name}.recovery"));
        let writer = RecoveryWriter::start(Box::new(Disk), &file, log.base);
        log.events.into_iter().for_each(|event| writer.add(event));
        let document = path.map(Path::to_owned);
        let (in_save, has_reported, has_reported_other) = (0, false, false);
        let writer = Some(writer);
        Some(Self { writer, lock, held, events, in_save, has_reported, document, has_reported_other })
    }

    /// Writes down what was done since the last call. Returns what a user has to know, once.
    pub(crate) fn follow(&mut self, document: &mut Document) -> Option<String> {
        let writer = self.writer.as_ref()?;
        for event in document.take_events() {
            writer.add(event);
            self.events += 1;
        }
        let error = writer.status().error.filter(|_| !self.has_reported)?;
        self.has_reported = true;
        Some(error)
    }

    /// A save begins: it holds what was done so far.
    pub(crate) fn save_begins(&mut self, document: &mut Document) -> Option<String> {
        let error = self.follow(document);
        self.in_save = self.events;
        error
    }

    /// The document was saved to a file: only what came after is missing there.
    pub(crate) fn saved(&mut self, path: &Path) {
        // If that fails, more is offered after a crash than is needed, which loses nothing.
        drop(write_lock(&mut self.held, self.in_save, Some(path)));
        if self.document.as_deref() != Some(path) {
            (self.document, self.has_reported_other) = (Some(path.to_owned()), false);
        }
    }

    /// Whether another editor has the document's file open, once. Elsewhere than on Unix nobody may read what another
    /// process has locked, so it is not noticed there.
    pub(crate) fn notices_other_editor(&mut self) -> bool {
        let is_other = self.document.as_deref().is_some_and(|path| is_open_elsewhere(&self.lock, path));
        let is_new = is_other && !self.has_reported_other;
        self.has_reported_other = is_other;
        is_new
    }

    /// The document is closed: nothing of it is to be recovered.
    pub(crate) fn close(mut self) {
        if let Some(writer) = self.writer.take() {
            writer.remove();
        }
        drop(fs::remove_file(&self.lock));
    }
}

/// Writes how many events a document's file holds, and its path. Through the handle that holds the lock: elsewhere
/// than on Unix no other one may.
fn write_lock(held: &mut File, saved: usize, path: Option<&Path>) -> std::io::Result<()> {
    let path = path.map(path_to_line).unwrap_or_default();
    held.set_len(0)?;
    held.seek(SeekFrom::Start(0))?;
    held.write_all(format!("{saved}\n{path}").as_bytes())
}

/// What [`write_lock`] wrote.
fn read_lock(held: &mut File) -> std::io::Result<(usize, Option<PathBuf>)> {
    let mut text = String::new();
    held.read_to_string(&mut text)?;
    let (saved, path) = text.split_once('\n').unwrap_or_default();
    // What a relative path meant is not known any more: saving there could replace another file.
    let path = Some(path_from_line(path)).filter(|path| path.is_absolute());
    Ok((saved.parse().unwrap_or(0), path))
}

/// Whether a lock that another process holds, in the folder of this one's, names the same file.
fn is_open_elsewhere(own: &Path, document: &Path) -> bool {
    let Ok(wanted) = FileIdentity::of(document) else { return false };
    let entries = own.parent().and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
    let locks = entries
        .map(|entry| entry.path())
        .filter(|path| path != own && path.extension().is_some_and(|extension| extension == "lock"));
    let names_it = |lock: PathBuf| {
        let mut file = File::open(lock).ok()?;
        // A lock that nobody holds is what a crash left.
        file.try_lock_shared().is_err().then_some(())?;
        let (_, path) = read_lock(&mut file).ok()?;
        (FileIdentity::of(&path?).ok()? == wanted).then_some(())
    };
    locks.filter_map(names_it).next().is_some()
}

/// A name that no document has, with its lock.
fn free_name(folder: &Path) -> Option<(String, File)> {
    let process = std::process::id();
    (0..1000).find_map(|number| {
        let name = format!("{process}-{number}");
        let lock = File::create_new(folder.join(format!("{name}.lock"))).ok()?;
        lock.try_lock().ok()?;
        Some((name, lock))
    })
}

/// Recovery files whose start is damaged, so that nothing in them can be used. They are told of once: from now on they
/// have other names, which are returned.
pub(crate) fn set_damaged_aside(folder: &Path) -> Vec<PathBuf> {
    let set_aside = |file: PathBuf| {
        let _held = free_lock(&file)?;
        RecoveryLog::read(&fs::read(&file).ok()?).err()?;
        let aside = file.with_extension("damaged");
        fs::rename(&file, &aside).ok()?;
        // A lock without a file holds nothing.
        drop(fs::remove_file(file.with_extension("lock")));
        Some(aside)
    };
    recovery_files(folder).into_iter().filter_map(set_aside).collect()
}

fn recovery_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "recovery"));
    files.sort();
    files
}

/// The lock of a recovery file, held from now on; `None` while another process holds it.
fn free_lock(file: &Path) -> Option<File> {
    let lock = file.with_extension("lock");
    let held = File::options().read(true).write(true).create(true).truncate(false).open(lock).ok()?;
    held.try_lock().ok()?;
    Some(held)
}

impl Left {
    /// What was left in a folder with anything to recover.
    pub(crate) fn find(folder: &Path) -> Vec<Self> {
        recovery_files(folder).into_iter().filter_map(Self::of).collect()
    }

    fn of(file: PathBuf) -> Option<Self> {
        let (mut held, lock) = (free_lock(&file)?, file.with_extension("lock"));
        // A file that cannot be read stays where it is: nobody has seen what it holds.
        let RecoveryLog { events, is_cut_off, .. } = RecoveryLog::read(&fs::read(&file).ok()?).ok()?;
        let changes = |event: &&Event| !matches!(event, Event::Run(command) if command.is_selection());
        let (saved, document) = read_lock(&mut held).ok()?;
        let actions = events.iter().skip(saved).filter(changes).count();
        let left = Self { file, lock, document, actions, is_cut_off, _held: held };
        if actions == 0 {
            left.discard();
            return None;
        }
        Some(left)
    }

    /// The document as it was, and what it was made from.
    ///
    /// # Errors
    /// Why not, for people.
    pub(crate) fn recover(&self) -> Result<(Document, RecoveryLog), String> {
        let bytes = fs::read(&self.file).map_err(|error| format!("{}: {error}", self.file.display()))?;
        let log = RecoveryLog::read(&bytes).map_err(|error| error.to_string())?;
        let name = self.document.as_deref().unwrap_or(Path::new("untitled.glb"));
        let (mut document, _) = Document::open_bytes(name, &log.base, &LoadOptions::default())
            .map_err(|error| error.to_string())?;
        // What was allowed then is allowed again.
        document.set_memory(u64::MAX);
        document.replay(&log.events).map_err(|error| error.to_string())?;
        Ok((document, log))
    }

    /// Nobody wants it.
    pub(crate) fn discard(&self) {
        drop(fs::remove_file(&self.file));
        drop(fs::remove_file(&self.lock));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(json: &str) -> trigon_document::Command {
        serde_json::from_str(json).expect("a command")
    }

    #[test]
    fn what_a_crash_leaves_is_found_once_and_comes_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        let mut document = Document::new(trigon_document::scene::showcase());
        let before = document.nodes().nodes().len();
        let path = Path::new("/models/chair.glb");
        let mut recovery = Recovery::start(folder, &mut document, Some(path)).expect("it can be written");
        document
            .run(command(r#"{"op":"add_object","object":{"shape":"cube","edge":2.0}}"#))
            .expect("possible");
        assert_eq!(recovery.follow(&mut document), None, "nothing goes wrong");
        assert!(Left::find(folder).is_empty(), "its process is alive");
        // A crash: the file stays, and the lock is free.
        drop(recovery);
        let left = Left::find(folder);
        let [left] = &left[..] else { panic!("one document was open: {left:?}") };
        assert_eq!((left.document.as_deref(), left.actions), (Some(path), 1), "what and how much");
        let (mut again, log) = left.recover().expect("it was written whole");
        assert_eq!(again.scene().nodes().len(), before + 1, "the cube is there");
        left.discard();
        assert!(Left::find(folder).is_empty(), "and it is not offered again");
        // The next crash comes after an undo of what was done before the first.
        let mut recovery = Recovery::resume(folder, &mut again, log, Some(path)).expect("it can be written");
        again.undo().expect("the cube was added");
        again.run(command(r#"{"op":"add_light"}"#)).expect("possible");
        assert_eq!(recovery.follow(&mut again), None, "nothing goes wrong");
        drop(recovery);
        let (third, _) = Left::find(folder)[0].recover().expect("undo finds what it undoes");
        let names = |document: &Document| -> Vec<String> {
            document.nodes().nodes().iter().map(|(_, node)| node.name.clone()).collect()
        };
        assert_eq!(names(&third), names(&again), "the light, and no cube");
    }

    /// Once a new document was saved after a crash, it was offered as one without a file, with all changes.
    #[test]
    fn what_a_file_holds_is_not_offered_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        let add = || command(r#"{"op":"add_object","object":{"shape":"cube","edge":2.0}}"#);
        let mut document = Document::default();
        let crash = |document: &mut Document, later: usize| {
            let mut recovery = Recovery::start(folder, document, None).expect("it can be written");
            document.run(add()).expect("possible");
            assert_eq!(recovery.save_begins(document), None, "nothing goes wrong");
            for _ in 0..later {
                document.run(add()).expect("possible");
            }
            recovery.saved(Path::new("/models/box.glb"));
            assert_eq!(recovery.follow(document), None, "nothing goes wrong");
        };
        crash(&mut document, 0);
        assert!(Left::find(folder).is_empty(), "all of it is in the file");
        crash(&mut document, 2);
        let left = Left::find(folder);
        let [left] = &left[..] else { panic!("one document was open: {left:?}") };
        assert_eq!(left.document.as_deref(), Some(Path::new("/models/box.glb")), "it has a file now");
        assert_eq!(left.actions, 2, "those after the save");
        let (mut again, _) = left.recover().expect("it was written whole");
        assert_eq!(again.scene().nodes().len(), document.scene().nodes().len(), "and all are recovered");
    }

    /// A document that was opened by a relative name came back under that name in whatever folder the editor was started
    /// from, and was saved over a file that had nothing to do with it.
    #[test]
    fn a_recovered_document_goes_back_to_its_own_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        let mut document = Document::default();
        let mut crash = |path: Option<&Path>| {
            let mut recovery = Recovery::start(folder, &mut document, path).expect("it can be written");
            document.run(command(r#"{"op":"add_light"}"#)).expect("possible");
            assert_eq!(recovery.follow(&mut document), None, "nothing goes wrong");
        };
        crash(Some(Path::new("chair.glb")));
        let absolute = std::env::current_dir().expect("a folder").join("chair.glb");
        let left = Left::find(folder);
        assert_eq!(left[0].document.as_deref(), Some(absolute.as_path()), "from any folder");
        left[0].discard();
        drop(left);
        // A lock file of an older version has what was typed: nobody knows where that was.
        crash(None);
        let lock = recovery_files(folder)[0].with_extension("lock");
        fs::write(&lock, "0\nchair.glb").expect("it can be written");
        assert_eq!(Left::find(folder)[0].document, None, "it asks where to save");
    }

    #[cfg(unix)]
    #[test]
    fn two_editors_on_one_file_learn_of_each_other_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let [path, other] = ["a.glb", "b.glb"].map(|name| folder.path().join(name));
        fs::write(&path, "").expect("written");
        fs::hard_link(&path, folder.path().join("second name.glb")).expect("linked");
        fs::write(&other, "").expect("written");
        let start = |path: &Path| {
            Recovery::start(folder.path(), &mut Document::default(), Some(path)).expect("it can be written")
        };
        let mut first = start(&path);
        assert!(!first.notices_other_editor(), "it is alone");
        let second = start(&other);
        assert!(!first.notices_other_editor(), "the other has another file");
        let mut third = start(&folder.path().join("second name.glb"));
        assert_eq!([first.notices_other_editor(), first.notices_other_editor()], [true, false], "once");
        assert!(third.notices_other_editor(), "under another name of the file, too");
        third.close();
        assert!(!first.notices_other_editor(), "it is alone again");
        second.close();
    }

    #[test]
    fn a_damaged_end_is_told_and_a_damaged_start_is_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        let mut document = Document::default();
        let mut recovery = Recovery::start(folder, &mut document, None).expect("it can be written");
        for _ in 0..2 {
            document
                .run(command(r#"{"op":"add_object","object":{"shape":"cube","edge":2.0}}"#))
                .expect("possible");
        }
        assert_eq!(recovery.follow(&mut document), None, "nothing goes wrong");
        drop(recovery);
        let file = {
            let left = Left::find(folder);
            assert!(!left[0].is_cut_off, "it was written whole");
            left[0].file.clone()
        };
        let bytes = fs::read(&file).expect("it is there");
        fs::write(&file, &bytes[..bytes.len() - 5]).expect("it can be written");
        {
            let left = Left::find(folder);
            assert_eq!((left[0].actions, left[0].is_cut_off), (1, true), "the second cube is incomplete");
        }
        let mut damaged = bytes.clone();
        damaged[20] ^= 1;
        fs::write(&file, &damaged).expect("it can be written");
        assert!(Left::find(folder).is_empty(), "there is nothing to offer");
        assert_eq!(fs::read(&file).expect("it is still there"), damaged, "nothing was deleted");
        let aside = set_damaged_aside(folder);
        assert_eq!(aside, [file.with_extension("damaged")], "it is named");
        assert_eq!(fs::read(&aside[0]).expect("it is there"), damaged, "and kept");
        assert!(set_damaged_aside(folder).is_empty(), "once");
    }

    #[test]
    fn the_base_of_a_recovery_file_numbers_objects_as_the_document_does() {
        let document = Document::new(trigon_document::scene::showcase());
        let base = document.to_native().encode().expect("small").to_bytes();
        let (again, _) =
            Document::open_bytes(Path::new("a.glb"), &base, &LoadOptions::default()).expect("ours");
        let names = |document: &Document| -> Vec<(usize, String)> {
            let nodes = document.nodes().nodes().iter();
            nodes.map(|(id, node)| (id.index(), node.name.clone())).collect()
        };
        assert_eq!(names(&again), names(&document), "commands name objects by number");
    }

    #[test]
    fn a_document_that_was_closed_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut document = Document::default();
        Recovery::start(folder.path(), &mut document, None).expect("it can be written").close();
        assert_eq!(fs::read_dir(folder.path()).expect("it is there").count(), 0, "no file");
        let mut untouched = Document::default();
        drop(Recovery::start(folder.path(), &mut untouched, None));
        assert!(Left::find(folder.path()).is_empty(), "nothing was done, so nothing is offered");
    }
}
