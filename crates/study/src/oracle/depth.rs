//! The exact depth of a triangle (the plane through its snapped corners, in rational numbers), which of
//! several triangles is nearest in a pixel (by integer fractions), and perspective-correct interpolation of a
//! value that is linear on a triangle in space.

use std::cmp::Ordering;
use std::ops::Range;

use num_rational::BigRational;

use super::area::{integer, rational};
use super::coverage::{covers, doubled_area, pixel_center};
use super::{GridPoint, STEPS};

/// A triangle on the sub-pixel grid with the depths of its corners, or any other
/// value that is linear on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Where the corners lie.
    pub corners: [GridPoint; 3],
    /// Their depths, which are finite.
    pub depths: [f32; 3],
}

impl Plane {
    /// The exact depth at a point, also outside of the triangle. `None` if the
    /// triangle has no area.
    ///
    /// # Panics
    /// A depth is not finite.
    #[must_use]
    pub fn at(&self, point: GridPoint) -> Option<BigRational> {
        let [a, b, c] = self.corners;
        let area = doubled_area(self.corners);
        // Each corner's weight is the area of the triangle in which the point replaces it.
        let shares = [[point, b, c], [a, point, c], [a, b, point]].map(doubled_area);
        let terms = shares.into_iter().zip(self.depths);
        let sum: BigRational = terms.map(|(share, depth)| integer(share) * rational(depth)).sum();
        (area != 0).then(|| sum / integer(area))
    }

    /// The least and the greatest depth of the corners, and so of the triangle.
    #[must_use]
    pub fn range(&self) -> [f32; 2] {
        let [a, b, c] = self.depths;
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// How thin it is: the area of its bounding box over its own area, at least 2, infinite without area. The
    /// rounding of a plane's slopes grows with it.
    #[must_use]
    pub fn stretch(&self) -> f64 {
        let extent = |axis: usize| {
            let [a, b, c] = self.corners.map(|corner| f64::from(corner[axis]));
            a.max(b).max(c) - a.min(b).min(c)
        };
        let area = doubled_area(self.corners).abs() as f64 / 2.0;
        if area == 0.0 { f64::INFINITY } else { extent(0) * extent(1) / area }
    }
}

/// A corner on the sub-pixel grid, with its nearness to the eye in steps of any length.
pub type Corner = [i32; 3];

/// The nearness of a triangle at a point: a fraction with a positive denominator.
#[derive(Clone, Copy, Debug)]
pub struct Nearness {
    numerator: i128,
    denominator: i128,
}

impl Nearness {
    /// At the centre of a pixel, exactly, if the triangle covers it. Corners are within 2²⁰ steps,
    /// so that fractions can be compared in 128 bits.
    #[must_use]
    pub fn of(corners: [Corner; 3], pixel: [i32; 2]) -> Option<Self> {
        let triangle = flat(corners);
        let point = pixel_center(pixel);
        if !covers(triangle, point) {
            return None;
        }
        let [a, b, c] = triangle;
        let shares = [[point, b, c], [a, point, c], [a, b, point]].map(doubled_area);
        let sum: i128 = shares.into_iter().zip(corners).map(|(share, [.., z])| share * i128::from(z)).sum();
        let area = doubled_area(triangle);
        Some(Self { numerator: sum * area.signum(), denominator: area.abs() })
    }
}

impl Ord for Nearness {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.numerator * other.denominator).cmp(&(other.numerator * self.denominator))
    }
}

