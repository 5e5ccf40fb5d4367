//! The operations, a file each: what a user of a modeller calls by a name.
//!
//! Each is a method of [`EditMesh`](super::EditMesh) that takes ids and parameters, in time
//! proportional to what it changes, and returns what it made. Ids that are given twice count once.
//! A refusal leaves the mesh as it was.

mod bevel;
mod catmull_clark;
mod copy;
mod bridge;
mod catmull_clark;
mod connect;
mod delete;
mod fill;
mod merge;
pub(super) mod numbering;
mod outlines;
mod parts;
mod subdivide;
mod triangulate;
mod tris_to_quads;

pub use connect::Connected;
pub use fill::Filled;
pub use merge::MergedVertices;
pub use subdivide::Subdivided;
mod loop_cut;
mod slide;

pub use bevel::{BevelLeftOut, BevelSettings, Beveled};
pub use loop_cut::{LoopCut, LoopCutSettings};
mod hide;
mod marks;
mod mirror;
mod project_uvs;
mod recalculate_normals;
mod symmetrize;
mod transform;

pub use hide::VisibilityChange;
pub use mirror::Mirrored;
pub use project_uvs::{BoxProjection, PlanarProjection};
pub use recalculate_normals::RecalculatedNormals;
pub use symmetrize::Symmetrized;
pub use transform::{Falloff, FalloffDistance, FalloffShape, MoveSession, Transform};
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
pub use triangulate::Triangulated;
pub use tris_to_quads::QuadLimits;
