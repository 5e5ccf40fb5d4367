//! A command that is tried out: what a modal tool shows while it runs.
//!
//! Each preview starts from the document as it was before the first one, so a drag of a thousand
//! steps ends where one step would. Nothing of it is in the history or in a recovery file until it is
//! confirmed.

use super::Document;
use crate::command::{Command, Outcome};
use crate::error::EditError;
use crate::history::Entry;

impl Document {
    /// Shows what a command would do, in place of what was previewed before: that is taken back
    /// first. There is no entry in the history and nothing in the recovery file until
    /// [`Self::confirm`].
    ///
    /// While a preview is under way the scene, the selection and the meshes are as after its command;
    /// so is what [`Self::encode`] writes. Every other method that changes the document confirms
    /// the preview first, as if [`Self::confirm`] had been called: what a user sees is
    /// never lost. In particular [`Self::undo`] takes the previewed command back, and
    /// [`Self::redo`] can do it again.
    ///
    /// It takes time proportional to what the commands change, beside one bit for each element of
    /// the meshes that are edited. Meshes that a command adds to the scene stay
    /// there unused when it is taken back, as after [`Self::undo`].
    ///
    /// # Errors
    /// Why the command was refused. The preview before stays, or the document as it was if there is none.
    pub fn preview(&mut self, command: Command) -> Result<Outcome, EditError> {
        let mut last = self.preview.take();
        if let Some(entry) = &mut last {
            self.exchange(entry);
        }
        match self.attempt(command) {
            Ok((entry, outcome)) => {
                self.preview = Some(entry);
                Ok(outcome)
            }
            Err(refusal) => {
                if let Some(entry) = &mut last {
                    self.exchange(entry);
                }
                self.preview = last;
                Err(refusal)
            }
        }
    }

    /// The command that is previewed; `None` while no preview is under way.
    #[must_use]
    pub fn previewed(&self) -> Option<&Command> {
        self.preview.as_ref().map(Entry::command)
    }

    /// Keeps what is previewed: one entry in the history, and one event for a recovery file. Whether
    /// there was a preview.
    pub fn confirm(&mut self) -> bool {
        let Some(entry) = self.preview.take() else { return false };
        self.enter(entry);
        true
    }

    /// Takes back what is previewed, to the last byte. Whether there was a preview.
    pub fn cancel(&mut self) -> bool {
        let Some(mut entry) = self.preview.take() else { return false };
        self.exchange(&mut entry);
        true
    }
}
