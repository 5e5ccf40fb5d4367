//! Exact and reproducible mathematics for graphics: [`glam`] and additions to it.
//!
//! Every function gives the same bits on every machine. Where a decision depends on a sign (which
//! side, inside or outside), the sign is exact or the documentation states the bound. The crate
//! knows nothing about pixels, meshes or files.
//!
//! # Conventions
//! - Clip space is reversed-Z: `x` and `y` in `[-w, w]` (`y` up), `z` from `w`
//!   at the near plane to `0` at the far plane or at infinity.
//! - The screen has its origin at the top left, `y` down.
//! - Angles are radians. Matrices act on column vectors.
//!
//! # Example
//! A screen coordinate becomes a fixed-point one, and three of them have an
//! exact orientation:
//!
//! ```
//! use trigon_math::{Fixed, FixedPoint, orientation_fixed};
//!
//! let point = |x, y| {
//!     Some(FixedPoint { x: Fixed::from_f32(x)?, y: Fixed::from_f32(y)? })
//! };
//! let (a, b, c) = (point(0.0, 0.0), point(2.0, 0.0), point(2.0, 1.0));
//! let area = orientation_fixed(a.unwrap(), b.unwrap(), c.unwrap());
//! // Twice the area, in units of (1/256 px)²; y points down, so the positive
//! // sign means clockwise as seen on the screen.
//! assert_eq!(area, 2 * 256 * 256);
//! assert_eq!(Fixed::from_f32(f32::NAN), None);
//! ```

mod bounds;
mod bvh;
pub mod clip;
pub mod color;
mod direction;
mod disjoint_sets;
pub mod elementary;
mod fixed;
mod frustum;
mod homogeneous;
mod matrix;
mod plane;
mod polygon;
mod predicates;
mod random;
pub mod simd;

pub use glam;
/// Matrices of views and projections in the conventions above, with angles in radians: a camera that looks along −Z, and
/// reversed depth without a far plane. `trigon-camera` has all others, in `f64`.
pub use glam::camera::rh::{proj::directx::perspective_infinite_reverse, view::look_at_mat4};
pub use glam::{
    DAffine2, DAffine3, DMat2, DMat3, DMat4, DQuat, DVec2, DVec3, DVec4, IVec2, Mat3, Mat4, Quat, UVec2,
    Vec2, Vec3, Vec4,
};

pub use fixed::{Fixed, FixedPoint};
pub use predicates::{Orientation, is_mirroring, orientation, orientation_fixed, side_of_triangle};

pub use bounds::Bounds3;
pub use bvh::{Bvh, Hemispheres, Ray, RayHit, Rays, Surroundings};
pub use clip::{Band, ClipPolygon, ClipVertex, ClipVolume, HalfSpace, Outcode, clip_segment, clip_triangle};

pub use direction::{angle, cofactors, or_if_zero, transformed_delta, transformed_direction, unit_or_zero};
pub use disjoint_sets::DisjointSets;
pub use frustum::{Frustum, FrustumSide};
pub use plane::Plane;
pub use polygon::{AxisProjection, area_vector};

pub use homogeneous::HomogeneousPoint;
pub use matrix::Matrix;

pub use random::SplitMix64;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
