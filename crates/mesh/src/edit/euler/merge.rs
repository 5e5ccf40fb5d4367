//! Several vertices become one.

use std::collections::BTreeMap;

use smallvec::SmallVec;

use super::super::edit_mesh::EditMesh;
use super::super::ids::{CornerId, EdgeId, FaceId, VertexId};
use super::super::refusal::Refusal;
use super::add::check_outline;

impl EditMesh {
    /// Lets one vertex take the place of others, for any number of pairs (vertex, what takes its
    /// place) at once. Edges that join the same vertices then become one, with the marks of all;
    /// faces lose corners, and a face that is left with fewer than three different vertices is
    /// removed. A pair of the same vertex twice is ignored.
    ///
    /// # Errors
    /// A vertex does not exist, or is to be replaced and to take the place of another, or is to be
    /// replaced by two different ones.
    pub fn merge_vertices(&mut self, pairs: &[(VertexId, VertexId)]) -> Result<(), Refusal> {
        let targets = self.merge_targets(pairs)?;
        let mut faces: Vec<FaceId> = targets.keys().flat_map(|&vertex| self.vertex_faces(vertex)).collect();
        faces.sort_unstable();
        faces.dedup();
        let mut edges: Vec<EdgeId> = targets.keys().flat_map(|&vertex| self.vertex_edges(vertex)).collect();
        edges.sort_unstable();
        edges.dedup();
        for &edge in &edges {
            self.stand_in(edge, &targets);
        }
        for face in faces {
            self.merge_in_face(face, &targets)?;
        }
        for edge in edges {
            self.remove_edge(edge)?;
        }
        for &vertex in targets.keys() {
            self.remove_vertex(vertex)?;
        }
        Ok(())
    }

    fn merge_targets(&self, pairs: &[(VertexId, VertexId)]) -> Result<BTreeMap<VertexId, VertexId>, Refusal> {
        let mut targets = BTreeMap::new();
        for &(from, into) in pairs {
            self.check_vertex(from)?;
            self.check_vertex(into)?;
            if from != into && targets.insert(from, into).is_some_and(|other| other != into) {
                let reason = "a vertex can be merged into one other only";
                return Err(Refusal::NotPossible { operation: "merging vertices", reason });
            }
        }
        if targets.values().any(|into| targets.contains_key(into)) {
            let reason = "what takes a place has to stay itself";
            return Err(Refusal::NotPossible { operation: "merging vertices", reason });
        }
        Ok(targets)
    }

    /// Makes the edge that takes the place of one at a merged vertex, if any does.
    fn stand_in(&mut self, edge: EdgeId, targets: &BTreeMap<VertexId, VertexId>) {
        let [a, b] = self.edge_vertices(edge).map(|vertex| targets.get(&vertex).copied().unwrap_or(vertex));
        if a == b {
            return;
        }
        let is_known = self.find_edge(a, b).is_some();
        let new = self.join(a, b);
        if is_known { self.unite_edge_marks(edge, new) } else { self.copy_edge(edge, new) }
    }

    fn merge_in_face(&mut self, face: FaceId, targets: &BTreeMap<VertexId, VertexId>) -> Result<(), Refusal> {
        let target = |vertex: VertexId| targets.get(&vertex).copied().unwrap_or(vertex);
        let corners: SmallVec<[CornerId; 8]> = self.face_corners(face).collect();
        // Of consecutive corners at what becomes one vertex, one stays: that which was there
        // already, else the first.
        let mut outline = SmallVec::<[(CornerId, VertexId); 8]>::new();
        let mut dropped = SmallVec::<[CornerId; 8]>::new();
        let mut keep = |outline: &mut SmallVec<[(CornerId, VertexId); 8]>, slot: usize, corner| {
            let (other, vertex) = outline[slot];
            let replaces = self.corner_vertex(corner) == vertex && self.corner_vertex(other) != vertex;
            dropped.push(if replaces { other } else { corner });
            if replaces {
                outline[slot].0 = corner;
            }
        };
        for &corner in &corners {
            let vertex = target(self.corner_vertex(corner));
            match outline.last() {
                Some(&(_, last)) if last == vertex => {
                    let slot = outline.len() - 1;
                    keep(&mut outline, slot, corner);
                }
                _ => outline.push((corner, vertex)),
            }
        }
        if outline.len() > 1 && outline[0].1 == outline[outline.len() - 1].1 {
            let (corner, _) = outline.pop().expect("it has two");
            keep(&mut outline, 0, corner);
        }
        let vertices: SmallVec<[VertexId; 8]> = outline.iter().map(|&(_, vertex)| vertex).collect();
        if vertices.len() < 3 || check_outline(&vertices).is_err() {
            return self.remove_face(face);
        }
        for corner in dropped {
            self.drop_corner(corner);
        }
        self.faces.write(face.0).corner = outline[0].0.0;
        self.relink_face(face, &vertices)
    }
}
