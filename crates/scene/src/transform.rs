//! The placement of a node relative to its parent.
//!
//! Everything is f64, because a model ten million metres from the origin must look the same as one at the
//! origin. The rotation is a unit quaternion, renormalized at every step, so that a million small rotations
//! do not shear the object.

use trigon_math::{DAffine3, DMat3, DQuat, DVec3, is_mirroring};

/// A node's placement in its parent: scale first, then rotation, then
/// translation; or any affine map, for files that carry sheared matrices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transform {
    /// Translation, rotation and scale.
    Decomposed {
        /// Position of the node's origin in its parent, in metres.
        translation: DVec3,
        /// A unit quaternion.
        rotation: DQuat,
        /// Factors along the node's own axes; negative factors mirror.
        scale: DVec3,
    },
    /// Any affine map.
    Affine(DAffine3),
}

impl Transform {
    /// The node coincides with its parent.
    pub const IDENTITY: Self =
        Self::Decomposed { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE };

    /// A translation alone.
    #[must_use]
    pub fn from_translation(translation: DVec3) -> Self {
        Self::Decomposed { translation, rotation: DQuat::IDENTITY, scale: DVec3::ONE }
    }

    /// Scale, then rotation, then translation. A rotation that is not finite
    /// or has no length counts as none.
    #[must_use]
    pub fn from_scale_rotation_translation(scale: DVec3, rotation: DQuat, translation: DVec3) -> Self {
        Self::Decomposed { translation, rotation: unit(rotation), scale }
    }

    /// The map from the node's space into its parent's.
    #[must_use]
    pub fn to_affine(&self) -> DAffine3 {
        match *self {
            Self::Decomposed { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
            Self::Affine(affine) => affine,
        }
    }

    /// Whether the numbers of its map are within those of an f32, which files have. False where one is not finite.
    #[must_use]
    pub fn fits_f32(&self) -> bool {
        self.to_affine().to_cols_array().iter().all(|number| number.abs() <= f64::from(f32::MAX))
    }

    /// Whether it mirrors. Computed from the factors themselves: in a product of matrices that
    /// nearly flatten something, rounding is larger than the rest.
    pub(crate) fn is_mirroring(&self) -> bool {
        match self {
            Self::Decomposed { scale, .. } => {
                scale.to_array().iter().filter(|&&factor| factor < 0.0).count() % 2 == 1
            }
            Self::Affine(affine) => is_mirroring(&affine.matrix3),
        }
    }

    /// Position of the node's origin in its parent.
    #[must_use]
    pub fn translation(&self) -> DVec3 {
        match self {
            Self::Decomposed { translation, .. } => *translation,
            Self::Affine(affine) => affine.translation,
        }
    }

    /// Moves the node's origin to a point in its parent's space.
    pub fn set_translation(&mut self, to: DVec3) {
        match self {
            Self::Decomposed { translation, .. } => *translation = to,
            Self::Affine(affine) => affine.translation = to,
        }
    }

    /// Moves the node along its parent's axes.
    pub fn translate(&mut self, by: DVec3) {
        self.set_translation(self.translation() + by);
    }

    /// Rotates the node about its own origin, around an axis in its parent's space, by `angle`
    /// radians counter-clockwise seen from the axis' tip. An axis without length has no effect.
    pub fn rotate(&mut self, axis: DVec3, angle: f64) {
        let Some(axis) = axis.try_normalize() else { return };
        let (sine, cosine) = trigon_math::elementary::sin_cos(angle * 0.5);
        let turn = DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine);
        match self {
            Self::Decomposed { rotation, .. } => *rotation = unit(turn * *rotation),
            Self::Affine(affine) => affine.matrix3 = DMat3::from_quat(unit(turn)) * affine.matrix3,
        }
    }

    /// Scales the node about its own origin, along its own axes.
    pub fn scale_by(&mut self, factor: DVec3) {
        match self {
            Self::Decomposed { scale, .. } => *scale *= factor,
            Self::Affine(affine) => affine.matrix3 *= DMat3::from_diagonal(factor),
        }
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// The unit quaternion in the same direction; the identity if there is none.
fn unit(rotation: DQuat) -> DQuat {
    let length = rotation.length();
    if length.is_finite() && length > 0.0 { rotation / length } else { DQuat::IDENTITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_small_turns_keep_the_object_rigid() {
        let mut transform = Transform::IDENTITY;
        for _ in 0..1_000_000 {
            transform.rotate(DVec3::new(1.0, 2.0, 3.0), 1e-3);
        }
        let Transform::Decomposed { rotation, .. } = transform else { panic!("rotation keeps the kind") };
        assert!((rotation.length() - 1.0).abs() < 1e-15, "length {}", rotation.length());
    }

    #[test]
    fn a_quaternion_without_length_is_no_rotation() {
        let zero = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        let transform = Transform::from_scale_rotation_translation(DVec3::ONE, zero, DVec3::X);
        assert_eq!(transform.to_affine(), DAffine3::from_translation(DVec3::X), "identity rotation");
    }
}
