//! Calibrated cameras: the matrix K of computer vision as a [`Projection`].
//!
//! Programs that read the same K often disagree by half a pixel. So the caller must say where K
//! places the centre of the first pixel.

use trigon_math::DVec2;

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
    fn to_halves(self) -> f64 {
        match self {
            Self::AtIntegers => 0.5,
            Self::AtHalves => 0.0,
        }
    }
}

impl Projection {
    /// A pinhole camera without skew or lens distortion:
    /// `u = fx · X / Z + cx`, `v = fy · Y / Z + cy` with Z forward and Y *down*,
    /// as computer vision has it; [`crate::Camera::from_opencv`] turns a pose of
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
}
