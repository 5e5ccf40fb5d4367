//! Perspective-correct interpolation of a value that is linear on a triangle in space.

use super::GridPoint;
use super::coverage::doubled_area;

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
