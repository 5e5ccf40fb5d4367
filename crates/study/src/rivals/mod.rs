//! Measures how accurately other renderers, and trigon, draw the [`workloads`](crate::workloads).
//!
//! Every image is compared with the same [`Exact`] image: the workload's definition evaluated in `f64`, by
//! rays, with camera, light and texture implemented again. It shares no code with the engine, and reads only
//! vertices, triangles and colours from the workloads. Errors are separated:
//!
//! - *Outlines*: pixels where several surfaces meet, and that show the wrong one. That is coverage, and depth where one
//!   surface hides another.
//! - *Within surfaces*: pixels whose neighbours show the same surface. What differs there is depth in [flat
//!   colours](crate::workloads::Shading::Flat), and interpolation, light or texture elsewhere.
//! - *The whole image*: against the mean of 256 rays through each pixel, which is what more samples come closer to.

mod errors;
mod exact;
mod light;
mod record;
mod texture;

#[cfg(test)]
mod tests;

pub use errors::Errors;
pub use exact::{Exact, Pixel};
pub use record::{Measured, Timed, measured, timed};
