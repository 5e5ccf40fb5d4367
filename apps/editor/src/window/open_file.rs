//! The document's file: what is known about it, and the questions before it is replaced.

use std::path::{Path, PathBuf};

use super::file_version::FileVersion;
use super::loading::SaveOrder;
use super::recovery::Left;
use crate::up::Up;

/// The file of the document, and whether it holds what was done.
#[derive(Debug, Default)]
pub(crate) struct OpenFile {
    pub(crate) path: Option<PathBuf>,
    /// What was on the disk when it was read or written last; `None` before that.
    version: Option<FileVersion>,
    /// A version of another program's that somebody was told of.
    noticed: Option<FileVersion>,
    /// How many changes lie between the document as it was opened and as it is.
    position: i64,
    /// The position that the file holds; `None` if no undo leads there.
    saved: Option<i64>,
    /// The position that is being written now, likewise.
    saving: Option<i64>,
}

impl OpenFile {
    pub(crate) fn opened(path: Option<PathBuf>) -> Self {
        let version = path.as_deref().and_then(FileVersion::of);
        Self { path, version, noticed: None, position: 0, saved: Some(0), saving: None }
    }

    /// Opened from what was on the disk in this version.
    pub(crate) fn of_version(self, version: Option<FileVersion>) -> Self {
        Self { version, ..self }
    }

    /// The version that another program has written since the file was read or written last.
    fn changed_on_disk(&self) -> Option<FileVersion> {
        let now = FileVersion::of(self.path.as_deref()?)?;
        (self.version.is_some() && self.version != Some(now)).then_some(now)
    }

    /// Whether a save to this path would replace what another program has written.
    pub(crate) fn would_overwrite(&self, path: &Path) -> bool {
        self.path.as_deref() == Some(path) && self.changed_on_disk().is_some()
    }

    /// Whether another program has written the file since this was asked for the last time.
    pub(crate) fn notices_change(&mut self) -> bool {
        let now = self.changed_on_disk();
        let is_new = now.is_some() && now != self.noticed;
        self.noticed = now;
        is_new
    }

    /// A command was run. One that only selects is no change, but what was undone before cannot be done again.
    pub(crate) fn ran(&mut self, selects: bool) {
        for position in [&mut self.saved, &mut self.saving] {
            *position = position.filter(|saved| *saved <= self.position);
        }
        self.position += i64::from(!selects);
    }

    /// A command was taken back.
    pub(crate) fn undid(&mut self, selects: bool) {
        self.position -= i64::from(!selects);
    }

    /// A command was done again.
    pub(crate) fn redid(&mut self, selects: bool) {
        self.position += i64::from(!selects);
    }

    /// Something was done that no count of commands tells.
    pub(crate) fn changed(&mut self) {
        (self.saved, self.saving) = (None, None);
    }

    /// It is being written as it is now.
    pub(crate) fn begins_save(&mut self) {
        self.saving = Some(self.position);
    }

    /// What was being written is in this file; `None` if it could not be written.
    pub(crate) fn ended_save(&mut self, path: Option<PathBuf>) {
        let saving = self.saving.take();
        if path.is_some() {
            (self.saved, self.version) = (saving, path.as_deref().and_then(FileVersion::of));
            (self.path, self.noticed) = (path, None);
        }
    }

    /// Whether something was done that the file does not hold.
    pub(crate) fn is_unsaved(&self) -> bool {
        self.saved != Some(self.position)
    }

    /// Whether it would not be lost once what is being written is in the file.
    pub(crate) fn is_being_saved(&self) -> bool {
        self.saving == Some(self.position)
    }

    pub(crate) fn name(&self) -> String {
        let name = self.path.as_deref().and_then(Path::file_name);
        name.map_or_else(|| "untitled".into(), |name| name.to_string_lossy().into_owned())
    }
}

/// What is done when a question is answered.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Next {
    New,
    Open(PathBuf),
    Quit,
}

/// What has to be answered before anything else is done.
#[derive(Debug)]
pub(crate) enum Question {
    /// The document has changes: save them, discard them, or go on.
    Unsaved(Next),
    /// The file would not hold all of the one that was opened.
    Losses { path: PathBuf, losses: Vec<String>, next: Option<Next> },
    /// Another program has written the file since.
    ChangedOnDisk(SaveOrder),
    /// A crash has left a document.
    Recover(Left),
    /// Which axis is up on the screen, at the first start.
    Up,
}

/// How a question was answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Save, write all the same, recover.
    Yes,
    /// Discard.
    No,
    /// Save to another file.
    SaveAs,
    /// Open the file as another program has written it.
    Reload,
    /// Show this axis as up.
    Up(Up),
    Cancel,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_another_program_writes_is_noticed_once_and_before_it_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.glb");
        std::fs::write(&path, "as opened").expect("written");
        let mut file = OpenFile::opened(Some(path.clone()));
        assert!(!file.notices_change() && !file.would_overwrite(&path), "nobody has changed it");
        std::fs::write(&path, "by another program").expect("written");
        assert!(file.would_overwrite(&path), "that would be lost");
        assert!(!file.would_overwrite(&folder.path().join("b.glb")), "another file is another question");
        assert_eq!([file.notices_change(), file.notices_change()], [true, false], "once");
        std::fs::write(&path, "and again, longer").expect("written");
        assert!(file.notices_change(), "another change");
        file.begins_save();
        file.ended_save(Some(path.clone()));
        assert!(!file.would_overwrite(&path), "it is ours now");
        std::fs::remove_file(&path).expect("removed");
        assert!(!file.would_overwrite(&path), "there is nothing to replace");
    }

    #[test]
    fn undo_and_redo_lead_back_to_what_was_saved_unless_something_else_was_done() {
        let mut file = OpenFile::opened(None);
        assert!(!file.is_unsaved(), "just opened");
        file.ran(true);
        assert!(!file.is_unsaved(), "a selection is no change");
        file.ran(false);
        file.begins_save();
        assert!(file.is_unsaved() && file.is_being_saved(), "not yet");
        file.ended_save(Some("/a.glb".into()));
        file.undid(false);
        assert!(file.is_unsaved(), "what was saved is undone");
        file.redid(false);
        assert!(!file.is_unsaved(), "and done again");
        file.undid(false);
        file.ran(false);
        assert!(file.is_unsaved(), "something else was done in its place");
        file.undid(false);
        file.ran(true);
        assert!(file.is_unsaved(), "nothing leads there any more");
    }

    #[test]
    fn what_is_done_during_a_save_is_not_saved_by_it() {
        let mut file = OpenFile::opened(None);
        file.ran(false);
        file.begins_save();
        file.ran(false);
        assert!(!file.is_being_saved(), "the second is not");
        file.ended_save(Some("/a.glb".into()));
        assert!(file.is_unsaved(), "the second is missing in the file");
        file.undid(false);
        assert!(!file.is_unsaved(), "the first is in it");
        file.begins_save();
        file.undid(false);
        file.ran(false);
        file.ended_save(Some("/a.glb".into()));
        assert!(file.is_unsaved(), "what was saved was undone, and something else done in its place");
    }
}
