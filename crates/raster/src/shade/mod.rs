//! The shade stage: computes the colour of the visible triangles at each pixel.
//!
//! In the order of the work on a tile:
//!
//! | file | what it does |
//! |---|---|
//! | `visible` | lists the visible triangles of a tile, by draw |
//! | `edges` | with multisampling, pixels that show several triangles |
//! | `layout`, `sorted`, `small`, `perspective`, `lines`, `records` | **records**: what shading needs of each visible triangle, made eight triangles at a time |
//! | `surface`, `task` | the tile's work: whole groups of pixels, and fragments of a list |
//! | `list`, `fragments` | fragments listed by triangle: masks, and layers to be blended |
//! | `run` | **the loop over groups of a draw**, eight pixels at a time |
//! | `columns` | the records of eight pixels, transposed: one pixel in each lane |
//! | `triangle_lanes`, `barycentrics`, `placed` | edge functions and **perspective-correct weights** at the pixels |
//! | `fragment_lanes` | the input of a pipeline's shading function: **interpolated varyings** and their gradients |
//! | `scalar` | pipelines that shade one fragment at a time |
//! | `lines_over` | blends edges and marks of faces over the colours |
//! | `output`, `encode` | where colours go; linear light to sRGB bytes |
//! | `context`, `frame_context`, `erased`, `shading` | the draw and the tile; pipelines without their type; memory kept from tile to tile |

mod barycentrics;
mod columns;
mod context;
mod edges;
mod encode;
mod erased;
mod fragment_lanes;
mod fragments;
mod frame_context;
mod layout;
mod lines;
mod lines_over;
mod list;
mod output;
mod perspective;
mod placed;
mod records;
mod run;
mod scalar;
mod shading;
mod small;
mod sorted;
mod surface;
mod task;
mod triangle_lanes;
mod visible;

use context::Spots;
pub(crate) use context::{Job, ShadeContext, ShadePoint};
pub(crate) use edges::{BEHIND, EdgeGroup};
pub(crate) use encode::Encoding;
pub(crate) use erased::AnyPipeline;
pub use fragment_lanes::FragmentLanes;
pub(crate) use fragment_lanes::RawFragment;
pub(crate) use list::{JobList, mask_jobs, shade_jobs, shade_jobs_with};
use output::ShadeOutput;
use records::Records;
pub(crate) use shading::{EmptyGroup, Shading};
pub(crate) use surface::{list_visible, shade_tile};
