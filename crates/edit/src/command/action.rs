//! What all commands have in common.

use super::outcome::Outcome;
use crate::document::Change;
use crate::error::EditError;

/// What a command does to a document.
pub(crate) trait Action {
    /// Does it. After a refusal the document takes back what was done until then.
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError>;
}
