//! Pipelines: the traits that a user of the rasterizer implements, and the loops that run them.
//!
//! | file | what it does |
//! |---|---|
//! | `traits` | the traits [`Pipeline`] and [`LanePipeline`] |
//! | `vertices` | the loop over the vertices of a draw |
//! | `run` | **the loop over the fragments of a draw**, eight pixels at a time, or fragment by fragment for scalar pipelines; pipelines without their type |

mod run;
mod traits;
mod vertices;

pub(crate) use run::AnyPipeline;
pub use traits::{LanePipeline, Pipeline, VertexOutput};
