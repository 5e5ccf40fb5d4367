//! Modal tools: state machines that turn mouse and keys into previews of commands.
//!
//! They know no window and draw nothing. A tool is started on the selection, receives each input
//! together with the view, previews its command on the document, and ends confirmed (one entry in
//! the history) or cancelled (with all bytes restored). `numeric`, `constraint`, `snap`, `pivot`
//! and `view` are shared by all tools; `transform` is move, rotate and scale in one; `gesture`
//! selects by regions.

mod bevel;
mod constraint;
mod expression;
mod extrude;
mod gesture;
mod inset;
mod loop_cut;
mod modal;
mod numeric;
mod pivot;
mod pointer;
mod rotate;
mod scale;
mod selected;
mod slide;
mod snap;
mod targets;
#[cfg(test)]
mod tests;
mod transform;
mod translate;
mod view;

use trigon_edit::Document;
use trigon_edit::mesh::math::{DVec2, DVec3};
use trigon_window::{Hands, Input};

pub(crate) use bevel::BevelTool;
pub(crate) use constraint::{Axis, Frames, Freedom, Orientation};
pub(crate) use extrude::ExtrudeTool;
pub(crate) use gesture::{Gesture, GestureKind, GestureState, RegionMode};
pub(crate) use inset::InsetTool;
pub(crate) use loop_cut::LoopCutTool;
pub(crate) use pivot::Pivot;
pub(crate) use selected::Selected;
pub(crate) use snap::{SnapSettings, SnapSource, SnapTarget};
pub(crate) use transform::{TransformKind, TransformSettings, TransformTool};
pub(crate) use view::ToolView;

/// A tool that runs.
pub(crate) trait Tool {
    /// Takes an input.
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState;

    /// Keys and numbers for the status line.
    fn status(&self) -> String;

    /// The window put its pointer somewhere else, as at the borders of endless drags: that was no
    /// movement.
    fn pointer_jumped(&mut self, to: DVec2);

    /// What is to be drawn over the picture.
    fn marks(&self) -> ToolMarks {
        ToolMarks::default()
    }
}

/// Whether a tool goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ToolState {
    /// It wants more input.
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
