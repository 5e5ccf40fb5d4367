//! Removes elements, and with them all elements that cannot exist without them.

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use crate::refusal::Refusal;

impl EditMesh {
    /// Removes a face; its edges and vertices stay.
    ///
    /// # Errors
    /// There is no such face.
    pub fn remove_face(&mut self, face: FaceId) -> Result<(), Refusal> {
        self.check_face(face)?;
        let first = self.faces[face.0].corner;
        let mut corner = first;
        loop {
            let next = self.corners[corner].next;
            self.unlink_at_edge(corner);
            self.free_corner(corner);
            corner = next;
            if corner == first {
                break;
            }
        }
        self.free_face(face.0);
        Ok(())
    }

    /// Removes an edge and its faces; vertices stay.
    ///
    /// # Errors
    /// There is no such edge.
    pub fn remove_edge(&mut self, edge: EdgeId) -> Result<(), Refusal> {
        self.check_edge(edge)?;
        while self.edges[edge.0].corner != NONE {
            let corner = CornerId(self.edges[edge.0].corner);
            self.remove_face(self.corner_face(corner))?;
        }
        self.unlink_at_vertex(edge.0, 0);
        self.unlink_at_vertex(edge.0, 1);
        self.free_edge(edge.0);
        Ok(())
    }

    /// Removes a vertex, its edges and their faces.
    ///
    /// # Errors
    /// There is no such vertex.
    pub fn remove_vertex(&mut self, vertex: VertexId) -> Result<(), Refusal> {
        self.check_vertex(vertex)?;
        while self.vertices[vertex.0].edge != NONE {
            self.remove_edge(EdgeId(self.vertices[vertex.0].edge))?;
        }
        self.free_vertex(vertex.0);
        Ok(())
    }

    /// Removes an edge if no face has it; whether it did.
    pub fn remove_loose_edge(&mut self, edge: EdgeId) -> bool {
        let is_loose = self.has_edge(edge) && self.edge_corners(edge).next().is_none();
        is_loose && self.remove_edge(edge).is_ok()
    }

    /// Removes a vertex if it has no edges; whether it did.
    pub fn remove_loose_vertex(&mut self, vertex: VertexId) -> bool {
        let is_loose = self.has_vertex(vertex) && self.vertex_edges(vertex).next().is_none();
        is_loose && self.remove_vertex(vertex).is_ok()
    }
}
