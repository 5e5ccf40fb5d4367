//! Rays on their way through the tree.

use std::ops::Range;

use glam::Vec3;

use super::triangle::ShearedRay;
use super::{Bvh, Node, Ray, RayHit};

/// By how much the far side of a box is moved away: the rounding of its three
/// operations, twice (Ize 2013, section 4).
const WIDENED: f32 = 1.0 + 6.0 * f32::EPSILON;

/// Nodes that wait to be visited. Each level of the tree has at most 15/16 of the
/// triangles above it, so 2³² triangles make no more levels than this.
const WAITING: usize = 352;

impl Bvh {
    /// What the ray meets first within a range of distances; of equally near
    /// triangles that with the smallest number.
    pub fn nearest(&self, ray: &Ray, range: Range<f32>) -> Option<RayHit> {
        let mut nearest: Option<RayHit> = None;
        let mut end = range.end;
        self.visit(ray, range.start, &mut end, |hit, end| {
            let nearer = nearest.is_none_or(|best| {
                hit.distance < best.distance
                    || (hit.distance == best.distance && hit.triangle < best.triangle)
            });
            if nearer {
                *end = hit.distance;
                nearest = Some(hit);
            }
            false
        });
        nearest
    }

    /// Whether the ray meets anything within a range of distances, the end left
    /// out.
    pub fn meets_any(&self, ray: &Ray, range: Range<f32>) -> bool {
        let mut found = false;
        let mut end = range.end;
        self.visit(ray, range.start, &mut end, |hit, end| {
            found = hit.distance < *end;
            found
        });
        found
    }

    /// Calls `found` with what the ray meets, in some order, until it says that
    /// this is enough; it may move the end of the range.
    fn visit(&self, ray: &Ray, start: f32, end: &mut f32, mut found: impl FnMut(RayHit, &mut f32) -> bool) {
        let possible = ray.origin.is_finite() && ray.direction.is_finite() && ray.direction != Vec3::ZERO;
        if self.nodes.is_empty() || !possible {
            return;
        }
        let sheared = ShearedRay::new(ray);
        let slabs = Slabs { origin: ray.origin, inverse: ray.direction.recip() };
        let mut waiting = [0_u32; WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let number = waiting[count];
            let node = &self.nodes[number as usize];
            if !slabs.meet(node, start, *end) {
                continue;
            }
            if node.count == 0 {
                let second = node.next;
                let nearer_first =
                    slabs.is_ahead(&self.nodes[number as usize + 1], &self.nodes[second as usize]);
                let order = if nearer_first { [second, number + 1] } else { [number + 1, second] };
                waiting[count..count + 2].copy_from_slice(&order);
                count += 2;
                continue;
            }
            let leaf = node.next as usize..(node.next + node.count) as usize;
            for (corners, &triangle) in self.triangles[leaf.clone()].iter().zip(&self.numbers[leaf]) {
                let Some((distance, weights)) = sheared.meets(corners) else { continue };
                if distance < start || distance > *end {
                    continue;
                }
                if found(RayHit { distance, triangle, weights }, end) {
                    return;
                }
            }
        }
    }
}

/// A ray made ready for boxes.
struct Slabs {
    origin: Vec3,
    inverse: Vec3,
}

impl Slabs {
    /// Whether the ray may meet a box within a range; `false` is certain.
    fn meet(&self, node: &Node, mut start: f32, mut end: f32) -> bool {
        for axis in 0..3 {
            let inverse = self.inverse[axis];
            let first = (node.min[axis] - self.origin[axis]) * inverse;
            let second = (node.max[axis] - self.origin[axis]) * inverse;
            let (near, far) = if inverse < 0.0 { (second, first) } else { (first, second) };
            // A ray within a side of the box gives no number, and is let through.
            if near > start {
                start = near;
            }
            if far * WIDENED < end {
                end = far * WIDENED;
            }
        }
        start <= end
    }

    /// Whether the first box lies before the second on the ray's way.
    fn is_ahead(&self, first: &Node, second: &Node) -> bool {
        let between = (second.min + second.max) - (first.min + first.max);
        let along = between.x * sign(self.inverse.x) + between.y * sign(self.inverse.y);
        along + between.z * sign(self.inverse.z) >= 0.0
    }
}

fn sign(value: f32) -> f32 {
    if value < 0.0 { -1.0 } else { 1.0 }
}
