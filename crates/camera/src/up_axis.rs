//! Which way is up in a world, and which sides are right and front therefore.

use std::fmt;
use std::str::FromStr;

use trigon_math::{DMat3, DVec3};

use crate::CameraError;
use crate::unit::unit_or;

/// The up axis of a world. It also decides which sides are right and front:
///
/// | up | right | front |
/// |---|---|---|
/// | +Y, as in glTF | +X | +Z |
/// | +Z, as in CAD and for printing | +X | −Y |
/// | −Y, −Z | +X | −Z, +Y |
/// | +X, −X | +Y | −Z, +Z |
///
/// Right is the world's +X made perpendicular to up, or its +Y if up is nearly ±X; front is right × up, the
/// side on which the viewer of a front view stands. F3D (1.3 and later) has the same sides.
///
/// ```
/// use trigon_camera::UpAxis;
/// use trigon_math::DVec3;
///
/// let up: UpAxis = "+Z".parse()?;
/// assert_eq!(up.direction(), DVec3::Z);
/// assert_eq!(up.frame().z_axis, DVec3::NEG_Y, "the front");
/// // A point that lies in front in a world with +Y up lies in front here, too.
/// assert_eq!(UpAxis::Y.turn_to(up) * DVec3::Z, DVec3::NEG_Y);
/// # Ok::<(), trigon_camera::CameraError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpAxis {
    /// Right, up and front as columns, of length 1.
    frame: DMat3,
}

/// No component is NaN.
impl Eq for UpAxis {}

/// The axes by name.
const NAMED: [(&str, DVec3); 6] = [
    ("+X", DVec3::X),
    ("-X", DVec3::NEG_X),
    ("+Y", DVec3::Y),
    ("-Y", DVec3::NEG_Y),
    ("+Z", DVec3::Z),
    ("-Z", DVec3::NEG_Z),
];

impl UpAxis {
    /// +Y is up and +Z is the front.
    pub const Y: Self = Self { frame: DMat3::IDENTITY };

    /// +Z is up and −Y is the front.
    pub const Z: Self = Self { frame: DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y) };

    /// The axis of this direction, of any length; one that is zero or not finite counts as +Y. For the six
    /// axes the frame has no rounding: its components are 0 and ±1.
    #[must_use]
    pub fn new(direction: DVec3) -> Self {
        /// Cosine beyond which up counts as along ±X: about 2.6 degrees, as in F3D.
        const ALONG_X: f64 = 0.999;
        let up = unit(direction);
        let side = if up.x.abs() > ALONG_X { DVec3::Y } else { DVec3::X };
        let front = side.cross(up).normalize();
        // Sums with 0 have no negative zeros.
        let axes = [up.cross(front), up, front].map(|axis| axis + DVec3::ZERO);
        Self { frame: DMat3::from_cols(axes[0], axes[1], axes[2]) }
    }

    /// Up, of length 1.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.frame.y_axis
    }

    /// Right, up and front as columns: the rotation from a world with +Y up to this one. Right goes to right
    /// and front to front.
    #[must_use]
    pub fn frame(&self) -> DMat3 {
        self.frame
    }

    /// The rotation from a world with this up axis to one with another.
    #[must_use]
    pub fn turn_to(&self, other: Self) -> DMat3 {
        other.frame * self.frame.transpose()
    }
}

impl Default for UpAxis {
    /// +Y.
    fn default() -> Self {
        Self::Y
    }
}

impl FromStr for UpAxis {
    type Err = CameraError;

    /// `+Z`, `-x`, `Y`, or three numbers such as `0,1,0.5` that are not all zero: whatever [`fmt::Display`]
    /// writes is read as the same bits.
    fn from_str(text: &str) -> Result<Self, CameraError> {
        let text = text.to_ascii_uppercase();
        let is_named = |name: &str| name == text || name.strip_prefix('+') == Some(text.as_str());
        let named = NAMED.iter().find(|(name, _)| is_named(name)).map(|&(_, direction)| direction);
        let direction = named.or_else(|| three_numbers(&text)).ok_or(CameraError::UnknownAxis)?;
        Ok(Self::new(direction))
    }
}

