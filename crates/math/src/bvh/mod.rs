//! A bounding volume hierarchy over triangles: what a ray meets first, and
//! whether it meets anything.
//!
//! Built by the surface area heuristic over bins (I. Wald, "On fast Construction of
//! SAH-based Bounding Volume Hierarchies", 2007), in one fixed order, so that the
//! same triangles give the same tree. Rays leak through no edge and no vertex (S.
//! Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", 2013),
//! and the test of boxes is widened by its own rounding (T. Ize, "Robust BVH Ray
//! Traversal", 2013), so that a tree answers as a look at every triangle would.

mod build;
mod ray;
mod traverse;
mod triangle;

#[cfg(test)]
mod tests;

pub use ray::{Ray, RayHit};

use glam::Vec3;

/// A bounding volume hierarchy over triangles.
///
/// ```
/// use trigon_math::{Bvh, Ray, Vec3};
///
/// let floor = [[Vec3::new(-1.0, 0.0, 1.0), Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -1.0)]];
/// let bvh = Bvh::new(&floor);
/// let down = Ray { origin: Vec3::new(0.0, 2.0, 0.0), direction: Vec3::NEG_Y };
/// let hit = bvh.nearest(&down, 0.0..f32::INFINITY).expect("the floor is below");
/// assert_eq!((hit.triangle, hit.distance), (0, 2.0));
/// assert!(!bvh.meets_any(&down, 0.0..1.5), "it is too far away");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    /// In the order of the leaves.
    triangles: Vec<[Vec3; 3]>,
    /// Which triangle each of them was.
    numbers: Vec<u32>,
}

/// A box and what is in it.
#[derive(Clone, Copy, Debug)]
struct Node {
    min: Vec3,
    max: Vec3,
    /// Of a leaf its first triangle; else its second child (the first one follows
    /// it).
    next: u32,
    /// Triangles of a leaf, else 0.
    count: u32,
}

impl Bvh {
    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// What it holds in memory, in bytes.
    pub fn byte_count(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.numbers.as_slice())
    }
}
