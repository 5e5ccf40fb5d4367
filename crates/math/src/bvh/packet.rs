//! Eight rays that run in similar directions, through one stack of boxes.
//!
//! A node's boxes are first tested against all rays at once, by intervals of their origins and directions (A. Reshetov,
//! A. Soupikov and J. Hurley, "Multi-Level Ray Tracing Algorithm", 2005). Rounding never turns the order of two numbers
//! around, so the bounds hold for what [`PreparedRay`] computes for each ray, to the last bit.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, mask32x8};

use super::bits::{last_bit, next_bit};
use super::prepared::{Boxes, PreparedRay, PreparedRays, WIDENED};
use super::stack::{Entered, Stack};
use super::traverse::Nearest;
use super::triangle::ShearedRay;
use super::wide::{Child, Eight, Inside, Node, WIDTH};
use super::{Bvh, RayHit};
use crate::simd::{greater, lesser};

/// Fewer rays are faster one by one.
const FEWEST: u32 = 3;

/// Up to eight rays whose directions have the same signs.
pub(super) struct Packet<'a> {
    rays: &'a PreparedRays,
    axes: [AxisBounds; 3],
    start: f32,
    outside: f32,
}

/// What holds for all rays of a packet on an axis.
struct AxisBounds {
    /// Which side of a box they hit first: 0 is the lower one.
    first: usize,
    /// The origin that comes to the near sides of boxes first, and the one that comes to the far sides last.
    origins: [f32; 2],
    /// The least and the greatest inverse of a direction.
    inverse: [f32; 2],
    /// The same, widened.
    wider: [f32; 2],
}

/// Some of the rays, and a box that they enter.
#[derive(Clone, Copy)]
struct Visit {
    child: Child,
    lanes: u32,
}

impl<'a> Packet<'a> {
    /// None if the rays do not run in similar directions.
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, rays: &'a PreparedRays) -> Option<Self> {
        let lanes = rays.possible;
        let is_similar = |axis: usize| {
            let downwards = rays.downwards[axis] & lanes;
            downwards == 0 || downwards == lanes
        };
        let is_packet = lanes.count_ones() >= FEWEST && lanes & rays.without_inverse == 0;
        if !is_packet || !is_similar(0) || !is_similar(1) || !is_similar(2) {
            return None;
        }
        let axes =
            [AxisBounds::new(simd, rays, 0), AxisBounds::new(simd, rays, 1), AxisBounds::new(simd, rays, 2)];
        let [start, _] = bounds(simd, &rays.start, lanes);
        let [_, outside] = bounds(simd, &rays.outside, lanes);
        Some(Self { rays, axes, start, outside })
    }

    /// Where the first ray may enter each box of a node, and one bit for each box that some of them may enter before an end.
    #[inline(always)]
    fn boxes<S: Simd>(&self, simd: S, node: &Node, end: f32) -> Boxes {
        let (mut from, mut to) = (f32x8::splat(simd, self.start), f32x8::splat(simd, end * WIDENED));
        for (axis, sides) in self.axes.iter().zip(&node.sides) {
            let near = f32x8::simd_from(simd, sides[axis.first & 1]) - axis.origins[0];
            from = greater(lesser(near * axis.inverse[0], near * axis.inverse[1]), from);
            let far = f32x8::simd_from(simd, sides[(axis.first ^ 1) & 1]) - axis.origins[1];
            to = lesser(greater(far * axis.wider[0], far * axis.wider[1]), to);
        }
        let entered = from.simd_le(to + self.outside).to_bitmask() as u32;
        Boxes { near: from.into(), entered }
    }

    /// The rays that may enter a box of a node before their ends, one bit for each.
    #[inline(always)]
    fn entering<S: Simd>(&self, simd: S, node: &Node, slot: usize, ends: &Eight) -> u32 {
        let rays = self.rays;
        let mut from = f32x8::simd_from(simd, rays.start);
        let mut to = f32x8::simd_from(simd, *ends) * WIDENED;
        for axis in 0..3 {
            let (sides, first) = (&node.sides[axis], self.axes[axis].first);
            let origin = f32x8::simd_from(simd, rays.origin[axis]);
            let near = f32x8::splat(simd, sides[first & 1][slot]) - origin;
            from = greater(near * f32x8::simd_from(simd, rays.inverse[axis]), from);
            let far = f32x8::splat(simd, sides[(first ^ 1) & 1][slot]) - origin;
            to = lesser(far * f32x8::simd_from(simd, rays.wider[axis]), to);
        }
        from.simd_le(to + f32x8::simd_from(simd, rays.outside)).to_bitmask() as u32
    }
}

impl AxisBounds {
    #[inline(always)]
    fn new<S: Simd>(simd: S, rays: &PreparedRays, axis: usize) -> Self {
        let lanes = rays.possible;
        let [least, greatest] = bounds(simd, &rays.origin[axis], lanes);
        let is_downwards = rays.downwards[axis] & lanes != 0;
        Self {
            first: usize::from(is_downwards),
            origins: if is_downwards { [least, greatest] } else { [greatest, least] },
            inverse: bounds(simd, &rays.inverse[axis], lanes),
            wider: bounds(simd, &rays.wider[axis], lanes),
        }
    }
}

