//! Rotations as people type them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DMat3, DQuat, DVec3, elementary};

/// A rotation as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "by", rename_all = "snake_case", deny_unknown_fields)]
#[schemars(extend("examples" = [
    Rotation::Euler { angles: [0.0; 3] },
    Rotation::Quaternion { xyzw: [0.0, 0.0, 0.0, 1.0] },
]))]
pub enum Rotation {
    /// Three rotations about the fixed axes of the space: first about x, then y, then z.
    Euler {
        /// About x, y and z, in degrees.
        angles: [f64; 3],
    },
    /// A quaternion; its length does not matter.
    Quaternion {
        /// The imaginary part, then the real part.
        xyzw: [f64; 4],
    },
}

impl Rotation {
    /// As a unit quaternion; no rotation if a quaternion has no direction.
    #[must_use]
    pub fn to_quaternion(self) -> DQuat {
        let quaternion = match self {
            Self::Euler { angles } => {
                let turn = |axis: DVec3, degrees: f64| {
                    let (sine, cosine) = elementary::sin_cos(degrees.to_radians() * 0.5);
                    DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine)
                };
                let [x, y, z] = angles;
                turn(DVec3::Z, z) * turn(DVec3::Y, y) * turn(DVec3::X, x)
            }
            Self::Quaternion { xyzw } => DQuat::from_array(xyzw),
        };
        let length = quaternion.length();
        if length.is_finite() && length > 0.0 { quaternion / length } else { DQuat::IDENTITY }
    }

    /// The angles of a unit quaternion: y from −90° to 90°, x and z from −180° to 180°. If y is
    /// ±90°, z is 0.
    #[must_use]
    pub fn euler(quaternion: DQuat) -> Self {
        let matrix = DMat3::from_quat(quaternion);
        let sine = -matrix.x_axis.z;
        // Closer to the pole than this, the other columns hold only rounding errors.
        const POLE: f64 = 1.0 - 1e-12;
        let radians = if sine.abs() < POLE {
            let x = elementary::atan2(matrix.y_axis.z, matrix.z_axis.z);
            [x, elementary::asin(sine), elementary::atan2(matrix.x_axis.y, matrix.x_axis.x)]
        } else {
            let x = elementary::atan2(-matrix.z_axis.y, matrix.y_axis.y);
            [x, elementary::asin(sine.clamp(-1.0, 1.0)), 0.0]
        };
        Self::Euler { angles: radians.map(f64::to_degrees) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_at_the_pole_turn_to_the_same_place() {
        for y in [90.0, -90.0] {
            let turned = Rotation::Euler { angles: [20.0, y, 50.0] }.to_quaternion();
            let again = Rotation::euler(turned).to_quaternion();
            // Near the pole the sine gives the angle with half of its digits.
            assert!(turned.dot(again).abs() > 1.0 - 1e-7, "{y}: {turned} and {again}");
        }
    }
}
