//! Which axis is up on the screen. Documents have +Y up, as glTF has. Whoever is used to Blender sees and types all
//! positions with +Z up: letters, colours and numbers of axes follow it, nothing of a document does.
//!
//! Shown x is x, shown z is y, and shown y is −z: a rotation about x, without any rounding. It holds for the
//! world and for the space of each object alike, as if a program with +Z up had imported the document.

use serde::{Deserialize, Serialize};
use trigon_document::mesh::math::{DMat3, DQuat, DVec3};

/// The axis that is shown as up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum Up {
    /// As documents have it.
    #[default]
    Y,
    Z,
}

impl Up {
    /// The shown axes in the document, in columns.
    pub(crate) fn axes(self) -> DMat3 {
        match self {
            Self::Y => DMat3::IDENTITY,
            Self::Z => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
        }
    }

    /// Which of the shown axes an axis of the document is: 0 to 2.
    pub(crate) fn shown_axis(self, axis: usize) -> usize {
        match (self, axis) {
            (Self::Z, 1) => 2,
            (Self::Z, 2) => 1,
            _ => axis,
        }
    }

    /// A position or direction of the document as it is shown.
    pub(crate) fn shown(self, vector: DVec3) -> DVec3 {
        match self {
            Self::Y => vector,
            Self::Z => DVec3::new(vector.x, -vector.z, vector.y),
        }
    }

    /// The position or direction of the document that is shown so.
    pub(crate) fn stored(self, shown: DVec3) -> DVec3 {
        match self {
            Self::Y => shown,
            Self::Z => DVec3::new(shown.x, shown.z, -shown.y),
        }
    }

    /// Lengths or factors along the three axes, from the document to the screen or back.
    pub(crate) fn exchanged(self, along_axes: DVec3) -> DVec3 {
        match self {
            Self::Y => along_axes,
            Self::Z => DVec3::new(along_axes.x, along_axes.z, along_axes.y),
        }
    }

    /// A rotation of the document as it is shown: about the same axis, by the same angle.
    pub(crate) fn shown_rotation(self, rotation: DQuat) -> DQuat {
        let axis = self.shown(DVec3::new(rotation.x, rotation.y, rotation.z));
        DQuat::from_vec4(axis.extend(rotation.w))
    }

    /// The rotation of the document that is shown so.
    pub(crate) fn stored_rotation(self, shown: DQuat) -> DQuat {
        let axis = self.stored(DVec3::new(shown.x, shown.y, shown.z));
        DQuat::from_vec4(axis.extend(shown.w))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn z_is_up_and_minus_y_is_the_front_as_in_blender() {
        assert_eq!(Up::Z.shown(DVec3::Y), DVec3::Z, "up");
        assert_eq!(Up::Z.shown(DVec3::Z), DVec3::NEG_Y, "the front, from where a front view looks");
        assert_eq!(Up::Z.shown(DVec3::X), DVec3::X, "the right");
    }

    proptest! {
        #[test]
        fn all_forms_of_an_axis_agree(v in prop::array::uniform3(-1e3f64..1e3), angle in -3.0f64..3.0) {
            for up in [Up::Y, Up::Z] {
                let (vector, axes) = (DVec3::from(v), up.axes());
                let shown = up.shown(vector);
                prop_assert_eq!(up.stored(shown), vector, "back");
                prop_assert_eq!(axes * shown, vector, "the columns are the shown axes");
                prop_assert_eq!(axes.determinant(), 1.0, "a rotation");
                prop_assert_eq!(up.exchanged(vector.abs()), shown.abs(), "sizes have no sign");
                for axis in 0..3 {
                    let name = up.shown_axis(axis);
                    prop_assert_eq!(axes.col(name).abs(), DVec3::AXES[axis], "the same line");
                }
                let rotation = DQuat::from_axis_angle(vector.normalize_or(DVec3::X), angle);
                let turned = up.shown_rotation(rotation) * up.shown(DVec3::ONE);
                // Rounding of a rotation.
                prop_assert!((turned - up.shown(rotation * DVec3::ONE)).length() < 1e-12, "turns what is shown");
                prop_assert_eq!(up.stored_rotation(up.shown_rotation(rotation)), rotation, "back");
            }
        }
    }
}