impl PartialOrd for Nearness {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Nearness {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Nearness {}

fn flat(corners: [Corner; 3]) -> [GridPoint; 3] {
    corners.map(|[x, y, _]| [x, y])
}

/// The pixels of an image whose centres a triangle can cover, row by row.
pub fn pixels(corners: [Corner; 3], size: [usize; 2]) -> impl Iterator<Item = [i32; 2]> {
    let range = |axis: usize| -> Range<i32> {
        let [a, b, c] = corners.map(|corner| corner[axis].div_euclid(STEPS));
        a.min(b).min(c).max(0)..(a.max(b).max(c) + 1).min(size[axis] as i32)
    };
    let (columns, rows) = (range(0), range(1));
    rows.flat_map(move |y| columns.clone().map(move |x| [x, y]))
}

/// The value at a point of the image, given the corners there, their distances from the eye
/// along the line of sight, and their values. `None` for a triangle without area.
///
/// Areas are exact integers; the rest is rounded in `f64` a dozen times, so where the point lies
/// in the triangle and distances are positive, the result is within 2⁻⁴⁸ of the greatest value.
#[must_use]
pub fn at(corners: [GridPoint; 3], distances: [f64; 3], values: [f64; 3], point: GridPoint) -> Option<f64> {
    let [a, b, c] = corners;
    // A corner's weight on the image is the area of the triangle with the point instead of it.
    // A corner that is twice as far away counts half as much on the triangle in space.
    let areas = [[point, b, c], [a, point, c], [a, b, point]].map(doubled_area);
    let weights = [0, 1, 2].map(|i| areas[i] as f64 / distances[i]);
    let sum: f64 = weights.iter().sum();
    let weighted: f64 = weights.iter().zip(values).map(|(weight, value)| weight * value).sum();
    (doubled_area(corners) != 0).then(|| weighted / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANE: Plane = Plane { corners: [[0, 0], [300, 0], [0, 500]], depths: [0.25, 0.5, 1.0] };

    #[test]
    fn corners_have_their_depths_in_any_order() {
        let [a, b, c] = PLANE.corners;
        let [x, y, z] = PLANE.depths;
        for plane in [PLANE, Plane { corners: [c, b, a], depths: [z, y, x] }] {
            for (corner, depth) in PLANE.corners.into_iter().zip(PLANE.depths) {
                assert_eq!(plane.at(corner), Some(rational(depth)), "at {corner:?}");
            }
        }
    }

    #[test]
    fn a_plane_is_linear_beyond_its_corners_too() {
        assert_eq!(PLANE.at([600, 0]), Some(rational(0.75)), "twice the way to a corner");
        assert_eq!(PLANE.at([1, 0]), Some(rational(0.25) + rational(0.25) / integer(300)), "no rounding");
    }

    #[test]
    fn a_needle_has_much_stretch_and_a_line_no_depth() {
        assert_eq!((PLANE.stretch(), PLANE.range()), (2.0, [0.25, 1.0]), "half of its box");
        let needle = Plane { corners: [[0, 0], [1000, 1000], [999, 1000]], ..PLANE };
        assert_eq!(needle.stretch(), 2000.0, "an area of 500 in a box of a million");
        let line = Plane { corners: [[0, 0], [5, 5], [9, 9]], ..PLANE };
        assert_eq!((line.at([1, 1]), line.stretch()), (None, f64::INFINITY), "no plane");
    }

    #[test]
    fn a_plane_is_told_from_one_that_is_a_hair_nearer() {
        let square = |far: i32| [[0, 0, 7], [1024, 0, far], [0, 1024, 9]];
        let [one, other] = [700_000, 700_001].map(|far| Nearness::of(square(far), [0, 0]).unwrap());
        assert!(one < other && one != other, "{one:?} and {other:?}");
        // At (128, 128) of 1024: weights of 6, 1 and 1 eighths.
        assert_eq!(one, Nearness { numerator: 6 * 7 + 700_000 + 9, denominator: 8 }, "the mean");
    }

    #[test]
    fn pixels_are_those_of_the_box_in_the_image() {
        let corners = [[-300, 100, 0], [600, 100, 0], [100, 300, 0]];
        assert_eq!(pixels(corners, [2, 9]).collect::<Vec<_>>(), [[0, 0], [1, 0], [0, 1], [1, 1]]);
        assert_eq!(Nearness::of(corners, [5, 5]), None, "beside it");
    }

    #[test]
    fn the_middle_of_a_receding_edge_is_nearer_to_the_near_end() {
        let corners = [[0, 0], [1024, 0], [0, 1024]];
        let found = at(corners, [1.0, 3.0, 1.0], [0.0, 1.0, 0.0], [512, 0]);
        // By similar triangles: the line of sight meets a quarter of the way.
        assert_eq!(found, Some(0.25), "not half");
        assert_eq!(at(corners, [2.0; 3], [0.0, 1.0, 0.0], [512, 0]), Some(0.5), "linear at one distance");
        assert_eq!(at([[0, 0]; 3], [1.0; 3], [1.0; 3], [0, 0]), None, "without area");
    }
}
