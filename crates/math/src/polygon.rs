//! Polygons in space: their area vectors, and how they are seen along an axis.

use glam::{DVec2, DVec3, Vec3};

/// The vector whose direction is a polygon's normal and whose length is its
/// area (M. Newell's normal, see Sutherland, Sproull and Schumacker, "A
/// Characterization of Ten Hidden-Surface Algorithms", 1974). Taken relative
/// to the first corner, so that a polygon far from the origin loses nothing.
///
/// ```
/// use trigon_math::{DVec3, area_vector};
///
/// let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
/// assert_eq!(area_vector(square), DVec3::Z);
/// ```
#[inline]
pub fn area_vector(corners: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for_each_cross_product(corners, |product| sum += product);
    sum * 0.5
}

/// A projection of a polygon onto a plane: drops the coordinate along which the polygon is seen, so that nothing is
/// rounded, and keeps the sense in which the polygon turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisProjection {
    /// The number of the coordinate that is dropped.
    axis: usize,
    /// Whether the polygon is seen from the negative end of the axis.
    swap: bool,
}

impl AxisProjection {
    /// Below this share of what the parts add up to without their signs, an area
    /// vector is rounding or a figure of eight, and says nothing about a side.
    pub const CANCELLED: f64 = 1e-12;

    /// Against the longest coordinate of a normal.
    #[must_use]
    #[inline]
    pub fn against(normal: DVec3) -> Self {
        let axis = longest_axis(normal);
        Self { axis, swap: normal[axis] < 0.0 }
    }

    /// The axis along which the polygon is seen largest, so that it runs counter-clockwise in (x right, y up).
    #[must_use]
    pub fn of(positions: &[Vec3]) -> Self {
        let (mut sum, mut magnitude) = (DVec3::ZERO, DVec3::ZERO);
        for_each_cross_product(positions.iter().map(|p| p.as_dvec3()), |product| {
            sum += product;
            magnitude += product.abs();
        });
        let longest = longest_axis(sum);
        let axis = if sum[longest].abs() > Self::CANCELLED * magnitude.max_element() {
            longest
        } else {
            longest_axis(magnitude)
        };
        Self { axis, swap: sum[axis] < 0.0 }
    }

    /// The other two coordinates, in the order that keeps the turning sense seen
    /// from the positive end of the axis, or the opposite order.
    #[must_use]
    #[inline]
    pub fn project(self, point: DVec3) -> DVec2 {
        let [u, v] = match self.axis {
            0 => [point.y, point.z],
            1 => [point.z, point.x],
            _ => [point.x, point.y],
        };
        if self.swap { DVec2::new(v, u) } else { DVec2::new(u, v) }
    }
}

/// Calls back with twice the area vector of each triangle of the fan round
/// the first corner.
#[inline]
fn for_each_cross_product(corners: impl IntoIterator<Item = DVec3>, mut visit: impl FnMut(DVec3)) {
    let mut corners = corners.into_iter();
    let Some(first) = corners.next() else { return };
    let mut last = DVec3::ZERO;
    for corner in corners {
        let corner = corner - first;
        visit(last.cross(corner));
        last = corner;
    }
}

/// The first of the longest coordinates.
#[inline]
fn longest_axis(vector: DVec3) -> usize {
    let [x, y, z] = vector.abs().to_array();
    match (x >= y, x >= z, y >= z) {
        (true, true, _) => 0,
        (false, _, true) => 1,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_vector_of_a_unit_square_is_its_normal() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        assert_eq!(area_vector(square), DVec3::Z, "area 1, towards +z");
        assert_eq!(area_vector([]), DVec3::ZERO, "nothing has no area");
    }

    #[test]
    fn every_projection_keeps_the_turning_sense() {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let normal = DVec3::from_array([0, 1, 2].map(|i| if i == axis { sign } else { 0.0 }));
                let u = normal.any_orthonormal_vector();
                let v = normal.cross(u);
                let triangle = [DVec3::ZERO, u, v].map(|p| p.as_vec3());
                let projection = AxisProjection::of(&triangle);
                let flat = triangle.map(|point| projection.project(point.as_dvec3()));
                let area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
                assert!(area > 0.5, "seen from {normal} it turned clockwise");
            }
        }
    }
}
