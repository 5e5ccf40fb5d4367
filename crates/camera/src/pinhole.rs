//! Calibrated cameras: the matrix K of computer vision as a [`Projection`].
//!
//! Programs that read the same K often disagree by half a pixel. So the caller must say where K
//! places the centre of the first pixel.

use trigon_math::DVec2;

use crate::clip_map::Kind;
use crate::projection::check_planes;
use crate::{CameraError, Projection, Viewport};

/// Where the coordinates of K place the centre of the top-left pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PixelCenters {
    /// At `(0, 0)`: OpenCV, most calibration tools.
    AtIntegers,
    /// At `(0.5, 0.5)`: COLMAP, OpenGL, and trigon's own screens.
    AtHalves,
}

impl PixelCenters {
    /// The offset to coordinates with centres at +0.5.
    pub(crate) fn to_halves(self) -> f64 {
        match self {
            Self::AtIntegers => 0.5,
            Self::AtHalves => 0.0,
        }
    }
}

/// The camera matrix K without skew, in pixels: `u = fx · X / Z + cx`, `v = fy · Y / Z + cy` with Z
/// forward and Y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intrinsics {
    /// `(fx, fy)`.
    pub focal: DVec2,
    /// `(cx, cy)`, the principal point.
    pub center: DVec2,
}

impl Projection {
    /// A pinhole camera without skew or lens distortion:
    /// `u = fx · X / Z + cx`, `v = fy · Y / Z + cy` with Z forward and Y *down*,
    /// as computer vision has it; [`crate::Camera::from_extrinsics`] takes a pose of
    /// that convention into ours.
    ///
    /// `focal` is `(fx, fy)` and `center` is `(cx, cy)`, in pixels of an image of size `image`. An
    /// image of another size shows the same view, scaled. There is no far plane;
    /// [`Projection::with_planes`] sets one.
    ///
    /// # Errors
    /// The focal lengths or `near` are not positive, the centre is not finite, or the image has no
    /// pixels.
    pub fn pinhole(
        focal: DVec2,
        center: DVec2,
        image: Viewport,
        pixel_centers: PixelCenters,
        near: f64,
    ) -> Result<Self, CameraError> {
        let size = image.size();
        CameraError::check_positive("fx", focal.x)?;
        CameraError::check_positive("fy", focal.y)?;
        CameraError::check_finite("cx", center.x)?;
        CameraError::check_finite("cy", center.y)?;
        CameraError::check("the image's width", size.x, size.x > 0.0, "at least 1 pixel")?;
        CameraError::check("the image's height", size.y, size.y > 0.0, "at least 1 pixel")?;
        check_planes(near, None)?;
        let center = center + DVec2::splat(pixel_centers.to_halves());
        Ok(Self::Pinhole { focal, center, size, near, far: None })
    }

    /// The K of an image of this size: the inverse of [`Projection::pinhole`], for any perspective. `None` for
    /// a parallel projection, which has none.
    ///
    /// ```
    /// use trigon_camera::math::DVec2;
    /// use trigon_camera::{PixelCenters, Projection, Viewport};
    ///
    /// let image = Viewport { width: 640, height: 480 };
    /// let wide = Projection::perspective(90f64.to_radians(), 0.1, None)?;
    /// let k = wide.intrinsics(image, PixelCenters::AtHalves).expect("a perspective");
    /// // At 90 degrees half the height lies as far off the axis as ahead.
    /// assert!((k.focal - DVec2::splat(240.0)).length() < 1e-12);
    /// assert_eq!(k.center, DVec2::new(320.0, 240.0));
    /// # Ok::<(), trigon_camera::CameraError>(())
    /// ```
    #[must_use]
    pub fn intrinsics(&self, image: Viewport, pixel_centers: PixelCenters) -> Option<Intrinsics> {
        let map = self.clip_map(image.aspect());
        let half = image.size() * 0.5;
        // Device coordinates point up, rows down.
        let shift = DVec2::new(-map.shift.x, map.shift.y);
        let center = (shift + 1.0) * half - DVec2::splat(pixel_centers.to_halves());
        (map.kind == Kind::Perspective).then_some(Intrinsics { focal: map.scale * half, center })
    }
}
