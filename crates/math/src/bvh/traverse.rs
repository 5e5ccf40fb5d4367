//! Traversal of the tree.

use std::ops::Range;

use glam::Vec3;

use super::triangle::ShearedRay;
use super::wide::{Child, Four, Inside, Node, WIDTH};
use super::{Bvh, Ray, RayHit};

/// The factor by which the far side of a box, and the end of the range, are moved away: the
/// rounding of four operations, twice (Ize 2013, section 4).
const WIDENED: f32 = 1.0 + 8.0 * f32::EPSILON;

/// How far outside its box a triangle may be hit, as a fraction of the distance at which the ray leaves the
/// whole tree.
///
/// The triangle test translates corners relative to the ray and shears them so that it runs along z, each in
/// f32. For the coordinate x of a corner with the difference z along the ray, and a shear S of at most 1,
/// that is `fl(fl(x − o) − fl(S · z))`, with errors of u·|x − o| and 2u·|S|·|z|, u being half of `EPSILON`;
/// those of the last subtraction and of the products of edges are as if corners were scaled by 1 ± 3u.
/// Scaling moves no corner to the ray's other side, so the ray misses the box at most by the error of
/// |S|·|z|: less than 16u·|S|·|z|. Along the ray that is 16u times the distance of z, whatever the direction.
/// Twice that is allowed for distances.
const OUTSIDE: f32 = 16.0 * f32::EPSILON;

/// How far outside its box a triangle may be hit on an axis because numbers underflow, as a distance on that axis: a
/// product and its sum are off by half of the smallest number each. Four times that.
const UNDERFLOW: f32 = f32::from_bits(4);

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
        let mut nearest: Option<RayHit> = None;
        let mut end = range.end;
        self.visit(ray, range.start, &mut end, |hit, end| {
            let order = |hit: RayHit| (hit.distance, hit.triangle);
            if nearest.is_none_or(|best| order(hit) < order(best)) && counts(&hit) {
                *end = hit.distance;
                nearest = Some(hit);
            }
            false
        });
        nearest
    }

    /// Whether the ray hits anything within a range of distances, excluding its end.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, range: Range<f32>) -> bool {
        let mut found = false;
        let mut end = range.end;
        self.visit(ray, range.start, &mut end, |hit, end| {
            found = hit.distance < *end;
            found
        });
        found
    }

    /// An upper bound of distances along the ray to anything in the tree.
    fn leaving(&self, ray: &ShearedRay) -> f32 {
        let sides = self.nodes.last().map_or([0.0; 2], |root| root.sides[ray.axis()].map(|side| side[0]));
        let [low, high] = sides.map(|side| ray.distance_along(side).abs());
        low.max(high)
    }

    /// Calls `found` with the hits of the ray, in some order, until it stops the traversal; it may
    /// move the end of the range.
    #[inline(always)]
    fn visit(&self, ray: &Ray, start: f32, end: &mut f32, mut found: impl FnMut(RayHit, &mut f32) -> bool) {
        let possible = ray.origin.is_finite() && ray.direction.is_finite() && ray.direction != Vec3::ZERO;
        if self.nodes.is_empty() || !possible {
            return;
        }
        let sheared = ShearedRay::new(ray);
        let slabs = Slabs::new(ray, &sheared, self.leaving(&sheared) * OUTSIDE);
        let mut waiting = Waiting::new(start, Child::node(self.nodes.len() - 1));
        while let Some((near, child)) = waiting.pop() {
            // A hit found meanwhile may be nearer.
            if near > *end * WIDENED + slabs.outside {
                continue;
            }
            match child.inside() {
                Inside::Node(number) => {
                    let node = &self.nodes[number];
                    waiting.push(slabs.meet(node, start, *end * WIDENED), &node.children);
                }
                Inside::Leaf(number) => {
                    let leaf = &self.leaves[number];
                    let met = sheared.meet(&leaf.corners);
                    for slot in 0..WIDTH {
                        let distance = met.distances[slot];
                        // False for NaN, which means a miss.
                        if distance >= start && distance <= *end {
                            let triangle = leaf.numbers[slot];
                            let weights = met.weights.map(|weight| weight[slot]);
                            if found(RayHit { distance, triangle, weights }, end) {
                                return;
                            }
                        }
                    }
                }
            }
        }
    }
}

