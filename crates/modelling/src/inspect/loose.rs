//! Findings about loose elements: vertices without edges, edges without faces; and the number of separate
//! parts.

use fixedbitset::FixedBitSet;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::records::POINT;

impl EditMesh {
    /// The vertices without an edge, but for those that are shown as points.
    #[must_use]
    pub fn loose_vertices(&self) -> Vec<VertexId> {
        let is_point = |vertex: VertexId| self.vertices[vertex.0].flags & POINT != 0;
        let is_loose = |vertex: &VertexId| self.vertex_edges(*vertex).next().is_none() && !is_point(*vertex);
        self.vertices().filter(is_loose).collect()
    }

    /// The edges without a face.
    #[must_use]
    pub fn loose_edges(&self) -> Vec<EdgeId> {
        self.edges().filter(|&edge| self.edge_corners(edge).next().is_none()).collect()
    }

    /// The faces of each part that is connected over vertices, in ascending order; the part
    /// with the smallest face first.
    #[must_use]
    pub fn parts(&self) -> Vec<Vec<FaceId>> {
        let mut visited_faces = FixedBitSet::with_capacity(self.face_capacity());
        let mut visited_vertices = FixedBitSet::with_capacity(self.vertex_capacity());
        let mut parts = Vec::new();
        for face in self.faces() {
            if visited_faces.put(face.0 as usize) {
                continue;
            }
            let mut part = vec![face];
            let mut next = 0;
            while let Some(&face) = part.get(next) {
                next += 1;
                for vertex in self.face_vertices(face) {
                    if !visited_vertices.put(vertex.0 as usize) {
                        part.extend(
                            self.vertex_faces(vertex).filter(|face| !visited_faces.put(face.0 as usize)),
                        );
                    }
                }
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }
}
