//! Rays and hits.

use glam::Vec3;

/// A ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Its origin.
    pub origin: Vec3,
    /// Any length but zero; distances are measured in it.
    pub direction: Vec3,
}

impl Ray {
    /// The point at a distance, in lengths of the direction.
    #[must_use]
    pub fn at(&self, distance: f32) -> Vec3 {
        self.origin + self.direction * distance
    }
}

/// The hit of a ray on a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RayHit {
    /// From the origin, in lengths of the direction.
    pub distance: f32,
    /// The number of the triangle.
    pub triangle: u32,
    /// Barycentrics of the three corners; their sum is 1 up to rounding, and none is negative.
    pub weights: [f32; 3],
}
