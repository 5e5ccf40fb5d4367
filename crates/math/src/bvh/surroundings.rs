//! What the rays of eight points on surfaces may hit: found once, it spares each ray the way from the root.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, mask32x8};

use super::Bvh;
use super::bits::next_bit;
use super::wide::{Eight, Inside, Leaf, Node, WIDTH};
use crate::simd::greater;

/// Eight points, and the side to which rays leave each of them.
#[derive(Clone, Copy, Debug)]
pub struct Hemispheres<S: Simd> {
    /// The points, by axis.
    pub origin: [f32x8<S>; 3],
    /// Unit vectors, by axis: no ray leaves to their other side.
    pub normal: [f32x8<S>; 3],
    /// How far the rays go at most.
    pub distance: f32,
    /// One bit for each hemisphere that rays leave into.
    pub active: u32,
}

/// The boxes that rays into eight hemispheres may enter.
#[derive(Debug)]
pub struct Surroundings {
    nodes: [Node; NODES],
    count: usize,
}

/// More boxes lie closer around what rays may hit, but each ray tests all of them.
const NODES: usize = 3;

/// The maximum number of boxes.
const MOST: usize = NODES * WIDTH;

/// How far below the plane through a point a triangle has to lie so that no ray into the hemisphere hits it, as a fraction
/// of the largest coordinate.
///
/// On each of two axes, a ray test moves a corner by at most 8 times `EPSILON` of its distance along the third, which is at
/// most twice the largest coordinate (see `OUTSIDE` in `prepared.rs`, where this is doubled): together 23. A height is
/// rounded by less than 7.
const BELOW: f32 = 32.0 * f32::EPSILON;

impl Surroundings {
    /// Whether no ray can hit anything.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    #[inline(always)]
    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes[..self.count.div_ceil(WIDTH)]
    }

    fn push(&mut self, parent: &Node, slot: usize) {
        let (node, to) = (&mut self.nodes[self.count / WIDTH % NODES], self.count % WIDTH);
        for axis in 0..3 {
            for side in 0..2 {
                node.sides[axis][side][to] = parent.sides[axis][side][slot];
            }
        }
        node.children[to] = parent.children[slot];
        self.count += 1;
    }
}

impl Bvh {
    /// What rays into hemispheres may hit.
    #[must_use]
    pub fn surroundings<S: Simd>(&self, simd: S, hemispheres: &Hemispheres<S>) -> Surroundings {
        simd.vectorize(
            #[inline(always)]
            || self.surroundings_at(simd, &ActiveHemispheres::new(self, hemispheres)),
        )
    }

    #[inline(always)]
    fn surroundings_at<S: Simd>(&self, simd: S, hemispheres: &ActiveHemispheres) -> Surroundings {
        let mut found = Surroundings { nodes: [Node::EMPTY; NODES], count: 0 };
        let mut root = Node::EMPTY;
        let [min, max] = self.extent;
        root.set(0, min, max, self.root);
        // Inner boxes that may be opened, the largest first: a node and a slot.
        let mut waiting = [(&root, 0); MOST];
        let (mut first, mut end) = (0, 0);
        let mut node = &root;
        loop {
            let mut near = hemispheres.near_boxes(simd, node);
            while let Some(slot) = next_bit(&mut near) {
                match node.children[slot].inside() {
                    Inside::Node(_) => {
                        waiting[end % MOST] = (node, slot);
                        end += 1;
                    }
                    Inside::Leaf(number) => {
                        if hemispheres.near_triangles(simd, &self.leaves[number]) != 0 {
                            found.push(node, slot);
                        }
                    }
                }
            }
            // What was opened leaves room for one.
            if first == end || found.count + (end - first) + WIDTH - 1 > MOST {
                break;
            }
            let (parent, slot) = waiting[first % MOST];
            first += 1;
            if let Inside::Node(number) = parent.children[slot].inside() {
                node = &self.nodes[number];
            }
        }
        for next in first..end {
            let (parent, slot) = waiting[next % MOST];
            found.push(parent, slot);
        }
        found
    }
}

