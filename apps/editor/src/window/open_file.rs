//! The document's file: what is known about it, and the questions before it is replaced.

use std::path::{Path, PathBuf};

use super::recovery::Left;

/// The file of the document, and whether it holds what was done.
#[derive(Debug, Default)]
pub(crate) struct OpenFile {
    pub(crate) path: Option<PathBuf>,
    /// How many changes lie between the document as it was opened and as it is.
    position: i64,
    /// The position that the file holds; `None` if no undo leads there.
    saved: Option<i64>,
    /// The position that is being written now, likewise.
    saving: Option<i64>,
}

impl OpenFile {
    pub(crate) fn opened(path: Option<PathBuf>) -> Self {
        Self { path, position: 0, saved: Some(0), saving: None }
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
            (self.saved, self.path) = (saving, path);
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
    /// A crash has left a document.
    Recover(Left),
}

/// How a question was answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Save, write all the same, recover.
    Yes,
    /// Discard.
    No,
    Cancel,
}

#[cfg(test)]
mod tests {
    use super::*;

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
