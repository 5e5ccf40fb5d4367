//! Previews of a command: what a modal tool shows while it runs.
//!
//! Each preview starts from the document as it was before the first one, so a drag of a thousand steps ends
//! where one step would. History and recovery file do not see it until it is confirmed.

use super::{Document, Entry};
use crate::command::{Command, Outcome};
use crate::error::EditError;

impl Document {
    /// Shows the effect of a command in place of the previous preview, which is undone first. There
    /// is no entry in the history and nothing in the recovery file until [`Self::confirm`].
    ///
    /// During a preview the scene, the selection and the meshes are as after its command, and so is the
    /// output of [`Self::to_native`]. Every other method that changes the document confirms the preview first,
    /// as if [`Self::confirm`] had been called, so that nothing a user sees is lost. In particular
    /// [`Self::undo`] undoes the previewed command, and [`Self::redo`] redoes it.
    ///
    /// Takes time proportional to what the commands change, plus one bit for each element of the
    /// edited meshes. Meshes that a command adds to the scene stay there unused after it is undone,
    /// as after [`Self::undo`].
    ///
    /// # Errors
    /// The command failed. The previous preview stays, or the document as it was if there is none.
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

    /// The previewed command; `None` if there is no preview.
    #[must_use]
    pub fn previewed(&self) -> Option<&Command> {
        self.preview.as_ref().map(Entry::command)
    }

    /// Confirms the preview: one entry in the history, and one event for a recovery file. Returns
    /// whether there was a preview.
    pub fn confirm(&mut self) -> bool {
        let Some(entry) = self.preview.take() else { return false };
        self.enter(entry);
        true
    }

    /// Cancels the preview and restores every byte. Returns whether there was a preview.
    pub fn cancel(&mut self) -> bool {
        let Some(mut entry) = self.preview.take() else { return false };
        self.exchange(&mut entry);
        true
    }
}
