//! What bevel, inset and extrude have in common: each previews one command, which follows the pointer and typed numbers.

use trigon_document::{Command, Document};

use super::modal::{Modal, Step};
use super::view::ToolView;
use super::{Tool, ToolState};

/// A tool that previews one command.
pub(super) trait PreviewTool: Tool {
    /// The command for the pointer and the typed numbers as they are now, or why there is none.
    fn command(&mut self, view: &ToolView) -> Result<Command, String>;

    /// Takes a key of the tool's own.
    fn key(&mut self, key: char, document: &mut Document, view: &ToolView) -> ToolState;

    /// Shows the command, or why there is none.
    fn update(&mut self, document: &mut Document, view: &ToolView) -> ToolState {
        match self.command(view) {
            Ok(command) => self.modal().show(document, command),
            Err(why) => self.modal().refuse(why),
        }
    }

    /// Handles a step for which the tool has no behaviour of its own.
    fn step(&mut self, step: Step, document: &mut Document, view: &ToolView) -> ToolState {
        match step {
            Step::Update => self.update(document, view),
            Step::Confirm => Modal::confirm(document),
            Step::Cancel => Modal::cancel(document),
            Step::Key(key) => self.key(key, document, view),
            Step::MiddlePressed
            | Step::MiddleReleased
            | Step::ToggleSnapping
            | Step::Wheel(_)
            | Step::Nothing => ToolState::Running,
        }
    }
}
