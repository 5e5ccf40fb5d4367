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
            || self.surroundings_at(simd, &JointHemisphere::new(self, hemispheres)),
        )
    }

    #[inline(always)]
    fn surroundings_at<S: Simd>(&self, simd: S, hemispheres: &JointHemisphere) -> Surroundings {
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

/// Bounds of the points and of the normals of all active hemispheres. Neighbours lie close together, so one test with these
/// replaces eight, and finds whatever one of the eight would: rounding keeps the order of offsets, products and sums.
struct JointHemisphere {
    /// The least and the greatest, by axis.
    origin: [[f32; 2]; 3],
    normal: [[f32; 2]; 3],
    /// The least height of anything that rays hit.
    below: f32,
    /// The square of the greatest distance.
    reach: f32,
}

impl JointHemisphere {
    #[inline(always)]
    fn new<S: Simd>(tree: &Bvh, all: &Hemispheres<S>) -> Self {
        let [min, max] = tree.extent;
        let (origin, normal) =
            (all.origin.map(|axis| range(axis, all.active)), all.normal.map(|axis| range(axis, all.active)));
        let largest = min.abs().max(max.abs()).max_element();
        let largest = origin.iter().flatten().fold(largest, |largest, value| largest.max(value.abs()));
        let below = largest * BELOW;
        let reach = all.distance * (1.0 + BELOW) + below;
        Self { origin, normal, below: -below, reach: reach * reach }
    }

    /// The boxes that rays may enter, one bit for each.
    #[inline(always)]
    fn near_boxes<S: Simd>(&self, simd: S, node: &Node) -> u32 {
        let [mut heights, mut squares] = [f32x8::splat(simd, 0.0); 2];
        // Where numbers are too large for their squares, comparisons of infinities must not leave a box out, nor find one
        // that is not there.
        let mut is_box = mask32x8::splat(simd, true);
        for (axis, [low, high]) in node.sides.iter().enumerate() {
            let [least, most] = self.offsets(simd, axis, [low, high]);
            is_box &= least.simd_le(most);
            heights += self.highest(axis, [least, most]);
            let outside = greater(greater(least, -most), f32x8::splat(simd, 0.0));
            squares += outside * outside;
        }
        (is_box & !heights.simd_lt(self.below) & !squares.simd_gt(self.reach)).to_bitmask() as u32
    }

    /// The triangles that rays may hit, one bit for each.
    #[inline(always)]
    fn near_triangles<S: Simd>(&self, simd: S, leaf: &Leaf) -> u32 {
        let mut near = mask32x8::splat(simd, false);
        for corner in &leaf.corners {
            let mut heights = f32x8::splat(simd, 0.0);
            for (axis, values) in corner.iter().enumerate() {
                heights += self.highest(axis, self.offsets(simd, axis, [values; 2]));
            }
            let x = f32x8::simd_from(simd, corner[0]);
            near |= x.simd_eq(x) & !heights.simd_lt(self.below);
        }
        near.to_bitmask() as u32
    }

    /// The least and the greatest offset along an axis from any point to ranges of eight boxes.
    #[inline(always)]
    fn offsets<S: Simd>(&self, simd: S, axis: usize, [low, high]: [&Eight; 2]) -> [f32x8<S>; 2] {
        let [first, last] = self.origin[axis];
        [f32x8::simd_from(simd, *low) - last, f32x8::simd_from(simd, *high) - first]
    }

    /// What offsets along an axis add at most to a height.
    #[inline(always)]
    fn highest<S: Simd>(&self, axis: usize, [least, most]: [f32x8<S>; 2]) -> f32x8<S> {
        let [low, high] = self.normal[axis];
        greater(greater(least * low, least * high), greater(most * low, most * high))
    }
}

/// The least and the greatest of the active values.
#[inline(always)]
fn range<S: Simd>(values: f32x8<S>, active: u32) -> [f32; 2] {
    let values: Eight = values.into();
    let [mut least, mut most] = [f32::INFINITY, f32::NEG_INFINITY];
    let mut left = active;
    while let Some(lane) = next_bit(&mut left) {
        let value = values[lane % WIDTH];
        (least, most) = (if value < least { value } else { least }, if value > most { value } else { most });
    }
    [least, most]
}
