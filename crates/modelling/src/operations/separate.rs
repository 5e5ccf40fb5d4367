//! Separating: faces become a separate mesh.

use super::copy::Elements;
use super::region::Region;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

impl EditMesh {
    /// Moves faces into a separate mesh with the same layers and modifiers. Edges and vertices that other
    /// faces or edges need are copied; the others move with the faces.
    ///
    /// # Errors
    /// No face is given, or one does not exist.
    pub fn separate(&mut self, faces: &[FaceId]) -> Result<Self, Refusal> {
        let region = Region::new(self, faces, "separating")?;
        let mut part = self.part(&Elements::with_parts(self, &[], &[], &region.faces));
        part.modifiers.clone_from(&self.modifiers);
        self.delete_faces(&region.faces)?;
        Ok(part)
    }

    /// A mesh of copies of these faces with their edges and vertices, edges with their ends, and vertices, with
    /// the same layers and modifiers. Elements given several times are copied once.
    ///
    /// # Errors
    /// One does not exist.
    pub fn extract(
        &self,
        vertices: &[VertexId],
        edges: &[EdgeId],
        faces: &[FaceId],
    ) -> Result<Self, Refusal> {
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        let mut part = self.part(&Elements::with_parts(self, vertices, edges, faces));
        part.modifiers.clone_from(&self.modifiers);
        Ok(part)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::super::region::tests::{check_change, chosen_faces, counts};
    use super::*;
    use crate::tests::{keeps_affine_values, meshes, with_affine_values};

    #[test]
    fn a_cubes_lid_comes_off() {
        let start = with_affine_values(primitives::cube(2.0));
        let (mesh, lid) = check_change(&start, |mesh| mesh.separate(&[FaceId(4)])).expect("a face");
        assert_eq!(counts(&mesh), [8, 12, 5], "a box without a lid");
        assert_eq!(counts(&lid), [4, 4, 1], "the lid");
        lid.check_structure().expect("whole");
        keeps_affine_values(&lid).expect("values came along");
        let positions = |mesh: &EditMesh, face| -> Vec<_> {
            mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).collect()
        };
        let before = EditMesh::from_mesh(&start).0;
        assert_eq!(positions(&lid, FaceId(0)), positions(&before, FaceId(4)), "where it was");
    }

    #[test]
    fn copies_of_some_elements_are_a_mesh_of_their_own() {
        let start = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0))).0;
        let lid: Vec<_> = start.face_vertices(FaceId(4)).collect();
        let apart = start.vertices().find(|vertex| !lid.contains(vertex)).expect("four are");
        let part = start.extract(&[apart, apart, lid[0]], &[], &[FaceId(4)]).expect("they exist");
        assert_eq!(counts(&part), [5, 4, 1], "the lid, and one vertex more");
        part.check_structure().expect("whole");
        keeps_affine_values(&part).expect("values came along");
        assert!(start.extract(&[VertexId(99)], &[], &[]).is_err(), "there is no such vertex");
    }

    proptest! {
        #[test]
        fn what_is_separated_and_joined_again_has_all_faces(start in meshes(), bits in any::<u64>()) {
            let faces = chosen_faces(&start, bits);
            let Ok((mut mesh, part)) = check_change(&start, |mesh| mesh.separate(&faces)) else {
                prop_assert!(faces.is_empty(), "nothing else is refused");
                return Ok(());
            };
            prop_assert_eq!(part.check_structure(), Ok(()));
            prop_assert_eq!(part.face_count(), faces.len());
            prop_assert_eq!(mesh.face_count() + part.face_count(), start.face_count());
            let joined = mesh.join_mesh(&part, &trigon_math::DAffine3::IDENTITY).expect("room");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            prop_assert_eq!(joined.faces.len(), faces.len());
            prop_assert_eq!(mesh.corner_count(), EditMesh::from_mesh(&start).0.corner_count());
            prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
        }
    }
}
