//! The oracle: clipping in exact rationals, in the triangle's own coordinates.
//!
//! A position is linear in the weights of the corners, so a half-space is linear
//! in them, too, and areas are measured there: the whole triangle has area 1,
//! whatever its shape in clip space, also if it is a point.

use num_rational::BigRational;
use num_traits::{FromPrimitive, Signed, Zero};
use trigon_math::Vec4;

/// A point by its weights.
pub(super) type Point = [BigRational; 3];

pub(super) fn rational(value: impl Into<f64>) -> BigRational {
    BigRational::from_f64(value.into()).expect("test input is finite")
}

/// The corners of the whole triangle.
pub(super) fn whole() -> Vec<Point> {
    let corner = |index: usize| std::array::from_fn(|i| rational(f64::from(u8::from(i == index))));
    (0..3).map(corner).collect()
}

/// The signed share of the triangle's area that a polygon has.
pub(super) fn area(polygon: &[Point]) -> BigRational {
    let mut sum = BigRational::zero();
    for (index, p) in polygon.iter().enumerate() {
        let q = &polygon[(index + 1) % polygon.len()];
        sum += &p[0] * &q[1] - &p[1] * &q[0];
    }
    sum
}

/// An equation's values at the corners of a triangle, plus `offset`.
pub(super) fn at_corners(
    equation: &[f64; 5],
    triangle: &[Vec4; 3],
    offset: &BigRational,
) -> [BigRational; 3] {
    triangle.map(|corner| {
        let terms = corner.to_array().into_iter().zip(equation);
        let linear: BigRational = terms.map(|(x, c)| rational(x) * rational(*c)).sum();
        linear + rational(equation[4]) + offset
    })
}

/// A linear function's value, given those at the corners.
fn value(at_corners: &[BigRational; 3], point: &Point) -> BigRational {
    let terms = at_corners.iter().zip(point).filter(|(_, weight)| !weight.is_zero());
    terms.map(|(value, weight)| value * weight).sum()
}

/// What is on either side of a line, given a linear function at the corners: not
/// negative, and negative with its border. What lies on the line is inside only.
pub(super) fn split(polygon: &[Point], at_corners: &[BigRational; 3]) -> (Vec<Point>, Vec<Point>) {
    let values: Vec<BigRational> = polygon.iter().map(|p| value(at_corners, p)).collect();
    if !values.iter().any(Signed::is_negative) {
        return (polygon.to_vec(), Vec::new());
    }
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for (index, (p, from)) in polygon.iter().zip(&values).enumerate() {
        let next = (index + 1) % polygon.len();
        let (q, to) = (&polygon[next], &values[next]);
        if !from.is_negative() {
            inside.push(p.clone());
        }
        if !from.is_positive() {
            outside.push(p.clone());
        }
        if (from.is_negative() && to.is_positive()) || (from.is_positive() && to.is_negative()) {
            let along = from / (from - to);
            let meeting: Point = std::array::from_fn(|i| &p[i] + (&q[i] - &p[i]) * &along);
            inside.push(meeting.clone());
            outside.push(meeting);
        }
    }
    (inside, outside)
}
