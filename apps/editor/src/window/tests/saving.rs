//! What happens while a document is being saved. The disk waits at a gate that the test opens.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};

use trigon_document::{Disk, Storage};

use super::*;
use crate::request::{FileAction, FileRequest};
use crate::window::open_file::{Answer, Question};

/// A disk that writes nothing before it is let, once for each save.
struct GatedDisk(Arc<Mutex<Receiver<()>>>);

impl Storage for GatedDisk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        Disk.read(path)
    }

    fn exists(&self, path: &Path) -> bool {
        Disk.exists(path)
    }

    fn create(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let let_through = self.0.lock().expect("no save panics").recv();
        let_through.map_err(io::Error::other)?;
        Disk.create(path, bytes)
    }

    fn append(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        Disk.append(path, bytes)
    }

    fn sync(&mut self, path: &Path) -> io::Result<()> {
        Disk.sync(path)
    }

    fn link(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        Disk.link(from, to)
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        Disk.rename(from, to)
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        Disk.remove(path)
    }

    fn sync_folder(&mut self, path: &Path) -> io::Result<()> {
        Disk.sync_folder(path)
    }
}

/// An editor whose saves wait for the sender; without one they fail.
fn gated() -> (Worked, Sender<()>) {
    let mut worked = Worked::new();
    let (gate, waits) = channel();
    let waits = Arc::new(Mutex::new(waits));
    worked.editor.storage = Box::new(move || Box::new(GatedDisk(Arc::clone(&waits))));
    (worked, gate)
}

impl Worked {
    fn file(&mut self, request: FileRequest) {
        self.editor.perform(&mut self.stage, Request::File(request));
    }

    /// Something that has to be saved.
    fn change(&mut self) {
        self.character('a');
        self.key(WindowKey::Character('d'), Modifiers::SHIFT);
        self.key(WindowKey::Escape, Modifiers::NONE);
    }

    fn finish_save(&mut self) {
        finish_save(&mut self.editor, &mut self.stage);
    }
}

fn count_of_objects(path: &Path) -> usize {
    let (document, _) = trigon_document::Document::open(path, &Default::default()).expect("it was saved");
    document.nodes().nodes().len()
}

#[test]
fn the_window_goes_on_while_it_saves_and_the_file_has_what_was_there_when_that_began() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("chair.glb");
    let (mut worked, gate) = gated();
    worked.change();
    worked.file(FileRequest::SaveAs(path.clone()));
    worked.change();
    assert_eq!(worked.objects(), 8, "twice as many, twice");
    assert_eq!(worked.stage.title(), "*untitled - trigon", "nothing is saved yet");
    gate.send(()).expect("it waits");
    worked.finish_save();
    assert_eq!(worked.stage.title(), "*chair.glb - trigon", "the second change is not in it");
    assert_eq!(count_of_objects(&path), 4, "the first is");
    worked.key(WindowKey::Character('z'), Modifiers::CTRL);
    assert_eq!(worked.stage.title(), "chair.glb - trigon", "undone, the file has it all");
}

#[test]
fn what_another_program_wrote_is_replaced_only_after_a_question() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("chair.glb");
    let mut worked = Worked::new();
    worked.file(FileRequest::SaveAs(path.clone()));
    worked.finish_save();
    let theirs = b"by another program";
    std::fs::write(&path, theirs).expect("written");
    worked.editor.notice_others();
    assert!(worked.refusal().contains("was changed by another program"), "{}", worked.refusal());
    worked.change();
    worked.file(FileRequest::Ask(FileAction::Save));
    assert!(matches!(worked.editor.question, Some(Question::ChangedOnDisk(_))), "a question");
    worked.editor.answer(&mut worked.stage, Answer::Cancel);
    assert_eq!(std::fs::read(&path).expect("it is there"), theirs, "nothing was written");
    worked.file(FileRequest::Ask(FileAction::Save));
    worked.editor.answer(&mut worked.stage, Answer::Yes);
    worked.finish_save();
    assert_eq!(count_of_objects(&path), worked.objects(), "overwritten");
    // The next save is of our own file.
    worked.change();
    worked.file(FileRequest::Ask(FileAction::Save));
    assert!(worked.editor.question.is_none(), "no question");
    worked.finish_save();
    // And a reload gives what is there.
    worked.change();
    let objects = count_of_objects(&path);
    let file = std::fs::File::options().write(true).open(&path).expect("it is there");
    file.set_modified(std::time::SystemTime::UNIX_EPOCH).expect("as if it had been written then");
    worked.file(FileRequest::Ask(FileAction::Save));
    worked.editor.answer(&mut worked.stage, Answer::Reload);
    finish_load(&mut worked.editor, &mut worked.stage);
    assert_eq!(worked.objects(), objects, "as it is in the file");
}

