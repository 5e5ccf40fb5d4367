//! The fragment stage: what is seen at each pixel gets its colour.

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
mod weights;

use context::Spots;
pub(crate) use context::{Job, ShadeContext, Work};
pub(crate) use edges::{BEHIND, EdgeGroup};
pub(crate) use encode::Encoding;
pub(crate) use erased::AnyPipeline;
pub use fragment_lanes::{FragmentLanes, RawFragment};
pub(crate) use list::{mask_jobs, shade_jobs, shade_jobs_with};
use output::ShadeOutput;
use records::Records;
pub(crate) use shading::{EmptyGroup, Shading};
pub(crate) use surface::{list_visible, shade_tile};
