//! Pipelines: the traits that a user of the rasterizer implements, and the loops that run them.
//!
//! | file | what it does |
//! |---|---|
//! | `traits` | the traits [`Pipeline`] and [`LanePipeline`] |
//! | `erased` | pipelines without their type |
//! | `vertices` | the loop over the vertices of a draw |
//! | `run` | **the loop over the fragments of a draw**, eight pixels at a time |
//! | `scalar` | the same for pipelines that shade one fragment at a time |

mod erased;
mod run;
mod scalar;
mod traits;
mod vertices;

pub(crate) use erased::AnyPipeline;
pub use traits::{LanePipeline, Pipeline, VertexOutput};
