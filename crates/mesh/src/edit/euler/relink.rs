//! A face gets other vertices, or turns over.

use smallvec::SmallVec;

use super::super::edit_mesh::EditMesh;
use super::super::ids::{CornerId, FaceId, VertexId};
use super::super::refusal::Refusal;
use super::add::check_outline;

impl EditMesh {
    /// Gives each corner of a face another vertex, with the edges that this needs. The face and its
    /// corners keep their ids and values. Old edges and vertices stay.
    ///
    /// # Errors
    /// There is no such face or vertex, there is not one vertex for each corner, or the outline
    /// cannot be that of a face (see [`Self::add_face`]).
    pub fn relink_face(&mut self, face: FaceId, vertices: &[VertexId]) -> Result<(), Refusal> {
        self.check_face(face)?;
        for &vertex in vertices {
            self.check_vertex(vertex)?;
        }
        self.check_room()?;
        if vertices.len() != self.face_size(face) {
            let reason = "a face needs one vertex for each of its corners";
            return Err(Refusal::NotPossible { operation: "giving a face other vertices", reason });
        }
        check_outline(vertices)?;
        let corners: SmallVec<[CornerId; 8]> = self.face_corners(face).collect();
        for (i, (&corner, &vertex)) in corners.iter().zip(vertices).enumerate() {
            let next = vertices[(i + 1) % vertices.len()];
            let is_same = self.corner_vertex(corner) == vertex
                && self.other_vertex(self.corner_edge(corner), self.corner_vertex(corner)) == next;
            if is_same {
                continue;
            }
            let edge = self.join(vertex, next);
            self.unlink_at_edge(corner.0);
            self.corners.write(corner.0).vertex = vertex.0;
            self.link_at_edge(corner.0, edge.0);
        }
        Ok(())
    }

    /// Turns a face over: its first corner stays first, the others follow in the opposite
    /// direction, each with its values. Normals that were given then point the
    /// other way.
    ///
    /// # Errors
    /// There is no such face.
    pub fn flip_face(&mut self, face: FaceId) -> Result<(), Refusal> {
        self.check_face(face)?;
        let corners: SmallVec<[CornerId; 8]> = self.face_corners(face).collect();
        // The edge that led to a corner is the one that leaves it afterwards.
        let edges: SmallVec<[u32; 8]> = corners.iter().map(|corner| self.corners[corner.0].edge).collect();
        for corner in &corners {
            self.unlink_at_edge(corner.0);
        }
        for (i, &corner) in corners.iter().enumerate() {
            let record = self.corners.write(corner.0);
            std::mem::swap(&mut record.next, &mut record.previous);
            let before = if i == 0 { corners.len() - 1 } else { i - 1 };
            self.link_at_edge(corner.0, edges[before]);
        }
        for corner in corners {
            for layer in &mut self.corner_layers {
                layer.turn_over(corner.0);
            }
        }
        Ok(())
    }
}
