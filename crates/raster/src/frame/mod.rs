//! A frame from its plan to its tiles.

mod change;
mod draw_view;
mod layout;
mod options;
mod outputs;
mod plan;
mod redraw;
mod set_up;
mod stages;
mod tiles;
mod touched;
mod view;

pub use change::{DrawChange, Redraw};
pub(crate) use draw_view::DrawView;
pub(crate) use options::FrameOptions;
pub(crate) use outputs::RequestedOutputs;
pub(crate) use plan::{DrawPlan, Plan};
pub(crate) use redraw::redraw;
pub(crate) use stages::{Arena, draw, prepare};
pub(crate) use tiles::outer_ink;
pub(crate) use view::FrameView;
