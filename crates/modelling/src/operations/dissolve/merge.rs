//! Merging faces across edges: each connected part becomes the polygon around it.

use super::super::tables::{IndexSet, IndexTable};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId};
use crate::refusal::Refusal;

/// What becomes of a part that cannot be one polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OnRefusal {
    /// Nothing is done at all.
    Refuse,
    /// It stays as it is.
    Skip,
}

/// A connected part of the faces.
struct Part {
    faces: Vec<FaceId>,
    /// The corners on its outline, in its order.
    outline: Vec<CornerId>,
}

/// Across which edges faces are united, and how the parts are numbered.
struct Merging {
    edges: IndexSet,
    /// From faces to their numbers in `faces`.
    indices: IndexTable,
    /// All faces at the edges, in ascending order.
    faces: Vec<FaceId>,
}

impl EditMesh {
    /// The corners at an edge across which two faces can be united: exactly two different ones are there,
    /// and run along it in opposite directions.
    pub(super) fn merging_pair(&self, edge: EdgeId) -> Option<[CornerId; 2]> {
        let [a, b] = self.edge_pair(edge)?;
        let is_alike = self.corner_vertex(a) != self.corner_vertex(b);
        (is_alike && self.corner_face(a) != self.corner_face(b)).then_some([a, b])
    }

    /// Unites faces across some of the edges: those that have a [`Self::merging_pair`]. Edges between faces
    /// that are united, but not given, become such that the face runs along and back. Returns the
    /// united faces.
    pub(super) fn merge_across(
        &mut self,
        edges: &[EdgeId],
        on_refusal: OnRefusal,
    ) -> Result<Vec<FaceId>, Refusal> {
        let merging = Merging::new(self, edges);
        let mut united = Vec::new();
        for part in merging.parts(self) {
            match merging.outline(self, part) {
                Ok(part) => united.push(self.unite(&merging, &part)),
                Err(refusal) if on_refusal == OnRefusal::Refuse => return Err(refusal),
                Err(_) => {}
            }
        }
        Ok(united)
    }

    /// Makes one face of a part.
    fn unite(&mut self, merging: &Merging, part: &Part) -> FaceId {
        let retained = part.faces[0];
        let mut inside: Vec<CornerId> = Vec::new();
        for &face in &part.faces {
            inside
                .extend(self.face_corners(face).filter(|&corner| merging.has_edge(self.corner_edge(corner))));
        }
        let mut edges: Vec<EdgeId> = inside.iter().map(|&corner| self.corner_edge(corner)).collect();
        edges.sort_unstable();
        edges.dedup();
        for corner in inside {
            self.unlink_at_edge(corner.0);
            self.free_corner(corner.0);
        }
        for &face in &part.faces[1..] {
            self.free_face(face.0);
        }
        for (i, &corner) in part.outline.iter().enumerate() {
            self.corners.write(corner.0).face = retained.0;
            self.link_in_face(corner.0, part.outline[(i + 1) % part.outline.len()].0);
        }
        let record = self.faces.write(retained.0);
        record.corner = part.outline[0].0;
        record.size = part.outline.len() as u32;
        self.remove_loose(&edges);
        retained
    }
}

impl Merging {
    fn new(mesh: &EditMesh, edges: &[EdgeId]) -> Self {
        let mut set = IndexSet::new(mesh.edge_capacity(), edges.len());
        let mut faces = Vec::new();
        for &edge in edges {
            if let Some(pair) = mesh.merging_pair(edge)
                && set.insert(edge.0)
            {
                faces.extend(pair.map(|corner| mesh.corner_face(corner)));
            }
        }
        faces.sort_unstable();
        faces.dedup();
        let mut indices = IndexTable::new(mesh.face_capacity(), faces.len());
        for (index, face) in (0..).zip(&faces) {
            indices.insert(face.0, index);
        }
        Self { edges: set, indices, faces }
    }

    fn has_edge(&self, edge: EdgeId) -> bool {
        self.edges.contains(edge.0)
    }

    /// The connected parts, each in ascending order.
    fn parts(&self, mesh: &EditMesh) -> Vec<Vec<FaceId>> {
        let mut is_visited = vec![false; self.faces.len()];
        let mut parts = Vec::new();
        for seed in 0..self.faces.len() {
            if std::mem::replace(&mut is_visited[seed], true) {
                continue;
            }
            let mut part = vec![self.faces[seed]];
            let mut next = 0;
            while next < part.len() {
                for corner in mesh.face_corners(part[next]) {
                    if !self.has_edge(mesh.corner_edge(corner)) {
                        continue;
                    }
                    let face = mesh.corner_face(mesh.radial_next(corner));
                    let index = self.indices.get(face.0).expect("faces at the edges are listed") as usize;
                    if !std::mem::replace(&mut is_visited[index], true) {
                        part.push(face);
                    }
                }
                next += 1;
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }

    /// Walks around a part.
    fn outline(&self, mesh: &EditMesh, faces: Vec<FaceId>) -> Result<Part, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: "dissolving", reason });
        let corners = faces.iter().flat_map(|&face| mesh.face_corners(face));
        let mut border = corners.filter(|&corner| !self.has_edge(mesh.corner_edge(corner)));
        let Some(first) = border.next() else {
            return refused("the faces are closed: nothing would be left of them");
        };
        let count = 1 + border.count();
        let mut outline = vec![first];
        loop {
            let mut corner = mesh.next_corner(outline[outline.len() - 1]);
            // Across an edge that goes, the outline continues in the other face.
            while self.has_edge(mesh.corner_edge(corner)) {
                corner = mesh.next_corner(mesh.radial_next(corner));
            }
            if corner == first {
                break;
            }
            outline.push(corner);
        }
        if outline.len() != count {
            return refused("the faces have a hole: leave an edge from it to the outline");
        }
        let mut vertices: Vec<_> = outline.iter().map(|&corner| mesh.corner_vertex(corner)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        if vertices.len() < 3 {
            return refused("the merged face would have fewer than three vertices");
        }
        Ok(Part { faces, outline })
    }
}
