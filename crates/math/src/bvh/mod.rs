//! A bounding volume hierarchy over triangles: the first hit of a ray, and whether it hits
//! anything.
//!
//! Built by the surface area heuristic over bins (I. Wald, "On fast Construction of SAH-based Bounding Volume
//! Hierarchies", 2007), in one fixed order, so that the same triangles give the same tree. Rays leak through no
//! edge and no vertex (S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", 2013). Eight boxes
//! or eight triangles are tested at once (H. Dammertz, J. Hanika and A. Keller, "Shallow Bounding Volume
//! Hierarchies for Fast SIMD Ray Tracing", 2008), and eight rays are prepared at once. The box test is widened by its
//! own rounding (T. Ize, "Robust BVH Ray Traversal", 2013), so that the tree gives the same results as testing every
//! triangle, at every SIMD level.

mod bits;
mod build;
mod extent;
mod packet;
mod prepared;
mod ray;
mod refit;
mod stack;
mod surroundings;
mod traverse;
mod triangle;
mod wide;

#[cfg(test)]
mod tests;

pub use ray::{Ray, RayHit, Rays};
pub use surroundings::{Hemispheres, Surroundings};

use glam::Vec3;

use wide::{Child, Leaf, Node};

use crate::simd::Token;

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
/// assert!(!bvh.occluded(&down, 0.0..1.5), "it is too far away");
/// ```
#[derive(Clone, Debug)]
pub struct Bvh {
    root: Child,
    /// Children before their parents.
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
    /// Triangles in all leaves.
    len: usize,
    /// The corners of their box.
    extent: [Vec3; 2],
    /// The boxes that a ray was expected to enter when the tree was built.
    cost: f32,
    /// The instructions that the processor has.
    level: Token,
}

impl Default for Bvh {
    fn default() -> Self {
        Self::new(&[])
    }
}

impl Bvh {
    /// The number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Its memory in bytes.
    #[must_use]
    pub fn byte_count(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.leaves.as_slice())
    }
}
