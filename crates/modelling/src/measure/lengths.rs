//! Lengths of edges, angles between faces, areas of faces.

use trigon_math::{DVec3, angle};

use super::FaceNormals;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};

impl EditMesh {
    /// How long an edge is, in metres.
    #[must_use]
    pub fn edge_length(&self, edge: EdgeId) -> f64 {
        let [a, b] = self.edge_vertices(edge).map(|vertex| self.point(vertex));
        a.distance(b)
    }

    /// By how much a surface folds at an edge: the angle between the normals of its two faces, 0
    /// (flat) to π (folded back), within 10⁻⁷ away from these. `None` unless exactly two faces with
    /// areas meet there that run in opposite directions.
    #[must_use]
    pub fn edge_angle(&self, edge: EdgeId) -> Option<f64> {
        self.edge_normals(edge, &mut FaceNormals::default()).map(|[one, two]| angle(one, two))
    }

    /// The normals of the two faces at an edge: `None` unless exactly two with areas meet there that
    /// run in opposite directions.
    pub(crate) fn edge_normals(&self, edge: EdgeId, normals: &mut FaceNormals) -> Option<[DVec3; 2]> {
        let [one, two] = self.edge_pair(edge)?;
        if self.corner_vertex(one) == self.corner_vertex(two) {
            return None;
        }
        let normals = [one, two].map(|corner| normals.of(self, self.corner_face(corner)));
        normals.iter().all(|&normal| normal != DVec3::ZERO).then_some(normals)
    }

    /// The area of a face in square metres; of one that is not planar, that of its area vector.
    #[must_use]
    pub fn face_area(&self, face: FaceId) -> f64 {
        self.face_area_vector(face).length()
    }

    /// The area of all faces in square metres.
    #[must_use]
    pub fn surface_area(&self) -> f64 {
        self.faces().map(|face| self.face_area(face)).sum()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_box_has_the_lengths_angles_and_areas_of_a_box() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        for edge in cube.edges() {
            assert_eq!(cube.edge_length(edge), 2.0, "{edge}");
            let angle = cube.edge_angle(edge).expect("a cube is closed");
            assert!((angle - FRAC_PI_2).abs() < 1e-7, "{edge}");
        }
        assert_eq!(cube.surface_area(), 24.0, "six of four");
        let face = cube.faces().next().expect("six");
        let edge = cube.face_edges(face).next().expect("four");
        cube.flip_face(face).expect("it exists");
        assert_eq!(cube.edge_angle(edge), None, "the faces run in the same direction");
    }
}
