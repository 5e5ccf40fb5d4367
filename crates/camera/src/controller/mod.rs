//! Cameras under a hand: plain state machines that are told "so much to the
//! right" and answer with a [`crate::Camera`]. They know no mouse and no clock.

mod angle;
mod axis_view;
mod orbit;

pub use axis_view::AxisView;
pub use orbit::{Orbit, OrbitStyle};
