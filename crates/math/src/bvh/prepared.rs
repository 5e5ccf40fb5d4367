//! Eight rays prepared for boxes and triangles.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, mask32x8};

use super::triangle::ShearedRay;
use super::wide::{Eight, Node, WIDTH};
use super::{Bvh, Rays};
use crate::simd::{greater, lesser};

/// The factor by which the far side of a box, and the end of the range, are moved away: the
/// rounding of four operations, twice (Ize 2013, section 4).
pub(super) const WIDENED: f32 = 1.0 + 8.0 * f32::EPSILON;

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

/// An axis: indexing by it needs no check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub(super) enum Axis {
    X,
    Y,
    Z,
}

/// Orders of axes in which a ray runs upwards along the last: twice the number of that axis, plus 1 where it runs
/// against it. The last two are there so that a number of three bits needs no check.
const ORDERS: [[Axis; 3]; 8] = {
    use Axis::{X, Y, Z};
    [[Y, Z, X], [Z, Y, X], [Z, X, Y], [X, Z, Y], [X, Y, Z], [Y, X, Z], [X, Y, Z], [X, Y, Z]]
};

/// Eight rays prepared for many boxes and triangles.
pub(super) struct PreparedRays {
    pub(super) origin: [Eight; 3],
    /// Of the directions: infinite on axes on which a ray is taken to run straight, and NaN, which decides nothing, where
    /// it is beyond all numbers.
    pub(super) inverse: [Eight; 3],
    /// The same, widened: for the far sides.
    pub(super) wider: [Eight; 3],
    /// By axis, the direction divided by that along the fastest axis.
    pub(super) shear: [Eight; 3],
    /// Of the direction along the fastest axis.
    pub(super) inverse_speed: Eight,
    /// How far along each ray a triangle may be hit outside its box.
    pub(super) outside: Eight,
    pub(super) start: Eight,
    pub(super) end: Eight,
    /// Numbers of [`ORDERS`].
    orders: [u32; WIDTH],
    /// By axis, one bit for each ray that hits the upper side of a box first.
    pub(super) downwards: [u32; 3],
    /// One bit for each ray whose inverse has a NaN.
    pub(super) without_inverse: u32,
    /// One bit for each ray that is cast and can hit anything.
    pub(super) possible: u32,
}

impl PreparedRays {
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, tree: &Bvh, rays: &Rays<S>) -> Self {
        let zero = f32x8::splat(simd, 0.0);
        let infinity = f32x8::splat(simd, f32::INFINITY);
        let [x, y, z] = rays.direction;
        let along = [x.abs(), y.abs(), z.abs()];
        let is_x = along[0].simd_gt(along[1]) & along[0].simd_gt(along[2]);
        let is_y = !is_x & along[1].simd_gt(along[2]);
        let fastest = Fastest { is_x, is_y };
        let speed = fastest.of(rays.direction);
        let inverse_speed = f32x8::splat(simd, 1.0) / speed;
        // A shear that is not a normal number has no precision: the ray runs straight on that axis.
        let shear = [x / speed, y / speed, z / speed];
        let normal = [is_normal(simd, shear[0]), is_normal(simd, shear[1]), is_normal(simd, shear[2])];
        let [inverse_x, slack_x] = inverse(simd, x, normal[0]);
        let [inverse_y, slack_y] = inverse(simd, y, normal[1]);
        let [inverse_z, slack_z] = inverse(simd, z, normal[2]);
        // An upper bound of distances along the ray to anything in the tree.
        let origin = fastest.of(rays.origin);
        let [low, high] = [extent(simd, tree, 0), extent(simd, tree, 1)];
        let low = ((fastest.of(low) - origin) * inverse_speed).abs();
        let high = ((fastest.of(high) - origin) * inverse_speed).abs();
        let leaving = (low.simd_gt(high) | !high.simd_ge(zero)).select(low, high);
        let slack = slack_x + slack_y + slack_z;
        let outside = leaving * OUTSIDE + slack * UNDERFLOW + f32x8::splat(simd, f32::MIN_POSITIVE);
        let finite = |values: [f32x8<S>; 3]| {
            values[0].abs().simd_lt(infinity)
                & values[1].abs().simd_lt(infinity)
                & values[2].abs().simd_lt(infinity)
        };
        let possible = finite(rays.origin) & finite(rays.direction) & !speed.simd_eq(zero);
        Self {
            origin: [rays.origin[0].into(), rays.origin[1].into(), rays.origin[2].into()],
            inverse: [inverse_x.into(), inverse_y.into(), inverse_z.into()],
            wider: [(inverse_x * WIDENED).into(), (inverse_y * WIDENED).into(), (inverse_z * WIDENED).into()],
            shear: [
                normal[0].select(shear[0], zero).into(),
                normal[1].select(shear[1], zero).into(),
                normal[2].select(shear[2], zero).into(),
            ],
            inverse_speed: inverse_speed.into(),
            outside: outside.into(),
            orders: fastest.orders(simd, speed),
            downwards: [
                inverse_x.simd_lt(zero).to_bitmask() as u32,
                inverse_y.simd_lt(zero).to_bitmask() as u32,
                inverse_z.simd_lt(zero).to_bitmask() as u32,
            ],
            start: rays.start.into(),
            end: rays.end.into(),
            without_inverse: (is_nan(inverse_x) | is_nan(inverse_y) | is_nan(inverse_z)).to_bitmask() as u32,
            possible: possible.to_bitmask() as u32 & rays.active,
        }
    }

    /// The axes of a ray; it runs along the last.
    #[inline(always)]
    pub(super) fn axes(&self, lane: usize) -> [Axis; 3] {
        ORDERS[self.orders[lane % WIDTH] as usize % ORDERS.len()]
    }
}