/// The active ones of eight hemispheres.
struct ActiveHemispheres {
    list: [Hemisphere; WIDTH],
    count: usize,
    /// The least height of anything that rays hit.
    below: f32,
    /// The square of the greatest distance.
    reach: f32,
}

#[derive(Clone, Copy)]
struct Hemisphere {
    origin: [f32; 3],
    normal: [f32; 3],
}

impl ActiveHemispheres {
    #[inline(always)]
    fn new<S: Simd>(tree: &Bvh, all: &Hemispheres<S>) -> Self {
        let by_axis =
            |values: &[f32x8<S>; 3]| -> [Eight; 3] { [values[0].into(), values[1].into(), values[2].into()] };
        let (origins, normals) = (by_axis(&all.origin), by_axis(&all.normal));
        let mut list = [Hemisphere { origin: [0.0; 3], normal: [0.0; 3] }; WIDTH];
        let [min, max] = tree.extent;
        let mut largest = min.abs().max(max.abs()).max_element();
        let (mut left, mut count) = (all.active, 0);
        while let Some(lane) = next_bit(&mut left) {
            let of = |values: &[Eight; 3]| [values[0][lane], values[1][lane], values[2][lane]];
            list[count % WIDTH] = Hemisphere { origin: of(&origins), normal: of(&normals) };
            largest = of(&origins).iter().fold(largest, |largest, value| largest.max(value.abs()));
            count += 1;
        }
        let below = largest * BELOW;
        let reach = all.distance * (1.0 + BELOW) + below;
        Self { list, count, below: -below, reach: reach * reach }
    }

    /// The boxes that rays may enter, one bit for each.
    #[inline(always)]
    fn near_boxes<S: Simd>(&self, simd: S, node: &Node) -> u32 {
        let mut near = mask32x8::splat(simd, false);
        for hemisphere in &self.list[..self.count] {
            let is_above = hemisphere.box_heights(simd, node).simd_ge(self.below);
            near |= is_above & hemisphere.box_distances(simd, node).simd_le(self.reach);
        }
        near.to_bitmask() as u32
    }

    /// The triangles that rays may hit, one bit for each.
    #[inline(always)]
    fn near_triangles<S: Simd>(&self, simd: S, leaf: &Leaf) -> u32 {
        let mut near = mask32x8::splat(simd, false);
        for hemisphere in &self.list[..self.count] {
            for corner in &leaf.corners {
                near |= hemisphere.heights(simd, corner).simd_ge(self.below);
            }
        }
        near.to_bitmask() as u32
    }
}

impl Hemisphere {
    /// How far eight points lie along the normal.
    #[inline(always)]
    fn heights<S: Simd>(&self, simd: S, points: &[Eight; 3]) -> f32x8<S> {
        let mut heights = f32x8::splat(simd, 0.0);
        for ((points, origin), normal) in points.iter().zip(self.origin).zip(self.normal) {
            heights += (f32x8::simd_from(simd, *points) - origin) * normal;
        }
        heights
    }

    /// How far eight boxes reach along the normal.
    #[inline(always)]
    fn box_heights<S: Simd>(&self, simd: S, node: &Node) -> f32x8<S> {
        let mut heights = f32x8::splat(simd, 0.0);
        for axis in 0..3 {
            let [low, high] = &node.sides[axis];
            let low = (f32x8::simd_from(simd, *low) - self.origin[axis]) * self.normal[axis];
            let high = (f32x8::simd_from(simd, *high) - self.origin[axis]) * self.normal[axis];
            heights += greater(low, high);
        }
        heights
    }

    /// The squares of the distances to eight boxes.
    #[inline(always)]
    fn box_distances<S: Simd>(&self, simd: S, node: &Node) -> f32x8<S> {
        let mut squares = f32x8::splat(simd, 0.0);
        for axis in 0..3 {
            let origin = f32x8::splat(simd, self.origin[axis]);
            let [low, high] = &node.sides[axis];
            let [low, high] = [f32x8::simd_from(simd, *low) - origin, origin - f32x8::simd_from(simd, *high)];
            let outside = greater(greater(low, high), f32x8::splat(simd, 0.0));
            squares += outside * outside;
        }
        squares
    }
}
