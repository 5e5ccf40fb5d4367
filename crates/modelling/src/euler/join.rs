//! Joins two edges into one, and two faces into one: the inverse of a split.

use smallvec::SmallVec;

use super::simple::is_simple;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

impl EditMesh {
    /// Removes a vertex between exactly two edges, which become one, in all their faces. Marks
    /// that either had stay. If its ends are joined by an edge already, that one takes the place of both.
    ///
    /// # Errors
    /// There is no such vertex, it has not exactly two edges, or a face would have fewer than three
    /// vertices or lie on another one.
    pub fn join_edges(&mut self, vertex: VertexId) -> Result<EdgeId, Refusal> {
        self.check_vertex(vertex)?;
        let refused = |reason| Err(Refusal::NotPossible { operation: "joining edges", reason });
        let edges: SmallVec<[EdgeId; 2]> = self.vertex_edges(vertex).take(3).collect();
        let [first, second] = edges[..] else {
            return refused("a vertex between exactly two edges is needed");
        };
        let corners: SmallVec<[CornerId; 4]> = self.vertex_corners(vertex).collect();
        for &corner in &corners {
            let face = self.corner_face(corner);
            if self.face_size(face) == 3 {
                return refused("a face would have fewer than three vertices; remove it first");
            }
            let left: SmallVec<[VertexId; 8]> =
                self.face_vertices(face).filter(|&other| other != vertex).collect();
            if self.face_over(&left, |_| false).is_some() {
                return refused("a face would lie on another one; remove one of them first");
            }
        }
        let (a, b) = (self.other_vertex(first, vertex), self.other_vertex(second, vertex));
        let known = self.find_edge(a, b);
        let edge = self.join(a, b);
        match known {
            Some(_) => self.unite_edge_marks(first, edge),
            None => self.copy_edge(first, edge),
        }
        self.unite_edge_marks(second, edge);
        let faces: SmallVec<[FaceId; 4]> = corners.iter().map(|&corner| self.corner_face(corner)).collect();
        for corner in corners {
            let before = self.previous_corner(corner);
            self.drop_corner(corner);
            self.unlink_at_edge(before.0);
            self.link_at_edge(before.0, edge.0);
        }
        self.remove_edge(first)?;
        self.remove_edge(second)?;
        self.free_vertex(vertex.0);
        faces.into_iter().for_each(|face| self.reveal_outline(face));
        Ok(edge)
    }

    /// Takes a corner out of its face. The corner before it still leaves along its old edge: the caller
    /// mends that.
    pub(crate) fn drop_corner(&mut self, corner: CornerId) {
        let record = self.corners[corner.0];
        self.unlink_at_edge(corner.0);
        self.link_in_face(record.previous, record.next);
        let face = self.faces.write(record.face);
        face.size -= 1;
        if face.corner == corner.0 {
            face.corner = record.next;
        }
        self.free_corner(corner.0);
    }

    /// Removes an edge where exactly two different faces meet that run along it in opposite
    /// directions, and makes them one face: the first of them.
    ///
    /// # Errors
    /// There is no such edge, it is not between two such faces, they share another vertex besides its ends, or
    /// they would lie on another face.
    pub fn join_faces(&mut self, edge: EdgeId) -> Result<FaceId, Refusal> {
        self.check_edge(edge)?;
        let refused = |reason| Err(Refusal::NotPossible { operation: "joining faces", reason });
        let Some([one, two]) = self.edge_pair(edge) else {
            return refused("an edge between exactly two faces is needed");
        };
        let (retained, gone) = (self.corner_face(one), self.corner_face(two));
        if retained == gone {
            return refused("both sides of the edge are the same face");
        }
        if self.corner_vertex(one) == self.corner_vertex(two) {
            return refused("the faces wind in opposite ways; recalculate normals first");
        }
        let outline: Vec<VertexId> = [retained, gone]
            .into_iter()
            .flat_map(|face| self.face_corners(face))
            .filter(|corner| ![one, two].contains(corner))
            .map(|corner| self.corner_vertex(corner))
            .collect();
        if !is_simple(&outline) {
            return refused("the faces share more than the edge; dissolve all that they share");
        }
        if self.face_over(&outline, |_| false).is_some() {
            return refused("the face would lie on another one; remove one of them first");
        }
        let moved: Vec<CornerId> = self.face_corners(gone).collect();
        for corner in &moved {
            self.corners.write(corner.0).face = retained.0;
        }
        let (before_one, after_one) = (self.corners[one.0].previous, self.corners[one.0].next);
        let (before_two, after_two) = (self.corners[two.0].previous, self.corners[two.0].next);
        self.link_in_face(before_one, after_two);
        self.link_in_face(before_two, after_one);
        for corner in [one, two] {
            self.unlink_at_edge(corner.0);
            self.free_corner(corner.0);
        }
        let record = self.faces.write(retained.0);
        record.size = record.size + moved.len() as u32 - 2;
        record.corner = after_one;
        self.free_face(gone.0);
        self.remove_edge(edge)?;
        self.reveal_outline(retained);
        Ok(retained)
    }
}
