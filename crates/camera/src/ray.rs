//! Rays through pixels.

use trigon_math::DVec3;

/// A ray in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Its origin.
    pub origin: DVec3,
    /// Its direction, unit length.
    pub direction: DVec3,
}

impl Ray {
    /// The point at this distance along the ray.
    #[must_use]
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }
}
