//! The point of a surface that is nearest to another one: a tree of boxes over the triangles of faces.

use std::ops::Range;

use trigon_math::{Bounds3, DAffine3, DVec3, Vec3};
use trigon_mesh::Triangulator;

use super::box_tree::{BoxItem, BoxTree};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};

/// A triangle of a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfaceTriangle {
    pub(super) corners: [CornerId; 3],
    pub(super) points: [DVec3; 3],
    /// The position of its face in the list of faces.
    face: u32,
}

/// The triangles of some faces as they are drawn, moved by a transform; without those that are not finite.
pub(super) fn face_triangles(
    mesh: &EditMesh,
    faces: &[FaceId],
    transform: &DAffine3,
) -> Vec<SurfaceTriangle> {
    let mut triangulator = Triangulator::default();
    let (mut cut, mut triangles) = (Vec::new(), Vec::new());
    for (index, &face) in (0..).zip(faces) {
        let corners: Vec<CornerId> = mesh.face_corners(face).collect();
        let positions: Vec<Vec3> =
            corners.iter().map(|&corner| mesh.position(mesh.corner_vertex(corner))).collect();
        cut.clear();
        triangulator.complete_polygon(&positions, &mut cut);
        for triangle in &cut {
            let points = triangle.map(|i| transform.transform_point3(positions[i as usize].as_dvec3()));
            if points.iter().all(|point| point.is_finite()) {
                triangles.push(SurfaceTriangle {
                    corners: triangle.map(|i| corners[i as usize]),
                    points,
                    face: index,
                });
            }
        }
    }
    triangles
}

impl SurfaceTriangle {
    pub(super) fn middle(&self) -> DVec3 {
        self.points.iter().sum::<DVec3>() / 3.0
    }
}

/// The triangles of the faces of a mesh, to find the nearest of their points.
pub(super) struct SurfaceTree {
    triangles: Vec<SurfaceTriangle>,
    boxes: BoxTree,
    faces: Vec<FaceId>,
    /// The triangles of each face.
    ranges: Vec<Range<u32>>,
}

/// A point of a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfacePoint {
    pub(super) face: FaceId,
    /// The corners of a triangle of the face.
    pub(super) corners: [CornerId; 3],
    /// Their weights in this point: at least 0, with a sum of 1.
    pub(super) weights: [f64; 3],
    pub(super) position: DVec3,
    squared: f64,
    face_index: u32,
}

impl SurfacePoint {
    /// The corners with their weights, but those without any.
    pub(super) fn parts(&self) -> impl Iterator<Item = (CornerId, f64)> + '_ {
        self.corners.into_iter().zip(self.weights).filter(|(_, weight)| *weight > 0.0)
    }
}

impl SurfaceTree {
    /// Of all faces of a mesh, moved by a transform. Triangles that are not finite are left out.
    pub(super) fn new(mesh: &EditMesh, transform: &DAffine3) -> Self {
        let faces: Vec<FaceId> = mesh.faces().collect();
        let triangles = face_triangles(mesh, &faces, transform);
        let mut ranges = vec![0..0; faces.len()];
        for (index, triangle) in (0..).zip(&triangles) {
            let range: &mut Range<u32> = &mut ranges[triangle.face as usize];
            *range = if range.start == range.end { index..index + 1 } else { range.start..index + 1 };
        }
        let item = |triangle: &SurfaceTriangle| BoxItem {
            bounds: Bounds3::from_points(triangle.points),
            middle: triangle.middle(),
        };
        let items: Vec<BoxItem> = triangles.iter().map(item).collect();
        Self { boxes: BoxTree::new(&items), triangles, faces, ranges }
    }

    /// The positions of all triangles, in the order of faces.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles.iter().map(|triangle| triangle.points)
    }

    /// The nearest point of the surface; of several, that of the first face. `None` if there is no triangle, or the point
    /// is not finite.
    pub(super) fn nearest(&self, point: DVec3) -> Option<SurfacePoint> {
        if !point.is_finite() {
            return None;
        }
        let mut best: Option<SurfacePoint> = None;
        self.boxes.for_each_near(point, |triangle| {
            self.improve(&mut best, triangle, point);
            best.map_or(f64::INFINITY, |best| best.squared)
        });
        best
    }

    /// The nearest point of the same face as another point's.
    pub(super) fn nearest_of_face(&self, like: &SurfacePoint, point: DVec3) -> SurfacePoint {
        let mut best = None;
        for triangle in self.ranges[like.face_index as usize].clone() {
            self.improve(&mut best, triangle, point);
        }
        best.unwrap_or(*like)
    }

    fn improve(&self, best: &mut Option<SurfacePoint>, triangle: u32, point: DVec3) {
        let SurfaceTriangle { corners, points, face } = self.triangles[triangle as usize];
        let weights = nearest_weights(points, point);
        let position = points[0] * weights[0] + points[1] * weights[1] + points[2] * weights[2];
        let squared = position.distance_squared(point);
        let is_better = best
            .is_none_or(|best| squared < best.squared || squared == best.squared && face < best.face_index);
        if is_better {
            let face_index = face;
            let face = self.faces[face as usize];
            *best = Some(SurfacePoint { face, corners, weights, position, squared, face_index });
        }
    }
}

