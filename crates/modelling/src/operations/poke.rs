//! Poking: each face becomes triangles around a new vertex in its middle.

use smallvec::SmallVec;
use trigon_math::DVec3;

use crate::edit_mesh::EditMesh;
use crate::euler::{Divided, PartPoint, Parts};
use crate::ids::{CornerId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// What poking made.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Poked {
    /// The new vertices, one for each given face in the order of ids.
    pub vertices: Vec<VertexId>,
    /// The triangles; of each face the first has its id.
    pub faces: Vec<FaceId>,
}

impl EditMesh {
    /// Gives each face a vertex in its middle, and cuts it into triangles from there to each of its edges.
    ///
    /// The middle is the mean of the corners, weighted by the lengths of both edges there, so that more corners on one
    /// side do not move it; with edges without length, the plain mean. It is moved along the face's normal by the offset
    /// (metres). Values are means with the same weights; triangles have the face's material and marks.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the offset is not finite; there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, FaceId};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let faces: Vec<FaceId> = cube.faces().collect();
    /// cube.poke_faces(&faces, 1.0)?;
    /// assert_eq!((cube.vertex_count(), cube.face_count()), (14, 24));
    /// // With a pyramid on each side it is a rhombic dodecahedron.
    /// assert!((cube.volume() - 16.0).abs() < 1e-12);
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn poke_faces(&mut self, faces: &[FaceId], offset: f64) -> Result<Poked, Refusal> {
        self.check_faces(faces, "poking")?;
        if !offset.is_finite() {
            let parameter = "the offset of a poke";
            return Err(Refusal::OutOfRange { parameter, value: offset, range: "finite" });
        }
        let faces = sorted_once(faces.to_vec());
        let corners: u64 = faces.iter().map(|&face| self.face_size(face) as u64).sum();
        self.check_capacity_for(NewElements {
            vertices: faces.len() as u64,
            edges: corners,
            corners: 2 * corners,
            faces: corners - faces.len() as u64,
        })?;
        let (mut vertices, mut divided, mut parts) = (Vec::new(), Divided::default(), Parts::default());
        for face in faces {
            vertices.push(self.poke_face(face, offset, &mut parts, &mut divided));
        }
        Ok(Poked { vertices, faces: divided.faces })
    }

    fn poke_face(&mut self, face: FaceId, offset: f64, parts: &mut Parts, divided: &mut Divided) -> VertexId {
        let weights = self.middle_weights(face);
        let at = |corner: CornerId| self.corner_vertex(corner);
        let middle: DVec3 = weights.iter().map(|&(corner, weight)| self.point(at(corner)) * weight).sum();
        let position = middle + self.face_normal(face) * offset;
        let of_vertices: SmallVec<[(VertexId, f64); 8]> =
            weights.iter().map(|&(corner, weight)| (at(corner), weight)).collect();
        let vertex = VertexId(self.new_vertex(position.as_vec3()));
        self.blend_vertex(&of_vertices, vertex);
        let tip = CornerId(self.new_corner(vertex.0, face.0));
        self.blend_corner(&weights, tip);
        let corners = weights.iter().map(|&(corner, _)| corner);
        let point =
            |corner: CornerId| PartPoint { vertex: self.corner_vertex(corner), corner, is_taken: false };
        let mut points: SmallVec<[PartPoint; 8]> = corners.chain([tip]).map(point).collect();
        let count = weights.len() as u32;
        parts.clear();
        (0..count).for_each(|i| parts.push([i, (i + 1) % count, count]));
        self.divide_face(face, &mut points, parts, divided);
        vertex
    }

    /// The corners of a face with their weights in its middle, which add up to 1.
    fn middle_weights(&self, face: FaceId) -> SmallVec<[(CornerId, f64); 8]> {
        let length = |corner: CornerId| self.edge_length(self.corner_edge(corner));
        let both = |corner: CornerId| length(corner) + length(self.previous_corner(corner));
        let mut weights: SmallVec<[(CornerId, f64); 8]> =
            self.face_corners(face).map(|corner| (corner, both(corner))).collect();
        let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
        let (count, is_usable) = (weights.len() as f64, sum > 0.0 && sum.is_finite());
        weights
            .iter_mut()
            .for_each(|(_, weight)| *weight = if is_usable { *weight / sum } else { 1.0 / count });
        weights
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, keeps_affine_values, meshes};

    #[test]
    fn more_corners_on_one_side_do_not_move_the_middle() {
        let mut mesh = EditMesh::new();
        let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.5, 2.0], [1.0, 2.0], [0.0, 2.0]];
        let vertices: Vec<VertexId> =
            outline.iter().map(|&[x, y]| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room")).collect();
        let face = mesh.add_face(&vertices).expect("simple");
        let made = mesh.poke_faces(&[face], 0.5).expect("possible");
        // Corners weigh half of both edges: the top is as heavy as without its additional ones.
        let center = mesh.position(made.vertices[0]);
        assert!(center.abs_diff_eq(Vec3::new(1.0, 1.0, 0.5), 0.1), "{center}");
        assert_eq!((center.y, center.z), (1.0, 0.5));
        assert_eq!(made.faces.len(), 6);
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        assert!(cube.poke_faces(&[], 0.0).is_err() && cube.poke_faces(&[FaceId(0)], f64::NAN).is_err());
    }

    proptest! {
        #[test]
        fn poked_faces_keep_closedness_values_and_volume(start in meshes(), bits in any::<u64>(), offset in -1.0f64..1.0) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let faces: Vec<FaceId> = mesh.faces().filter(|face| bits >> (face.0 % 64) & 1 != 0).collect();
            prop_assume!(!faces.is_empty());
            let flat = check_operation(&mesh, |mesh| mesh.poke_faces(&faces, 0.0));
            let (flat, made) = flat.map_err(TestCaseError::fail)?.expect("possible");
            prop_assert_eq!(keeps_affine_values(&flat), Ok(()));
            prop_assert_eq!(made.vertices.len(), faces.len());
            let (high, _) = check_operation(&mesh, |mesh| mesh.poke_faces(&faces, offset))
                .map_err(TestCaseError::fail)?
                .expect("possible");
            prop_assert_eq!(high.face_count(), flat.face_count());
            if mesh.is_watertight() {
                prop_assert!(high.is_watertight());
                // A pyramid on each face.
                let area: f64 = faces.iter().map(|&face| mesh.face_area(face)).sum();
                let expected = flat.volume() + area * offset / 3.0;
                prop_assert!((high.volume() - expected).abs() < 1e-4, "{} for {}", high.volume(), expected);
            }
        }
    }
}
