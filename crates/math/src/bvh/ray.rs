//! Rays and hits.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};
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

/// Eight rays, component by component.
#[derive(Clone, Copy, Debug)]
pub struct Rays<S: Simd> {
    /// Their origins, by axis.
    pub origin: [f32x8<S>; 3],
    /// By axis; of any length but zero. Distances are measured in it.
    pub direction: [f32x8<S>; 3],
    /// The least distance that counts, for each ray.
    pub start: f32x8<S>,
    /// The greatest.
    pub end: f32x8<S>,
    /// One bit for each ray, which says whether it is cast.
    pub active: u32,
}

impl<S: Simd> Rays<S> {
    /// A single ray.
    #[inline(always)]
    pub(super) fn one(simd: S, ray: &Ray, range: std::ops::Range<f32>) -> Self {
        let (origin, direction) = (ray.origin, ray.direction);
        let splat = |value: f32| f32x8::splat(simd, value);
        Self {
            origin: [splat(origin.x), splat(origin.y), splat(origin.z)],
            direction: [splat(direction.x), splat(direction.y), splat(direction.z)],
            start: splat(range.start),
            end: splat(range.end),
            active: 1,
        }
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
