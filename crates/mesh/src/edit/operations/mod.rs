//! The operations, a file each: what a user of a modeller calls by a name.
//!
//! Each is a method of [`EditMesh`](super::EditMesh) that takes ids and parameters, in time
//! proportional to what it changes, and returns what it made. Ids that are given twice count once.
//! A refusal leaves the mesh as it was.

mod delete;
mod hide;
mod marks;
mod mirror;
mod project_uvs;
#[cfg(test)]
mod random_tests;
mod recalculate_normals;
mod symmetrize;
mod transform;

pub use hide::VisibilityChange;
pub use mirror::Mirrored;
pub use project_uvs::{BoxProjection, PlanarProjection};
pub use recalculate_normals::RecalculatedNormals;
pub use symmetrize::Symmetrized;
pub use transform::{Falloff, FalloffDistance, FalloffShape, MoveSession, Transform};
