//! The operations, a file each: what a user of a modeller calls by a name.
//!
//! Each is a method of [`EditMesh`](super::EditMesh) that takes ids and parameters, in time
//! proportional to what it changes, and returns what it made. Ids that are given twice count once.
//! A refusal leaves the mesh as it was.

mod copy;
mod delete;
mod dissolve;
mod duplicate;
mod extrude;
mod frame;
mod inset;
mod join;
mod lift;
mod region;
mod separate;
mod split;
mod tables;

pub use copy::CopiedElements;
pub use dissolve::{Dissolved, LimitedDissolve};
pub use extrude::{ExtrudeOffset, ExtrudedEdges, ExtrudedFaces, ExtrudedVertices};
pub use inset::{Inset, InsetFaces};
