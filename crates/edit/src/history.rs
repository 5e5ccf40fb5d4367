//! What was done, and how to go back and forth: one entry for each action of a user.

use trigon_mesh::edit::Difference;
use trigon_scene::{MeshId, SceneParts};

use crate::command::Command;
use crate::selection::Selection;

/// One action: the command, and what leads to the state before it or after it again.
#[derive(Debug, Clone)]
pub struct Entry {
    pub(crate) command: Command,
    pub(crate) meshes: Vec<(MeshId, Difference)>,
    pub(crate) parts: Option<Box<SceneParts>>,
    /// What was selected in the other state.
    pub(crate) selection: Selection,
}

impl Entry {
    /// What was done.
    #[must_use]
    pub fn command(&self) -> &Command {
        &self.command
    }

    /// The memory that the entry takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let meshes: usize = self.meshes.iter().map(|(_, difference)| difference.bytes()).sum();
        meshes + self.parts.as_ref().map_or(0, |parts| parts.bytes()) + self.selection.bytes()
    }
}

/// The entries of a document, oldest first, within a budget of memory.
#[derive(Debug, Clone)]
pub struct History {
    entries: Vec<Entry>,
    /// How many of them are done; the others were undone and can be done again.
    done: usize,
    budget: usize,
    /// How many of the oldest were dropped to stay within the budget.
    dropped: usize,
}

impl Default for History {
    fn default() -> Self {
        Self { entries: Vec::new(), done: 0, budget: Self::DEFAULT_BUDGET, dropped: 0 }
    }
}

impl History {
    /// Entries take at most so much memory, in bytes: 512 MiB.
    pub const DEFAULT_BUDGET: usize = 512 << 20;

    /// Sets how much memory entries may take, in bytes. The last entry is kept in any case.
    pub fn set_budget(&mut self, bytes: usize) {
        self.budget = bytes;
        self.keep_budget();
    }

    /// What was done and can be undone, the oldest first.
    #[must_use]
    pub fn done(&self) -> &[Entry] {
        &self.entries[..self.done]
    }

    /// What was undone and can be done again, the first to be done again first.
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
        self.entries.iter().map(Entry::bytes).sum()
    }

    /// Adds what was just done; what was undone before cannot be done again then.
    pub(crate) fn push(&mut self, entry: Entry) {
        self.entries.truncate(self.done);
        self.entries.push(entry);
        self.done += 1;
        self.keep_budget();
    }

    /// The entry to be undone next; it counts as undone from now on.
    pub(crate) fn step_back(&mut self) -> Option<&mut Entry> {
        self.done = self.done.checked_sub(1)?;
        self.entries.get_mut(self.done)
    }

    /// The entry to be done again next; it counts as done from now on.
    pub(crate) fn step_forward(&mut self) -> Option<&mut Entry> {
        let entry = self.entries.get_mut(self.done)?;
        self.done += 1;
        Some(entry)
    }

    fn keep_budget(&mut self) {
        let mut bytes = self.bytes();
        let mut gone = 0;
        while bytes > self.budget && gone + 1 < self.done {
            bytes -= self.entries[gone].bytes();
            gone += 1;
        }
        self.entries.drain(..gone);
        self.done -= gone;
        self.dropped += gone;
    }
}
