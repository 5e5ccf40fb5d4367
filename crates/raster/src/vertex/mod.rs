//! The vertex stage: the pipeline runs once for each vertex in use, and the vertex is snapped to the
//! sub-pixel grid.
//!
//! In the order in which a vertex passes through:
//!
//! | file | what it holds |
//! |---|---|
//! | `program` | which vertices of a draw are run, and their slots; a pipeline without its type; looks up the vertices of a draw |
//! | `screen` | **snaps** eight vertices at a time (`pipeline/vertices.rs` runs the pipeline for them), or one ([`ScreenVertex::of`]), which set-up needs for corners of cut triangles. The result is [`ScreenVertex`]: a position on the grid with depth and 1/w, or an outcode |
//!
//! Vertices that must be cut are not snapped here: see [`Setup::snap`](crate::setup::Setup).

mod program;
mod screen;

pub use program::VertexLanes;
pub(crate) use program::{DrawVertices, Slots, UsedVertices, VertexDestination, VertexProgram};
pub(crate) use screen::{ScreenVertex, nearer, nearer_lanes, to_screen};
