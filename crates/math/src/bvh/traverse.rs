//! Traversal of the tree.

use std::ops::Range;

use fearless_simd::Simd;

use super::bits::{last_bit, next_bit};
use super::packet::Packet;
use super::prepared::{PreparedRay, PreparedRays};
use super::stack::{Entered, Stack};
use super::surroundings::Surroundings;
use super::triangle::ShearedRay;
use super::wide::{Child, Eight, Inside, Leaf, WIDTH};
use super::{Bvh, Ray, RayHit, Rays};
use crate::at_level;

impl Bvh {
    /// The first hit of the ray within a range of distances; of equally near triangles the one with
    /// the smallest number.
    #[must_use]
    pub fn nearest(&self, ray: &Ray, range: Range<f32>) -> Option<RayHit> {
        self.nearest_of(ray, range, |_| true)
    }

    /// As [`nearest`](Self::nearest), of those hits alone that `counts` accepts. It is called in no particular order, and
    /// not for every hit.
    #[must_use]
    pub fn nearest_of(
        &self,
        ray: &Ray,
        range: Range<f32>,
        mut counts: impl FnMut(&RayHit) -> bool,
    ) -> Option<RayHit> {
        at_level!(self.level, simd => self.nearest_one(simd, &Rays::one(simd, ray, range), &mut counts))
    }

    /// Whether the ray hits anything within a range of distances, excluding its end.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, range: Range<f32>) -> bool {
        at_level!(self.level, simd => self.occluded_one(simd, &Rays::one(simd, ray, range)))
    }

    /// The first hit of the first of eight rays, the only one.
    #[inline(always)]
    fn nearest_one<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        counts: &mut dyn FnMut(&RayHit) -> bool,
    ) -> Option<RayHit> {
        let rays = PreparedRays::new(simd, self, rays);
        let [mut nearest, ..] = Nearest::before(&rays.end);
        if rays.possible != 0 {
            self.nearest_below(simd, &PreparedRay::new(&rays, 0), self.root, &mut nearest, counts);
        }
        nearest.hit
    }

    /// Whether the first of eight rays, the only one, hits anything.
    #[inline(always)]
    fn occluded_one<S: Simd>(&self, simd: S, rays: &Rays<S>) -> bool {
        let rays = PreparedRays::new(simd, self, rays);
        rays.possible != 0 && self.occluded_below(simd, &PreparedRay::new(&rays, 0), self.root)
    }

    /// The first hit of each of eight rays, as [`nearest_of`](Self::nearest_of) finds them. `counts` gets the number of the
    /// ray, too.
    #[must_use]
    pub fn nearest_rays<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        counts: &mut dyn FnMut(usize, &RayHit) -> bool,
    ) -> [Option<RayHit>; WIDTH] {
        simd.vectorize(
            #[inline(always)]
            || {
                let rays = PreparedRays::new(simd, self, rays);
                let mut nearest = Nearest::before(&rays.end);
                if let Some(packet) = Packet::new(simd, &rays) {
                    self.nearest_packet(simd, &packet, &mut nearest, counts);
                } else {
                    let mut left = rays.possible;
                    while let Some(lane) = next_bit(&mut left) {
                        let (ray, nearest) = (PreparedRay::new(&rays, lane), &mut nearest[lane]);
                        self.nearest_below(simd, &ray, self.root, nearest, &mut |hit| counts(lane, hit));
                    }
                }
                let mut hits = [None; WIDTH];
                for (hit, nearest) in hits.iter_mut().zip(nearest) {
                    *hit = nearest.hit;
                }
                hits
            },
        )
    }

    /// Which of eight rays hit anything within their ranges, excluding the ends: one bit for each. Rays that start among
    /// `surroundings` need not begin at the root.
    #[must_use]
    pub fn occluded_rays<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        surroundings: Option<&Surroundings>,
    ) -> u32 {
        simd.vectorize(
            #[inline(always)]
            || {
                let rays = PreparedRays::new(simd, self, rays);
                // Rays into a hemisphere run in all directions.
                if surroundings.is_none()
                    && let Some(packet) = Packet::new(simd, &rays)
                {
                    return self.occluded_packet(simd, &packet);
                }
                let (mut left, mut occluded) = (rays.possible, 0);
                while let Some(lane) = next_bit(&mut left) {
                    let ray = PreparedRay::new(&rays, lane);
                    let is_occluded = match surroundings {
                        Some(surroundings) => self.occluded_among(simd, &ray, surroundings),
                        None => self.occluded_below(simd, &ray, self.root),
                    };
                    occluded |= u32::from(is_occluded) << lane;
                }
                occluded
            },
        )
    }

    /// Whether a ray hits anything in a part of the tree.
    #[inline(always)]
    pub(super) fn occluded_below<S: Simd>(&self, simd: S, ray: &PreparedRay, root: Child) -> bool {
        let mut stack = Stack::new(root);
        stack.push(root);
        self.occluded_in(simd, ray, &mut stack)
    }

    #[inline(always)]
    fn occluded_among<S: Simd>(&self, simd: S, ray: &PreparedRay, surroundings: &Surroundings) -> bool {
        let mut stack = Stack::new(self.root);
        let end = ray.widened_end(simd, ray.sheared.end);
        for node in surroundings.nodes().iter().rev() {
            let mut entered = ray.boxes(simd, node, end).entered;
            while let Some(slot) = last_bit(&mut entered) {
                stack.push(node.children[slot]);
            }
        }
        self.occluded_in(simd, ray, &mut stack)
    }

    #[inline(always)]
    fn occluded_in<S: Simd>(&self, simd: S, ray: &PreparedRay, stack: &mut Stack<Child>) -> bool {
        let end = ray.widened_end(simd, ray.sheared.end);
        while let Some(mut child) = stack.pop() {
            loop {
                match child.inside() {
                    Inside::Leaf(number) => {
                        if self.is_hit(simd, &ray.sheared, &self.leaves[number]) {
                            return true;
                        }
                        break;
                    }
                    Inside::Node(number) => {
                        stack.reserve();
                        let node = &self.nodes[number];
                        let mut entered = ray.boxes(simd, node, end).entered;
                        // The largest box comes first: it is the likeliest to stop the ray (Ogaki and Derouet-Jourdan 2016).
                        let Some(first) = next_bit(&mut entered) else { break };
                        while let Some(slot) = last_bit(&mut entered) {
                            stack.push(node.children[slot]);
                        }
                        child = node.children[first];
                    }
                }
            }
        }
        false
    }

    /// Whether a ray hits a triangle of a leaf.
    #[inline(always)]
    pub(super) fn is_hit<S: Simd>(&self, simd: S, ray: &ShearedRay, leaf: &Leaf) -> bool {
        let mut candidates = ray.candidates(simd, leaf);
        while let Some(slot) = next_bit(&mut candidates) {
            let counts = |distance: f32| distance >= ray.start && distance < ray.end;
            if ray.crossing(leaf, slot).is_some_and(|found| counts(found.distance)) {
                return true;
            }
        }
        false
    }

    /// Finds the nearest hit of a ray in a part of the tree.
    #[inline(always)]
    pub(super) fn nearest_below<S: Simd>(
        &self,
        simd: S,
        ray: &PreparedRay,
        root: Child,
        nearest: &mut Nearest,
        counts: &mut dyn FnMut(&RayHit) -> bool,
    ) {
        let root = Entered { near: ray.sheared.start, child: root };
        let mut stack = Stack::new(root);
        stack.push(root);
        while let Some(Entered { near, mut child }) = stack.pop() {
            // A hit found meanwhile may be nearer.
            if ray.is_behind(near, nearest.end) {
                continue;
            }
            loop {
                match child.inside() {
                    Inside::Leaf(number) => {
                        nearest.look(simd, &ray.sheared, &self.leaves[number], counts);
                        break;
                    }
                    Inside::Node(number) => {
                        stack.reserve();
                        let node = &self.nodes[number];
                        let boxes = ray.boxes(simd, node, ray.widened_end(simd, nearest.end));
                        let mut entered = boxes.entered;
                        let Some(first) = next_bit(&mut entered) else { break };
                        child = node.children[first];
                        if entered == 0 {
                            continue;
                        }
                        let below = stack.count();
                        stack.push(Entered { near: boxes.near[first], child });
                        while let Some(slot) = next_bit(&mut entered) {
                            let child = node.children[slot];
                            stack.push_sorted(Entered { near: boxes.near[slot], child }, below);
                        }
                        break;
                    }
                }
            }
        }
    }
}

