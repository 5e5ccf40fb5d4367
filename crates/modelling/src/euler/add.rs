//! New vertices, edges and faces.

use super::simple::is_simple;
use smallvec::SmallVec;
use trigon_math::Vec3;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Indices stay below this, so that `NONE` is none of them.
const MOST: u32 = u32::MAX - 1;

impl EditMesh {
    /// Adds a vertex; it can be reset to this place.
    ///
    /// # Errors
    /// There are as many as indices can name.
    pub fn add_vertex(&mut self, position: Vec3) -> Result<VertexId, Refusal> {
        self.check_capacity()?;
        Ok(VertexId(self.new_vertex(position)))
    }

    /// The edge between two vertices: the one that is there, or a new one.
    ///
    /// # Errors
    /// A vertex does not exist, or both are the same.
    pub fn add_edge(&mut self, a: VertexId, b: VertexId) -> Result<EdgeId, Refusal> {
        self.check_vertex(a)?;
        self.check_vertex(b)?;
        self.check_capacity()?;
        if a == b {
            let reason = "an edge joins two different vertices";
            return Err(Refusal::NotPossible { operation: "adding an edge", reason });
        }
        Ok(self.join(a, b))
    }

    /// The edge between two different vertices that exist.
    pub(crate) fn join(&mut self, a: VertexId, b: VertexId) -> EdgeId {
        if let Some(edge) = self.find_edge(a, b) {
            return edge;
        }
        let edge = self.new_edge([a.0, b.0]);
        self.link_at_vertex(edge, 0);
        self.link_at_vertex(edge, 1);
        EdgeId(edge)
    }

    /// Adds a polygon, counter-clockwise seen from outside, with the edges that it lacks. Its
    /// values are zero, its material is slot 0.
    ///
    /// # Errors
    /// A vertex does not exist, one is there twice, there are fewer than three.
    pub fn add_face(&mut self, vertices: &[VertexId]) -> Result<FaceId, Refusal> {
        for &vertex in vertices {
            self.check_vertex(vertex)?;
        }
        self.check_capacity()?;
        check_outline(vertices)?;
        Ok(self.face_of(vertices))
    }

    /// The same for an operation that fills a gap: no face is there yet.
    ///
    /// # Errors
    /// Those of [`Self::add_face`]; there is a face with the same vertices.
    pub(crate) fn add_first_face(
        &mut self,
        vertices: &[VertexId],
        operation: &'static str,
    ) -> Result<FaceId, Refusal> {
        if self.face_over(vertices, |_| false).is_some() {
            let reason = "a face with the same vertices is there already";
            return Err(Refusal::NotPossible { operation, reason });
        }
        let face = self.add_face(vertices)?;
        self.reveal_outline(face);
        Ok(face)
    }

    /// The face of an outline that has been checked.
    pub(crate) fn face_of(&mut self, vertices: &[VertexId]) -> FaceId {
        let mut outline = SmallVec::<[(VertexId, EdgeId); 8]>::with_capacity(vertices.len());
        for (i, &vertex) in vertices.iter().enumerate() {
            let next = vertices[(i + 1) % vertices.len()];
            outline.push((vertex, self.join(vertex, next)));
        }
        self.face_along(&outline)
    }

    /// The face of an outline that has been checked, whose edges are known: each vertex with the edge
    /// from it to the next.
    pub(crate) fn face_along(&mut self, outline: &[(VertexId, EdgeId)]) -> FaceId {
        let face = self.new_face();
        let mut corners = SmallVec::<[u32; 8]>::with_capacity(outline.len());
        for &(vertex, edge) in outline {
            let corner = self.new_corner(vertex.0, face);
            self.link_at_edge(corner, edge.0);
            corners.push(corner);
        }
        self.link_outline(face, &corners);
        FaceId(face)
    }

    /// Makes corners, in their order, the outline of a face.
    pub(super) fn link_outline(&mut self, face: u32, corners: &[u32]) {
        for (i, &corner) in corners.iter().enumerate() {
            let next = if i + 1 == corners.len() { 0 } else { i + 1 };
            self.link_in_face(corner, corners[next]);
        }
        let record = self.faces.write(face);
        record.corner = corners[0];
        record.size = corners.len() as u32;
    }

    /// Whether there is room for some more elements; an operation that adds many asks for each.
    pub(crate) fn check_capacity(&self) -> Result<(), Refusal> {
        /// More than any single element can take: a split edge has a corner in each of its faces,
        /// a face a corner for each of its vertices, and lists of these are limited themselves.
        const MARGIN: u32 = 1 << 20;
        let longest = self.corners.len().max(self.edges.len()).max(self.vertices.len());
        if MARGIN < MOST - longest.min(MOST) { Ok(()) } else { Err(Refusal::TooMany) }
    }

    /// The same for so many more elements of each kind, and whether memory is allowed for them.
    pub(crate) fn check_capacity_for_each(&self, more: usize) -> Result<(), Refusal> {
        self.check_capacity_for(NewElements::each(more))
    }
}

/// Whether an outline can be that of a face.
pub(crate) fn check_outline(vertices: &[VertexId]) -> Result<(), Refusal> {
    let refused = |reason| Err(Refusal::NotPossible { operation: "adding a face", reason });
    let next = vertices.iter().cycle().skip(1);
    if vertices.iter().zip(next).any(|(a, b)| a == b) {
        return refused("consecutive vertices of a face differ");
    }
    if vertices.len() < 3 {
        return refused("a face has at least three different vertices");
    }
    if is_simple(vertices) { Ok(()) } else { refused("a face visits each of its vertices once") }
}
