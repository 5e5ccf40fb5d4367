//! Fragments: what a pipeline reads of eight pixels and the triangles that they show, and where their
//! colours go. Everything here belongs to one draw in one tile.
//!
//! In the order of the work:
//!
//! | file | what it does |
//! |---|---|
//! | `context` | the draw and the tile; the pixels to be shaded |
//! | `layout`, `sorted`, `perspective`, `lines`, `records` | **records**: what shading needs of each visible triangle, made eight triangles at a time |
//! | `task` | fragments in a list; groups of pixels and lists that are to be shaded |
//! | `columns` | the records of eight pixels, transposed: one pixel in each lane |
//! | `triangle_lanes`, `barycentrics` | edge functions and **perspective-correct weights** at the pixels |
//! | `fragment_lanes` | the input of a pipeline's shading function: **interpolated varyings** and their gradients |
//! | `surface_point`, `surface_points` | the same input for points that were found otherwise, such as by rays |
//! | `lines_over` | blends edges and marks of faces over the colours |
//! | `output` | where colours go; linear light to sRGB bytes |

mod barycentrics;
mod columns;
mod context;
mod fragment_lanes;
mod layout;
mod lines;
mod lines_over;
mod output;
mod perspective;
mod records;
mod sorted;
mod surface_point;
mod surface_points;
mod task;
mod triangle_lanes;

pub(crate) use barycentrics::Barycentrics;
pub(crate) use columns::{Columns, SpecialColumns};
pub(crate) use context::{DrawVaryings, Job, ShadeContext, ShadePoint, Spots};
pub use fragment_lanes::FragmentLanes;
pub(crate) use fragment_lanes::RawFragment;
pub(crate) use layout::RecordShape;
pub(crate) use output::{Codes, Encoding, ShadeOutput, finite};
pub(crate) use records::Records;
pub use surface_point::SurfacePoint;
pub use surface_points::PointScratch;
pub(crate) use task::{FragmentBatch, FragmentList, FragmentSlice, Group, Task, VisibleTriangles};
pub(crate) use triangle_lanes::TriangleLanes;
