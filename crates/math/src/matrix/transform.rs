//! Movements of space as matrices on homogeneous points.

use glam::{DMat4, DQuat, DVec3};

use super::Matrix;

impl Matrix<4, 4> {
    /// Moves points by `offset`; directions stay.
    #[must_use]
    pub fn translation(offset: DVec3) -> Self {
        DMat4::from_translation(offset).into()
    }

    /// Turns about an axis through the origin by `angle` in radians,
    /// counter-clockwise seen from the tip of the axis. The axis need not have
    /// unit length.
    ///
    /// `None` if the axis is zero or not finite, or the angle is not finite.
    #[must_use]
    pub fn rotation(axis: DVec3, angle: f64) -> Option<Self> {
        let axis = axis.try_normalize()?;
        let turn = DQuat::from_axis_angle(axis, angle);
        turn.is_finite().then(|| DMat4::from_quat(turn).into())
    }
}
