//! Triangles, lines and points to pixels on the CPU: exact, and the same bytes
//! everywhere.
//!
//! This crate knows vertices, triangles and pixels. It never knows scenes,
//! materials, lights, files or windows; it never prints; and it never lets the
//! number of threads, the size of a tile or the order of draws change a byte of
//! the picture.
//!
//! A [`Pipeline`] says where vertices lie and what colour a sample gets; a
//! [`Pass`] records draws, each with a pipeline of its own, and executes them
//! into a [`Target`].
//!
//! ```
//! use trigon_math::Vec4;
//! use trigon_raster::*;
//!
//! /// A triangle with a brightness at each corner.
//! struct Triangle;
//!
//! impl Pipeline for Triangle {
//!     type Varyings = f32;
//!
//!     fn vertex_count(&self) -> usize {
//!         3
//!     }
//!
//!     fn vertex(&self, index: usize) -> VertexOutput<f32> {
//!         // Clip space: x and y from -1 to 1, y up; depth 1 is nearest.
//!         let [x, y] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]][index];
//!         VertexOutput { position: Vec4::new(x, y, 0.5, 1.0), varyings: index as f32 / 2.0 }
//!     }
//!
//!     fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
//!         Vec4::splat(fragment.varyings).with_w(1.0)
//!     }
//! }
//!
//! let mut target = Target::new(10, 5, &[Output::Linear])?;
//! let mut pass = Pass::new();
//! pass.triangles(Draw::new(&Triangle, &[[0, 1, 2]]));
//! Rasterizer::default().draw(&pass, &mut target);
//!
//! let symbol = |color: &Vec4| if color.w == 0.0 { ' ' } else { char::from(b'0' + (color.x * 10.0) as u8) };
//! let picture: String = target.linear().unwrap().iter().map(symbol).collect();
//! let rows: Vec<&str> = picture.as_bytes().chunks(10).map(|row| std::str::from_utf8(row).unwrap()).collect();
//! assert_eq!(rows, [
//!     "         9",
//!     "       778",
//!     "     55667",
//!     "   3344556",
//!     " 112233445",
//! ]);
//! # Ok::<(), TargetError>(())
//! ```
//!
//! # What holds
//! - Vertices are snapped to 1/256 of a sample, to the nearest, ties to even.
//!   Which samples a triangle covers is then decided in integers, without error;
//!   a sample on an edge belongs to the triangle on one side of it: that for
//!   which the edge is a left edge, or a horizontal one at the top.
//! - Depth is reversed (1 near, 0 far). It is a convex combination of the
//!   vertices' depths, so no sample lies nearer or further than the triangle.
//!   The nearer sample is seen; of equally near ones the smaller (object, face).
//! - Varyings are perspective-correct, within the range of the vertices' values,
//!   and exactly constant where those are equal. Their derivatives are analytic.
//! - Any vertex is safe, whatever its bits; no output holds a NaN.
//! - Triangles are cut only at w > 0, at the near plane and far outside the
//!   view; neighbours are cut at the same bits, so no seam opens.
//!
//! # The way of a frame
//! `vertex` → `clip` → `setup` (with `line` and `point`) → `bin`, then for each
//! tile `tile` (coverage, depth, visibility) → `shade` → `blend` → `resolve`.
//! Each stage is a folder of that name.
//!
//! # Wireframes
//! A line along the edge of a surface has, off its exact middle, another depth
//! than the surface, and would fight with it. So edges of visible faces are best
//! painted by the pass itself: [`Pass::edges`] lays them over what is visible, and
//! [`Draw::edge_flags`] tells edges from diagonals. For hidden lines shade the
//! surface in the colour of the background; for see-through wireframes draw
//! [`Lines`] alone. Lines over a surface of their own can be drawn a little
//! nearer with [`Lines::toward_eye`]. A pipeline that wants to do more with edges
//! asks for the distance to the next one: [`Fragment::nearest_edge`].
//!
//! # User interfaces
//! [`paint2d`] is a path of its own, without depth and in gamma space: it paints
//! triangles in the order given, as user interface toolkits want it.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "tests may"))]

mod bin;
mod blend;
mod cancel;
mod certify;
mod clip;
mod clock;
mod draw;
mod explain;
mod fragment;
mod frame;
mod geometry;
mod ink;
mod line;
pub mod paint2d;
mod pass;
mod pipeline;
mod point;
mod pool;
mod rasterizer;
mod resolve;
mod samples;
mod settings;
mod setup;
mod shade;
pub mod simd;
mod stats;
mod target;
mod texture;
mod tile;
mod ulps;
mod varyings;
mod vertex;
mod viewport;

pub use cancel::Cancel;
pub use certify::{Certainty, Certificate, Tolerance};
pub use draw::{Culling, Draw, Lines, MarkedPoints, Outline, PointShape, Points, Surface};
pub use explain::{
    EdgeExplanation, FragmentExplanation, PixelExplanation, PrimitiveKind, SampleExplanation, Verdict,
};
pub use fragment::{EdgeFlags, Fragment};
pub use frame::{DrawChange, Redraw};
pub use ink::{FaceEdges, MarkColors, Marks};
pub use paint2d::Rect;
pub use pass::{Background, Pass};
#[doc(hidden)]
pub use pipeline::ScalarPipeline;
pub use pipeline::{LanePipeline, Pipeline, VertexOutput};
pub use rasterizer::Rasterizer;
pub use settings::{DepthTest, ExecuteSettings, TileSize};
pub use shade::FragmentLanes;
#[doc(hidden)]
pub use shade::RawFragment;
pub use stats::{StageTimes, Stats};
pub use target::{MAX_SAMPLES_PER_AXIS, MAX_TARGET_SIZE, Output, Pictures, Target, TargetError};
pub use texture::{
    Dual, Filter, MAX_ANISOTROPY, MAX_TEXTURE_SIZE, MipFilter, Sampler, Texture, TextureError, TextureFormat,
    Wrap,
};
pub use varyings::{MAX_VARYINGS, Varyings};
pub use vertex::VertexLanes;

/// The set that [`MarkedPoints`] takes.
pub use fixedbitset::FixedBitSet;
/// The crate below, so that points and vectors need no other dependency.
pub use trigon_math as math;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
