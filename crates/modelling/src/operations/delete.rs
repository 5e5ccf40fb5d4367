//! Deleting elements, in the four common ways.

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

impl EditMesh {
    /// Deletes vertices with all edges and faces at them.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn delete_vertices(&mut self, vertices: &[VertexId]) -> Result<(), Refusal> {
        require(vertices, "deleting vertices", "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        for &vertex in vertices {
            // An element given twice is already gone.
            if self.has_vertex(vertex) {
                self.remove_vertex(vertex)?;
            }
        }
        Ok(())
    }

    /// Deletes edges with all faces at them, and vertices that have no edge left.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn delete_edges(&mut self, edges: &[EdgeId]) -> Result<(), Refusal> {
        require(edges, "deleting edges", "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        for &edge in edges {
            if self.has_edge(edge) {
                let ends = self.edge_vertices(edge);
                self.remove_edge(edge)?;
                for vertex in ends {
                    self.remove_loose_vertex(vertex);
                }
            }
        }
        Ok(())
    }

    /// Deletes faces, and their edges and vertices that belong to nothing else.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn delete_faces(&mut self, faces: &[FaceId]) -> Result<(), Refusal> {
        require(faces, "deleting faces", "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        let mut edges = Vec::new();
        for &face in faces {
            if self.has_face(face) {
                edges.clear();
                edges.extend(self.face_edges(face));
                self.remove_face(face)?;
                self.remove_loose(&edges);
            }
        }
        Ok(())
    }

    /// Deletes faces and leaves their edges as wires.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn delete_only_faces(&mut self, faces: &[FaceId]) -> Result<(), Refusal> {
        require(faces, "deleting faces", "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        for &face in faces {
            if self.has_face(face) {
                self.remove_face(face)?;
            }
        }
        Ok(())
    }

    /// Removes those of some edges that have no face, and vertices then left without edges. Removed
    /// edges are skipped.
    pub(super) fn remove_loose(&mut self, edges: &[EdgeId]) {
        for &edge in edges {
            if !self.has_edge(edge) {
                continue;
            }
            let ends = self.edge_vertices(edge);
            if self.remove_loose_edge(edge) {
                for vertex in ends {
                    self.remove_loose_vertex(vertex);
                }
            }
        }
    }
}

/// An error for an operation that was given nothing.
pub(super) fn require<T>(
    elements: &[T],
    operation: &'static str,
    needed: &'static str,
) -> Result<(), Refusal> {
    if elements.is_empty() { Err(Refusal::NothingGiven { operation, needed }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    fn cube() -> EditMesh {
        EditMesh::from_mesh(&primitives::cube(2.0)).0
    }

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    #[test]
    fn a_cube_loses_what_is_deleted_and_what_hangs_on_it() {
        let mut mesh = cube();
        mesh.delete_vertices(&[VertexId(0), VertexId(0)]).expect("twice is once");
        assert_eq!(counts(&mesh), [7, 9, 3], "a vertex with three edges and faces");

        let mut mesh = cube();
        mesh.delete_edges(&[EdgeId(0)]).expect("it exists");
        assert_eq!(counts(&mesh), [8, 11, 4], "an edge with two faces");

        let mut mesh = cube();
        mesh.delete_faces(&[FaceId(0)]).expect("it exists");
        assert_eq!(counts(&mesh), [8, 12, 5], "others have its edges");
        let all: Vec<FaceId> = mesh.faces().collect();
        mesh.delete_faces(&all).expect("they exist");
        assert_eq!(counts(&mesh), [0, 0, 0], "nothing is left over");

        let mut mesh = cube();
        let all: Vec<FaceId> = mesh.faces().collect();
        mesh.delete_only_faces(&all).expect("they exist");
        assert_eq!(counts(&mesh), [8, 12, 0], "wires");
    }

    #[test]
    fn what_cannot_be_deleted_is_said_and_nothing_is_done() {
        let mut mesh = cube();
        let before = mesh.clone();
        let nothing = mesh.delete_faces(&[]).expect_err("no face");
        assert_eq!(nothing.to_string(), "deleting faces needs at least one face: select them first");
        assert_eq!(mesh.delete_faces(&[FaceId(0), FaceId(6)]), Err(Refusal::NoSuchFace(FaceId(6))), "six");
        assert!(mesh == before, "the first one is still there");
    }
}
