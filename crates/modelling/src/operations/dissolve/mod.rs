//! Dissolving: elements are removed, and the surface that they divided stays as larger faces.

mod discs;
mod limited;
mod merge;
#[cfg(test)]
mod tests;

use super::delete::require;
use super::region::Region;
use super::tables::IndexSet;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

pub use limited::LimitedDissolve;

/// The result of dissolving.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Dissolved {
    /// The merged faces, in ascending order: each has the lowest id of its parts.
    pub faces: Vec<FaceId>,
    /// The number of removed vertices.
    pub removed_vertices: usize,
    /// The number of given edges that stay because they are not between exactly two faces with the same winding.
    pub left_edges: usize,
}

impl EditMesh {
    /// Merges faces that are joined by edges into one polygon for each connected part. It keeps the id,
    /// material and marks of the face with the lowest id, and every corner on its outline its values.
    /// Vertices inside are removed.
    ///
    /// Faces are joined where exactly two meet at an edge with the same winding.
    ///
    /// # Errors
    /// No face is given, or one does not exist; no two of them are joined; a part has a hole, is closed or has
    /// fewer than three vertices on its outline.
    pub fn dissolve_faces(&mut self, faces: &[FaceId]) -> Result<Dissolved, Refusal> {
        let region = Region::new(self, faces, "dissolving faces")?;
        let mut edges = Vec::new();
        for &face in &region.faces {
            edges.extend(self.face_edges(face));
        }
        let is_inside = |mesh: &Self, edge: EdgeId| mesh.edge_faces(edge).all(|face| region.contains(face));
        edges.retain(|&edge| is_inside(self, edge));
        let vertices = self.vertex_count();
        self.whole(|mesh| {
            let faces = mesh.merge_across(&edges)?;
            if faces.is_empty() {
                let reason = "no two of the faces share an edge and have the same winding";
                return Err(Refusal::NotPossible { operation: "dissolving faces", reason });
            }
            Ok(Dissolved { faces, removed_vertices: vertices - mesh.vertex_count(), left_edges: 0 })
        })
    }

    /// Removes edges between two faces, which become one; vertices that are left between two edges are also
    /// removed, if they had more before. Edges that are not between exactly two faces with the same winding stay.
    ///
    /// # Errors
    /// No edge is given, or one does not exist, or all of them stay; a merged face would have a hole, be closed or
    /// have fewer than three vertices.
    pub fn dissolve_edges(&mut self, edges: &[EdgeId]) -> Result<Dissolved, Refusal> {
        require(edges, "dissolving edges", "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        let given = edges.len();
        let edges: Vec<EdgeId> =
            edges.iter().copied().filter(|&edge| self.merging_pair(edge).is_some()).collect();
        if edges.is_empty() {
            let reason = "no edge is between exactly two faces with the same winding";
            return Err(Refusal::NotPossible { operation: "dissolving edges", reason });
        }
        let left_edges = given - edges.len();
        let mut ends: Vec<VertexId> = edges.iter().flat_map(|&edge| self.edge_vertices(edge)).collect();
        ends.sort_unstable();
        ends.dedup();
        ends.retain(|&vertex| self.vertex_edges(vertex).nth(2).is_some());
        let vertices = self.vertex_count();
        self.whole(|mesh| {
            let faces = mesh.merge_across(&edges)?;
            for vertex in ends {
                if mesh.has_vertex(vertex) {
                    // One that a face needs stays.
                    mesh.join_edges(vertex).ok();
                }
            }
            Ok(Dissolved { faces, removed_vertices: vertices - mesh.vertex_count(), left_edges })
        })
    }

    /// Removes vertices: the faces at each become one, and two edges at it become one. A vertex without faces
    /// goes with its edges unless it has exactly two.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist, or the faces at one cannot be merged: more than two meet at
    /// an edge, their windings are opposite, or the result would have a hole, be closed or have fewer than
    /// three vertices.
    pub fn dissolve_vertices(&mut self, vertices: &[VertexId]) -> Result<Dissolved, Refusal> {
        require(vertices, "dissolving vertices", "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let mut listed = IndexSet::new(self.vertex_capacity(), vertices.len());
        let given: Vec<VertexId> =
            vertices.iter().copied().filter(|vertex| listed.insert(vertex.0)).collect();
        let mut edges: Vec<EdgeId> = Vec::new();
        // Between two edges there is nothing to unite.
        for &vertex in given.iter().filter(|&&vertex| self.vertex_edges(vertex).nth(2).is_some()) {
            edges.extend(self.vertex_edges(vertex).filter(|&edge| self.merging_pair(edge).is_some()));
        }
        let before = self.vertex_count();
        self.whole(|mesh| {
            let mut faces = mesh.merge_across(&edges)?;
            for &vertex in given.iter().filter(|&&vertex| listed.contains(vertex.0)) {
                if mesh.has_vertex(vertex) {
                    mesh.dissolve_left_over(vertex)?;
                }
            }
            faces.retain(|&face| mesh.has_face(face));
            Ok(Dissolved { faces, removed_vertices: before - mesh.vertex_count(), left_edges: 0 })
        })
    }

    /// A vertex whose faces were united, and that is still there.
    fn dissolve_left_over(&mut self, vertex: VertexId) -> Result<(), Refusal> {
        if self.vertex_edges(vertex).count() == 2 {
            return self.join_edges(vertex).map(drop);
        }
        if self.vertex_faces(vertex).next().is_some() {
            let reason = "the faces at a vertex cannot be merged into one";
            return Err(Refusal::NotPossible { operation: "dissolving vertices", reason });
        }
        self.remove_vertex(vertex)
    }
}
