//! The vertex stage: the pipeline runs once for each vertex in use, and the vertex is snapped to the
//! sub-pixel grid.
//!
//! In the order in which a vertex passes through:
//!
//! | file | what it holds |
//! |---|---|
//! | `used` | which vertices of a draw are run, and their slots |
//! | `program`, `lanes` | a pipeline without its type; the vertices that it runs at once |
//! | `snap` | **snaps** eight vertices at a time; `pipeline/vertices.rs` runs the pipeline for them |
//! | `screen` | the result: [`ScreenVertex`], a position on the grid with depth and 1/w, or an outcode |
//! | `depth` | the same for a single vertex ([`ScreenVertex::of`]), which set-up needs for corners of cut triangles; the range of depths |
//! | `draw` | looks up the vertices of a draw |
//!
//! Vertices that must be cut are not snapped here: see [`Setup::snap`](crate::setup::Setup).

mod depth;
mod draw;
mod lanes;
mod program;
mod screen;
mod snap;
mod used;

pub(crate) use depth::{nearer, nearer_lanes};
pub(crate) use draw::DrawVertices;
pub use lanes::VertexLanes;
pub(crate) use program::{VertexDestination, VertexProgram};
pub(crate) use screen::ScreenVertex;
pub(crate) use snap::to_screen;
pub(crate) use used::{Slots, UsedVertices};
