//! Independent, slow and exact implementations of what the renderer computes.
//!
//! Nothing here shares a line with the engine: coverage by displaced samples instead of biased edge functions
//! ([`coverage`]), depth and areas in rational numbers ([`depth`], [`area`]), depth order by integer
//! fractions ([`depth`]), and visibility by rays instead of projection, clipping and snapping ([`ray`]).
//! Where a result is not exact, its documentation states the bound.
//!
//! A snapped triangle is given by its corners on the sub-pixel grid. From there on, only one answer is
//! correct:
//!
//! ```
//! use trigon_study::oracle::{GridPoint, area, coverage, depth};
//!
//! // Two triangles that make the square of the first two pixels' width.
//! let corners: [GridPoint; 4] = [[0, 0], [512, 0], [512, 512], [0, 512]];
//! let [lower, upper] = [[0, 2, 3], [0, 1, 2]].map(|half| half.map(|i: usize| corners[i]));
//! // The centre of the first pixel lies on the diagonal: one of them has it.
//! let both = [lower, upper].map(|half| coverage::covers(half, coverage::pixel_center([0, 0])));
//! assert_eq!(both, [false, true]);
//!
//! let half = area::rational(0.5);
//! assert_eq!(area::in_pixel(upper, [0, 0]), half);
//!
//! let plane = depth::Plane { corners: upper, depths: [0.0, 0.0, 1.0] };
//! assert_eq!(plane.at([512, 256]), Some(half));
//! ```

pub mod area;
pub mod coverage;
pub mod depth;
mod double_double;
pub mod face_edges;
pub mod half_plane;
pub mod ray;

pub use double_double::DoubleDouble;

/// A point of the sub-pixel grid: x to the right and y down from the image's
/// top left corner, in 1/256 pixel.
pub type GridPoint = [i32; 2];

/// How many steps of the grid make a pixel.
pub const STEPS: i32 = 256;
