//! The operations, a file each: what a user of a modeller calls by a name.
//!
//! Each is a method of [`EditMesh`](super::EditMesh) that takes ids and parameters, in time
//! proportional to what it changes, and returns what it made. Ids that are given twice count once.
//! A refusal leaves the mesh as it was.

mod bridge;
mod catmull_clark;
mod connect;
mod delete;
mod fill;
mod grid_fill;
mod merge;
pub(super) mod numbering;
mod outlines;
mod parts;
mod subdivide;
mod triangulate;
mod tris_to_quads;

pub use connect::Connected;
pub use fill::Filled;
pub use grid_fill::GridSides;
pub use merge::MergedVertices;
pub use subdivide::Subdivided;
pub use triangulate::Triangulated;
pub use tris_to_quads::QuadLimits;
