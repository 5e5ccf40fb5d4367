//! Duplicating: copies that are not joined to anything else.

use super::copy::{CopiedElements, Elements};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

impl EditMesh {
    /// Copies faces with their edges and vertices, edges with their ends, and vertices, all with their values
    /// and marks, in the same positions. Elements given several times are copied once; copies are joined to
    /// each other like the originals, and to nothing else.
    ///
    /// # Errors
    /// Nothing is given, something does not exist, or there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, FaceId};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(1.0));
    /// let copy = cube.duplicate(&[], &[], &[FaceId::new(0), FaceId::new(1)])?;
    /// assert_eq!(copy.faces.len(), 2);
    /// assert_eq!(cube.face_count(), 8);
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn duplicate(
        &mut self,
        vertices: &[VertexId],
        edges: &[EdgeId],
        faces: &[FaceId],
    ) -> Result<CopiedElements, Refusal> {
        if vertices.is_empty() && edges.is_empty() && faces.is_empty() {
            let needed = "at least one vertex, edge or face";
            return Err(Refusal::NothingGiven { operation: "duplicating", needed });
        }
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        self.check_capacity_for_copies(faces, edges.len() + vertices.len())?;
        let part = self.part(&Elements::with_parts(self, vertices, edges, faces));
        Ok(self.append(&part))
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
    fn two_faces_of_a_cube_have_six_vertices() {
        let start = with_affine_values(primitives::cube(2.0));
        let mut marked = EditMesh::from_mesh(&start).0;
        let shared = marked.edges().next().expect("twelve");
        marked.set_crease(shared, 0.5);
        let faces: Vec<FaceId> = marked.edge_faces(shared).collect();
        let copy = marked.duplicate(&[], &[shared], &faces).expect("two faces and their edge");
        marked.check_structure().expect("whole");
        assert_eq!(counts(&marked), [14, 19, 8], "six vertices, seven edges, two faces more");
        let new = copy.edges.iter().copied().find(|&edge| marked.edge_faces(edge).count() == 2);
        assert_eq!(new.map(|edge| marked.crease(edge)), Some(0.5), "marks are copied");
    }

    #[test]
    fn duplicating_nothing_is_refused() {
        let nothing = check_change(&primitives::cube(2.0), |mesh| mesh.duplicate(&[], &[], &[]));
        assert!(matches!(nothing, Err(Refusal::NothingGiven { .. })), "nothing was selected");
    }

    proptest! {
        #[test]
        fn copies_are_like_the_originals(start in meshes(), bits in any::<u64>(), picks in (any::<u32>(), any::<u32>())) {
            let faces = chosen_faces(&start, bits);
            let edges = [EdgeId(picks.0 % (start.edge_count() as u32).max(1))];
            let vertices = [VertexId(picks.1 % start.vertex_count() as u32)];
            let Ok((mesh, copy)) = check_change(&start, |mesh| mesh.duplicate(&vertices, &edges, &faces)) else {
                return Ok(());
            };
            prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
            prop_assert_eq!(copy.faces.len(), faces.len());
            for (&original, &copied) in faces.iter().zip(&copy.faces) {
                let positions = |face| mesh.face_vertices(face).map(|vertex| mesh.position(vertex));
                prop_assert!(positions(original).eq(positions(copied)), "the same outline");
                let is_new = mesh.face_vertices(copied).all(|vertex| copy.vertices.contains(&vertex));
                prop_assert!(is_new, "joined to copies alone");
            }
        }
    }
}
