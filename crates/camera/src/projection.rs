//! Projections: the shape of the visible space and its mapping to clip space. Every constructor
//! checks its parameters, and the fields cannot be written from outside this crate, so a
//! `Projection` is always valid.

use trigon_math::{DMat4, DVec2, DVec3, elementary};

use crate::CameraError;
use crate::clip_map::ClipMap;

/// The shape of the visible space.
///
/// Depth is reversed: 1 on the near plane, 0 on the far plane or, if `far` is
/// `None`, at infinity. Distances are along the line of sight, from the eye.
///
/// **Aspect.** [`Perspective`](Self::Perspective) and [`Orthographic`](Self::Orthographic) fix the
/// vertical extent; the horizontal one follows from the image. [`Frustum`](Self::Frustum) and
/// [`Pinhole`](Self::Pinhole) fix both, see [`Projection::own_aspect`]: their window covers the
/// whole image, so an image of another aspect is stretched. Tiles, stereo pairs and scaled
/// calibrated images need this.
///
/// The variants can be matched, but only the constructors build them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// A symmetric perspective.
    #[non_exhaustive]
    Perspective {
        /// The full angle between the lower and the upper edge, in `(0, π)`.
        vertical_fov: f64,
        /// Distance of the near plane, greater than 0.
        near: f64,
        /// Distance of the far plane, greater than `near`; `None` is infinity.
        far: Option<f64>,
    },
    /// A parallel projection.
    #[non_exhaustive]
    Orthographic {
        /// Height of the visible window, greater than 0.
        height: f64,
        /// Distance of the near plane; may be negative (behind the eye).
        near: f64,
        /// Distance of the far plane, greater than `near`.
        far: f64,
    },
    /// A perspective through an arbitrary window on the near plane.
    #[non_exhaustive]
    Frustum {
        /// x of the window's left edge on the near plane.
        left: f64,
        /// x of the window's right edge on the near plane.
        right: f64,
        /// y of the window's lower edge on the near plane.
        bottom: f64,
        /// y of the window's upper edge on the near plane.
        top: f64,
        /// Distance of the near plane, greater than 0.
        near: f64,
        /// Distance of the far plane, greater than `near`; `None` is infinity.
        far: Option<f64>,
    },
    /// A calibrated camera: the matrix K of computer vision, in pixels.
    #[non_exhaustive]
    Pinhole {
        /// Focal lengths in pixels, greater than 0.
        focal: DVec2,
        /// Principal point on the screen: origin top-left corner, y down,
        /// pixel centres at +0.5.
        center: DVec2,
        /// Size in pixels of the image that K belongs to.
        size: DVec2,
        /// Distance of the near plane, greater than 0.
        near: f64,
        /// Distance of the far plane, greater than `near`; `None` is infinity.
        far: Option<f64>,
    },
}

/// Default vertical field of view: 30 degrees, as in VTK and F3D.
const DEFAULT_VERTICAL_FOV: f64 = std::f64::consts::PI / 6.0;

/// Default near plane. Reversed depth keeps its relative precision at any distance, so a small
/// value costs nothing.
const DEFAULT_NEAR: f64 = 0.01;

impl Default for Projection {
    /// 30 degrees, near plane at 0.01, no far plane.
    fn default() -> Self {
        Self::Perspective { vertical_fov: DEFAULT_VERTICAL_FOV, near: DEFAULT_NEAR, far: None }
    }
}

impl Projection {
    /// A symmetric perspective. `vertical_fov` is the full angle in radians.
    ///
    /// # Errors
    /// `vertical_fov` is not between 0 and π, or not `0 < near < far`.
    pub fn perspective(vertical_fov: f64, near: f64, far: Option<f64>) -> Result<Self, CameraError> {
        let half = elementary::tan(vertical_fov * 0.5);
        // Of angles from 0 on, those near 0 and π have no normal tangent or none for its reciprocal.
        let good = (0.0..std::f64::consts::PI).contains(&vertical_fov)
            && half.is_normal()
            && half.recip().is_normal();
        CameraError::check("the vertical field of view", vertical_fov, good, "between 0 and π, exclusive")?;
        check_planes(near, far)?;
        Ok(Self::Perspective { vertical_fov, near, far })
    }

