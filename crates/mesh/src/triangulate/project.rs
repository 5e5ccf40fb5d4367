//! Projects a polygon in space onto a plane.

use trigon_math::{DVec2, DVec3, Vec3};

/// Below this share of what the parts add up to without their signs, an area
/// vector is rounding or a figure of eight, and says nothing about a side.
pub(crate) const CANCELLED: f64 = 1e-12;

/// The vector whose direction is a polygon's normal and whose length is its
/// area (M. Newell's normal, see Sutherland, Sproull and Schumacker, "A
/// Characterization of Ten Hidden-Surface Algorithms", 1974). Taken relative
/// to the first corner, so that a polygon far from the origin loses nothing.
pub(crate) fn area_vector(corners: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for_each_part(corners, |part| sum += part);
    sum * 0.5
}

/// From where a polygon is seen: along which axis, and whether from its negative end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct View {
    axis: usize,
    swap: bool,
}

impl View {
    /// Against the longest coordinate of a normal.
    pub(crate) fn against(normal: DVec3) -> Self {
        let axis = longest_axis(normal);
        Self { axis, swap: normal[axis] < 0.0 }
    }

    /// The axis along which the polygon is seen largest, so that it runs counter-clockwise in (x right, y up).
    pub(super) fn of(positions: &[Vec3]) -> Self {
        let (mut sum, mut magnitude) = (DVec3::ZERO, DVec3::ZERO);
        for_each_part(positions.iter().map(|p| p.as_dvec3()), |part| {
            sum += part;
            magnitude += part.abs();
        });
        let longest = longest_axis(sum);
        let axis = if sum[longest].abs() > CANCELLED * magnitude.max_element() {
            longest
        } else {
            longest_axis(magnitude)
        };
        Self { axis, swap: sum[axis] < 0.0 }
    }
}

/// Drops the coordinate along which the polygon is seen. Nothing is rounded.
pub(super) fn project(positions: &[Vec3], projected: &mut Vec<DVec2>) {
    let view = View::of(positions);
    projected.clear();
    projected.extend(positions.iter().map(|p| plane(p.as_dvec3(), view)));
}

/// Calls back with twice the area vector of each triangle of the fan round
/// the first corner.
fn for_each_part(corners: impl IntoIterator<Item = DVec3>, mut part: impl FnMut(DVec3)) {
    let mut corners = corners.into_iter();
    let Some(first) = corners.next() else { return };
    let mut last = DVec3::ZERO;
    for corner in corners {
        let corner = corner - first;
        part(last.cross(corner));
        last = corner;
    }
}

/// The other two coordinates, in the order that keeps the turning sense seen
/// from the positive end of the axis, or the opposite order.
pub(crate) fn plane(point: DVec3, View { axis, swap }: View) -> DVec2 {
    let [u, v] = match axis {
        0 => [point.y, point.z],
        1 => [point.z, point.x],
        _ => [point.x, point.y],
    };
    if swap { DVec2::new(v, u) } else { DVec2::new(u, v) }
}

/// The first of the longest coordinates.
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
                let mut flat = Vec::new();
                project(&triangle, &mut flat);
                let area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
                assert!(area > 0.5, "seen from {normal} it turned clockwise");
            }
        }
    }
}
