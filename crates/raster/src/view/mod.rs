//! What the stages that draw tiles read of a frame: its plan, its draws, and the outputs of the stages before.

mod background_row;
mod frame_view;
mod outputs;
mod plan;
mod visible_tile;

pub(crate) use background_row::{BackgroundRow, finite_color};
pub(crate) use frame_view::FrameView;
pub(crate) use outputs::RequestedOutputs;
pub(crate) use plan::{DrawPlan, Plan};
pub(crate) use visible_tile::VisibleTile;
