//! Splits an edge into two, and a face into two.

use smallvec::SmallVec;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

/// The new elements where an edge was split.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SplitEdge {
    /// Between the two parts.
    pub vertex: VertexId,
    /// From the new vertex to the old edge's second vertex; the old edge is the other part.
    pub edge: EdgeId,
}

/// The new elements where a face was split.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SplitFace {
    /// Between the two parts: a new one, or the one that was there already.
    pub edge: EdgeId,
    /// From the second corner to the first; the old face is the other part.
    pub face: FaceId,
}

impl EditMesh {
    /// Puts a new vertex on an edge, at `t` of the way from its first vertex to its second (0
    /// to 1), and into all its faces. Values of corners and vertices are interpolated, marks
    /// are copied.
    ///
    /// # Errors
    /// There is no such edge, or `t` is not within 0…1.
    pub fn split_edge(&mut self, edge: EdgeId, t: f64) -> Result<SplitEdge, Refusal> {
        self.check_edge(edge)?;
        self.check_capacity()?;
        if !(0.0..=1.0).contains(&t) {
            return Err(Refusal::OutOfRange {
                parameter: "the position on the edge",
                value: t,
                range: "0 to 1",
            });
        }
        let [a, b] = self.edge_vertices(edge);
        let position = self.point(a) * (1.0 - t) + self.point(b) * t;
        let middle = VertexId(self.new_vertex(position.as_vec3()));
        self.blend_vertex(&[(a, 1.0 - t), (b, t)], middle);
        // Values are taken while the corners still have their old neighbours.
        let sides: SmallVec<[CornerId; 4]> = self.edge_corners(edge).collect();
        let mut added = SmallVec::<[CornerId; 4]>::new();
        for &side in &sides {
            let corner = CornerId(self.new_corner(middle.0, self.corners[side.0].face));
            let t = if self.corner_vertex(side) == a { t } else { 1.0 - t };
            self.blend_corner(&[(side, 1.0 - t), (self.next_corner(side), t)], corner);
            added.push(corner);
        }
        // The old edge keeps its first vertex.
        self.unlink_at_vertex(edge.0, 1);
        self.edges.write(edge.0).vertices[1] = middle.0;
        self.link_at_vertex(edge.0, 1);
        let far = EdgeId(self.new_edge([middle.0, b.0]));
        self.link_at_vertex(far.0, 0);
        self.link_at_vertex(far.0, 1);
        self.copy_edge(edge, far);
        for (&side, &corner) in sides.iter().zip(&added) {
            let next = self.corners[side.0].next;
            self.link_in_face(side.0, corner.0);
            self.link_in_face(corner.0, next);
            let face = self.corners[side.0].face;
            self.faces.write(face).size += 1;
            // Where the side leaves from `b`, it is the far part that it leaves along.
            let (first, second) = if self.corner_vertex(side) == a { (edge, far) } else { (far, edge) };
            if first != edge {
                self.unlink_at_edge(side.0);
                self.link_at_edge(side.0, first.0);
            }
            self.link_at_edge(corner.0, second.0);
        }
        Ok(SplitEdge { vertex: middle, edge: far })
    }

    /// Cuts a face from one of its corners to another. Each part keeps the values of its
    /// corners.
    ///
    /// # Errors
    /// The corners are not two of the same face, or they are neighbours, or both at the same
    /// vertex.
    pub fn split_face(&mut self, from: CornerId, to: CornerId) -> Result<SplitFace, Refusal> {
        self.check_corner(from)?;
        self.check_corner(to)?;
        self.check_capacity()?;
        let refused = |reason| Err(Refusal::NotPossible { operation: "splitting a face", reason });
        if self.corner_face(from) != self.corner_face(to) {
            return refused("both corners must belong to the same face");
        }
        if from == to || self.next_corner(from) == to || self.next_corner(to) == from {
            return refused("there is an edge between these corners already");
        }
        let (a, b) = (self.corner_vertex(from), self.corner_vertex(to));
        if a == b {
            return refused("both corners are at the same vertex");
        }
        if !self.has_three_vertices(from, to) || !self.has_three_vertices(to, from) {
            return refused("a part would have fewer than three different vertices");
        }
        Ok(self.cut_face(from, to))
    }

    /// Whether the outline from one corner to another, both included, visits three vertices.
    fn has_three_vertices(&self, from: CornerId, to: CornerId) -> bool {
        let (a, b) = (self.corner_vertex(from), self.corner_vertex(to));
        let mut corner = self.next_corner(from);
        while corner != to {
            let vertex = self.corner_vertex(corner);
            if vertex != a && vertex != b {
                return true;
            }
            corner = self.next_corner(corner);
        }
        false
    }

    /// The old face keeps the outline from `from` to `to`, the new one has that back to
    /// `from`.
    fn cut_face(&mut self, from: CornerId, to: CornerId) -> SplitFace {
        let old = self.corner_face(from);
        let (a, b) = (self.corner_vertex(from), self.corner_vertex(to));
        let edge = self.join(a, b);
        let new = FaceId(self.new_face());
        self.copy_face(old, new);
        // Two new corners: at `b` in the old face, which closes along the cut, and at `a` in the new.
        let closing_old = CornerId(self.new_corner(b.0, old.0));
        let closing_new = CornerId(self.new_corner(a.0, new.0));
        self.copy_corner(to, closing_old);
        self.copy_corner(from, closing_new);
        let before_from = self.corners[from.0].previous;
        let before_to = self.corners[to.0].previous;
        self.link_in_face(before_to, closing_old.0);
        self.link_in_face(closing_old.0, from.0);
        self.link_in_face(before_from, closing_new.0);
        self.link_in_face(closing_new.0, to.0);
        self.link_at_edge(closing_old.0, edge.0);
        self.link_at_edge(closing_new.0, edge.0);
        let mut moved = 0;
        let mut corner = to.0;
        loop {
            self.corners.write(corner).face = new.0;
            moved += 1;
            corner = self.corners[corner].next;
            if corner == to.0 {
                break;
            }
        }
        let record = self.faces.write(old.0);
        record.corner = from.0;
        record.size = record.size + 2 - moved;
        let record = self.faces.write(new.0);
        record.corner = to.0;
        record.size = moved;
        SplitFace { edge, face: new }
    }
}
