//! The exact depth of a triangle: the plane through its snapped corners, in rational numbers.

use super::GridPoint;
use super::area::{integer, rational};
use super::coverage::doubled_area;
use num_rational::BigRational;

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
}
