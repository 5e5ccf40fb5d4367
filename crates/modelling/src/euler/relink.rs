//! Gives a face other vertices, or reverses it.

use smallvec::SmallVec;

use super::add::check_outline;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::records::CornerRecord;
use crate::refusal::Refusal;

/// A corner of a face that is turned over.
struct TurnedCorner {
    record: CornerRecord,
    /// Its edge knows it as its first corner.
    is_first: bool,
}

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
        self.check_capacity()?;
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
        self.reveal_outline(face);
        Ok(())
    }

    /// Turns a face over: its first corner stays first, the others follow in the opposite
    /// direction, each with its values. Normals that were given then point the other way. Turned
    /// over twice, it is as it was.
    ///
    /// # Errors
    /// There is no such face.
    pub fn flip_face(&mut self, face: FaceId) -> Result<(), Refusal> {
        self.check_face(face)?;
        let corners: SmallVec<[(CornerId, CornerRecord); 8]> =
            self.face_corners(face).map(|corner| (corner, self.corners[corner.0])).collect();
        let turned: SmallVec<[TurnedCorner; 8]> =
            corners.iter().map(|&(_, record)| self.turned_over(face, record)).collect();
        for (&(corner, _), turned) in corners.iter().zip(&turned) {
            self.turn_over(corner, turned);
        }
        for (corner, _) in corners {
            for layer in &mut self.corner_layers {
                layer.turn_over(corner.0);
            }
        }
        Ok(())
    }

    /// What a corner is once its face is turned over: it leaves along the edge that led to it, and takes
    /// the place of the corner before it in the ring of that edge.
    fn turned_over(&self, face: FaceId, record: CornerRecord) -> TurnedCorner {
        let side = self.corners[record.previous];
        // A side of the same face has its place taken over, too.
        let taken_over = |corner: u32| {
            let record = &self.corners[corner];
            if record.face == face.0 { record.next } else { corner }
        };
        let turned = CornerRecord {
            edge: side.edge,
            next: record.previous,
            previous: record.next,
            radial_next: taken_over(side.radial_next),
            radial_previous: taken_over(side.radial_previous),
            ..record
        };
        TurnedCorner { record: turned, is_first: self.edges[side.edge].corner == record.previous }
    }

    /// Writes a corner's record, and makes its edge and the corners beside it there know it.
    fn turn_over(&mut self, corner: CornerId, &TurnedCorner { record, is_first }: &TurnedCorner) {
        if is_first {
            self.edges.write(record.edge).corner = corner.0;
        }
        *self.corners.write(corner.0) = record;
        self.corners.write(record.radial_next).radial_previous = corner.0;
        self.corners.write(record.radial_previous).radial_next = corner.0;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::tests::meshes;

    proptest! {
        #[test]
        fn a_face_that_is_turned_over_twice_is_as_it_was(start in meshes(), index in any::<prop::sample::Index>()) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            prop_assume!(mesh.face_count() > 0);
            let before = mesh.clone();
            let face = FaceId(index.index(mesh.face_count()) as u32);
            let mut corners: Vec<CornerId> = mesh.face_corners(face).collect();
            mesh.flip_face(face).expect("it exists");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            corners[1..].reverse();
            prop_assert!(mesh.face_corners(face).eq(corners));
            mesh.flip_face(face).expect("it exists");
            prop_assert!(mesh == before);
        }
    }
}
