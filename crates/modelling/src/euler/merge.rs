//! Merges several vertices into one.

use smallvec::SmallVec;

use super::simple::is_simple;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::{Numbering, sorted_once};
use crate::refusal::Refusal;

/// What takes the place of each vertex that goes.
struct Targets {
    /// (vertex, what takes its place), by vertex.
    pairs: Vec<(VertexId, VertexId)>,
    numbering: Numbering,
}

impl Targets {
    /// What is in a vertex's place afterwards.
    #[inline]
    fn of(&self, vertex: VertexId) -> VertexId {
        self.numbering.get(vertex.0).map_or(vertex, |index| self.pairs[index].1)
    }

    fn gone(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.pairs.iter().map(|&(vertex, _)| vertex)
    }
}

impl EditMesh {
    /// Lets one vertex take the place of others, for any number of pairs (vertex, what takes its
    /// place) at once. Edges that join the same vertices then become one, with the marks of all;
    /// faces lose corners, and a face that would visit a vertex twice becomes its simple parts:
    /// none of what runs along an edge and back, one for each loop. A face that would lie on another one is
    /// removed. A pair of the same vertex twice is ignored.
    ///
    /// # Errors
    /// A vertex does not exist, or is to be replaced and to take the place of another, or is to be
    /// replaced by two different ones.
    pub fn merge_vertices(&mut self, pairs: &[(VertexId, VertexId)]) -> Result<(), Refusal> {
        let targets = self.merge_targets(pairs)?;
        let faces = sorted_once(targets.gone().flat_map(|vertex| self.vertex_faces(vertex)).collect());
        let edges = sorted_once(targets.gone().flat_map(|vertex| self.vertex_edges(vertex)).collect());
        for &edge in &edges {
            self.stand_in(edge, &targets);
        }
        for face in faces {
            self.merge_in_face(face, &targets)?;
        }
        for edge in edges {
            self.remove_edge(edge)?;
        }
        for vertex in targets.gone() {
            self.remove_vertex(vertex)?;
        }
        Ok(())
    }

    fn merge_targets(&self, pairs: &[(VertexId, VertexId)]) -> Result<Targets, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: "merging vertices", reason });
        for &(from, into) in pairs {
            self.check_vertex(from)?;
            self.check_vertex(into)?;
        }
        let pairs = sorted_once(pairs.iter().copied().filter(|(from, into)| from != into).collect());
        if pairs.windows(2).any(|two| two[0].0 == two[1].0) {
            return refused("a vertex can be merged into one other only");
        }
        let gone: Vec<u32> = pairs.iter().map(|(from, _)| from.0).collect();
        let numbering = Numbering::new(&gone, self.vertex_capacity());
        if pairs.iter().any(|(_, into)| numbering.get(into.0).is_some()) {
            return refused("the vertex that others are merged into cannot be merged itself");
        }
        Ok(Targets { pairs, numbering })
    }

    /// Makes the edge that takes the place of one at a merged vertex, if any does.
    fn stand_in(&mut self, edge: EdgeId, targets: &Targets) {
        let [a, b] = self.edge_vertices(edge).map(|vertex| targets.of(vertex));
        if a == b {
            return;
        }
        let is_known = self.find_edge(a, b).is_some();
        let new = self.join(a, b);
        if is_known { self.unite_edge_marks(edge, new) } else { self.copy_edge(edge, new) }
    }

    fn merge_in_face(&mut self, face: FaceId, targets: &Targets) -> Result<(), Refusal> {
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
            let vertex = targets.of(self.corner_vertex(corner));
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
        if vertices.len() < 3 {
            return self.remove_face(face);
        }
        for corner in dropped {
            self.drop_corner(corner);
        }
        self.faces.write(face.0).corner = outline[0].0.0;
        if is_simple(&vertices) {
            self.relink_face(face, &vertices)?;
            return self.remove_if_doubled(face);
        }
        let corners: SmallVec<[CornerId; 8]> = outline.iter().map(|&(corner, _)| corner).collect();
        let parts = self.lay_simple_parts(face, &corners, &vertices);
        parts.into_iter().try_for_each(|part| self.remove_if_doubled(part))
    }

    /// Removes a face that lies on another one. Of faces that become such, the last one goes.
    fn remove_if_doubled(&mut self, face: FaceId) -> Result<(), Refusal> {
        let vertices: SmallVec<[VertexId; 8]> = self.face_vertices(face).collect();
        if self.face_over(&vertices, |other| other == face).is_some() {
            self.remove_face(face)
        } else {
            Ok(())
        }
    }
}
