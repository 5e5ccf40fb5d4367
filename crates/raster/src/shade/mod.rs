//! The fragment stage: what is seen at each pixel gets its colour.

mod context;
mod encode;
mod erased;
mod fragment_lanes;
mod mixed;
mod output;
mod run;
mod scalar;
mod uniform;
mod visible;
mod weights;

pub(crate) use context::{Job, ShadeContext, Work};
pub(crate) use encode::Encoding;
pub(crate) use erased::AnyPipeline;
pub(crate) use fragment_lanes::{CornerValues, LaneTriangles};
pub use fragment_lanes::{FragmentLanes, MAX_VARYINGS, RawFragment};
pub(crate) use output::ShadeOutput;
pub(crate) use visible::{shade_jobs, shade_to_codes, shade_to_colors};
