//! Dividing a face into parts: shared by subdividing, triangulating and connecting.

use crate::edit_mesh::EditMesh;
use crate::euler::check_outline;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};

/// A point that becomes a corner of parts of a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct PartPoint {
    pub(super) vertex: VertexId,
    /// A corner of the face with the point's values: one of its own, or a new one that is not
    /// joined to anything. The first part at the point takes it, others take copies.
    pub(super) corner: CornerId,
    pub(super) is_taken: bool,
}

/// Outlines of parts, as indices into a list of points.
#[derive(Debug, Clone, Default)]
pub(super) struct Parts {
    indices: Vec<u32>,
    ends: Vec<usize>,
}

impl Parts {
    pub(super) fn clear(&mut self) {
        self.indices.clear();
        self.ends.clear();
    }

    pub(super) fn push(&mut self, outline: impl IntoIterator<Item = u32>) {
        self.indices.extend(outline);
        self.ends.push(self.indices.len());
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.indices[start..end])
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }
}

/// Elements created by dividing faces.
#[derive(Debug, Clone, Default)]
pub(super) struct Divided {
    /// Those between parts that were not there before.
    pub(super) edges: Vec<EdgeId>,
    /// All parts; the first of each face is the old face.
    pub(super) faces: Vec<FaceId>,
}

impl EditMesh {
    /// Divides a face. All its corners are among the points, and each point is in a part. Each part
    /// is the outline of a face.
    pub(super) fn divide_face(
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
        let (mut first, mut last) = (NONE, NONE);
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
            if last == NONE {
                first = corner;
            } else {
                self.link_in_face(last, corner);
            }
            last = corner;
        }
        self.link_in_face(last, first);
        let record = self.faces.write(part.0);
        record.corner = first;
        record.size = outline.len() as u32;
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
    pub(super) fn join_new(&mut self, a: VertexId, b: VertexId, new: &mut Vec<EdgeId>) -> EdgeId {
        let before = self.edge_count();
        let edge = self.join(a, b);
        if self.edge_count() > before {
            new.push(edge);
        }
        edge
    }
}

/// Whether each part can be a face: in a face that visits a vertex twice, parts may lack three
/// different vertices.
pub(super) fn are_faces(points: &[PartPoint], parts: &Parts) -> bool {
    let mut vertices = Vec::new();
    parts.iter().all(|outline| {
        vertices.clear();
        vertices.extend(outline.iter().map(|&index| points[index as usize].vertex));
        check_outline(&vertices).is_ok()
    })
}

/// Fills the strip between two rows of points with quads and triangles: steps along each row are
/// spread evenly, and where both rows step at the same moment there is a quad. Rows may begin or
/// end in the same point. `piece` gets the outlines, which run along `row` and back along `other`.
pub(super) fn fill_strip(row: &[u32], other: &[u32], mut piece: impl FnMut(&[u32])) {
    let (steps, other_steps) = (row.len() - 1, other.len() - 1);
    let (mut i, mut j) = (0, 0);
    while i < steps || j < other_steps {
        // Step number i of n happens at (i + 1/2) / n.
        let moment = (2 * i + 1) as u64 * other_steps as u64;
        let other_moment = (2 * j + 1) as u64 * steps as u64;
        let advances = j == other_steps || (i < steps && moment <= other_moment);
        let other_advances = i == steps || (j < other_steps && other_moment <= moment);
        let mut outline = [0; 4];
        let mut count = 0;
        let mut add = |index: u32| {
            if !outline[..count].contains(&index) {
                outline[count] = index;
                count += 1;
            }
        };
        add(row[i]);
        i += usize::from(advances);
        add(row[i]);
        add(other[j + usize::from(other_advances)]);
        add(other[j]);
        j += usize::from(other_advances);
        if count > 2 {
            piece(&outline[..count]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(row: &[u32], other: &[u32]) -> Vec<Vec<u32>> {
        let mut pieces = Vec::new();
        fill_strip(row, other, |piece| pieces.push(piece.to_vec()));
        pieces
    }

    #[test]
    fn a_strip_is_filled_evenly() {
        assert_eq!(pieces(&[0, 1, 2], &[5, 4, 3]), [[0, 1, 4, 5], [1, 2, 3, 4]], "quads");
        assert_eq!(pieces(&[0, 1, 2], &[4, 3]), [[0, 1, 4], [1, 3, 4], [1, 2, 3]], "three triangles");
        let symmetric = [vec![0, 1, 9], vec![1, 2, 8, 9], vec![2, 3, 8]];
        assert_eq!(pieces(&[0, 1, 2, 3], &[9, 8]), symmetric, "a quad in the middle");
        assert_eq!(pieces(&[0, 1, 2], &[9]), [[0, 1, 9], [1, 2, 9]], "a fan");
        assert_eq!(pieces(&[0, 1, 2], &[0, 3, 4]), [vec![0, 1, 3], vec![1, 2, 4, 3]], "from one point");
    }
}
