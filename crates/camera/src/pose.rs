//! Cameras from matrices and back, in the conventions of graphics and of computer vision.

use trigon_math::{DAffine3, DMat3, DQuat, DVec3};

use crate::{Camera, CameraError, Projection};

/// Which way the axes of a camera point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CameraAxes {
    /// X right, Y up, looking along −Z: OpenGL, Blender, NeRF, trigon.
    OpenGl,
    /// X right, Y down, looking along +Z: OpenCV, COLMAP.
    OpenCv,
}

impl CameraAxes {
    /// The columns of a rotation from a camera's axes of this convention as those of trigon's convention, or back.
    fn exchanged(self, rotation: DMat3) -> DMat3 {
        match self {
            Self::OpenGl => rotation,
            Self::OpenCv => DMat3::from_cols(rotation.x_axis, -rotation.y_axis, -rotation.z_axis),
        }
    }
}

impl Camera {
    /// A camera of a pose: `to_world` takes the camera's space to the world. A rotation that is off by up to 10⁻³,
    /// such as one written with four digits, becomes the nearest rotation.
    ///
    /// # Errors
    /// The matrix is not finite, or more than a rotation and a translation.
    pub fn from_pose(
        to_world: &DAffine3,
        axes: CameraAxes,
        projection: Projection,
    ) -> Result<Self, CameraError> {
        let rotation = nearest_rotation(to_world)?;
        let orientation = DQuat::from_mat3(&axes.exchanged(rotation)).normalize();
        Ok(Self { position: to_world.translation, orientation, projection })
    }

    /// A camera of the extrinsic matrix `[R | t]` of computer vision, which takes the world to the camera's space:
    /// the inverse of a pose.
    ///
    /// ```
    /// use trigon_camera::math::{DAffine3, DVec3};
    /// use trigon_camera::{Camera, CameraAxes, Projection};
    ///
    /// // The world's origin is 5 m ahead.
    /// let ahead = DAffine3::from_translation(DVec3::new(0.0, 0.0, 5.0));
    /// let camera = Camera::from_extrinsics(&ahead, CameraAxes::OpenCv, Projection::default())?;
    /// assert_eq!(camera.forward(), DVec3::Z);
    /// assert_eq!(camera.extrinsics(CameraAxes::OpenCv), ahead);
    /// # Ok::<(), trigon_camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    /// As [`from_pose`](Self::from_pose).
    pub fn from_extrinsics(
        world_to_camera: &DAffine3,
        axes: CameraAxes,
        projection: Projection,
    ) -> Result<Self, CameraError> {
        let to_world = nearest_rotation(world_to_camera)?.transpose();
        let orientation = DQuat::from_mat3(&axes.exchanged(to_world)).normalize();
        Ok(Self { position: -(to_world * world_to_camera.translation), orientation, projection })
    }

    /// Takes the camera's space to the world.
    #[must_use]
    pub fn pose(&self, axes: CameraAxes) -> DAffine3 {
        let rotation = axes.exchanged(DMat3::from_quat(self.orientation));
        DAffine3 { matrix3: rotation, translation: self.position }
    }

    /// Takes the world to the camera's space: `[R | t]` of computer vision with [`CameraAxes::OpenCv`].
    #[must_use]
    pub fn extrinsics(&self, axes: CameraAxes) -> DAffine3 {
        let rotation = self.pose(axes).matrix3.transpose();
        DAffine3 { matrix3: rotation, translation: -(rotation * self.position) }
    }
}

/// The rotation nearest to a matrix: its polar factor, by Newton and Schulz's iteration.
fn nearest_rotation(pose: &DAffine3) -> Result<DMat3, CameraError> {
    /// How far the product of a rotation and its transpose may be from the identity.
    const ORTHONORMAL: f64 = 1e-3;
    let matrix = pose.matrix3;
    let excess = matrix.transpose() * matrix - DMat3::IDENTITY;
    let error = excess.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    if !(pose.is_finite() && error <= ORTHONORMAL) {
        let lengths = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length);
        return Err(CameraError::NoRotation { lengths });
    }
    if matrix.determinant() < 0.0 {
        return Err(CameraError::Mirrored);
    }
    // Each step squares the error: 1e-3 needs three.
    let better = |r: DMat3, _| r * 1.5 - r * (r.transpose() * r) * 0.5;
    Ok((0..4).fold(matrix, better))
}
