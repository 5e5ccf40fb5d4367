//! Recovery files: all actions since a document was opened, on disk while it is edited. After a
//! crash the document and its history are restored.
//!
//! A recovery file is the document as it was opened, followed by one record for each action. Records are only
//! ever appended, each with a checksum; a record that was being written during a power failure is dropped.
//! Commands are data and give the same bytes each time, so running them again restores the document, its
//! selection and its history.

mod log;
mod writer;

pub use log::{RecoveryLog, UnreadableRecovery};
pub use writer::{RecoveryStatus, RecoveryWriter};

use crate::document::{Document, Event};
use crate::error::EditError;

impl Document {
    /// Replays a recovery file on the document as it was opened.
    ///
    /// # Errors
    /// An event fails that succeeded before: then the base is another document. The events before
    /// it stay done.
    pub fn replay(&mut self, events: &[Event]) -> Result<(), EditError> {
        for event in events {
            match event {
                Event::Run(command) => drop(self.run((**command).clone())?),
                Event::Undo => self.undo()?,
                Event::Redo => self.redo()?,
            }
        }
        Ok(())
    }
}
