//! What all commands have in common.

use super::outcome::Outcome;
use crate::error::EditError;
use crate::state::Change;

/// The implementation of a command.
pub(crate) trait Action {
    /// Runs the command. On an error the caller undoes all changes made so far.
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError>;
}
