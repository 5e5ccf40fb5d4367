//! What all tools are to the window: they take inputs, tell their state, and say what is drawn over the image.

use trigon_document::Document;
use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_window::{Hands, Input};

use super::modal::Modal;
use super::transform_kind::TransformKind;
use super::view::ToolView;

/// A tool that runs.
pub(crate) trait Tool {
    /// Takes an input.
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState;

    /// Keys and numbers for the status line.
    fn status(&self) -> String;

    /// The state that it shares with all modal tools.
    fn modal(&mut self) -> &mut Modal;

    /// The window put its pointer somewhere else, as at the borders of endless drags: that was no
    /// movement.
    fn pointer_jumped(&mut self, to: DVec2) {
        self.modal().pointer.jumped(to);
    }

    /// What is to be drawn over the image.
    fn marks(&self) -> ToolMarks {
        ToolMarks::default()
    }
}

/// Whether a tool continues.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ToolState {
    /// It waits for more input.
    Running,
    /// It is over: what it showed is done.
    Confirmed,
    /// As [`Confirmed`](Self::Confirmed), and what it made is turned or scaled next.
    ConfirmedThen(TransformKind),
    /// It is over: the document is as it was.
    Cancelled,
}

/// What a tool draws, in the world.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ToolMarks {
    /// Axes of locks, cuts to come.
    pub(crate) lines: Vec<[DVec3; 2]>,
    /// The reach of proportional editing: a centre and a radius in metres.
    pub(crate) circle: Option<(DVec3, f64)>,
    /// What something snapped to.
    pub(crate) point: Option<DVec3>,
}
