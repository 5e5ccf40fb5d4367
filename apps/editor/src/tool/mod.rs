//! Modal tools: state machines that turn mouse and keys into previews of commands.
//!
//! Tools know no window and draw nothing. A tool is started on the selection, receives each input together with
//! the view, previews its command on the document, and ends confirmed (one entry in the history) or cancelled
//! (with all bytes restored). `numeric`, `constraint`, `snap`, `selected` and `view` are shared by all tools;
//! `transform` is move, rotate and scale in one; `gesture` selects by regions.

mod bevel;
mod constraint;
mod expression;
mod extrude;
mod gesture;
mod knife;
mod loop_cut;
mod measure;
mod modal;
mod numeric;
mod selected;
mod slide;
mod snap;
#[cfg(test)]
mod tests;
mod transform;
mod translate;
mod uv;
mod view;

pub(crate) use bevel::{BevelTool, InsetTool};
pub(crate) use constraint::{Axis, Frames, Freedom, Orientation, TransformKind};
pub(crate) use expression::{Quantity, evaluate};
pub(crate) use extrude::ExtrudeTool;
pub(crate) use gesture::{Gesture, GestureKind, GestureState, RegionMode};
pub(crate) use knife::KnifeTool;
pub(crate) use loop_cut::LoopCutTool;
pub(crate) use measure::MeasureTool;
pub(crate) use modal::{FaceTool, Tool, ToolMarks, ToolState};
pub(crate) use selected::{Pivot, Selected};
pub(crate) use snap::{SnapSettings, SnapSource, SnapTarget};
pub(crate) use transform::{TransformSettings, TransformTool};
pub(crate) use uv::{UvPixels, UvTool, UvTransform};
pub(crate) use view::ToolView;