/// The nearest hit of a ray so far.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    hit: Option<RayHit>,
    /// Its distance, or the end of the range.
    pub(super) end: f32,
}

impl Nearest {
    /// Of eight rays that have hit nothing yet.
    #[inline(always)]
    fn before(ends: &Eight) -> [Self; WIDTH] {
        let mut nearest = [Self { hit: None, end: 0.0 }; WIDTH];
        for (nearest, &end) in nearest.iter_mut().zip(ends) {
            nearest.end = end;
        }
        nearest
    }

    /// Looks at the triangles of a leaf.
    #[inline(always)]
    pub(super) fn look<S: Simd>(
        &mut self,
        simd: S,
        ray: &ShearedRay,
        leaf: &Leaf,
        counts: &mut dyn FnMut(&RayHit) -> bool,
    ) {
        let mut candidates = ray.candidates(simd, leaf);
        while let Some(slot) = next_bit(&mut candidates) {
            let Some(found) = ray.crossing(leaf, slot) else { continue };
            let (distance, triangle) = (found.distance, leaf.numbers[slot]);
            let is_nearer = |best: RayHit| (distance, triangle) < (best.distance, best.triangle);
            if distance >= ray.start && distance <= self.end && self.hit.is_none_or(is_nearer) {
                let hit = RayHit { distance, triangle, weights: found.weights() };
                if counts(&hit) {
                    (self.hit, self.end) = (Some(hit), distance);
                }
            }
        }
    }
}
