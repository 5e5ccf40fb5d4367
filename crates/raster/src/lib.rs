//! Triangles, lines and points to pixels on the CPU: exact, and the same bytes
//! everywhere.
//!
//! This crate knows vertices, triangles and pixels. It never knows scenes,
//! materials, lights, files or windows; it never prints; it never lets the
//! number of threads, the size of a tile or the order of opaque draws change a
//! byte of the picture.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "tests may"))]

mod draw;
mod fragment;
mod pass;
mod pipeline;
mod settings;
mod stats;
mod target;
mod texture;
mod varyings;

pub use pipeline::{Pipeline, VertexOutput};
pub use varyings::Varyings;
pub use fragment::{EdgeFlags, Fragment};
pub use draw::{Culling, Draw, Lines, PointShape, Points, Surface};
pub use pass::{Background, Pass};
pub use settings::{ExecuteSettings, TileSize};
pub use target::{MAX_SAMPLES_PER_AXIS, MAX_TARGET_SIZE, Output, Pictures, Target, TargetError};
pub use stats::Stats;
pub use texture::{
    Filter, MAX_TEXTURE_SIZE, MipFilter, Sampler, Texture, TextureError, TextureFormat, Wrap,
};
