//! Modal tools: state machines that turn mouse and keys into previews of commands.
//!
//! Tools know no window and draw nothing. A tool is started on the selection, receives each input together with
//! the view, previews its command on the document, and ends confirmed (one entry in the history) or cancelled
//! (with all bytes restored). `numeric`, `constraint`, `snap`, `pivot` and `view` are shared by all tools;
//! `transform` is move, rotate and scale in one; `gesture` selects by regions.

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
mod preview;
mod rotate;
mod scale;
mod selected;
mod slide;
mod snap;
mod state;
mod targets;
#[cfg(test)]
mod tests;
mod transform;
mod transform_kind;
mod translate;
mod view;

pub(crate) use bevel::BevelTool;
pub(crate) use constraint::{Axis, Frames, Freedom, Orientation};
pub(crate) use extrude::ExtrudeTool;
pub(crate) use gesture::{Gesture, GestureKind, GestureState, RegionMode};
pub(crate) use inset::InsetTool;
pub(crate) use loop_cut::LoopCutTool;
pub(crate) use pivot::Pivot;
pub(crate) use selected::Selected;
pub(crate) use snap::{SnapSettings, SnapSource, SnapTarget};
pub(crate) use state::{Tool, ToolMarks, ToolState};
pub(crate) use transform::{TransformSettings, TransformTool};
pub(crate) use transform_kind::TransformKind;
pub(crate) use view::ToolView;
