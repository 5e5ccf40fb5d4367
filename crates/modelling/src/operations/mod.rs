//! The operations of a modeller, one file each.
//!
//! Each is a method of [`EditMesh`](super::EditMesh) that takes ids and parameters, in time proportional to
//! what it changes, and returns what it made. Ids given twice count once. On an error the mesh is unchanged.

mod align_uvs;
mod bevel;
mod bisect;
mod boolean;
mod box_tree;
mod bridge;
mod catmull_clark;
mod connect;
mod copy;
mod decimate;
mod delete;
mod dissolve;
mod duplicate;
mod element_marks;
mod extrude;
mod fill;
mod follow_quads;
mod frame;
mod grid_fill;
mod halves;
mod hide;
mod hull;
mod inset;
mod join;
mod knife;
mod lift;
mod loop_cut;
mod make_solid;
#[cfg(test)]
mod memory_tests;
mod merge;
mod mirror;
mod outlines;
mod parts;
mod poke;
mod project_around;
mod project_uvs;
#[cfg(test)]
mod random_tests;
mod recalculate_normals;
mod region;
mod rip;
mod separate;
mod slide;
mod solidify;
mod spin;
mod split;
mod subdivide;
mod surface_tree;
mod sweep_frame;
mod symmetrize;
#[cfg(test)]
mod table_tests;
mod tables;
mod transfer_values;
mod transform;
mod transform_uvs;
mod triangulate;
mod tris_to_quads;
mod tube;
mod un_subdivide;
mod unwrap;
mod uv_overlaps;
mod uv_pins;
mod vertex_groups;
mod voxel_remesh;
mod wireframe;

pub use align_uvs::{Straightened, UvAlignment};
pub use bevel::{BevelLeftOut, BevelSettings, BevelWidth, Beveled, InnerMiter, OuterMiter};
pub use bisect::{BisectSettings, Bisected};
pub use boolean::{BooleanTool, Combined};
pub use bridge::{BridgePath, BridgeProfile, BridgeSettings};
pub use connect::Connected;
pub use copy::CopiedElements;
pub use decimate::Decimated;
pub use dissolve::{Dissolved, LimitedDissolve};
pub use extrude::{ExtrudeOffset, ExtrudedEdges, ExtrudedFaces, ExtrudedVertices};
pub use fill::Filled;
pub use follow_quads::QuadLength;
pub use grid_fill::GridSides;
pub use hide::VisibilityChange;
pub use hull::{ConvexHull, HullSettings};
pub use inset::{Inset, InsetFaces};
pub use knife::{IntersectWith, KnifeCut, KnifePoint, KnifeProjection, ProjectedLine, Sight};
pub use loop_cut::{LoopCut, LoopCutSettings};
pub use make_solid::{SolidReport, SolidSettings};
pub use merge::MergedVertices;
pub use mirror::Mirrored;
pub use poke::Poked;
pub use project_around::{CylinderProjection, SphereProjection};
pub use project_uvs::{BoxProjection, PlanarProjection};
pub use recalculate_normals::RecalculatedNormals;
pub use rip::Ripped;
pub use solidify::Solidified;
pub use spin::{SpinSettings, Spun};
pub use subdivide::Subdivided;
pub use symmetrize::Symmetrized;
pub use transfer_values::{TransferMapping, TransferSettings, TransferSource};
pub use transform::{Falloff, FalloffDistance, FalloffShape, MoveSession, Transform};
pub use transform_uvs::UvElements;
pub use triangulate::Triangulated;
pub use tris_to_quads::QuadLimits;
pub use tube::TubeSettings;
pub use un_subdivide::UnSubdivided;
pub use unwrap::{
    PackSettings, SmartProjection, StitchSettings, Stitched, UnwrapMethod, UnwrapSettings, Unwrapped,
};
pub use vertex_groups::GroupAssignment;
pub use voxel_remesh::VoxelRemeshSettings;
pub use wireframe::WireframeSettings;
