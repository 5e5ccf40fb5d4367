//! Which of several triangles is nearest in a pixel, by integer fractions.

use super::coverage::{centre, covers, doubled_area};
use super::{GridPoint, STEPS};
use std::cmp::Ordering;
use std::ops::Range;

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
        let point = centre(pixel);
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
