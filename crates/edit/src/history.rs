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
    /// The memory that it takes; found when it comes into the history.
    pub(crate) bytes: usize,
}

impl Entry {
    /// What was done.
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
        meshes + self.parts.as_ref().map_or(0, |parts| parts.bytes()) + selection
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
    /// The memory that all of them take.
    bytes: usize,
}

impl Default for History {
    fn default() -> Self {
        Self { entries: Vec::new(), done: 0, budget: Self::DEFAULT_BUDGET, dropped: 0, bytes: 0 }
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
        self.bytes
    }

    /// Adds what was just done; what was undone before cannot be done again then.
    pub(crate) fn push(&mut self, mut entry: Entry) {
        self.bytes -= self.entries.drain(self.done..).map(|undone| undone.bytes).sum::<usize>();
        entry.bytes = entry.bytes_after(self.entries.last());
        self.bytes += entry.bytes;
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