/// A ray prepared for box tests.
struct Slabs {
    origin: [f32; 3],
    inverse: [f32; 3],
    /// The same, widened: for the far sides.
    wider: [f32; 3],
    /// Which side of a box it hits first: 0 is the lower one.
    first: [usize; 3],
    /// How far along the ray a triangle may be hit outside its box.
    outside: f32,
}

impl Slabs {
    fn new(ray: &Ray, sheared: &ShearedRay, outside: f32) -> Self {
        let direction = sheared.straightened(ray.direction);
        let (inverse, is_straight) = (direction.recip(), direction.cmpeq(Vec3::ZERO));
        // Where the ray runs straight its coordinate is exact, and in a box or not. A direction without a finite
        // inverse decides nothing: NaN passes the test.
        let has_inverse = inverse.is_finite_mask();
        let slack = Vec3::select(has_inverse, inverse.abs(), Vec3::ZERO);
        let outside = outside + slack.element_sum() * UNDERFLOW + f32::MIN_POSITIVE;
        let inverse = Vec3::select(has_inverse | is_straight, inverse, Vec3::NAN);
        let inverse = inverse.to_array();
        Self {
            origin: ray.origin.to_array(),
            inverse,
            wider: inverse.map(|inverse| inverse * WIDENED),
            first: inverse.map(|inverse| usize::from(inverse < 0.0)),
            outside,
        }
    }

    /// Where the ray enters each of four boxes; NaN if it certainly misses the box within the
    /// range.
    #[inline(always)]
    fn meet(&self, node: &Node, start: f32, end: f32) -> Four {
        let (mut from, mut to) = ([start; WIDTH], [end; WIDTH]);
        for axis in 0..3 {
            let (origin, first) = (self.origin[axis], self.first[axis]);
            let (near, far) = (&node.sides[axis][first], &node.sides[axis][1 - first]);
            for slot in 0..WIDTH {
                // A ray within a side of a box gives NaN, and passes the test.
                let near = (near[slot] - origin) * self.inverse[axis];
                from[slot] = if near > from[slot] { near } else { from[slot] };
                let far = (far[slot] - origin) * self.wider[axis];
                to[slot] = if far < to[slot] { far } else { to[slot] };
            }
        }
        let outside = self.outside;
        std::array::from_fn(|slot| if from[slot] <= to[slot] + outside { from[slot] } else { f32::NAN })
    }
}

/// Boxes to visit, the next one last.
struct Waiting {
    few: [(f32, Child); Self::FEW],
    count: usize,
    /// The entries below these, for lopsided trees.
    more: Vec<(f32, Child)>,
}

impl Waiting {
    /// A balanced tree over 2³² triangles has 16 levels, each of which leaves 3 boxes.
    const FEW: usize = 64;

    /// For a root, and where it is entered.
    fn new(start: f32, root: Child) -> Self {
        Self { few: [(start, root); Self::FEW], count: 1, more: Vec::new() }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<(f32, Child)> {
        if self.count == 0 {
            return self.more.pop();
        }
        self.count -= 1;
        Some(self.few[self.count % Self::FEW])
    }

    /// Adds the boxes that are entered somewhere, the nearest last.
    #[inline(always)]
    fn push(&mut self, entered: Four, children: &[Child; WIDTH]) {
        if self.count + WIDTH > Self::FEW {
            self.spill();
        }
        let first = self.count;
        for slot in 0..WIDTH {
            // Without branches: a box that is not entered is overwritten by the next.
            self.few[self.count % Self::FEW] = (entered[slot], children[slot]);
            self.count += usize::from(!entered[slot].is_nan());
        }
        for end in first + 1..self.count {
            let mut slot = end % Self::FEW;
            while slot > first && self.few[slot - 1].0 < self.few[slot].0 {
                self.few.swap(slot - 1, slot);
                slot -= 1;
            }
        }
    }

    #[cold]
    fn spill(&mut self) {
        self.more.extend_from_slice(&self.few[..self.count]);
        self.count = 0;
    }
}
