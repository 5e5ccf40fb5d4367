//! What the stages that draw tiles read of a frame: its plan, its draws, and the outputs of the stages before.

mod draw_view;
mod frame_view;
mod outputs;
mod plan;

pub(crate) use draw_view::DrawView;
pub(crate) use frame_view::FrameView;
pub(crate) use outputs::RequestedOutputs;
pub(crate) use plan::{DrawPlan, Plan};