    /// One-point perspective by focal length, as in courses on computer graphics. The image plane stands at
    /// distance `focal_length` from the eye, and the visible window on it is `height` tall. Objects on it are
    /// drawn in their true size. With `z` measured from the image plane away from the eye this is the matrix
    /// with `r = 1 / focal_length`: `x' = x / (1 + r·z)`, `y' = y / (1 + r·z)` (Rogers and Adams,
    /// *Mathematical Elements for Computer Graphics*, one-point perspective). The orthographic projection of
    /// the same `height` is its limit for an infinite focal length; [`Projection::to_orthographic`] switches
    /// to it.
    ///
    /// # Errors
    /// A parameter is not positive and finite, or `near` is not less than `far`.
    pub fn one_point(
        focal_length: f64,
        height: f64,
        near: f64,
        far: Option<f64>,
    ) -> Result<Self, CameraError> {
        CameraError::check_positive("the focal length", focal_length)?;
        CameraError::check_positive("the window's height", height)?;
        Self::perspective(2.0 * elementary::atan2(height * 0.5, focal_length), near, far)
    }

    /// A parallel projection of a window `height` tall.
    ///
    /// # Errors
    /// `height` is not positive, `near` is not less than `far`, or a value is not finite. `near`
    /// may be negative.
    pub fn orthographic(height: f64, near: f64, far: f64) -> Result<Self, CameraError> {
        CameraError::check_positive("the window's height", height)?;
        CameraError::check_ordered("near", near, "far", far)?;
        Ok(Self::Orthographic { height, near, far })
    }

    /// A perspective through the window `left..right` by `bottom..top` on the
    /// near plane; it need not contain the line of sight.
    ///
    /// # Errors
    /// Not `left < right`, `bottom < top` and `0 < near < far`, or a value is not finite.
    pub fn frustum(
        left: f64,
        right: f64,
        bottom: f64,
        top: f64,
        near: f64,
        far: Option<f64>,
    ) -> Result<Self, CameraError> {
        CameraError::check_ordered("left", left, "right", right)?;
        CameraError::check_ordered("bottom", bottom, "top", top)?;
        check_planes(near, far)?;
        Ok(Self::Frustum { left, right, bottom, top, near, far })
    }

    /// The same frustum from two triples: `(left, bottom, near)` and `(right, top, far)`. Left,
    /// bottom, right and top are measured on the near plane; near and far are distances and
    /// therefore positive.
    ///
    /// # Errors
    /// As [`Projection::frustum`].
    pub fn frustum_from_corners(near_corner: DVec3, far_corner: DVec3) -> Result<Self, CameraError> {
        Self::frustum(
            near_corner.x,
            far_corner.x,
            near_corner.y,
            far_corner.y,
            near_corner.z,
            Some(far_corner.z),
        )
    }

    /// Camera space to clip space, for column vectors and an image of this `aspect` (width over
    /// height; anything but a positive number counts as 1).
    #[must_use]
    pub fn matrix(&self, aspect: f64) -> DMat4 {
        self.clip_map(aspect).matrix()
    }

    /// The aspect of the window, if the projection fixes it.
    #[must_use]
    pub fn own_aspect(&self) -> Option<f64> {
        match *self {
            Self::Perspective { .. } | Self::Orthographic { .. } => None,
            Self::Frustum { left, right, bottom, top, .. } => Some((right - left) / (top - bottom)),
            Self::Pinhole { focal, size, .. } => Some((size.x / focal.x) / (size.y / focal.y)),
        }
    }

    /// Height of the visible window at this distance from the eye.
    #[must_use]
    pub fn height_at(&self, distance: f64) -> f64 {
        match *self {
            Self::Perspective { vertical_fov, .. } => 2.0 * distance * elementary::tan(vertical_fov * 0.5),
            Self::Orthographic { height, .. } => height,
            Self::Frustum { bottom, top, near, .. } => distance * ((top - bottom) / near),
            Self::Pinhole { focal, size, .. } => distance * (size.y / focal.y),
        }
    }

