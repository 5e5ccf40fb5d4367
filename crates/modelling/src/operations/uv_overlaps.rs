//! Faces whose texture coordinates lie on those of others.

use fixedbitset::FixedBitSet;
use trigon_math::{DVec2, Orientation, Vec3, orientation};
use trigon_mesh::triangulate_polygon;

use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;

/// A part of a face in the image, counter-clockwise.
struct UvTriangle {
    face: FaceId,
    corners: [DVec2; 3],
    low: DVec2,
    high: DVec2,
}

impl EditMesh {
    /// The faces whose texture coordinates overlap those of another face by any area, decided without rounding; in the
    /// order of their ids. Faces without area in the image overlap nothing. None where there is no such set.
    ///
    /// Takes time proportional to the number of pairs that overlap in width, which is small in usual layouts.
    #[must_use]
    pub fn uv_overlaps(&self, uv_set: usize) -> Vec<FaceId> {
        if uv_set >= self.uv_set_count() {
            return Vec::new();
        }
        let mut parts: Vec<UvTriangle> = self.faces().flat_map(|face| self.uv_parts(uv_set, face)).collect();
        parts.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
        let mut found = FixedBitSet::with_capacity(self.face_capacity());
        let mut beside: Vec<UvTriangle> = Vec::new();
        for part in parts {
            beside.retain(|other| other.high.x > part.low.x);
            for other in &beside {
                let is_beside = other.low.y < part.high.y && part.low.y < other.high.y;
                if is_beside && other.face != part.face && overlap(&other.corners, &part.corners) {
                    found.insert(other.face.0 as usize);
                    found.insert(part.face.0 as usize);
                }
            }
            beside.push(part);
        }
        found.ones().map(|index| FaceId(index as u32)).collect()
    }

    fn uv_parts(&self, uv_set: usize, face: FaceId) -> Vec<UvTriangle> {
        let uv = |corner| self.uv(uv_set, corner).expect("the set exists");
        let points: Vec<Vec3> = self.face_corners(face).map(|corner| uv(corner).extend(0.0)).collect();
        let part = |triangle: [u32; 3]| {
            let [a, b, c] = triangle.map(|corner| points[corner as usize].truncate().as_dvec2());
            let corners = match orientation(a, b, c) {
                Orientation::CounterClockwise => [a, b, c],
                Orientation::Clockwise => [a, c, b],
                Orientation::Collinear => return None,
            };
            Some(UvTriangle { face, corners, low: a.min(b).min(c), high: a.max(b).max(c) })
        };
        triangulate_polygon(&points).into_iter().filter_map(part).collect()
    }
}

/// Whether two triangles that run counter-clockwise share any area: unless the line of a side of one of them has the
/// other one on its outer side.
fn overlap(a: &[DVec2; 3], b: &[DVec2; 3]) -> bool {
    let separates = |a: &[DVec2; 3], b: &[DVec2; 3]| {
        (0..3).any(|side| {
            let (from, to) = (a[side], a[(side + 1) % 3]);
            b.iter().all(|&point| orientation(from, to, point) != Orientation::CounterClockwise)
        })
    };
    !separates(a, b) && !separates(b, a)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec2;

    use super::*;

    /// Triangles of their own with these coordinates, on a grid of integers.
    fn triangles(uvs: &[[[i8; 2]; 3]]) -> EditMesh {
        let mut mesh = EditMesh::new();
        for _ in uvs {
            let vertices = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|at| mesh.add_vertex(at).expect("room"));
            mesh.add_face(&vertices).expect("a triangle");
        }
        mesh.add_uv_set(0).expect("room");
        for (face, uvs) in mesh.faces().collect::<Vec<_>>().into_iter().zip(uvs) {
            let corners: Vec<_> = mesh.face_corners(face).collect();
            for (corner, [u, v]) in corners.into_iter().zip(uvs) {
                mesh.set_uv(0, corner, Vec2::new(f32::from(*u), f32::from(*v)));
            }
        }
        mesh
    }

    #[test]
    fn faces_that_only_touch_do_not_overlap() {
        let first = [[0, 0], [4, 0], [0, 4]];
        let overlaps = |second| !triangles(&[first, second]).uv_overlaps(0).is_empty();
        assert!(!overlaps([[4, 0], [4, 4], [0, 4]]), "along an edge");
        assert!(!overlaps([[0, 0], [-4, 0], [0, -4]]), "at a corner");
        assert!(overlaps([[1, 1], [5, 1], [1, 5]]), "by a part");
        assert!(overlaps(first), "in the same position");
        assert!(overlaps([[0, 0], [0, 4], [4, 0]]), "turned over");
        assert!(!overlaps([[0, 0], [2, 0], [4, 0]]), "without area");
    }

    /// Whether two triangles of integers share area, by the areas of what is cut off, in exact rationals: the one is
    /// clipped by the sides of the other.
    fn shares_area(a: [[i8; 2]; 3], b: [[i8; 2]; 3]) -> bool {
        // Homogeneous coordinates: numerators and a positive denominator.
        let point = |[x, y]: [i8; 2]| [i128::from(x), i128::from(y), 1];
        let turned = |t: [[i8; 2]; 3]| {
            let [a, b, c] = t.map(|p| p.map(i32::from));
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            (area, if area < 0 { [t[0], t[2], t[1]] } else { t })
        };
        let ((area_a, a), (area_b, b)) = (turned(a), turned(b));
        if area_a == 0 || area_b == 0 {
            return false;
        }
        let mut polygon: Vec<[i128; 3]> = b.map(point).to_vec();
        for side in 0..3 {
            let (from, to) = (a[side].map(i128::from), a[(side + 1) % 3].map(i128::from));
            let (nx, ny) = (-(to[1] - from[1]), to[0] - from[0]);
            let distance = |p: &[i128; 3]| nx * (p[0] - from[0] * p[2]) + ny * (p[1] - from[1] * p[2]);
            let mut clipped = Vec::new();
            for (index, p) in polygon.iter().enumerate() {
                let q = polygon[(index + 1) % polygon.len()];
                let (d, e) = (distance(p), distance(&q));
                if d >= 0 {
                    clipped.push(*p);
                }
                if (d > 0 && e < 0) || (d < 0 && e > 0) {
                    // p·|e| + q·|d| over the sum, in homogeneous coordinates.
                    clipped.push(std::array::from_fn(|axis| p[axis] * e.abs() + q[axis] * d.abs()));
                }
            }
            polygon = clipped;
        }
        // Twice the area has the sign of the sum of these, over a common positive denominator; some triangle of a convex
        // polygon with area has area.
        polygon.windows(2).any(|pair| {
            let [o, p, q] = [polygon[0], pair[0], pair[1]].map(|p| p.map(|value| value as f64));
            let [ox, oy, px, py, qx, qy] =
                [o[0] / o[2], o[1] / o[2], p[0] / p[2], p[1] / p[2], q[0] / q[2], q[1] / q[2]];
            ((px - ox) * (qy - oy) - (py - oy) * (qx - ox)).abs() > 1e-9
        })
    }

    proptest! {
        #[test]
        fn overlaps_are_those_of_exact_clipping(
            uvs in prop::collection::vec(prop::array::uniform3(prop::array::uniform2(-6i8..6)), 2..7)
        ) {
            let found = triangles(&uvs).uv_overlaps(0);
            for (index, &triangle) in uvs.iter().enumerate() {
                let expected = uvs.iter().enumerate().any(|(other, &with)| other != index && shares_area(triangle, with));
                prop_assert_eq!(found.contains(&FaceId(index as u32)), expected, "{:?}", triangle);
            }
        }
    }
}
