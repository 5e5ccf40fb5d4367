//! Connecting vertices by cuts through faces (a modeller's J).

mod inside;
mod path;
#[cfg(test)]
mod tests;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::{Numbering, sorted_once};
use crate::refusal::Refusal;

/// What joins vertices.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Connected {
    /// The new edges, and existing ones of a path.
    pub edges: Vec<EdgeId>,
    /// New vertices where a path crosses edges.
    pub vertices: Vec<VertexId>,
    /// The new faces: one part of each face that was cut, the other keeps its id.
    pub faces: Vec<FaceId>,
}

const CONNECTING: &str = "connecting vertices";

impl EditMesh {
    /// Connects vertices by cuts through their faces.
    ///
    /// In each face that has several of them, each is connected to the next one around the face, unless an
    /// edge does so already or the cut would leave the face (in a concave one). If there are exactly two
    /// vertices without a common face, a path is cut from one to the other, straight in the plane through
    /// both and the mean of their normals. The path may cross several faces, and adds vertices on the edges
    /// that it crosses. Within a millionth of an edge from its end, it goes through the vertex there.
    ///
    /// Values are kept at corners and interpolated at new vertices.
    ///
    /// # Errors
    /// No vertex is given, one does not exist, no two of them can be connected, or a path runs into
    /// a border.
    pub fn connect_vertices(&mut self, vertices: &[VertexId]) -> Result<Connected, Refusal> {
        require(vertices, CONNECTING, "at least two vertices")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let vertices = sorted_once(vertices.to_vec());
        let faces: Vec<FaceId> = sorted_once(vertices.iter().flat_map(|&v| self.vertex_faces(v)).collect());
        let indices: Vec<u32> = vertices.iter().map(|vertex| vertex.0).collect();
        let numbering = Numbering::new(&indices, self.vertex_capacity());
        let is_given = |vertex: VertexId| numbering.get(vertex.0).is_some();
        let connected = self.whole(|mesh| {
            let mut connected = Connected::default();
            let mut is_shared = false;
            for face in faces {
                let corners = mesh.face_corners(face);
                let given: Vec<CornerId> =
                    corners.filter(|&corner| is_given(mesh.corner_vertex(corner))).collect();
                is_shared |= given.iter().any(|&c| mesh.corner_vertex(c) != mesh.corner_vertex(given[0]));
                mesh.connect_in_face(&given, &mut connected)?;
            }
            if let ([from, to], false) = (&vertices[..], is_shared) {
                mesh.connect_by_path(*from, *to, &mut connected)?;
            }
            Ok(connected)
        })?;
        if connected.edges.is_empty() {
            let reason = "they are joined already, or no two have a face in which a cut can run";
            return Err(Refusal::NotPossible { operation: CONNECTING, reason });
        }
        Ok(connected)
    }

    /// Joins corners of a face, in their order, each to the next.
    fn connect_in_face(&mut self, given: &[CornerId], connected: &mut Connected) -> Result<(), Refusal> {
        let count = given.len();
        let pairs = if count == 2 { 1 } else { count };
        // After a cut the rest of the face has a new corner in place of the first one.
        let mut first = given.first().copied();
        for i in 0..if count < 2 { 0 } else { pairs } {
            let from = given[i];
            let to = if i + 1 == count { first.expect("there are two") } else { given[i + 1] };
            if self.is_joined_to(from, to) || !self.is_cut_inside(from, to) {
                continue;
            }
            // The part between both keeps the id; the rest is the new face.
            let Ok(split) = self.split_face(from, to) else { continue };
            if i == 0 {
                first = Some(self.previous_corner(to));
            }
            connected.edges.push(split.edge);
            connected.faces.push(split.face);
        }
        Ok(())
    }

    /// Whether an edge joins the vertices of two corners.
    fn is_joined_to(&self, from: CornerId, to: CornerId) -> bool {
        self.find_edge(self.corner_vertex(from), self.corner_vertex(to)).is_some()
    }
}
