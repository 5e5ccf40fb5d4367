//! Areas of triangles, and of what is left of them after clipping at half-planes, in rational numbers.
//!
//! A point of a triangle is given by its barycentric coordinates. A linear function of the position is also linear
//! in these, so areas need no coordinates. The whole triangle has area 1, whatever its shape and the space it lies
//! in, even if it is degenerate.

use super::coverage::doubled_area;
use super::{GridPoint, STEPS};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{FromPrimitive, Signed, Zero};

/// A point in barycentric coordinates.
pub type Weights = [BigRational; 3];

/// A number as it is.
///
/// # Panics
/// Not a finite number.
#[must_use]
pub fn rational(value: impl Into<f64>) -> BigRational {
    BigRational::from_f64(value.into()).expect("a finite number")
}

/// An integer.
#[must_use]
pub fn integer(value: i128) -> BigRational {
    BigRational::from_integer(BigInt::from(value))
}

/// The corners of the whole triangle.
#[must_use]
pub fn whole() -> Vec<Weights> {
    let corner = |index: usize| std::array::from_fn(|i| integer(i128::from(i == index)));
    (0..3).map(corner).collect()
}

/// The fraction of the triangle's area that a polygon covers: negative if its winding is opposite.
#[must_use]
pub fn share(polygon: &[Weights]) -> BigRational {
    let mut sum = BigRational::zero();
    for (index, p) in polygon.iter().enumerate() {
        let q = &polygon[(index + 1) % polygon.len()];
        sum += &p[0] * &q[1] - &p[1] * &q[0];
    }
    sum
}

/// A linear function's value, given those at the corners.
fn value(at_corners: &[BigRational; 3], point: &Weights) -> BigRational {
    let terms = at_corners.iter().zip(point).filter(|(_, weight)| !weight.is_zero());
    terms.map(|(value, weight)| value * weight).sum()
}

/// The two parts of a convex polygon on either side of a line, given a linear function's values at the
/// triangle's corners: first where it is not negative, then where it is, including the border. A polygon that
/// lies on the line as a whole is in the first part only.
#[must_use]
pub fn split(polygon: &[Weights], at_corners: &[BigRational; 3]) -> (Vec<Weights>, Vec<Weights>) {
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
            let meeting: Weights = std::array::from_fn(|i| &p[i] + (&q[i] - &p[i]) * &along);
            inside.push(meeting.clone());
            outside.push(meeting);
        }
    }
    (inside, outside)
}

/// The fraction of a pixel that a triangle covers, from 0 to 1.
#[must_use]
pub fn in_pixel(triangle: [GridPoint; 3], pixel: [i32; 2]) -> BigRational {
    let mut polygon = whole();
    for axis in [0, 1] {
        let low = i128::from(pixel[axis]) * i128::from(STEPS);
        let beyond = |border: i128| triangle.map(|corner| integer(i128::from(corner[axis]) - border));
        (polygon, _) = split(&polygon, &beyond(low));
        (_, polygon) = split(&polygon, &beyond(low + i128::from(STEPS)));
    }
    let squares = 2 * i128::from(STEPS) * i128::from(STEPS);
    share(&polygon) * integer(doubled_area(triangle).abs()) / integer(squares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::coverage::sample_points;
    use num_traits::One;

    #[test]
    fn the_pixels_of_a_triangle_add_up_to_its_area() {
        let triangle = [[-100, 77], [1203, -51], [640, 1500]];
        let pixels = (-1..7).flat_map(|y| (-1..7).map(move |x| [x, y]));
        let sum: BigRational = pixels.map(|pixel| in_pixel(triangle, pixel)).sum();
        let squares = 2 * i128::from(STEPS) * i128::from(STEPS);
        assert_eq!(
            sum,
            integer(doubled_area(triangle).abs()) / integer(squares),
            "nothing is lost or doubled"
        );
    }

    #[test]
    fn winding_does_not_matter_and_no_area_is_none() {
        let [a, b, c] = [[0, 0], [256, 0], [0, 256]];
        for triangle in [[a, b, c], [c, b, a]] {
            assert_eq!(in_pixel(triangle, [0, 0]), rational(0.5), "half of the pixel");
            assert_eq!(in_pixel(triangle, [1, 0]), integer(0), "nothing of its neighbour");
        }
        assert_eq!(in_pixel([a, b, b], [0, 0]), integer(0), "a line");
    }

    /// The area is what the share of ever more samples tends to; 16 of them, one in
    /// each row and column, are off by less than a quarter for an outline that
    /// crosses few of the cells.
    #[test]
    fn areas_and_samples_agree() {
        let triangle = [[-300, 40], [700, 90], [200, 900]];
        for pixel in [[0, 0], [1, 1], [0, 1], [-1, 0], [9, 9]] {
            let points = sample_points(16, pixel);
            let share = points.filter(|&point| crate::oracle::coverage::covers(triangle, point)).count();
            let difference = in_pixel(triangle, pixel) - rational(share as f64 / 16.0);
            assert!(difference.abs() < rational(0.25), "at {pixel:?}: {difference}");
        }
    }

    #[test]
    fn a_line_splits_exactly() {
        let at_corners = [rational(-1.0), rational(1.0), rational(2.0)];
        let (inside, outside) = split(&whole(), &at_corners);
        // The small corner has sides of 1/2 and 1/3 of the whole's.
        assert_eq!(share(&outside), integer(1) / integer(6), "what is cut off");
        assert_eq!(share(&inside) + share(&outside), BigRational::one(), "and the rest");
        let (inside, outside) = split(&whole(), &[rational(0.0), rational(0.0), rational(1.0)]);
        assert_eq!((inside, outside.len()), (whole(), 0), "what touches the line lies inside");
    }
}
