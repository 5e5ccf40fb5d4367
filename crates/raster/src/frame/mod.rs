//! Draws a frame: runs all stages, from the plan to the finished tiles.

mod affected_primitives;
mod bits;
mod change;
mod changed_vertices;
mod follow;
mod layout;
mod moving;
mod options;
mod redraw;
mod set_up;
mod stages;
mod tile_cache;
mod tiles;

pub use change::{DrawChange, Redraw};
pub(crate) use options::FrameOptions;
pub(crate) use redraw::redraw;
pub(crate) use stages::{Arena, draw, prepare};
pub(crate) use tiles::outer_ink;
