//! Navigation from an element to its neighbours.

use trigon_math::{DVec3, unit_or_zero};

use super::edit_mesh::EditMesh;
use super::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};

/// A walk around a ring, once.
#[derive(Clone)]
struct Ring<F> {
    first: u32,
    /// `NONE` at the end.
    here: u32,
    follow: F,
}

impl<F: Fn(u32) -> u32> Iterator for Ring<F> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let here = self.here;
        if here == NONE {
            return None;
        }
        let next = (self.follow)(here);
        self.here = if next == self.first { NONE } else { next };
        Some(here)
    }
}

fn ring<F: Fn(u32) -> u32>(first: u32, follow: F) -> Ring<F> {
    Ring { first, here: first, follow }
}

impl EditMesh {
    /// The edges at a vertex.
    #[inline]
    pub fn vertex_edges(&self, vertex: VertexId) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        let first = self.vertices[vertex.0].edge;
        let next = move |edge: u32| {
            let record = &self.edges[edge];
            record.next[record.end(vertex.0)]
        };
        ring(first, next).map(EdgeId)
    }

    /// The corners at a vertex, by edge: a face that visits the vertex twice shows two.
    pub fn vertex_corners(&self, vertex: VertexId) -> impl Iterator<Item = CornerId> + Clone + '_ {
        let edges = self.vertex_edges(vertex);
        let corners = edges.flat_map(move |edge| self.edge_corners(edge));
        corners.filter(move |corner| self.corners[corner.0].vertex == vertex.0)
    }

    /// The faces at a vertex: each once for each of its corners there.
    pub fn vertex_faces(&self, vertex: VertexId) -> impl Iterator<Item = FaceId> + Clone + '_ {
        self.vertex_corners(vertex).map(|corner| self.corner_face(corner))
    }

    /// The vertices that are joined to a vertex by edges.
    pub fn vertex_neighbors(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.vertex_edges(vertex).map(move |edge| self.other_vertex(edge, vertex))
    }

    /// The two different vertices of an edge.
    #[inline]
    pub fn edge_vertices(&self, edge: EdgeId) -> [VertexId; 2] {
        self.edges[edge.0].vertices.map(VertexId)
    }

    /// The vertex at the other end of an edge.
    ///
    /// # Panics
    /// May panic when the vertex is not one of its ends.
    #[inline]
    #[must_use]
    pub fn other_vertex(&self, edge: EdgeId, vertex: VertexId) -> VertexId {
        VertexId(self.edges[edge.0].other(vertex.0))
    }

    /// The corners that leave along an edge, one for each side of a face there.
    #[inline]
    pub fn edge_corners(&self, edge: EdgeId) -> impl Iterator<Item = CornerId> + Clone + '_ {
        ring(self.edges[edge.0].corner, |corner| self.corners[corner].radial_next).map(CornerId)
    }

    /// The faces at an edge: each once for each of its sides there.
    #[inline]
    pub fn edge_faces(&self, edge: EdgeId) -> impl Iterator<Item = FaceId> + Clone + '_ {
        self.edge_corners(edge).map(|corner| self.corner_face(corner))
    }

    /// Whether exactly one side of a face is at an edge.
    #[must_use]
    pub fn is_boundary(&self, edge: EdgeId) -> bool {
        self.edge_corners(edge).take(2).count() == 1
    }

    /// The two corners of an edge that is where exactly two sides of faces meet.
    #[must_use]
    pub fn edge_pair(&self, edge: EdgeId) -> Option<[CornerId; 2]> {
        let mut corners = self.edge_corners(edge);
        let pair = [corners.next()?, corners.next()?];
        corners.next().is_none().then_some(pair)
    }

    /// The edge at a vertex that is closest to a direction, as a vertex slides along it; the first one if there are several.
    /// Edges without length are the last.
    #[must_use]
    pub fn edge_towards(&self, vertex: VertexId, direction: DVec3) -> Option<EdgeId> {
        let here = self.point(vertex);
        let alike = |edge: EdgeId| match unit_or_zero(self.point(self.other_vertex(edge, vertex)) - here) {
            DVec3::ZERO => f64::NEG_INFINITY,
            way => way.dot(direction),
        };
        let edges = self.vertex_edges(vertex).map(|edge| (alike(edge), edge));
        let best = edges.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, edge)| edge)
    }

    /// The edge that joins two vertices, in time proportional to the number of edges of that
    /// with fewer.
    #[must_use]
    pub fn find_edge(&self, a: VertexId, b: VertexId) -> Option<EdgeId> {
        if a == b {
            return None;
        }
        let mut at_a = self.vertex_edges(a);
        let mut at_b = self.vertex_edges(b);
        // One step at each, so that a hub with a hundred thousand spokes costs nothing.
        while let (Some(from_a), Some(from_b)) = (at_a.next(), at_b.next()) {
            if self.other_vertex(from_a, a) == b {
                return Some(from_a);
            }
            if self.other_vertex(from_b, b) == a {
                return Some(from_b);
            }
        }
        None
    }

    /// How many corners a face has, at least 3.
    #[must_use]
    pub fn face_size(&self, face: FaceId) -> usize {
        self.faces[face.0].size as usize
    }

    /// The corners of a face from its first on, counter-clockwise seen from outside.
    #[inline]
    pub fn face_corners(&self, face: FaceId) -> impl Iterator<Item = CornerId> + Clone + '_ {
        ring(self.faces[face.0].corner, |corner| self.corners[corner].next).map(CornerId)
    }

    /// The vertices of a face, in the order of its corners.
    #[inline]
    pub fn face_vertices(&self, face: FaceId) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.face_corners(face).map(|corner| self.corner_vertex(corner))
    }

    /// The edges of a face, in the order of the corners that leave along them.
    #[inline]
    pub fn face_edges(&self, face: FaceId) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        self.face_corners(face).map(|corner| self.corner_edge(corner))
    }

    /// The corner of a face at a vertex; the first of several.
    #[must_use]
    pub fn face_corner_at(&self, face: FaceId, vertex: VertexId) -> Option<CornerId> {
        self.face_corners(face).find(|&corner| self.corner_vertex(corner) == vertex)
    }

    /// The vertex of a corner.
    #[inline]
    #[must_use]
    pub fn corner_vertex(&self, corner: CornerId) -> VertexId {
        VertexId(self.corners[corner.0].vertex)
    }

    /// The edge from a corner's vertex to that of the next corner of its face.
    #[inline]
    #[must_use]
    pub fn corner_edge(&self, corner: CornerId) -> EdgeId {
        EdgeId(self.corners[corner.0].edge)
    }

    /// The face of a corner.
    #[inline]
    #[must_use]
    pub fn corner_face(&self, corner: CornerId) -> FaceId {
        FaceId(self.corners[corner.0].face)
    }

    /// The corner after a corner in its face.
    #[inline]
    #[must_use]
    pub fn next_corner(&self, corner: CornerId) -> CornerId {
        CornerId(self.corners[corner.0].next)
    }

    /// The corner before a corner in its face.
    #[inline]
    #[must_use]
    pub fn previous_corner(&self, corner: CornerId) -> CornerId {
        CornerId(self.corners[corner.0].previous)
    }

    /// The next corner that leaves along the same edge; the corner itself at a boundary.
    #[inline]
    #[must_use]
    pub fn radial_next(&self, corner: CornerId) -> CornerId {
        CornerId(self.corners[corner.0].radial_next)
    }
}
