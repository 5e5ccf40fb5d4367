//! Dividing a face into parts.

use smallvec::SmallVec;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};

/// A point that becomes a corner of parts of a face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PartPoint {
    pub(crate) vertex: VertexId,
    /// A corner of the face with the point's values: one of its own, or a new one that is not
    /// joined to anything. The first part at the point takes it, others take copies.
    pub(crate) corner: CornerId,
    pub(crate) is_taken: bool,
}

/// Outlines of parts, as indices into a list of points.
#[derive(Debug, Clone, Default)]
pub(crate) struct Parts {
    indices: Vec<u32>,
    ends: Vec<usize>,
}

impl Parts {
    pub(crate) fn clear(&mut self) {
        self.indices.clear();
        self.ends.clear();
    }

    pub(crate) fn push(&mut self, outline: impl IntoIterator<Item = u32>) {
        self.indices.extend(outline);
        self.ends.push(self.indices.len());
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.indices[start..end])
    }

    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }
}

/// Elements created by dividing faces.
#[derive(Debug, Clone, Default)]
pub(crate) struct Divided {
    /// Those between parts that were not there before.
    pub(crate) edges: Vec<EdgeId>,
    /// All parts; the first of each face is the old face.
    pub(crate) faces: Vec<FaceId>,
}

impl EditMesh {
    /// Divides a face. All its corners are among the points. Each part is the outline of a face; a corner of a point that
    /// is in none is left to the caller.
    pub(crate) fn divide_face(
        &mut self,
        face: FaceId,
        points: &mut [PartPoint],
        parts: &Parts,
        divided: &mut Divided,
    ) {
        for (number, outline) in parts.iter().enumerate() {
            let part = if number == 0 { face } else { FaceId(self.new_face()) };
            if number > 0 {
                self.copy_face(face, part);
            }
            self.lay_outline(part, outline, points, divided);
            divided.faces.push(part);
        }
    }

    fn lay_outline(
        &mut self,
        part: FaceId,
        outline: &[u32],
        points: &mut [PartPoint],
        divided: &mut Divided,
    ) {
        let mut corners = SmallVec::<[u32; 8]>::with_capacity(outline.len());
        for (i, &index) in outline.iter().enumerate() {
            let next = points[outline[if i + 1 == outline.len() { 0 } else { i + 1 }] as usize].vertex;
            let corner = self.take_corner(&mut points[index as usize], part).0;
            let edge = self.join_new(points[index as usize].vertex, next, &mut divided.edges).0;
            let known = self.corners[corner].edge;
            if known != edge {
                if known != NONE {
                    self.unlink_at_edge(corner);
                }
                self.link_at_edge(corner, edge);
            }
            corners.push(corner);
        }
        self.link_outline(part.0, &corners);
        self.reveal_outline(part);
    }

    /// The corner that a part gets at a point.
    fn take_corner(&mut self, point: &mut PartPoint, part: FaceId) -> CornerId {
        if point.is_taken {
            let copy = CornerId(self.new_corner(point.vertex.0, part.0));
            self.copy_corner(point.corner, copy);
            return copy;
        }
        point.is_taken = true;
        self.corners.write(point.corner.0).face = part.0;
        point.corner
    }

    /// The edge between two vertices; added to `new` if it was not there.
    pub(crate) fn join_new(&mut self, a: VertexId, b: VertexId, new: &mut Vec<EdgeId>) -> EdgeId {
        let before = self.edge_count();
        let edge = self.join(a, b);
        if self.edge_count() > before {
            new.push(edge);
        }
        edge
    }
}
