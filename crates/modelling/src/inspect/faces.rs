//! Findings about the shape of faces: without area, not planar.

use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;

/// A face with corners off its plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct NonPlanarFace {
    /// Which.
    pub face: FaceId,
    /// How far the farthest corner is from the plane through the mean of all corners,
    /// perpendicular to the face's normal; in metres.
    pub distance: f64,
}

impl EditMesh {
    /// The faces no larger than `most` square metres, and those at places that are not finite.
    #[must_use]
    pub fn zero_area_faces(&self, most: f64) -> Vec<FaceId> {
        let has_area = |face: &FaceId| {
            let area = self.face_area(*face);
            area > most && area.is_finite()
        };
        self.faces().filter(|face| !has_area(face)).collect()
    }

    /// The faces with a corner farther than `within` metres from their plane. A face without area has
    /// no plane, and is none of them.
    #[must_use]
    pub fn non_planar_faces(&self, within: f64) -> Vec<NonPlanarFace> {
        let finding = |face| NonPlanarFace { face, distance: self.distance_from_plane(face) };
        self.faces().map(finding).filter(|finding| finding.distance > within).collect()
    }

    fn distance_from_plane(&self, face: FaceId) -> f64 {
        if self.face_size(face) <= 3 {
            return 0.0;
        }
        let (center, normal) = (self.face_center(face), self.face_normal(face));
        let distances =
            self.face_vertices(face).map(|vertex| (self.point(vertex) - center).dot(normal).abs());
        distances.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {

    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_lifted_corner_of_a_square_is_a_quarter_off_its_plane() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 1, 1));
        assert_eq!(mesh.non_planar_faces(0.0), vec![], "flat");
        let vertex = mesh.vertices().next().expect("four");
        let lift = 0.001;
        mesh.set_position(vertex, mesh.position(vertex) + Vec3::Y * lift);
        let [found] = mesh.non_planar_faces(1e-4)[..] else { panic!("one face") };
        // The plane follows two of its corners by half and the mean by a quarter; the tilt of its
        // normal changes that by its square.
        assert!((found.distance - f64::from(lift) / 4.0).abs() < 1e-8, "{}", found.distance);
        let vertices: Vec<_> = mesh.vertices().collect();
        vertices.iter().for_each(|&vertex| mesh.set_position(vertex, Vec3::X));
        assert_eq!(mesh.zero_area_faces(0.0).len(), 1, "all at one place");
    }
}
