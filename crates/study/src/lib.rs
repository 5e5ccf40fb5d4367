//! Measures what the trigon renderer costs and how accurate it is.
//!
//! - A module for each question: [`fill`], [`visibility`], [`mod@line`], [`shading`], [`interpolation`], [`depth`],
//!   [`texture`], [`transparency`], [`shadow`], [`same_bytes`], [`storage`], [`threads`]. Each compares classical algorithms with the engine. Every algorithm has a file of its own
//!   that cites its source. [`frames`] compares whole images, [`rivals`] images of other renderers.
//! - Exact results to compare with: [`oracle`].
//! - The report: [`report`].
//! - [`workloads`] that other renderers draw, too, and the code that times them. The bench `limits` measures what
//!   the processor can do under the renderer's rules.
//!
//! All input is in closed form, or pseudorandom from a fixed seed, so the same images are made on every machine. The
//! library never prints, and the renderer does not depend on it.
//!
//! ```
//! use trigon_raster::Rasterizer;
//! use trigon_study::workloads::{Canvas, Scene, Timings, Workload};
//!
//! // The torus knot of W3, small: 1/64 of the pixels.
//! let mut scene: Scene = Workload::KnotPhong.scene();
//! scene.size = scene.size / 8;
//! let mut pixels = vec![[0; 4]; scene.pixel_count()];
//! let mut canvas = Canvas::new(Rasterizer::default(), &scene, &mut pixels)?;
//! let timings = Timings::of_frames(5, || canvas.draw(&scene));
//! assert!(timings.min() <= timings.median() && timings.median() <= timings.max());
//!
//! let covered = pixels.iter().filter(|&&pixel| pixel != Scene::BACKGROUND).count();
//! assert!((9_000..9_300).contains(&covered), "1/64 of 586,330 pixels are 9,161");
//! # Ok::<(), trigon_raster::TargetError>(())
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "tests may"))]

pub mod depth;
pub mod fill;
pub mod frames;
pub mod interpolation;
pub mod line;
pub mod oracle;
pub mod report;
pub mod rivals;
pub mod same_bytes;
pub mod shading;
pub mod shadow;
pub mod sittings;
pub mod storage;
pub mod texture;
pub mod threads;
pub mod transparency;
pub mod truth;
pub mod visibility;
pub mod workloads;

mod engine;
mod measure;
mod metric;

pub use engine::Engine;
pub use measure::{Spread, interleaved};
pub use metric::{Difference, lightness};

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
