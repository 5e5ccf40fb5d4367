//! A camera: an eye, an orientation, and a projection.

use trigon_math::{DAffine3, DMat4, DQuat, DVec3};

use crate::{Projection, orientation_looking};

/// The position, orientation and projection of a camera.
///
/// In camera space the eye is the origin, the line of sight is −Z, +X is right
/// and +Y is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The eye, in world coordinates.
    pub position: DVec3,
    /// Rotates camera space into world space. Must have unit length.
    pub orientation: DQuat,
    /// The shape of the visible space.
    pub projection: Projection,
}

impl Default for Camera {
    /// At the origin, looking along −Z, with the default projection.
    fn default() -> Self {
        Self { position: DVec3::ZERO, orientation: DQuat::IDENTITY, projection: Projection::default() }
    }
}

impl Camera {
    /// A camera at `position` that looks at `target`, with `up` towards the upper edge of the image
    /// and the default projection.
    ///
    /// A target equal to the position counts as one along −Z; for an `up` along the line of sight
    /// see [`orientation_looking`].
    #[must_use]
    pub fn look_at(position: DVec3, target: DVec3, up: DVec3) -> Self {
        Self {
            position,
            orientation: orientation_looking(target - position, up),
            projection: Projection::default(),
        }
    }

    /// The same camera with another projection.
    #[must_use]
    pub fn with_projection(self, projection: Projection) -> Self {
        Self { projection, ..self }
    }

    /// World to camera space. Far from the origin prefer [`Camera::to_camera`], which subtracts
    /// before it rotates.
    #[must_use]
    pub fn view(&self) -> DAffine3 {
        let turn = self.orientation.conjugate();
        DAffine3::from_rotation_translation(turn, turn * -self.position)
    }

    /// World to clip space, for an image of this aspect (width over height).
    #[must_use]
    pub fn view_projection(&self, aspect: f64) -> DMat4 {
        self.projection.matrix(aspect) * DMat4::from(self.view())
    }

    /// A world point in camera space. The eye is subtracted first, so the result is as accurate at
    /// 10⁷ metres from the origin as at the origin.
    #[must_use]
    pub fn to_camera(&self, point: DVec3) -> DVec3 {
        self.orientation.conjugate() * (point - self.position)
    }

    /// A point of camera space in the world.
    #[must_use]
    pub fn to_world(&self, point: DVec3) -> DVec3 {
        self.orientation * point + self.position
    }

    /// The line of sight, unit length, in the world.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        self.orientation * DVec3::NEG_Z
    }

    /// Towards the right edge of the image, unit length, in the world.
    #[must_use]
    pub fn right(&self) -> DVec3 {
        self.orientation * DVec3::X
    }

    /// Towards the upper edge of the image, unit length, in the world.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.orientation * DVec3::Y
    }
}
