//! The actions of a user, as recovery files record them.

use serde::{Deserialize, Serialize};

use crate::command::Command;

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
