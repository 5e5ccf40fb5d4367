//! A ray from each point to the light (T. Whitted, "An improved illumination model for shaded display", CACM
//! 23(6), 1980), tested against a tree of triangles.

use super::ball_on_floor::{LIGHT, on_floor, triangles};
use trigon_math::{Bvh, Ray, Vec3};

/// A ball of 5,120 triangles in a tree.
pub struct ShadowRays {
    tree: Bvh,
}

impl Default for ShadowRays {
    fn default() -> Self {
        Self::new()
    }
}

impl ShadowRays {
    /// Builds the tree.
    #[must_use]
    pub fn new() -> Self {
        let triangles: Vec<[Vec3; 3]> =
            triangles().into_iter().map(|triangle| triangle.map(|corner| corner.as_vec3())).collect();
        Self { tree: Bvh::new(&triangles) }
    }

    /// 0 or 1.
    #[must_use]
    pub fn light(&self, point: [f64; 2]) -> f64 {
        let ray = Ray { origin: on_floor(point).as_vec3(), direction: LIGHT.as_vec3() };
        if self.tree.occluded(&ray, 0.0..f32::INFINITY) { 0.0 } else { 1.0 }
    }
}
