//! The history: one entry for each action of a user, as recovery files record it, with the data to undo and
//! redo it; and previews of a command, which a modal tool shows while it runs.
//!
//! Each preview starts from the document as it was before the first one, so a drag of a thousand steps ends where
//! one step would. History and recovery file do not see it until it is confirmed.

use serde::{Deserialize, Serialize};
use trigon_modelling::Difference;
use trigon_scene::{MeshId, SceneParts};

use super::Document;
use crate::command::{Command, Outcome};
use crate::error::EditError;
use crate::selection::Selection;

/// One action: the command, and the data that leads to the state before it or after it again.
#[derive(Debug, Clone)]
pub struct Entry {
    pub(crate) command: Command,
    pub(crate) meshes: Vec<(MeshId, Difference)>,
    pub(crate) parts: Option<Box<SceneParts>>,
    /// The selection in the other state.
    pub(crate) selection: Selection,
    /// The memory that it takes; computed when it is added to the history.
    pub(crate) bytes: usize,
}

impl Entry {
    /// The command.
    #[must_use]
    pub fn command(&self) -> &Command {
        &self.command
    }

    /// The memory that the entry takes, in bytes. A selection that it shares with the entry before is not
    /// counted.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// The same after an entry, if there is one.
    fn bytes_after(&self, before: Option<&Self>) -> usize {
        let meshes: usize = self.meshes.iter().map(|(_, difference)| difference.bytes()).sum();
        let selection = self.selection.bytes_beside(before.map(|before| &before.selection));
        let parts = self.parts.as_ref().map_or(0, |parts| parts.bytes());
        meshes + parts + selection + self.command.action().bytes()
    }
}

/// The entries of a document, oldest first, within a budget of memory.
#[derive(Debug, Clone)]
pub struct History {
    entries: Vec<Entry>,
    /// The number of entries that are done; the others were undone and can be redone.
    done: usize,
    budget: usize,
    /// How many of the oldest were dropped to stay within the budget.
    dropped: usize,
    /// The memory of all entries.
    bytes: usize,
}

impl Default for History {
    fn default() -> Self {
        Self { entries: Vec::new(), done: 0, budget: Self::DEFAULT_BUDGET, dropped: 0, bytes: 0 }
    }
}

impl History {
    /// The largest total size of the entries, in bytes: 512 MiB.
    pub const DEFAULT_BUDGET: usize = 512 << 20;

    /// Sets the largest total size of the entries, in bytes. The last entry is always kept.
    pub fn set_budget(&mut self, bytes: usize) {
        self.budget = bytes;
        self.keep_budget();
    }

    /// The commands that can be undone, oldest first.
    #[must_use]
    pub fn done(&self) -> &[Entry] {
        &self.entries[..self.done]
    }

    /// The commands that can be redone, in the order in which they would be.
    #[must_use]
    pub fn undone(&self) -> &[Entry] {
        &self.entries[self.done..]
    }

    /// How many entries were dropped because of the budget.
    #[must_use]
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// The memory that all entries take, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Adds an entry; what was undone before can no longer be redone.
    pub(crate) fn push(&mut self, mut entry: Entry) {
        self.bytes -= self.entries.drain(self.done..).map(|undone| undone.bytes).sum::<usize>();
        entry.bytes = entry.bytes_after(self.entries.last());
        self.bytes += entry.bytes;
        self.entries.push(entry);
        self.done += 1;
        self.keep_budget();
    }

    /// The entry to undo next; from now on it counts as undone.
    pub(crate) fn step_back(&mut self) -> Option<&mut Entry> {
        self.done = self.done.checked_sub(1)?;
        self.entries.get_mut(self.done)
    }

    /// The entry to redo next; from now on it counts as done.
    pub(crate) fn step_forward(&mut self) -> Option<&mut Entry> {
        let entry = self.entries.get_mut(self.done)?;
        self.done += 1;
        Some(entry)
    }

    fn keep_budget(&mut self) {
        let mut gone = 0;
        while self.bytes > self.budget && gone + 1 < self.done {
            self.bytes -= self.entries[gone].bytes;
            gone += 1;
        }
        self.entries.drain(..gone);
        self.done -= gone;
        self.dropped += gone;
    }
}

/// A user's action.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// A command was run successfully.
    Run(Box<Command>),
    /// The last command was undone.
    Undo,
    /// An undone command was redone.
    Redo,
}

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
