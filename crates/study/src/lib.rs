//! What the trigon renderer costs and how right it is, measured: workloads that
//! other renderers draw too, the harness that times them, and exact [`oracle`]s.
//!
//! The workloads are closed form: no file is read and no random number is drawn,
//! so the same triangles can be made anywhere from the same formulas. The
//! library never prints, and the renderer never needs it.
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

pub mod limits;
pub mod oracle;
pub mod workloads;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