#[test]
fn closing_during_a_save_waits_for_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("chair.glb");
    let (mut worked, gate) = gated();
    worked.change();
    worked.file(FileRequest::SaveAs(path.clone()));
    worked.file(FileRequest::Ask(FileAction::New));
    assert!(worked.editor.question.is_none(), "it is being saved: nothing is to be asked");
    assert_eq!(worked.objects(), 4, "but it is not gone yet");
    worked.key(WindowKey::Character('x'), Modifiers::NONE);
    assert_eq!(worked.objects(), 4, "nothing is done that would be lost");
    gate.send(()).expect("it waits");
    worked.finish_save();
    assert_eq!((worked.objects(), count_of_objects(&path)), (2, 4), "saved, and another document");
}

#[test]
fn a_save_that_fails_closes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut worked, gate) = gated();
    worked.change();
    worked.file(FileRequest::SaveAs(folder.path().join("chair.glb")));
    worked.file(FileRequest::Ask(FileAction::New));
    drop(gate);
    worked.finish_save();
    assert_eq!(worked.objects(), 4, "all is there");
    assert!(worked.refusal().contains("cannot be saved"), "{}", worked.refusal());
    worked.file(FileRequest::Ask(FileAction::New));
    assert!(matches!(worked.editor.question, Some(Question::Unsaved(_))), "and asked about");
}

#[test]
fn closing_with_changes_since_a_save_began_asks_and_saves_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path: PathBuf = folder.path().join("chair.glb");
    let (mut worked, gate) = gated();
    worked.change();
    worked.file(FileRequest::SaveAs(path.clone()));
    gate.send(()).expect("it waits");
    worked.finish_save();
    worked.change();
    worked.file(FileRequest::Ask(FileAction::Save));
    worked.change();
    worked.file(FileRequest::Ask(FileAction::New));
    assert!(matches!(worked.editor.question, Some(Question::Unsaved(_))), "the last change is not saved");
    let Worked { editor, stage } = &mut worked;
    editor.answer(stage, Answer::Yes);
    gate.send(()).and_then(|()| gate.send(())).expect("it waits");
    worked.finish_save();
    assert_eq!((worked.objects(), count_of_objects(&path)), (16, 8), "the first of both");
    worked.finish_save();
    assert_eq!((worked.objects(), count_of_objects(&path)), (2, 16), "all, and another document");
}

#[test]
fn a_document_that_waits_for_its_save_can_be_kept_open() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut worked, gate) = gated();
    worked.change();
    worked.file(FileRequest::SaveAs(folder.path().join("chair.glb")));
    worked.file(FileRequest::Ask(FileAction::New));
    assert!(worked.editor.closes_after_save(), "it waits");
    worked.editor.stay_open();
    gate.send(()).expect("it waits");
    worked.finish_save();
    assert_eq!(worked.objects(), 4, "it is still open");
    assert_eq!(worked.stage.title(), "chair.glb - trigon", "and saved");
}

#[test]
fn files_are_imported_after_the_one_that_is_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = ["one", "two", "three"].map(|name| {
        let path = folder.path().join(format!("{name}.obj"));
        std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").expect("written");
        path
    });
    let mut stage = Stage::new("test");
    settings::prepare(&mut stage);
    let mut editor = Editor::new(Keys::default(), None, files.to_vec());
    editor.start(&mut stage);
    for expected in 1..=3 {
        finish_load(&mut editor, &mut stage);
        assert_eq!(editor.document.nodes().nodes().len(), expected, "{:?}", editor.message);
    }
    assert!(editor.loading.is_none(), "that was all");
}
