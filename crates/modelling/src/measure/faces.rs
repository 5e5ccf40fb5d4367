//! Normals, areas and centres of faces, and normals of vertices.

use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;
use trigon_math::{DVec3, angle, area_vector, unit_or_zero};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};

/// Normals of faces that are asked for again and again, once for each of their edges or corners: those
/// of large faces are kept, so that time stays proportional to the corners.
#[derive(Debug, Default)]
pub(crate) struct FaceNormals {
    large: BTreeMap<FaceId, DVec3>,
}

impl FaceNormals {
    /// [`EditMesh::face_normal`], computed once for a large face.
    pub(crate) fn of(&mut self, mesh: &EditMesh, face: FaceId) -> DVec3 {
        /// Up to here computing a normal costs about as much as looking for it.
        const SMALL: usize = 16;
        if mesh.face_size(face) <= SMALL {
            return mesh.face_normal(face);
        }
        *self.large.entry(face).or_insert_with(|| mesh.face_normal(face))
    }
}

impl EditMesh {
    /// The area vector of a face: its direction is the face's normal, its length the area in
    /// square metres. Of a face that is not planar this is the mean over its surface, however
    /// that is cut.
    #[must_use]
    pub fn face_area_vector(&self, face: FaceId) -> DVec3 {
        area_vector(self.face_vertices(face).map(|vertex| self.point(vertex)))
    }

    /// The unit normal of a face, out of the side from which it is counter-clockwise. Zero where
    /// it has no area or a position is not finite.
    #[must_use]
    pub fn face_normal(&self, face: FaceId) -> DVec3 {
        unit_or_zero(self.face_area_vector(face))
    }

    /// The mean of a face's corners, in metres.
    #[must_use]
    pub fn face_center(&self, face: FaceId) -> DVec3 {
        let sum: DVec3 = self.face_vertices(face).map(|vertex| self.point(vertex)).sum();
        sum / self.face_size(face) as f64
    }

    /// The angle of a face at one of its corners, 0 to π; 0 at an edge without length.
    #[must_use]
    pub fn corner_angle(&self, corner: CornerId) -> f64 {
        let here = self.point(self.corner_vertex(corner));
        let back = self.point(self.corner_vertex(self.previous_corner(corner)));
        let ahead = self.point(self.corner_vertex(self.next_corner(corner)));
        angle(back - here, ahead - here)
    }

    /// The unit normal of a vertex: the mean of the normals of all its faces, weighted by their
    /// angles there, as [`Mesh::vertex_normals`](trigon_mesh::Mesh::vertex_normals) has it. Zero where
    /// faces cancel each other or there are none.
    #[must_use]
    pub fn vertex_normal(&self, vertex: VertexId) -> DVec3 {
        let weighted = |corner| self.face_normal(self.corner_face(corner)) * self.corner_angle(corner);
        unit_or_zero(self.vertex_corners(vertex).map(weighted).sum())
    }

    /// The normals of many vertices, in the order given, in time proportional to the vertices and
    /// the faces at them: a face with very many corners is measured once. Of a vertex that is
    /// given twice only the last has one.
    pub(crate) fn vertex_normals(&self, vertices: &[VertexId]) -> Vec<DVec3> {
        // By vertex, one more than its place in the list.
        let mut numbers = vec![0u32; self.vertex_capacity()];
        for (number, vertex) in (1..).zip(vertices) {
            numbers[vertex.0 as usize] = number;
        }
        let mut sums = vec![DVec3::ZERO; vertices.len()];
        let mut visited = FixedBitSet::with_capacity(self.face_capacity());
        for face in vertices.iter().flat_map(|&vertex| self.vertex_faces(vertex)) {
            if visited.put(face.0 as usize) {
                continue;
            }
            let normal = self.face_normal(face);
            for corner in self.face_corners(face) {
                let number = numbers[self.corner_vertex(corner).0 as usize];
                if number != 0 {
                    sums[number as usize - 1] += normal * self.corner_angle(corner);
                }
            }
        }
        sums.into_iter().map(unit_or_zero).collect()
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_cubes_faces_and_vertices_look_outwards() {
        let (cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        for face in cube.faces() {
            assert_eq!(cube.face_center(face), cube.face_normal(face), "one metre from the middle");
            assert_eq!(cube.face_area_vector(face).length(), 4.0, "two by two");
        }
        for vertex in cube.vertices() {
            let outwards = cube.point(vertex).normalize();
            // Three weights of a right angle, each within 2·10⁻⁸.
            assert!(cube.vertex_normal(vertex).abs_diff_eq(outwards, 1e-7), "{vertex}");
            let [of_many] = cube.vertex_normals(&[vertex])[..] else { panic!("one for one") };
            // Sums in another order.
            assert!(of_many.abs_diff_eq(cube.vertex_normal(vertex), 1e-15), "{vertex}");
        }
    }
}
