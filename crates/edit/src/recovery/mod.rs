//! What was done since a document was opened, kept on the disk while it is edited: after a crash the
//! document and its history are as they were.
//!
//! A recovery file is the document as it was opened and then one record for each action. Records
//! are only ever added, each with a checksum; what was being written when the power went is left out.
//! Commands are data and give the same bytes each time, so running them again gives the document, its
//! selection and its history.

mod log;
mod writer;

pub use log::{Event, RecoveryLog, UnreadableRecovery};
pub use writer::{RecoveryStatus, RecoveryWriter};

use crate::document::Document;
use crate::error::EditError;

impl Document {
    /// Does again what a recovery file tells, on the document as it was opened.
    ///
    /// # Errors
    /// An event is refused that was not refused before: then the base was another document.
    /// Those before it stay done.
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
