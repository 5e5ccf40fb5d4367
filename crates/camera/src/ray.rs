//! A half-line, as it comes out of a pixel.

use trigon_math::DVec3;

/// A half-line in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes, unit length.
    pub direction: DVec3,
}

impl Ray {
    /// The point at this distance along the ray.
    #[must_use]
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }
}