    /// Distance of the near plane.
    #[must_use]
    pub fn near(&self) -> f64 {
        match *self {
            Self::Perspective { near, .. }
            | Self::Orthographic { near, .. }
            | Self::Frustum { near, .. }
            | Self::Pinhole { near, .. } => near,
        }
    }

    /// Distance of the far plane; `None` is infinity.
    #[must_use]
    pub fn far(&self) -> Option<f64> {
        match *self {
            Self::Orthographic { far, .. } => Some(far),
            Self::Perspective { far, .. } | Self::Frustum { far, .. } | Self::Pinhole { far, .. } => far,
        }
    }

    /// Whether lines of sight are parallel.
    #[must_use]
    pub fn is_orthographic(&self) -> bool {
        matches!(self, Self::Orthographic { .. })
    }

    /// The parallel projection that shows objects at `distance` in the same size. The planes are
    /// kept; an infinite far plane becomes one at a million times `distance`, which
    /// [`crate::Camera::with_clip_planes`] can move.
    ///
    /// # Errors
    /// `distance` is not positive and finite, or the window at it is not.
    pub fn to_orthographic(&self, distance: f64) -> Result<Self, CameraError> {
        const FAR: f64 = 1e6;
        CameraError::check_positive("the distance", distance)?;
        let far = self.far().unwrap_or(FAR * (distance + self.near()));
        Self::orthographic(self.height_at(distance), self.near(), far)
    }

    /// The same view with other planes. The window of a frustum is scaled along, so that the image
    /// stays the same.
    ///
    /// # Errors
    /// Not `near < far` (infinite for `None`), or not `0 < near` in a perspective. A parallel
    /// projection needs a far plane.
    pub fn with_planes(&self, near: f64, far: Option<f64>) -> Result<Self, CameraError> {
        match *self {
            Self::Perspective { vertical_fov, .. } => Self::perspective(vertical_fov, near, far),
            Self::Orthographic { height, .. } => {
                Self::orthographic(height, near, far.unwrap_or(f64::INFINITY))
            }
            Self::Frustum { left, right, bottom, top, near: old, .. } => {
                let s = near / old;
                Self::frustum(left * s, right * s, bottom * s, top * s, near, far)
            }
            Self::Pinhole { focal, center, size, .. } => {
                check_planes(near, far)?;
                Ok(Self::Pinhole { focal, center, size, near, far })
            }
        }
    }

    /// The six numbers behind the matrix.
    pub(crate) fn clip_map(&self, aspect: f64) -> ClipMap {
        let aspect = if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 };
        match *self {
            Self::Perspective { vertical_fov, near, far } => {
                let y = elementary::tan(vertical_fov * 0.5).recip();
                ClipMap::perspective(DVec2::new(y / aspect, y), DVec2::ZERO, near, far)
            }
            Self::Orthographic { height, near, far } => {
                let y = 2.0 / height;
                ClipMap::parallel(DVec2::new(y / aspect, y), near, far)
            }
            Self::Frustum { left, right, bottom, top, near, far } => {
                let size = DVec2::new(right - left, top - bottom);
                let sum = DVec2::new(right + left, top + bottom);
                ClipMap::perspective(DVec2::splat(2.0 * near) / size, sum / size, near, far)
            }
            Self::Pinhole { focal, center, size, near, far } => {
                let offset = 2.0 * center / size - DVec2::ONE;
                ClipMap::perspective(2.0 * focal / size, DVec2::new(-offset.x, offset.y), near, far)
            }
        }
    }
}

/// Checks the planes of a perspective.
pub(crate) fn check_planes(near: f64, far: Option<f64>) -> Result<(), CameraError> {
    CameraError::check_positive("near", near)?;
    let Some(far) = far else { return Ok(()) };
    CameraError::check_ordered("near", near, "far", far)?;
    // Equal in all but the last bit: no depth could be distinguished between them.
    if near / far < 1.0 {
        return Ok(());
    }
    Err(CameraError::Unordered { low_name: "near", low: near, high_name: "far", high: far })
}
