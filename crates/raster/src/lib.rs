//! Triangles, lines and points to pixels on the CPU: exact, and the same bytes
//! everywhere.
//!
//! This crate knows vertices, triangles and pixels. It never knows scenes,
//! materials, lights, files or windows; it never prints; it never lets the
//! number of threads, the size of a tile or the order of opaque draws change a
//! byte of the picture.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "tests may"))]

mod bin;
mod blend;
mod clip;
mod draw;
mod fragment;
mod frame;
mod geometry;
mod line;
mod pass;
mod pipeline;
mod point;
mod pool;
mod resolve;
mod settings;
mod setup;
mod shade;
mod stats;
mod target;
mod texture;
mod tile;
mod varyings;
mod vertex;
mod viewport;

pub use draw::{Culling, Draw, Lines, PointShape, Points, Surface};
pub use fragment::{EdgeFlags, Fragment};
pub use pass::{Background, Pass};
pub use pipeline::{Pipeline, VertexOutput};
pub use settings::{ExecuteSettings, TileSize};
pub use stats::Stats;
pub use target::{MAX_SAMPLES_PER_AXIS, MAX_TARGET_SIZE, Output, Pictures, Target, TargetError};
pub use texture::{Filter, MAX_TEXTURE_SIZE, MipFilter, Sampler, Texture, TextureError, TextureFormat, Wrap};
pub use varyings::Varyings;
