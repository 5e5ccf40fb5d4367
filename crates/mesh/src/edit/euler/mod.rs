//! The elementary changes of structure, from which all operations are made. Each leaves a mesh
//! that keeps every rule of [`EditMesh`](super::EditMesh), or refuses and changes nothing.
//!
//! They are called after Leonhard Euler, whose formula they keep (Baumgart, "Winged edge
//! polyhedron representation", 1972); the set here follows Blender's BMesh.

mod add;
mod join;
mod merge;
mod relink;
mod remove;
mod split;
mod turn;

pub(super) use add::check_outline;
pub use split::{SplitEdge, SplitFace};
