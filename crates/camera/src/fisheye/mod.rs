//! Fisheye lenses: equidistant ones, and those of OpenCV's calibration (Kannala and Brandt). The distance from the
//! centre of the image follows the angle from the axis and not its tangent, so that they see beyond 90°.
//!
//! No matrix maps space to such an image: a [`FisheyeCamera`] is no [`Camera`](crate::Camera), and only rays draw it.

mod distortion;
mod posed;

use trigon_math::{DVec2, DVec3, elementary};

use crate::{CameraError, PixelCenters, Viewport};
use distortion::Distortion;

pub use posed::FisheyeCamera;

/// A fisheye lens with the image that it belongs to.
///
/// A point whose direction is at the angle θ from the axis is drawn at `c + f · d(θ)` from the centre `c`, towards the
/// side on which it lies. Equidistant lenses have `d(θ) = θ`, those of OpenCV's `cv2.fisheye`
/// `d(θ) = θ (1 + k₁θ² + k₂θ⁴ + k₃θ⁶ + k₄θ⁸)` (J. Kannala and S. Brandt, "A Generic Camera Model and Calibration Method
/// for Conventional, Wide-Angle, and Fish-Eye Lenses", 2006).
///
/// The lens ends at its greatest angle: where `d` ceases to increase, at 180°, or where [`with_fov`](Self::with_fov)
/// ends it. Pixels beyond show nothing.
///
/// ```
/// use trigon_camera::math::{DVec2, DVec3};
/// use trigon_camera::{FisheyeLens, PixelCenters, Viewport};
///
/// let image = Viewport { width: 400, height: 400 };
/// let lens = FisheyeLens::new(DVec2::splat(100.0), DVec2::splat(200.0), image, PixelCenters::AtHalves, [0.0; 4])?;
/// // Straight to the right, at 90° from the axis.
/// let pixel = lens.project(DVec3::X).expect("less than 180°");
/// assert!((pixel - DVec2::new(200.0 + 100.0 * std::f64::consts::FRAC_PI_2, 200.0)).length() < 1e-12);
/// assert!((lens.ray(pixel).expect("the same") - DVec3::X).length() < 1e-15);
/// # Ok::<(), trigon_camera::CameraError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FisheyeLens {
    /// In pixels.
    focal: DVec2,
    /// The first pixel's centre is at (0.5, 0.5).
    center: DVec2,
    /// Of the image, in pixels.
    size: DVec2,
    distortion: Distortion,
}

/// The ray of a pixel, and how it changes from pixel to pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FisheyeRay {
    /// In camera space, of length 1.
    pub direction: DVec3,
    /// Its derivatives to the right and downwards, per pixel. At the rim of a lens whose `d` ends there they may be
    /// infinite.
    pub steps: [DVec3; 2],
}

impl FisheyeLens {
    /// A lens with focal lengths `(fx, fy)` and centre `(cx, cy)` in pixels of an image of size `image`. `distortion` is
    /// `k₁` to `k₄` of `cv2.fisheye`; all 0 is an equidistant lens. An image of another size shows the same view,
    /// scaled.
    ///
    /// # Errors
    /// The focal lengths are not positive, another number is not finite, or the image has no pixels.
    pub fn new(
        focal: DVec2,
        center: DVec2,
        image: Viewport,
        pixel_centers: PixelCenters,
        distortion: [f64; 4],
    ) -> Result<Self, CameraError> {
        let size = image.size();
        CameraError::check_positive("fx", focal.x)?;
        CameraError::check_positive("fy", focal.y)?;
        CameraError::check_finite("cx", center.x)?;
        CameraError::check_finite("cy", center.y)?;
        for (name, value) in ["k1", "k2", "k3", "k4"].into_iter().zip(distortion) {
            CameraError::check_finite(name, value)?;
        }
        CameraError::check("the image's width", size.x, size.x > 0.0, "at least 1 pixel")?;
        CameraError::check("the image's height", size.y, size.y > 0.0, "at least 1 pixel")?;
        let center = center + DVec2::splat(pixel_centers.to_halves());
        Ok(Self { focal, center, size, distortion: Distortion::new(distortion) })
    }

