//! Cameras in double precision: position, projection, and interactive control. A camera maps a scene in world
//! coordinates to a rasterizer's clip coordinates.
//!
//! Conventions of every function:
//! - World and camera space are right-handed. The camera looks along −Z, +Y is up.
//! - Clip space: x and y in `[-w, w]`, y up. Depth is reversed: 1 on the near
//!   plane, 0 on the far plane or at infinity.
//! - Screen: origin in the top-left corner, y down, pixel `(i, j)` has its
//!   centre at `(i + 0.5, j + 0.5)`.
//! - Angles are radians, lengths are the world's (metres).
//!
//! This crate does not depend on windows, input devices, meshes, or the contents of pixels.
//!
//! ```
//! use trigon_camera::math::{DVec2, DVec3};
//! use trigon_camera::{Camera, Projector, Viewport};
//!
//! let camera = Camera::look_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y);
//! let projector = Projector::new(&camera, Viewport { width: 10, height: 5 });
//!
//! // What the camera looks at lands in the middle of the image …
//! let (screen, depth) = projector.to_screen_and_depth(DVec3::ZERO).expect("in front of the eye");
//! assert_eq!(screen, DVec2::new(5.0, 2.5));
//! // … and comes back from there.
//! let point = projector.unproject(screen, depth).expect("not at infinity");
//! assert!(point.length() < 1e-12);
//! // What is behind the eye is nowhere on the screen.
//! assert_eq!(projector.to_screen(DVec3::new(0.0, 0.0, 6.0)), None);
//! ```

mod camera;
mod clip_map;
mod controller;
mod error;
mod fisheye;
mod fit;
mod part;
mod pinhole;
mod pose;
mod projection;
mod projector;
mod ray;
mod unit;
mod up_axis;
mod view;
mod viewport;

pub use camera::Camera;
pub use controller::{AxisView, Orbit, OrbitStyle};
pub use error::CameraError;
pub use fisheye::{FisheyeCamera, FisheyeLens, FisheyeRay};
pub use fit::{DEFAULT_MARGIN, Extent};
pub use pinhole::{Intrinsics, PixelCenters};
pub use pose::CameraAxes;
pub use projection::Projection;
pub use projector::Projector;
pub use ray::Ray;
pub use up_axis::UpAxis;
pub use view::orientation_looking;
pub use viewport::Viewport;

/// Re-export of the crate below, so that points and vectors need no other dependency.
pub use trigon_math as math;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
