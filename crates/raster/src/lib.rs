//! A CPU rasterizer for triangles, lines and points. Coverage is exact, and the
//! output has the same bytes on every machine.
//!
//! The crate knows vertices, triangles and pixels. It never knows scenes,
//! materials, lights, files or windows, and it never prints. The number of
//! threads, the size of a tile and the order of draws never change a byte.
//!
//! A [`Pipeline`] computes vertex positions and fragment colours. A [`Pass`]
//! records draws, each with its own pipeline. A [`Rasterizer`] draws a pass into a
//! [`Target`].
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
//! let image: String = target.linear().unwrap().iter().map(symbol).collect();
//! let rows: Vec<&str> = image.as_bytes().chunks(10).map(|row| std::str::from_utf8(row).unwrap()).collect();
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
//! # Guarantees
//! - Vertices are snapped to 1/256 of a sample, to the nearest, ties to even.
//!   Coverage is then decided in integers, without error. A sample exactly on an
//!   edge belongs to one of the two triangles beside it: the one for which the
//!   edge is a left edge or a horizontal top edge.
//! - Depth is reversed (1 near, 0 far). It stays within the range of the
//!   vertices' depths. The nearest fragment is visible; of equally near ones the
//!   one with the smaller (object, face).
//! - Varyings are perspective-correct, within the range of the vertices' values,
//!   and exactly constant where those are equal. Their derivatives are analytic.
//! - Any vertex is safe, whatever its bits. No output contains a NaN.
//! - Triangles are clipped only at a small positive w, at the near plane and far
//!   outside the view. Neighbours are clipped at identical points, so no gap opens.
//!
//! # The stages of a frame
//! `vertex` → `clip` → `setup` (with `line` and `point`) → `bin`, then for each
//! tile `tile` (coverage, depth, visibility) → `shade` → `blend` → `resolve`.
//! Each stage is a module of that name. `primitive`, `tile_buffer`, `fragments`
//! and `pipeline` hold the types that the stages pass on.
//!
//! # Wireframes
//! A line drawn along the edge of a surface has the surface's depth only on its
//! exact middle, so the two flicker (z-fighting). Edges of
//! visible faces are therefore best painted by the pass itself: [`Pass::edges`]
//! paints them over what is visible, and [`Draw::edge_flags`] distinguishes edges
//! from diagonals. For hidden-line images, shade the surface in the background's
//! colour. For see-through wireframes, draw [`Lines`] alone. Lines that lie on a
//! surface can be drawn slightly nearer with [`Lines::depth_bias`]. A pipeline can
//! read the distance to the nearest edge with [`Fragment::nearest_edge`].
//!
//! # User interfaces
//! [`paint2d`] is a separate painter without depth, in gamma space. It paints
//! triangles in submission order, as user interface toolkits need.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "tests may"))]

mod bin;
mod blend;
mod cancel;
mod certify;
mod clip;
mod draw;
mod draw_view;
mod explain;
mod fragment;
mod fragments;
mod frame;
mod geometry;
mod ink;
mod line;
mod outer_ink;
pub mod paint2d;
mod pass;
mod pipeline;
mod point;
mod point_shader;
mod pool;
mod primitive;
mod rasterizer;
mod resolve;
mod setup;
mod shade;
pub mod simd;
mod stats;
mod target;
mod texture;
mod tile;
mod tile_buffer;
mod ulps;
mod vertex;
mod view;
mod viewport;

pub use cancel::Cancel;
pub use certify::{Certainty, Certificate, Tolerance};
pub use draw::{
    BlendMode, Culling, Draw, DrawBounds, Lines, MarkColors, MarkedPoints, Marks, PointShape, Points,
    Smoothing,
};
pub use explain::{
    EdgeExplanation, FragmentExplanation, PixelExplanation, PrimitiveKind, SampleExplanation, Verdict,
};
pub use fragment::{EdgeFlags, Fragment, MAX_VARYINGS, Varyings};
pub use fragments::{FragmentLanes, PointScratch, SurfacePoint};
pub use frame::{DrawChange, Redraw};
pub use ink::FaceEdges;
pub use paint2d::Rect;
pub use pass::{Background, Pass};
pub use pipeline::{LanePipeline, Pipeline, VertexOutput};
pub use point_shader::{PointShader, ShadedDraw};
pub use rasterizer::{DepthTest, ExecuteSettings, Rasterizer, Threads, TileSize};
pub use stats::{StageTimes, Stats};
pub use target::{MAX_SAMPLES_PER_AXIS, MAX_TARGET_SIZE, Output, Target, TargetError, TargetImages};
pub use texture::{
    Dual, Filter, MAX_ANISOTROPY, MAX_TEXTURE_SIZE, MipFilter, Sampler, Texture, TextureError, TextureFormat,
    Wrap,
};
pub use vertex::VertexLanes;

/// The set that [`MarkedPoints`] takes.
pub use fixedbitset::FixedBitSet;
/// The crate below, so that points and vectors need no other dependency.
pub use trigon_math as math;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
