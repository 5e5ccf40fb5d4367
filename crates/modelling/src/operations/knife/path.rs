//! Which faces the path of a knife cuts.

use smallvec::SmallVec;

use super::{KnifePoint, OPERATION};
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::refusal::Refusal;

/// A part of a path between two points on edges or at vertices, with points within one face between
/// them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    /// Points of the path.
    pub(super) from: usize,
    pub(super) to: usize,
    /// The face that is cut; `None` where the path runs along an edge.
    pub(super) face: Option<FaceId>,
}

impl EditMesh {
    pub(super) fn check_knife_point(&self, point: &KnifePoint) -> Result<(), Refusal> {
        match *point {
            KnifePoint::Vertex(vertex) => self.check_vertex(vertex),
            KnifePoint::Face(face, _) => self.check_face(face),
            KnifePoint::Edge(edge, t) => {
                self.check_edge(edge)?;
                if (0.0..=1.0).contains(&t) {
                    return Ok(());
                }
                let (parameter, range) = ("the position on the edge", "0 to 1");
                Err(Refusal::OutOfRange { parameter, value: t, range })
            }
        }
    }

    /// The parts of a path, each with the face that it cuts.
    pub(super) fn knife_stretches(&self, path: &[KnifePoint]) -> Result<Vec<Stretch>, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        let is_inside = |i: usize| matches!(path[i], KnifePoint::Face(..));
        if path.len() < 2 || is_inside(0) || is_inside(path.len() - 1) {
            return refused("the path begins and ends at vertices or on edges, at least two of them");
        }
        let mut stretches = Vec::new();
        let mut from = 0;
        for to in 1..path.len() {
            if is_inside(to) {
                continue;
            }
            let mut common: SmallVec<[FaceId; 4]> = self.faces_at_point(path[from]);
            let end = self.faces_at_point(path[to]);
            common.retain(|face| end.binary_search(face).is_ok());
            for point in &path[from + 1..to] {
                if let KnifePoint::Face(inside, _) = point {
                    common.retain(|face| face == inside);
                }
            }
            let runs_along = to == from + 1 && self.share_an_edge(path[from], path[to]);
            let face = if runs_along { None } else { common.first().copied() };
            if face.is_none() && !runs_along {
                return refused("consecutive points of the path have no face in common; add points between");
            }
            stretches.push(Stretch { from, to, face });
            from = to;
        }
        Ok(stretches)
    }

    /// The faces at a point, sorted.
    fn faces_at_point(&self, point: KnifePoint) -> SmallVec<[FaceId; 4]> {
        let mut faces: SmallVec<[FaceId; 4]> = match point {
            KnifePoint::Vertex(vertex) => self.vertex_faces(vertex).collect(),
            KnifePoint::Edge(edge, _) => self.edge_faces(edge).collect(),
            KnifePoint::Face(face, _) => SmallVec::from_slice(&[face]),
        };
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// Whether two points are on the same edge.
    fn share_an_edge(&self, a: KnifePoint, b: KnifePoint) -> bool {
        match (a, b) {
            (KnifePoint::Vertex(a), KnifePoint::Vertex(b)) => self.find_edge(a, b).is_some(),
            (KnifePoint::Edge(a, _), KnifePoint::Edge(b, _)) => a == b,
            (KnifePoint::Vertex(vertex), KnifePoint::Edge(edge, _))
            | (KnifePoint::Edge(edge, _), KnifePoint::Vertex(vertex)) => {
                self.edge_vertices(edge).contains(&vertex)
            }
            _ => false,
        }
    }
}
