//! What the stages that draw tiles read of a frame: its plan, its draws, and the outputs of the stages before.

mod frame_view;
mod plan;

pub(crate) use frame_view::{BackgroundRow, FrameView, RequestedOutputs, VisibleTile, finite_color};
pub(crate) use plan::{DrawPlan, Plan};
