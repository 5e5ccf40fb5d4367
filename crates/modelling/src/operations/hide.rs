//! Hiding and revealing elements.
//!
//! Hiding is propagated to everything that is not visible without a hidden element. A hidden vertex
//! hides its edges, a hidden edge its faces. In addition, hiding faces or edges hides what they
//! leave behind: edges all of whose faces are now hidden, and vertices all of whose edges are.
//! Hiding vertices leaves the rest of the outlines of their faces visible, as in Blender.

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

/// Elements that were hidden or revealed: those whose state changed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct VisibilityChange {
    /// In the order of discovery.
    pub vertices: Vec<VertexId>,
    /// In the order of discovery.
    pub edges: Vec<EdgeId>,
    /// In the order of discovery.
    pub faces: Vec<FaceId>,
}

impl EditMesh {
    /// Hides faces, edges all of whose faces are then hidden, and vertices all of whose edges are.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn hide_faces(&mut self, faces: &[FaceId]) -> Result<VisibilityChange, Refusal> {
        self.check_faces(faces, "hiding faces")?;
        let mut change = VisibilityChange::default();
        faces.iter().for_each(|&face| self.hide_face(face, &mut change));
        self.hide_left_behind(&mut change);
        Ok(change)
    }

    /// Hides edges, their faces, and what these leave behind: edges all of whose faces are then
    /// hidden, and vertices all of whose edges are.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn hide_edges(&mut self, edges: &[EdgeId]) -> Result<VisibilityChange, Refusal> {
        self.check_edges(edges, "hiding edges")?;
        let mut change = VisibilityChange::default();
        edges.iter().for_each(|&edge| self.hide_edge(edge, &mut change));
        self.hide_left_behind(&mut change);
        Ok(change)
    }

    /// Hides vertices with their edges and the faces at them.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn hide_vertices(&mut self, vertices: &[VertexId]) -> Result<VisibilityChange, Refusal> {
        self.check_vertices(vertices, "hiding vertices")?;
        let mut change = VisibilityChange::default();
        for &vertex in vertices {
            if !self.is_vertex_hidden(vertex) {
                self.set_vertex_hidden(vertex, true);
                change.vertices.push(vertex);
            }
            let edges: Vec<EdgeId> = self.vertex_edges(vertex).collect();
            edges.into_iter().for_each(|edge| self.hide_edge(edge, &mut change));
        }
        Ok(change)
    }

    /// Reveals everything that is hidden.
    pub fn reveal_all(&mut self) -> VisibilityChange {
        let change = VisibilityChange {
            vertices: self.vertices().filter(|&vertex| self.is_vertex_hidden(vertex)).collect(),
            edges: self.edges().filter(|&edge| self.is_edge_hidden(edge)).collect(),
            faces: self.faces().filter(|&face| self.is_face_hidden(face)).collect(),
        };
        change.vertices.iter().for_each(|&vertex| self.set_vertex_hidden(vertex, false));
        change.edges.iter().for_each(|&edge| self.set_edge_hidden(edge, false));
        change.faces.iter().for_each(|&face| self.set_face_hidden(face, false));
        change
    }

    fn hide_face(&mut self, face: FaceId, change: &mut VisibilityChange) {
        if !self.is_face_hidden(face) {
            self.set_face_hidden(face, true);
            change.faces.push(face);
        }
    }

    fn hide_edge(&mut self, edge: EdgeId, change: &mut VisibilityChange) {
        if !self.is_edge_hidden(edge) {
            self.set_edge_hidden(edge, true);
            change.edges.push(edge);
        }
        let faces: smallvec::SmallVec<[FaceId; 4]> = self.edge_faces(edge).collect();
        faces.into_iter().for_each(|face| self.hide_face(face, change));
    }

    /// Hides edges without a visible face at faces that were hidden, and vertices without a visible
    /// edge at edges that were.
    fn hide_left_behind(&mut self, change: &mut VisibilityChange) {
        let mut edges: Vec<EdgeId> = change.faces.iter().flat_map(|&face| self.face_edges(face)).collect();
        edges.sort_unstable();
        edges.dedup();
        for edge in edges {
            if self.edge_faces(edge).all(|face| self.is_face_hidden(face)) {
                self.hide_edge(edge, change);
            }
        }
        let mut vertices: Vec<VertexId> =
            change.edges.iter().flat_map(|&edge| self.edge_vertices(edge)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for vertex in vertices {
            let is_left = self.vertex_edges(vertex).all(|edge| self.is_edge_hidden(edge));
            if is_left && !self.is_vertex_hidden(vertex) {
                self.set_vertex_hidden(vertex, true);
                change.vertices.push(vertex);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::meshes;

    fn hidden(mesh: &EditMesh) -> [usize; 3] {
        [
            mesh.vertices().filter(|&vertex| mesh.is_vertex_hidden(vertex)).count(),
            mesh.edges().filter(|&edge| mesh.is_edge_hidden(edge)).count(),
            mesh.faces().filter(|&face| mesh.is_face_hidden(face)).count(),
        ]
    }

    fn counts(change: &VisibilityChange) -> [usize; 3] {
        [change.vertices.len(), change.edges.len(), change.faces.len()]
    }

    #[test]
    fn of_a_cube_more_is_hidden_with_each_face() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let face = FaceId(0);
        assert_eq!(
            counts(&cube.hide_faces(&[face, face]).expect("it exists")),
            [0, 0, 1],
            "others need its edges"
        );
        let edge = cube.face_edges(face).next().expect("four");
        let beside = cube.edge_faces(edge).find(|&other| other != face).expect("a cube is closed");
        assert_eq!(
            counts(&cube.hide_faces(&[beside]).expect("it exists")),
            [0, 1, 1],
            "the edge between them"
        );
        let all: Vec<FaceId> = cube.faces().collect();
        cube.hide_faces(&all).expect("they exist");
        assert_eq!(hidden(&cube), [8, 12, 6], "all");
        assert_eq!(counts(&cube.reveal_all()), [8, 12, 6], "and shown again");
        assert_eq!(hidden(&cube), [0; 3], "none");
        assert_eq!(counts(&cube.hide_vertices(&[VertexId(0)]).expect("it exists")), [1, 3, 3], "a corner");
        assert_eq!(cube.reveal_all().faces.len(), 3, "the faces of the corner");
        assert_eq!(counts(&cube.hide_edges(&[EdgeId(0)]).expect("it exists")), [0, 1, 2], "an edge");
        assert!(cube.hide_faces(&[FaceId(6)]).is_err(), "there are six");
    }

    proptest! {
        /// Whatever is hidden, nothing visible needs a hidden element.
        #[test]
        fn nothing_in_view_needs_what_is_hidden(
            start in meshes(),
            steps in prop::collection::vec((0u8..3, any::<prop::sample::Index>()), 1..5),
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            for (kind, index) in steps {
                let change = match kind {
                    0 => mesh.hide_vertices(&[VertexId(index.index(mesh.vertex_count()) as u32)]),
                    1 if mesh.edge_count() > 0 => mesh.hide_edges(&[EdgeId(index.index(mesh.edge_count()) as u32)]),
                    _ if mesh.face_count() > 0 => mesh.hide_faces(&[FaceId(index.index(mesh.face_count()) as u32)]),
                    _ => continue,
                };
                change.expect("the element exists");
                for edge in mesh.edges().filter(|&edge| !mesh.is_edge_hidden(edge)) {
                    prop_assert!(mesh.edge_vertices(edge).iter().all(|&vertex| !mesh.is_vertex_hidden(vertex)));
                }
                for face in mesh.faces().filter(|&face| !mesh.is_face_hidden(face)) {
                    prop_assert!(mesh.face_edges(face).all(|edge| !mesh.is_edge_hidden(edge)));
                }
            }
            mesh.reveal_all();
            prop_assert!(mesh == before);
        }
    }
}
