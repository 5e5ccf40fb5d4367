//! Merging faces: each group of them becomes the polygon around it.

use smallvec::SmallVec;

use super::super::tables::IndexTable;
use crate::edit_mesh::EditMesh;
use crate::euler::is_simple;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;

/// Disjoint groups of faces; each is connected.
pub(super) struct FaceGroups {
    /// In ascending order.
    pub(super) groups: Vec<Vec<FaceId>>,
    /// From faces to the index of their group.
    pub(super) numbers: IndexTable,
}

impl EditMesh {
    /// The corners at an edge across which two faces can be united: exactly two different ones are there,
    /// and run along it in opposite directions.
    pub(super) fn merging_pair(&self, edge: EdgeId) -> Option<[CornerId; 2]> {
        let [a, b] = self.edge_pair(edge)?;
        let is_alike = self.corner_vertex(a) != self.corner_vertex(b);
        (is_alike && self.corner_face(a) != self.corner_face(b)).then_some([a, b])
    }

    /// Unites faces across some of the edges: those that have a [`Self::merging_pair`]. Other edges between two faces
    /// of one group go, too: the united face would run along them and back. Returns the united faces.
    pub(super) fn merge_across(&mut self, edges: &[EdgeId]) -> Result<Vec<FaceId>, Refusal> {
        let groups = FaceGroups::across(self, edges);
        let unite =
            |number| groups.outline(self, number).map(|outline| self.unite(&groups, number, &outline));
        (0..groups.groups.len()).map(unite).collect()
    }

    /// Makes one face of a group. It keeps the first one's id.
    pub(super) fn unite(&mut self, groups: &FaceGroups, number: usize, outline: &[CornerId]) -> FaceId {
        let faces = &groups.groups[number];
        let retained = faces[0];
        let corners = faces.iter().flat_map(|&face| self.face_corners(face));
        let inside: Vec<CornerId> =
            corners.filter(|&corner| groups.is_inside(self, number, corner)).collect();
        let edges: Vec<EdgeId> = sorted_once(inside.iter().map(|&corner| self.corner_edge(corner)).collect());
        for corner in inside {
            self.unlink_at_edge(corner.0);
            self.free_corner(corner.0);
        }
        for &face in &faces[1..] {
            self.free_face(face.0);
        }
        for (i, &corner) in outline.iter().enumerate() {
            self.corners.write(corner.0).face = retained.0;
            self.link_in_face(corner.0, outline[(i + 1) % outline.len()].0);
        }
        let record = self.faces.write(retained.0);
        record.corner = outline[0].0;
        record.size = outline.len() as u32;
        self.remove_loose(&edges);
        self.reveal_outline(retained);
        retained
    }
}

impl FaceGroups {
    /// The faces that some edges connect.
    fn across(mesh: &EditMesh, edges: &[EdgeId]) -> Self {
        let pairs: Vec<[FaceId; 2]> = edges
            .iter()
            .filter_map(|&edge| mesh.merging_pair(edge))
            .map(|pair| pair.map(|corner| mesh.corner_face(corner)))
            .collect();
        let faces = sorted_once(pairs.iter().flatten().copied().collect());
        let mut neighbors: Vec<[FaceId; 2]> = pairs.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
        neighbors.sort_unstable();
        let mut numbers = IndexTable::new(mesh.face_capacity(), faces.len());
        let mut groups: Vec<Vec<FaceId>> = Vec::new();
        for seed in faces {
            if numbers.get(seed.0).is_some() {
                continue;
            }
            let number = groups.len() as u32;
            numbers.insert(seed.0, number);
            let mut group = vec![seed];
            let mut next = 0;
            while next < group.len() {
                let here = group[next];
                let start = neighbors.partition_point(|pair| pair[0] < here);
                for &[_, there] in neighbors[start..].iter().take_while(|pair| pair[0] == here) {
                    if numbers.get(there.0).is_none() {
                        numbers.insert(there.0, number);
                        group.push(there);
                    }
                }
                next += 1;
            }
            group.sort_unstable();
            groups.push(group);
        }
        Self { groups, numbers }
    }

    fn has(&self, number: usize, face: FaceId) -> bool {
        self.numbers.get(face.0) == Some(number as u32)
    }

    /// Whether the edge along which a corner of a group leaves is between two of its faces, so that it goes.
    fn is_inside(&self, mesh: &EditMesh, number: usize, corner: CornerId) -> bool {
        let edge = mesh.corner_edge(corner);
        let is_of_group = |corner: CornerId| self.has(number, mesh.corner_face(corner));
        mesh.merging_pair(edge).is_some_and(|pair| pair.into_iter().all(is_of_group))
    }

    /// The corners on the outline of a group, in its order.
    ///
    /// # Errors
    /// The group cannot be one face.
    pub(super) fn outline(&self, mesh: &EditMesh, number: usize) -> Result<Vec<CornerId>, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: "dissolving", reason });
        let is_inside = |corner: CornerId| self.is_inside(mesh, number, corner);
        let corners = self.groups[number].iter().flat_map(|&face| mesh.face_corners(face));
        let mut border = corners.filter(|&corner| !is_inside(corner));
        let Some(first) = border.next() else {
            return refused("the faces are closed: nothing would be left of them");
        };
        let count = 1 + border.count();
        let mut outline = vec![first];
        loop {
            let mut corner = mesh.next_corner(outline[outline.len() - 1]);
            // Across an edge that goes, the outline continues in the other face.
            while is_inside(corner) {
                corner = mesh.next_corner(mesh.radial_next(corner));
            }
            if corner == first {
                break;
            }
            outline.push(corner);
        }
        let vertices: SmallVec<[VertexId; 16]> =
            outline.iter().map(|&corner| mesh.corner_vertex(corner)).collect();
        if outline.len() != count {
            return refused("the faces have a hole: leave two edges between it and the outline");
        }
        if outline.len() < 3 {
            return refused("the merged face would have fewer than three vertices");
        }
        if !is_simple(&vertices) {
            return refused("the merged face would visit a vertex twice: leave an edge there");
        }
        if mesh.face_over(&vertices, |face| self.has(number, face)).is_some() {
            return refused("the merged face would lie on another one: leave an edge");
        }
        Ok(outline)
    }
}
