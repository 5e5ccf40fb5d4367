//! Rays, and what they meet.

use glam::Vec3;

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Any length but zero; distances are counted in it.
    pub direction: Vec3,
}

impl Ray {
    /// The point at a distance, in lengths of the direction.
    pub fn at(&self, distance: f32) -> Vec3 {
        self.origin + self.direction * distance
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// From the origin, in lengths of the direction.
    pub distance: f32,
    /// The number of the triangle.
    pub triangle: u32,
    /// Weights of the three corners; their sum is 1 but for rounding, and none is
    /// negative.
    pub weights: [f32; 3],
}