    /// The same lens, seeing no more than the full angle `fov` in radians.
    ///
    /// # Errors
    /// `fov` is not above 0 and at most 2π.
    pub fn with_fov(self, fov: f64) -> Result<Self, CameraError> {
        let is_sound = fov > 0.0 && fov <= std::f64::consts::TAU;
        CameraError::check("the field of view", fov, is_sound, "above 0 and at most 2π")?;
        Ok(Self { distortion: self.distortion.up_to(fov * 0.5), ..self })
    }

    /// The greatest angle from the axis that it shows, in radians; at most π.
    #[must_use]
    pub fn greatest_angle(&self) -> f64 {
        self.distortion.greatest_angle()
    }

    /// `k₁` to `k₄`.
    #[must_use]
    pub fn distortion(&self) -> [f64; 4] {
        self.distortion.coefficients()
    }

    /// The focal lengths and the centre for an image of this size.
    #[must_use]
    pub fn intrinsics(&self, image: Viewport, pixel_centers: PixelCenters) -> crate::Intrinsics {
        let scaled = self.for_image(image);
        let center = scaled.center - DVec2::splat(pixel_centers.to_halves());
        crate::Intrinsics { focal: scaled.focal, center }
    }

    /// The image that the lens was calibrated for, width over height.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        self.size.x / self.size.y
    }

    /// The same view in an image of this size. An image without pixels changes nothing.
    #[must_use]
    pub fn for_image(&self, image: Viewport) -> Self {
        let size = image.size();
        if size.cmple(DVec2::ZERO).any() {
            return *self;
        }
        let scale = size / self.size;
        Self { focal: self.focal * scale, center: self.center * scale, size, ..*self }
    }

    /// Where the lens shows a point of camera space (looking along −Z, Y up), in pixels of its image. `None` for points
    /// beyond its greatest angle, the eye itself, and points exactly behind it, which have no side.
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        let largest = point.abs().max_element();
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        // Large and small numbers do not overflow when squared.
        let DVec3 { x: right, y: up, z: back } = point / largest;
        let side = DVec2::new(right, -up);
        let across = side.length();
        let angle = elementary::atan2(across, -back);
        let radius = self.distortion.distorted(angle)?;
        match across > 0.0 {
            true => Some(self.center + self.focal * (side / across) * radius),
            false => (back < 0.0).then_some(self.center),
        }
    }

    /// The ray of a position in the image, a unit vector in camera space. `None` beyond the greatest angle.
    ///
    /// The angle is found by Newton's method in f64, to within 4 units in its last place of a root of the rounded
    /// polynomial.
    #[must_use]
    pub fn ray(&self, pixel: DVec2) -> Option<DVec3> {
        Some(self.ray_with_steps(pixel)?.direction)
    }

    /// As [`ray`](Self::ray), with the derivatives.
    #[must_use]
    pub fn ray_with_steps(&self, pixel: DVec2) -> Option<FisheyeRay> {
        let image = (pixel - self.center) / self.focal;
        let radius = image.length();
        let angle = self.distortion.angle(radius)?;
        let (sine, cosine) = elementary::sin_cos(angle);
        // In the middle every side is as good.
        let side = if radius > 0.0 { image / radius } else { DVec2::X };
        let spread = if radius > 0.0 { sine / radius } else { 1.0 };
        let outwards = DVec3::new(cosine * side.x, -cosine * side.y, sine) / self.distortion.slope(angle);
        let around = DVec3::new(-side.y, -side.x, 0.0) * spread;
        Some(FisheyeRay {
            direction: DVec3::new(sine * side.x, -sine * side.y, -cosine),
            steps: [
                (outwards * side.x - around * side.y) / self.focal.x,
                (outwards * side.y + around * side.x) / self.focal.y,
            ],
        })
    }
}