/// The weights of a triangle's corners in its point that is nearest to another one: by the region in which the point lies
/// (C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5).
fn nearest_weights([a, b, c]: [DVec3; 3], point: DVec3) -> [f64; 3] {
    let (ab, ac) = (b - a, c - a);
    // The regions of a triangle without area are only rounding.
    if ab.cross(ac).length_squared() <= 1e-24 * ab.length_squared() * ac.length_squared() {
        return nearest_on_edges([a, b, c], point);
    }
    let from_a = [ab.dot(point - a), ac.dot(point - a)];
    if from_a[0] <= 0.0 && from_a[1] <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let from_b = [ab.dot(point - b), ac.dot(point - b)];
    if from_b[0] >= 0.0 && from_b[1] <= from_b[0] {
        return [0.0, 1.0, 0.0];
    }
    let from_c = [ab.dot(point - c), ac.dot(point - c)];
    if from_c[1] >= 0.0 && from_c[0] <= from_c[1] {
        return [0.0, 0.0, 1.0];
    }
    let beside_c = from_a[0] * from_b[1] - from_b[0] * from_a[1];
    if beside_c <= 0.0 && from_a[0] >= 0.0 && from_b[0] <= 0.0 {
        let part = part_of(from_a[0], from_a[0] - from_b[0]);
        return [1.0 - part, part, 0.0];
    }
    let beside_b = from_c[0] * from_a[1] - from_a[0] * from_c[1];
    if beside_b <= 0.0 && from_a[1] >= 0.0 && from_c[1] <= 0.0 {
        let part = part_of(from_a[1], from_a[1] - from_c[1]);
        return [1.0 - part, 0.0, part];
    }
    let beside_a = from_b[0] * from_c[1] - from_c[0] * from_b[1];
    let (along, back) = (from_b[1] - from_b[0], from_c[0] - from_c[1]);
    if beside_a <= 0.0 && along >= 0.0 && back >= 0.0 {
        let part = part_of(along, along + back);
        return [0.0, 1.0 - part, part];
    }
    let sum = beside_a + beside_b + beside_c;
    let (v, w) = (part_of(beside_b, sum), part_of(beside_c, sum));
    [(1.0 - v - w).max(0.0), v, w]
}

fn nearest_on_edges(points: [DVec3; 3], point: DVec3) -> [f64; 3] {
    let mut best = ([1.0, 0.0, 0.0], f64::INFINITY);
    for [from, to] in [[0, 1], [1, 2], [2, 0]] {
        let along = points[to] - points[from];
        let part = part_of(along.dot(point - points[from]).max(0.0), along.length_squared());
        let squared = (points[from] + along * part).distance_squared(point);
        if squared < best.1 {
            let mut weights = [0.0; 3];
            weights[from] = 1.0 - part;
            weights[to] = part;
            best = (weights, squared);
        }
    }
    best.0
}

/// A part of a whole, 0 to 1; 0 of nothing.
fn part_of(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { (part / whole).clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::meshes;

    #[test]
    fn the_nearest_point_of_a_cube_is_known() {
        let (cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let tree = SurfaceTree::new(&cube, &DAffine3::from_translation(DVec3::X));
        for point in [DVec3::new(5.0, 0.5, 0.25), DVec3::new(-3.0, 7.0, -9.0), DVec3::new(1.5, 0.0, 0.9)] {
            let clamped = point.clamp(DVec3::new(0.0, -1.0, -1.0), DVec3::new(2.0, 1.0, 1.0));
            let inside = point == clamped;
            let expected = if inside { DVec3::new(point.x, point.y, 1.0) } else { clamped };
            let found = tree.nearest(point).expect("faces");
            assert!(found.position.distance(expected) < 1e-12, "{} for {expected}", found.position);
        }
        assert!(tree.nearest(DVec3::NAN).is_none(), "nowhere");
        assert!(SurfaceTree::new(&EditMesh::new(), &DAffine3::IDENTITY).nearest(DVec3::ZERO).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// No other point of a triangle is nearer: many are tried.
        #[test]
        fn no_point_of_the_surface_is_nearer(start in meshes(), at in prop::array::uniform3(-6.0_f64..6.0)) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let tree = SurfaceTree::new(&mesh, &DAffine3::IDENTITY);
            let point = DVec3::from(at);
            let Some(found) = tree.nearest(point) else { return Ok(()) };
            let blend: DVec3 =
                found.parts().map(|(corner, weight)| mesh.point(mesh.corner_vertex(corner)) * weight).sum();
            prop_assert!(blend.distance(found.position) < 1e-9, "the parts are the point");
            let least = found.position.distance(point);
            for triangle in &tree.triangles {
                let [a, b, c] = triangle.points;
                for i in 0..=8 {
                    for j in 0..=8 - i {
                        let (v, w) = (f64::from(i) / 8.0, f64::from(j) / 8.0);
                        let other = (a + (b - a) * v + (c - a) * w).distance(point);
                        prop_assert!(other >= least - 1e-9, "{} and {}", other, least);
                    }
                }
            }
        }
    }
}
