//! Both sides of a plane, and cuts along it.

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;
use trigon_math::{DVec3, Plane};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    InFront,
    Middle,
    Behind,
}

/// On which side vertices are.
pub(super) struct Halves<'a> {
    plane: &'a Plane,
    /// By vertex; those of other faces count as in front.
    sides: Vec<Side>,
    operation: &'static str,
}

impl<'a> Halves<'a> {
    /// All vertices are in front.
    pub(super) fn new(mesh: &EditMesh, plane: &'a Plane, operation: &'static str) -> Self {
        Self { plane, sides: vec![Side::InFront; mesh.vertex_capacity()], operation }
    }

    pub(super) fn set_side(&mut self, vertex: VertexId, side: Side) {
        self.sides[vertex.0 as usize] = side;
    }

    pub(super) fn side(&self, vertex: VertexId) -> Side {
        self.sides[vertex.0 as usize]
    }

    pub(super) fn has(&self, mesh: &EditMesh, face: FaceId, side: Side) -> bool {
        mesh.face_vertices(face).any(|vertex| self.side(vertex) == side)
    }

    pub(super) fn crosses(&self, mesh: &EditMesh, face: FaceId) -> bool {
        self.has(mesh, face, Side::InFront) && self.has(mesh, face, Side::Behind)
    }

    /// Cuts all faces along the plane. All of their pieces, each face once.
    pub(super) fn cut(&mut self, mesh: &mut EditMesh, faces: &[FaceId]) -> Result<Vec<FaceId>, Refusal> {
        let mut listed = FixedBitSet::with_capacity(mesh.face_capacity());
        let mut pieces: Vec<FaceId> = faces.to_vec();
        pieces.retain(|face| !listed.put(face.0 as usize));
        let mut edges: Vec<EdgeId> = pieces.iter().flat_map(|&face| mesh.face_edges(face)).collect();
        edges.sort_unstable();
        edges.dedup();
        for edge in edges {
            self.cut_edge(mesh, edge)?;
        }
        for index in 0..pieces.len() {
            let face = pieces[index];
            if self.crosses(mesh, face) {
                let first = pieces.len();
                self.cut_face(mesh, face, &mut pieces)?;
                if pieces[first..].iter().chain([&face]).any(|&piece| self.crosses(mesh, piece)) {
                    return self.cannot_cut();
                }
            }
        }
        Ok(pieces)
    }

    /// Puts a vertex where an edge crosses the plane.
    pub(super) fn cut_edge(&mut self, mesh: &mut EditMesh, edge: EdgeId) -> Result<(), Refusal> {
        let ends = mesh.edge_vertices(edge);
        let sides = ends.map(|vertex| self.side(vertex));
        if sides != [Side::InFront, Side::Behind] && sides != [Side::Behind, Side::InFront] {
            return Ok(());
        }
        let [a, b] = ends.map(|vertex| self.plane.signed_distance(mesh.point(vertex)));
        // The ends are on different sides: the difference is not zero, and t is within 0 and 1. It
        // is not a number where an end is not, or is at infinity.
        let t = a / (a - b);
        let split = mesh.split_edge(edge, if t.is_finite() { t } else { 0.5 })?;
        mesh.snap_to_plane(split.vertex, self.plane);
        self.sides.resize(mesh.vertex_capacity(), Side::InFront);
        self.sides[split.vertex.0 as usize] = Side::Middle;
        Ok(())
    }

    /// Cuts a face that crosses the plane between the places where its outline does, taken in pairs
    /// along the plane: between the first and the second it is inside, then outside.
    pub(super) fn cut_face(
        &self,
        mesh: &mut EditMesh,
        face: FaceId,
        pieces: &mut Vec<FaceId>,
    ) -> Result<(), Refusal> {
        let along = self.plane.normal().cross(mesh.face_normal(face));
        let mut crossings = self.crossings(mesh, face);
        let distance_along =
            |mesh: &EditMesh, corner: CornerId| along.dot(mesh.point(mesh.corner_vertex(corner)));
        crossings.sort_by(|a, b| distance_along(mesh, a[0]).total_cmp(&distance_along(mesh, b[0])));
        if !crossings.len().is_multiple_of(2) {
            return self.cannot_cut();
        }
        for pair in crossings.chunks_exact(2) {
            let (from, to) = nearest(mesh, pair[0], pair[1]);
            match mesh.split_face(from, to) {
                Ok(split) => pieces.push(split.face),
                Err(Refusal::NotPossible { .. }) => return self.cannot_cut(),
                Err(other) => return Err(other),
            }
        }
        Ok(())
    }

    fn cannot_cut<T>(&self) -> Result<T, Refusal> {
        let reason = "a face crosses the plane so that no straight cut divides it; triangulate it first";
        Err(Refusal::NotPossible { operation: self.operation, reason })
    }

    /// Where the outline of a face goes from one side to the other: the first and the last corner
    /// on the plane there.
    fn crossings(&self, mesh: &EditMesh, face: FaceId) -> SmallVec<[[CornerId; 2]; 4]> {
        let side = |corner: &CornerId| self.side(mesh.corner_vertex(*corner));
        let mut corners: SmallVec<[CornerId; 8]> = mesh.face_corners(face).collect();
        // Begins off the plane, so that no row of corners on it is cut in two.
        let start = corners.iter().position(|corner| side(corner) != Side::Middle).unwrap_or(0);
        corners.rotate_left(start);
        let mut crossings = SmallVec::new();
        let mut last = side(&corners[0]);
        let mut row: Option<[CornerId; 2]> = None;
        for corner in corners.iter().chain([&corners[0]]) {
            match side(corner) {
                Side::Middle => row = Some([row.map_or(*corner, |[first, _]| first), *corner]),
                here => {
                    crossings.extend(row.take().filter(|_| here != last));
                    last = here;
                }
            }
        }
        crossings
    }
}

/// The two corners, one of each row, that are nearest to each other.
fn nearest(mesh: &EditMesh, one: [CornerId; 2], two: [CornerId; 2]) -> (CornerId, CornerId) {
    let position = |corner: CornerId| -> DVec3 { mesh.point(mesh.corner_vertex(corner)) };
    let mut best = (one[0], two[0]);
    for a in one {
        for b in two {
            let distance = |(a, b)| position(a).distance_squared(position(b));
            if distance((a, b)) < distance(best) {
                best = (a, b);
            }
        }
    }
    best
}
