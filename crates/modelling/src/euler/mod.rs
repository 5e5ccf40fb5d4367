//! The elementary changes of structure, of which all operations consist. After each change the mesh
//! satisfies every rule of [`EditMesh`](super::EditMesh); otherwise the change is refused and nothing
//! happens.
//!
//! Euler operators are named after Leonhard Euler, because they preserve his formula (Baumgart, "Winged edge
//! polyhedron representation", 1972). The set follows Blender's BMesh.

mod add;
mod join;
mod merge;
mod parts;
mod relink;
mod remove;
mod simple;
mod split;
mod turn;

pub(super) use parts::{Divided, PartPoint, Parts};
pub(super) use simple::{is_simple, simple_parts};
pub use split::{SplitEdge, SplitFace};
