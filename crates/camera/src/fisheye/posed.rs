//! A fisheye lens at a pose.

use trigon_math::{DAffine3, DQuat, DVec2, DVec3};

use super::FisheyeLens;
use crate::{Camera, CameraAxes, CameraError, Projection, Ray, Viewport};

/// The position, orientation and lens of a fisheye camera. In camera space the eye is the origin, the axis of the lens
/// is −Z, +X is right and +Y is up, as for a [`Camera`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FisheyeCamera {
    /// The eye, in world coordinates.
    pub position: DVec3,
    /// Rotates camera space into world space. Must have unit length.
    pub orientation: DQuat,
    /// The lens.
    pub lens: FisheyeLens,
}

impl FisheyeCamera {
    /// A camera of a pose, which takes the camera's space to the world; see [`Camera::from_pose`].
    ///
    /// # Errors
    /// The matrix is not finite, or more than a rotation and a translation.
    pub fn from_pose(to_world: &DAffine3, axes: CameraAxes, lens: FisheyeLens) -> Result<Self, CameraError> {
        Ok(Self::at(&Camera::from_pose(to_world, axes, Projection::default())?, lens))
    }

    /// This lens in place of a camera's own.
    #[must_use]
    pub fn at(camera: &Camera, lens: FisheyeLens) -> Self {
        Self { position: camera.position, orientation: camera.orientation, lens }
    }

    /// A camera with another lens where this one is.
    #[must_use]
    pub fn with_projection(&self, projection: Projection) -> Camera {
        Camera { position: self.position, orientation: self.orientation, projection }
    }

    /// Where an image of this size shows a point of the world, in pixels; `None` for points that the lens does not see.
    #[must_use]
    pub fn project(&self, point: DVec3, image: Viewport) -> Option<DVec2> {
        self.lens.for_image(image).project(self.orientation.conjugate() * (point - self.position))
    }

    /// The ray of a position in an image of this size, in the world; `None` beyond the lens.
    #[must_use]
    pub fn ray(&self, pixel: DVec2, image: Viewport) -> Option<Ray> {
        let direction = self.lens.for_image(image).ray(pixel)?;
        Some(Ray { origin: self.position, direction: self.orientation * direction })
    }
}
