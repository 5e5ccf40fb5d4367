//! Orientation of three points, with the exact sign.
//!
//! Everything that decides topology (coverage, ears, culling) uses these functions, never a rounded cross product.
//! Points on the screen's grid have an exact integer area. Points in `f64` have an exact sign by adaptive
//! precision (J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
//! 1997; the `robust` crate).

use std::cmp::Ordering;

use glam::{DMat3, DVec2, DVec3};

use crate::FixedPoint;

/// Twice the signed area of the triangle `a`, `b`, `c`, in units of
/// (1/256 pixel)²: the cross product of `b - a` and `c - a`, exactly.
///
/// Positive if `a`, `b`, `c` run clockwise as seen on the screen (`y` down), zero if they are
/// collinear. Exchanging two points only changes the sign.
///
/// # Range
/// Exact for every [`FixedPoint`]: raw coordinates are within ±2³⁰
/// ([`Fixed::LIMIT`](crate::Fixed::LIMIT)), differences within ±2³¹, products
/// within ±2⁶². The exact difference of the products is twice the area of a
/// triangle in a square of side 2³¹, so it is within ±2⁶², too. In the
/// clipper's guard band of ±32768 px it is within ±2⁴⁸.
#[must_use]
pub fn orientation_fixed(a: FixedPoint, b: FixedPoint, c: FixedPoint) -> i64 {
    let difference = |end: crate::Fixed, start: crate::Fixed| i64::from(end.raw()) - i64::from(start.raw());
    difference(b.x, a.x) * difference(c.y, a.y) - difference(b.y, a.y) * difference(c.x, a.x)
}

/// The orientation of three points. The names are for a plane with `y` up; on a screen with `y`
/// down the same orientation appears mirrored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Orientation {
    /// From the x axis towards the y axis: the cross product is positive.
    CounterClockwise,
    /// Collinear, or two points are equal: the cross product is zero.
    Collinear,
    /// From the y axis towards the x axis: the cross product is negative.
    Clockwise,
}

impl Orientation {
    /// The orientation of the same points in the opposite order.
    #[must_use]
    pub const fn reversed(self) -> Self {
        match self {
            Self::CounterClockwise => Self::Clockwise,
            Self::Collinear => Self::Collinear,
            Self::Clockwise => Self::CounterClockwise,
        }
    }
}

/// The orientation of `a`, `b`, `c`, decided without rounding.
///
/// Exact if every coordinate is zero or has a magnitude between 2⁻⁴⁰⁰ and 2⁴⁰⁰: then no product and
/// no tail of one leaves the range of normal numbers. NaN and infinities give `Collinear`.
#[must_use]
pub fn orientation(a: DVec2, b: DVec2, c: DVec2) -> Orientation {
    let coordinate = |point: DVec2| robust::Coord { x: point.x, y: point.y };
    let area = robust::orient2d(coordinate(a), coordinate(b), coordinate(c));
    if !(a.is_finite() && b.is_finite() && c.is_finite()) {
        Orientation::Collinear
    } else if area > 0.0 {
        Orientation::CounterClockwise
    } else if area < 0.0 {
        Orientation::Clockwise
    } else {
        Orientation::Collinear
    }
}

/// On which side of the plane through `a`, `b` and `c` a point is, decided without rounding: `Greater` on the side from
/// which they run counter-clockwise, `Equal` on the plane or if they are collinear.
///
/// Exact if every coordinate is zero or has a magnitude between 2⁻²⁵⁰ and 2²⁵⁰. NaN and infinities give `Equal`.
#[must_use]
pub fn side_of_triangle([a, b, c]: [DVec3; 3], point: DVec3) -> Ordering {
    let coordinate = |DVec3 { x, y, z }: DVec3| robust::Coord3D { x, y, z };
    let volume = robust::orient3d(coordinate(a), coordinate(b), coordinate(c), coordinate(point));
    if [a, b, c, point].iter().all(|point| point.is_finite()) {
        // Positive if the point lies below.
        0.0_f64.partial_cmp(&volume).unwrap_or(Ordering::Equal)
    } else {
        Ordering::Equal
    }
}

/// Whether a linear map mirrors: whether its determinant is negative, decided without rounding.
///
/// Exact if the non-zero entries within each column differ by a factor of at most 2²⁵⁰, however
/// large or small they are. NaN and infinities count as not mirroring.
#[must_use]
pub fn is_mirroring(matrix: &DMat3) -> bool {
    let column = |axis: DVec3| {
        let DVec3 { x, y, z } = axis * unit_of(axis);
        robust::Coord3D { x, y, z }
    };
    let origin = robust::Coord3D { x: 0.0, y: 0.0, z: 0.0 };
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(column);
    matrix.is_finite() && robust::orient3d(x, y, z, origin) < 0.0
}

/// A power of two that brings the largest entry near 1, so that products of three stay in range; it
/// preserves all digits. 1 for zero.
fn unit_of(vector: DVec3) -> f64 {
    /// Beyond, the power itself would leave the range.
    const LARGEST: i64 = 1000;
    const BIAS: i64 = 1023;
    let largest = vector.abs().max_element();
    let exponent = (largest.to_bits() >> 52) as i64 - BIAS;
    if largest == 0.0 {
        1.0
    } else {
        f64::from_bits(((BIAS - exponent.clamp(-LARGEST, LARGEST)) as u64) << 52)
    }
}

#[cfg(test)]
mod tests;