/// The least and the greatest of the numbers of some lanes.
#[inline(always)]
fn bounds<S: Simd>(simd: S, values: &Eight, lanes: u32) -> [f32; 2] {
    let first = values[lanes.trailing_zeros() as usize % WIDTH];
    let mask = mask32x8::from_bitmask(simd, u64::from(lanes));
    let values: Eight = mask.select(f32x8::simd_from(simd, *values), f32x8::splat(simd, first)).into();
    let less = |a: f32, b: f32| if a < b { a } else { b };
    let more = |a: f32, b: f32| if a > b { a } else { b };
    let [a, b, c, d, e, f, g, h] = values;
    let least = [less(a, e), less(b, f), less(c, g), less(d, h)];
    let most = [more(a, e), more(b, f), more(c, g), more(d, h)];
    let least = less(less(least[0], least[2]), less(least[1], least[3]));
    [least, more(more(most[0], most[2]), more(most[1], most[3]))]
}

impl Bvh {
    /// The rays of a packet that hit anything, one bit for each.
    #[inline(always)]
    pub(super) fn occluded_packet<S: Simd>(&self, simd: S, packet: &Packet<'_>) -> u32 {
        let (rays, lanes) = (packet.rays, packet.rays.possible);
        let [_, end] = bounds(simd, &rays.end, lanes);
        let whole = Visit { child: self.root, lanes };
        let mut stack = Stack::new(whole);
        stack.push(whole);
        let mut alive = lanes;
        while let Some(Visit { child, lanes }) = stack.pop() {
            let mut lanes = lanes & alive;
            match child.inside() {
                Inside::Node(number) if lanes.count_ones() > 1 => {
                    stack.reserve();
                    let node = &self.nodes[number];
                    let mut entered = packet.boxes(simd, node, end).entered;
                    while let Some(slot) = last_bit(&mut entered) {
                        let lanes = packet.entering(simd, node, slot, &rays.end) & lanes;
                        if lanes != 0 {
                            stack.push(Visit { child: node.children[slot], lanes });
                        }
                    }
                }
                // A ray that has lost the others.
                Inside::Node(_) => {
                    while let Some(lane) = next_bit(&mut lanes) {
                        if self.occluded_below(simd, &PreparedRay::new(rays, lane), child) {
                            alive &= !(1 << lane);
                        }
                    }
                }
                Inside::Leaf(number) => {
                    let leaf = &self.leaves[number];
                    while let Some(lane) = next_bit(&mut lanes) {
                        if self.is_hit(simd, &ShearedRay::new(rays, lane), leaf) {
                            alive &= !(1 << lane);
                        }
                    }
                }
            }
            if alive == 0 {
                break;
            }
        }
        lanes & !alive
    }

    /// Finds the nearest hits of the rays of a packet.
    #[inline(always)]
    pub(super) fn nearest_packet<S: Simd>(
        &self,
        simd: S,
        packet: &Packet<'_>,
        nearest: &mut [Nearest; WIDTH],
        counts: &mut dyn FnMut(usize, &RayHit) -> bool,
    ) {
        let (rays, lanes) = (packet.rays, packet.rays.possible);
        let mut ends = rays.end;
        let [_, mut end] = bounds(simd, &ends, lanes);
        let whole = Entered { near: packet.start, child: Visit { child: self.root, lanes } };
        let mut stack = Stack::new(whole);
        stack.push(whole);
        while let Some(Entered { near, child: Visit { child, mut lanes } }) = stack.pop() {
            // Hits found meanwhile may be nearer.
            if near > end * WIDENED + packet.outside {
                continue;
            }
            match child.inside() {
                Inside::Node(number) if lanes.count_ones() > 1 => {
                    stack.reserve();
                    let node = &self.nodes[number];
                    let Boxes { near, mut entered } = packet.boxes(simd, node, end);
                    let below = stack.count();
                    while let Some(slot) = next_bit(&mut entered) {
                        let lanes = packet.entering(simd, node, slot, &ends) & lanes;
                        if lanes != 0 {
                            let child = Visit { child: node.children[slot], lanes };
                            stack.push_sorted(Entered { near: near[slot], child }, below);
                        }
                    }
                }
                // A ray that has lost the others.
                Inside::Node(_) => {
                    while let Some(lane) = next_bit(&mut lanes) {
                        let (ray, nearest) = (PreparedRay::new(rays, lane), &mut nearest[lane]);
                        self.nearest_below(simd, &ray, child, nearest, &mut |hit| counts(lane, hit));
                        ends[lane] = nearest.end;
                    }
                    [_, end] = bounds(simd, &ends, rays.possible);
                }
                Inside::Leaf(number) => {
                    let leaf = &self.leaves[number];
                    while let Some(lane) = next_bit(&mut lanes) {
                        let ray = ShearedRay::new(rays, lane);
                        nearest[lane].look(simd, &ray, leaf, &mut |hit| counts(lane, hit));
                        ends[lane] = nearest[lane].end;
                    }
                    [_, end] = bounds(simd, &ends, rays.possible);
                }
            }
        }
    }
}
