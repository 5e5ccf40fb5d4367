//! The vertex stage: each vertex once, then its place on the grid.

mod depth;
mod draw;
mod lanes;
mod program;
mod run;
mod screen;
mod used;

pub(crate) use depth::{nearer, nearer_lanes};
pub(crate) use draw::DrawVertices;
pub use lanes::VertexLanes;
pub(crate) use program::VertexProgram;
pub(crate) use screen::ScreenVertex;
pub(crate) use used::{Slots, UsedVertices};