/// The axes along which eight rays run fastest.
#[derive(Clone, Copy)]
struct Fastest<S: Simd> {
    is_x: mask32x8<S>,
    is_y: mask32x8<S>,
}

impl<S: Simd> Fastest<S> {
    #[inline(always)]
    fn of(&self, [x, y, z]: [f32x8<S>; 3]) -> f32x8<S> {
        self.is_x.select(x, self.is_y.select(y, z))
    }

    #[inline(always)]
    fn orders(&self, simd: S, speed: f32x8<S>) -> [u32; WIDTH] {
        use fearless_simd::u32x8;
        let [zero, one] = [u32x8::splat(simd, 0), u32x8::splat(simd, 1)];
        let [two, four] = [u32x8::splat(simd, 2), u32x8::splat(simd, 4)];
        let axis = self.is_x.select(zero, self.is_y.select(two, four));
        let is_against = speed.simd_lt(f32x8::splat(simd, 0.0));
        (axis + is_against.select(one, zero)).into()
    }
}

#[inline(always)]
fn is_normal<S: Simd>(simd: S, value: f32x8<S>) -> mask32x8<S> {
    let value = value.abs();
    value.simd_ge(f32x8::splat(simd, f32::MIN_POSITIVE)) & value.simd_lt(f32x8::splat(simd, f32::INFINITY))
}

#[inline(always)]
fn is_nan<S: Simd>(value: f32x8<S>) -> mask32x8<S> {
    !value.simd_eq(value)
}

/// The inverse of a direction, and its absolute value where it is finite.
#[inline(always)]
fn inverse<S: Simd>(simd: S, direction: f32x8<S>, is_normal: mask32x8<S>) -> [f32x8<S>; 2] {
    let inverse = f32x8::splat(simd, 1.0) / direction;
    let infinity = f32x8::splat(simd, f32::INFINITY);
    let is_finite = inverse.abs().simd_lt(infinity) & is_normal;
    let no_inverse = is_normal.select(f32x8::splat(simd, f32::NAN), infinity);
    let inverse = is_finite.select(inverse, no_inverse);
    [inverse, is_finite.select(inverse.abs(), f32x8::splat(simd, 0.0))]
}

/// A corner of the box of a tree.
#[inline(always)]
fn extent<S: Simd>(simd: S, tree: &Bvh, side: usize) -> [f32x8<S>; 3] {
    let corner = tree.extent[side];
    [f32x8::splat(simd, corner.x), f32x8::splat(simd, corner.y), f32x8::splat(simd, corner.z)]
}

/// One of eight prepared rays.
pub(super) struct PreparedRay {
    pub(super) sheared: ShearedRay,
    origin: [f32; 3],
    inverse: [f32; 3],
    wider: [f32; 3],
    /// Which side of a box it hits first: 0 is the lower one.
    first: [u32; 3],
    outside: f32,
}

/// Eight boxes that a ray may enter.
pub(super) struct Boxes {
    /// Where it enters each.
    pub(super) near: Eight,
    /// One bit for each that it does not certainly miss.
    pub(super) entered: u32,
}

impl PreparedRay {
    #[inline(always)]
    pub(super) fn new(rays: &PreparedRays, lane: usize) -> Self {
        let lane = lane % WIDTH;
        let of = |values: &[Eight; 3]| [values[0][lane], values[1][lane], values[2][lane]];
        let [x, y, z] = rays.downwards;
        Self {
            sheared: ShearedRay::new(rays, lane),
            origin: of(&rays.origin),
            inverse: of(&rays.inverse),
            wider: of(&rays.wider),
            first: [x >> lane & 1, y >> lane & 1, z >> lane & 1],
            outside: rays.outside[lane],
        }
    }

    /// The end of a range of distances to boxes.
    #[inline(always)]
    pub(super) fn widened_end<S: Simd>(&self, simd: S, end: f32) -> f32x8<S> {
        f32x8::splat(simd, end * WIDENED)
    }

    /// Whether a box that it enters at a distance lies behind another distance.
    #[inline(always)]
    pub(super) fn is_behind(&self, near: f32, end: f32) -> bool {
        near > end * WIDENED + self.outside
    }

    /// The boxes of a node that it enters before the widened end.
    #[inline(always)]
    pub(super) fn boxes<S: Simd>(&self, simd: S, node: &Node, end: f32x8<S>) -> Boxes {
        let (mut from, mut to) = (f32x8::splat(simd, self.sheared.start), end);
        for axis in 0..3 {
            let (origin, first) = (self.origin[axis], self.first[axis] as usize);
            let [near, far] = [&node.sides[axis][first & 1], &node.sides[axis][(first ^ 1) & 1]];
            // A ray within a side of a box gives NaN, and passes the test.
            let near = (f32x8::simd_from(simd, *near) - origin) * self.inverse[axis];
            from = greater(near, from);
            let far = (f32x8::simd_from(simd, *far) - origin) * self.wider[axis];
            to = lesser(far, to);
        }
        let entered = from.simd_le(to + self.outside).to_bitmask() as u32;
        Boxes { near: from.into(), entered }
    }
}
