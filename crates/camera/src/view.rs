//! Orientations from directions that may be degenerate: a camera at its own target, or one looking
//! straight down along its up vector, must still give an image.

use trigon_math::{DMat3, DQuat, DVec3};

use crate::UpAxis;
use crate::unit::unit_or;

/// Below this sine of the angle between line of sight and up, up does not define the roll: its
/// perpendicular part is mostly rounding.
const PARALLEL: f64 = 1e-8;

/// The orientation (camera to world) that looks along `direction` with `up` towards the upper edge
/// of the image. Neither needs unit length.
///
/// The result is always stable:
/// - a `direction` that is zero or not finite counts as −Z;
/// - an `up` that is zero or not finite counts as +Y;
/// - if they are parallel, the result is that of the front view pitched up or down: looking along
///   −Y with up +Y puts −Z at the top and keeps +X to the right.
#[must_use]
pub fn orientation_looking(direction: DVec3, up: DVec3) -> DQuat {
    let back = -unit_or(direction, DVec3::NEG_Z);
    let up = unit_or(up, DVec3::Y);
    let across = up.cross(back);
    let right = if across.length() > PARALLEL {
        across.normalize()
    } else {
        let right = UpAxis::new(up).frame().x_axis;
        (right - back * right.dot(back)).normalize()
    };
    let axes = DMat3::from_cols(right, back.cross(right), back);
    DQuat::from_mat3(&axes).normalize()
}
