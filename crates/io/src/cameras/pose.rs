//! Poses, in either convention and direction, as trigon's.

use serde_json::Value;
use trigon_math::{DMat3, DQuat, DVec3};

/// How far the product of a rotation and its transpose may be from the identity: poses are often written with four
/// digits. What is within becomes the nearest rotation.
const ORTHONORMAL: f64 = 1e-3;

/// Which way the axes of a camera point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axes {
    /// X right, Y up, looking along −Z: OpenGL, Blender, NeRF, trigon.
    OpenGl,
    /// X right, Y down, looking along +Z: OpenCV, COLMAP.
    OpenCv,
}

/// The direction of a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    ToWorld,
    ToCamera,
}

/// Where a camera is, and the rotation from its axes (looking along −Z, Y up) to the world's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) position: DVec3,
    pub(super) orientation: DQuat,
}

impl Pose {
    /// A pose of a matrix by rows, 4 × 4 or 3 × 4.
    pub(super) fn from_rows(value: &Value, direction: Direction, axes: Axes) -> Result<Self, String> {
        let rows: Option<Vec<[f64; 4]>> =
            value.as_array().and_then(|rows| rows.iter().map(numbers).collect());
        let rows = rows
            .filter(|rows| matches!(rows.len(), 3 | 4))
            .ok_or("its pose is not a matrix of 4 by 4, or 3 by 4, numbers")?;
        if rows.get(3).is_some_and(|last| *last != [0.0, 0.0, 0.0, 1.0]) {
            return Err(
                "the last row of its pose is not 0 0 0 1; transpose it if it is stored by columns".to_owned()
            );
        }
        let column = |index: usize| DVec3::new(rows[0][index], rows[1][index], rows[2][index]);
        let rotation = DMat3::from_cols(column(0), column(1), column(2));
        Self::new(rotation, column(3), direction, axes)
    }

    /// A pose of a rotation and the translation after it.
    pub(super) fn new(
        rotation: DMat3,
        translation: DVec3,
        direction: Direction,
        axes: Axes,
    ) -> Result<Self, String> {
        let rotation = nearest_rotation(rotation)?;
        if !translation.is_finite() {
            return Err("its position is not finite".to_owned());
        }
        let (to_world, position) = match direction {
            Direction::ToWorld => (rotation, translation),
            Direction::ToCamera => (rotation.transpose(), -(rotation.transpose() * translation)),
        };
        let to_world = match axes {
            Axes::OpenGl => to_world,
            Axes::OpenCv => DMat3::from_cols(to_world.x_axis, -to_world.y_axis, -to_world.z_axis),
        };
        Ok(Self { position, orientation: DQuat::from_mat3(&to_world).normalize() })
    }

    /// A pose of a position and a unit quaternion x, y, z, w to the world. One that has length 1 to the last bits
    /// stays as it is.
    pub(super) fn from_quaternion(
        position: DVec3,
        [x, y, z, w]: [f64; 4],
        axes: Axes,
    ) -> Result<Self, String> {
        let rotation = DQuat::from_xyzw(x, y, z, w);
        if !position.is_finite() {
            return Err("its position is not finite".to_owned());
        }
        let orientation = unit(rotation)?;
        Ok(match axes {
            Axes::OpenGl => Self { position, orientation },
            // Half a turn about X exchanges the conventions.
            Axes::OpenCv => {
                Self { position, orientation: orientation * DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0) }
            }
        })
    }
}

/// A quaternion of length 1.
pub(super) fn unit(quaternion: DQuat) -> Result<DQuat, String> {
    let length = quaternion.length();
    if !(length - 1.0).abs().le(&ORTHONORMAL) {
        return Err(format!("its rotation is a quaternion of length {length}, not 1"));
    }
    // Dividing by a length that differs from 1 by rounding alone would change bits.
    Ok(if (length - 1.0).abs() < 4.0 * f64::EPSILON { quaternion } else { quaternion.normalize() })
}

/// Four numbers of a row.
fn numbers(row: &Value) -> Option<[f64; 4]> {
    let numbers: Vec<f64> = row.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// The rotation nearest to a matrix: its polar factor, by Newton and Schulz's iteration.
fn nearest_rotation(matrix: DMat3) -> Result<DMat3, String> {
    let excess = matrix.transpose() * matrix - DMat3::IDENTITY;
    let error = excess.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    if !(matrix.is_finite() && error <= ORTHONORMAL) {
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length);
        return Err(format!(
            "its pose is no rotation and translation: the columns have the lengths {x}, {y}, {z}, or are not square to each other"
        ));
    }
    if matrix.determinant() < 0.0 {
        return Err("its pose is a mirror image; negate one axis, or name the other convention".to_owned());
    }
    // The error is squared each time: 1e-3 needs three.
    let better = |r: DMat3, _| r * 1.5 - r * (r.transpose() * r) * 0.5;
    Ok((0..4).fold(matrix, better))
}