impl fmt::Display for UpAxis {
    /// `+Z`, or `0.5,1,0` for a direction between the axes.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let up = self.direction();
        match NAMED.iter().find(|&&(_, direction)| direction == up) {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "{},{},{}", up.x, up.y, up.z),
        }
    }
}

/// Three finite numbers that are not all zero.
fn three_numbers(text: &str) -> Option<DVec3> {
    let numbers: Vec<f64> =
        text.split(',').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?;
    let direction = DVec3::from_array(numbers.try_into().ok()?);
    Some(direction).filter(|direction| direction.is_finite() && *direction != DVec3::ZERO)
}

/// The vector with length 1. One that has this length already keeps its bits, so that an axis made from the
/// direction of another one is the same.
fn unit(direction: DVec3) -> DVec3 {
    /// Rounding errors of normalization are smaller.
    const ROUNDING: f64 = 1e-14;
    let is_unit = (direction.length_squared() - 1.0).abs() < ROUNDING;
    if is_unit { direction } else { unit_or(direction, DVec3::Y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sides as F3D's `vtkF3DRenderer::InitializeUpVector` defines them.
    #[test]
    fn axes_have_exact_sides() {
        let expected = [
            ("+X", [DVec3::Y, DVec3::X, DVec3::NEG_Z]),
            ("-X", [DVec3::Y, DVec3::NEG_X, DVec3::Z]),
            ("+Y", [DVec3::X, DVec3::Y, DVec3::Z]),
            ("-Y", [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z]),
            ("+Z", [DVec3::X, DVec3::Z, DVec3::NEG_Y]),
            ("-Z", [DVec3::X, DVec3::NEG_Z, DVec3::Y]),
        ];
        for (name, [right, up, front]) in expected {
            let axis: UpAxis = name.parse().expect("an axis");
            assert_eq!(axis.frame(), DMat3::from_cols(right, up, front), "{name}");
            assert_eq!(axis.frame().determinant(), 1.0, "{name} is not mirrored");
            assert_eq!(axis.to_string(), name, "written as read");
            assert_eq!(UpAxis::new(up * 1e-30), axis, "{name} of another length");
        }
        assert_eq!("z".parse(), Ok(UpAxis::Z), "without a sign, in any case");
        for broken in ["+W", "", "1,2", "0,0,0", "nan,0,1", "1,2,3,4"] {
            assert_eq!(broken.parse::<UpAxis>(), Err(CameraError::UnknownAxis), "{broken}");
        }
    }

    #[test]
    fn any_direction_has_perpendicular_sides() {
        for direction in [
            DVec3::new(1.0, 2.0, -3.0),
            DVec3::new(-1.0, 1e-3, 0.0),
            DVec3::new(1.0, 0.05, 0.0),
            DVec3::new(1e-200, 1e-200, 0.0),
        ] {
            let axis = UpAxis::new(direction);
            let error = axis.frame() * axis.frame().transpose() - DMat3::IDENTITY;
            let largest =
                error.to_cols_array().into_iter().fold(0.0, |most: f64, component| most.max(component.abs()));
            assert!(largest < 1e-15, "{direction}: {largest}");
            assert!(axis.direction().dot(direction) > 0.0, "{direction} is up");
            assert_eq!(UpAxis::new(axis.direction()), axis, "{direction}: the same bits again");
            assert_eq!(axis.to_string().parse(), Ok(axis), "{direction}: also as text");
        }
    }

    #[test]
    fn a_direction_without_length_is_that_of_gltf() {
        for broken in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
            assert_eq!(UpAxis::new(broken), UpAxis::Y, "{broken}");
        }
    }

    #[test]
    fn turns_take_sides_to_sides() {
        let turn = UpAxis::Z.turn_to(UpAxis::Y);
        assert_eq!(turn * DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 3.0, -2.0), "up and back");
        assert_eq!(UpAxis::Y.turn_to(UpAxis::Z) * turn, DMat3::IDENTITY, "and back again");
    }
}
