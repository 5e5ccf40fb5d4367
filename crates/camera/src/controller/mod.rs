//! Interactive cameras: plain state machines that take amounts of movement and return a [`crate::Camera`].
//! Controllers know no mouse and no clock.

mod angle;
mod axis_view;
mod orbit;

pub use axis_view::AxisView;
pub use orbit::{Orbit, OrbitStyle};
