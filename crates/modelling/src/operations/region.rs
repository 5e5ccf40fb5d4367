//! A region of faces: its neighbourhood, and how its border separates from the outside.
//!
//! Extruding, insetting and splitting have this in common. The region keeps its vertices and edges, so that
//! the selection stays selected. The outside gets new ones along the border (the base), and walls connect
//! both. Few elements are written this way, and none inside the region.

use smallvec::SmallVec;

use super::delete::require;
use super::tables::{IndexSet, IndexTable};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use crate::refusal::Refusal;

/// Some faces of a mesh, each once, by index.
pub(super) struct Region {
    pub(super) faces: Vec<FaceId>,
    set: IndexSet,
}

/// An edge where a region ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct BorderEdge {
    pub(super) edge: EdgeId,
    /// The first side of a face of the region along it.
    pub(super) inner: CornerId,
    /// The first side of a face outside; `None` at an open border.
    pub(super) outer: Option<CornerId>,
}

/// A vertex of a region's border, and the new one that what is outside has in its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplitVertex {
    pub(super) cap: VertexId,
    pub(super) base: VertexId,
}

/// The vertices that are parted.
pub(super) struct SplitVertices {
    pub(super) list: Vec<SplitVertex>,
    /// From the vertex to its place in the list.
    table: IndexTable,
}

impl Region {
    /// # Errors
    /// No face is given, or one does not exist.
    pub(super) fn new(mesh: &EditMesh, faces: &[FaceId], operation: &'static str) -> Result<Self, Refusal> {
        require(faces, operation, "at least one face")?;
        faces.iter().try_for_each(|&face| mesh.check_face(face))?;
        let mut faces = faces.to_vec();
        if !faces.is_sorted_by(|a, b| a < b) {
            faces.sort_unstable();
            faces.dedup();
        }
        let set = IndexSet::from_faces(mesh, &faces);
        Ok(Self { faces, set })
    }

    #[inline]
    pub(super) fn contains(&self, face: FaceId) -> bool {
        self.set.contains(face.0)
    }

    #[inline]
    pub(super) fn has_corner(&self, mesh: &EditMesh, corner: CornerId) -> bool {
        self.contains(mesh.corner_face(corner))
    }

    /// How many corners its faces have.
    pub(super) fn corner_count(&self, mesh: &EditMesh) -> usize {
        self.faces.iter().map(|&face| mesh.face_size(face)).sum()
    }

    /// Its vertices, each once, in the order of its faces.
    pub(super) fn vertices(&self, mesh: &EditMesh) -> Vec<VertexId> {
        let mut listed = IndexSet::new(mesh.vertex_capacity(), self.corner_count(mesh));
        let mut vertices = Vec::new();
        for &face in &self.faces {
            vertices.extend(mesh.face_vertices(face).filter(|vertex| listed.insert(vertex.0)));
        }
        vertices
    }

    /// The edges where it ends: those with a face outside, and those with one side of a face of the
    /// region alone. An edge is there once, whatever the number of its faces.
    pub(super) fn border(&self, mesh: &EditMesh) -> Vec<BorderEdge> {
        let mut border = Vec::new();
        // Edges with more than two sides are looked at once each, because that takes long.
        let mut crowded = Vec::new();
        for &face in &self.faces {
            for corner in mesh.face_corners(face) {
                let edge = mesh.corner_edge(corner);
                let other = mesh.radial_next(corner);
                if other == corner {
                    border.push(BorderEdge { edge, inner: corner, outer: None });
                } else if mesh.radial_next(other) != corner {
                    crowded.push(edge);
                } else if !self.has_corner(mesh, other) {
                    border.push(BorderEdge { edge, inner: corner, outer: Some(other) });
                }
            }
        }
        crowded.sort_unstable();
        crowded.dedup();
        border.extend(crowded.into_iter().filter_map(|edge| {
            let outer = mesh.edge_corners(edge).find(|&corner| !self.has_corner(mesh, corner))?;
            let inner = mesh.edge_corners(edge).find(|&corner| self.has_corner(mesh, corner))?;
            Some(BorderEdge { edge, inner, outer: Some(outer) })
        }));
        border
    }

    /// The faces of those of its parts that no edge joins to a face outside: whole sheets.
    pub(super) fn sheets(&self, mesh: &EditMesh, border: &[BorderEdge]) -> Vec<FaceId> {
        let mut attached = IndexSet::new(mesh.face_capacity(), self.faces.len());
        let mut crowded_edges = IndexSet::new(mesh.edge_capacity(), border.len());
        let mut waiting: Vec<FaceId> = Vec::new();
        for edge in border.iter().filter(|edge| edge.outer.is_some()) {
            let sides = mesh.edge_faces(edge.edge).filter(|&face| self.contains(face));
            waiting.extend(sides.filter(|face| attached.insert(face.0)));
        }
        if waiting.is_empty() {
            return self.faces.clone();
        }
        while let Some(face) = waiting.pop() {
            for corner in mesh.face_corners(face) {
                let is_crowded = mesh.radial_next(mesh.radial_next(corner)) != corner;
                if is_crowded && !crowded_edges.insert(mesh.corner_edge(corner).0) {
                    continue;
                }
                let mut side = mesh.radial_next(corner);
                while side != corner {
                    let face = mesh.corner_face(side);
                    if self.contains(face) && attached.insert(face.0) {
                        waiting.push(face);
                    }
                    side = mesh.radial_next(side);
                }
            }
        }
        self.faces.iter().copied().filter(|face| !attached.contains(face.0)).collect()
    }
}

impl SplitVertices {
    /// None yet, of about `expected`.
    pub(super) fn new(mesh: &EditMesh, expected: usize) -> Self {
        Self { list: Vec::new(), table: IndexTable::new(mesh.vertex_capacity(), expected) }
    }

    /// What is outside has this in place of a vertex.
    #[inline]
    pub(super) fn base(&self, vertex: VertexId) -> Option<VertexId> {
        self.index_of(vertex).map(|index| self.list[index].base)
    }

    /// Where a vertex is in the list.
    #[inline]
    pub(super) fn index_of(&self, vertex: VertexId) -> Option<usize> {
        self.table.get(vertex.0).map(|index| index as usize)
    }

    /// Makes the new vertex at the same place and with the same values, unless there is one.
    pub(super) fn split(&mut self, mesh: &mut EditMesh, cap: VertexId) -> VertexId {
        if let Some(base) = self.base(cap) {
            return base;
        }
        let base = mesh.twin_vertex(cap);
        self.table.insert(cap.0, self.list.len() as u32);
        self.list.push(SplitVertex { cap, base });
        base
    }
}

impl EditMesh {
    /// A vertex without edges like another: the same place and values.
    pub(super) fn twin_vertex(&mut self, vertex: VertexId) -> VertexId {
        let twin = VertexId(self.new_vertex(self.position(vertex)));
        *self.first_positions.write(twin.0) = self.first_position(vertex);
        self.copy_vertex(vertex, twin);
        twin
    }

    /// An edge between vertices that are not joined yet.
    pub(super) fn fresh_edge(&mut self, a: VertexId, b: VertexId) -> EdgeId {
        let edge = self.new_edge([a.0, b.0]);
        self.link_at_vertex(edge, 0);
        self.link_at_vertex(edge, 1);
        EdgeId(edge)
    }

    /// Makes the edges of the base along a border between vertices that were split, and gives
    /// everything outside of the region that is at those vertices the base's elements. Returns the
    /// base's edges, in the border's order.
    pub(super) fn part_from_outside(
        &mut self,
        region: &Region,
        border: &[BorderEdge],
        splits: &SplitVertices,
    ) -> Vec<EdgeId> {
        let base = |vertex| splits.base(vertex).expect("the ends of a border were split");
        let mut edges = Vec::with_capacity(border.len());
        for border in border {
            let [a, b] = self.edge_vertices(border.edge);
            let edge = self.fresh_edge(base(a), base(b));
            self.copy_edge(border.edge, edge);
            edges.push(edge);
            if border.outer.is_none() {
                continue;
            }
            let sides: SmallVec<[CornerId; 4]> = self.edge_corners(border.edge).collect();
            for side in sides {
                if region.has_corner(self, side) {
                    continue;
                }
                self.unlink_at_edge(side.0);
                self.corners.write(side.0).vertex = base(self.corner_vertex(side)).0;
                self.link_at_edge(side.0, edge.0);
            }
        }
        let mut outside = Vec::new();
        for &SplitVertex { cap, base } in &splits.list {
            // Sides outside left the border's edges, so the first side tells for all.
            let is_outside = |edge: &EdgeId| match self.edges[edge.0].corner {
                NONE => true,
                corner => !region.has_corner(self, CornerId(corner)),
            };
            outside.clear();
            outside.extend(self.vertex_edges(cap).filter(is_outside));
            for &edge in &outside {
                self.move_edge_end(edge, cap, base);
            }
        }
        edges
    }

    /// Lets an edge, and the corners of its faces at that end, end at another vertex. The two ends are
    /// not joined yet. The corners at the old vertex that leave along other edges are for the
    /// caller.
    pub(super) fn move_edge_end(&mut self, edge: EdgeId, from: VertexId, to: VertexId) {
        let end = self.edges[edge.0].end(from.0);
        self.unlink_at_vertex(edge.0, end);
        self.edges.write(edge.0).vertices[end] = to.0;
        self.link_at_vertex(edge.0, end);
        let first = self.edges[edge.0].corner;
        let mut corner = first;
        while corner != NONE {
            if self.corners[corner].vertex == from.0 {
                self.corners.write(corner).vertex = to.0;
            }
            corner = self.corners[corner].radial_next;
            if corner == first {
                break;
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use trigon_mesh::Mesh;

    /// Runs an operation on a mesh as a transaction: the structure is whole after it, undone it is
    /// the first mesh, redone the other again, and a refusal changes nothing.
    pub(crate) fn check_change<T>(
        start: &Mesh,
        operation: impl FnOnce(&mut EditMesh) -> Result<T, Refusal>,
    ) -> Result<(EditMesh, T), Refusal> {
        let (mut mesh, _) = EditMesh::from_mesh(start);
        let before = mesh.clone();
        match mesh.transaction(operation) {
            Ok((result, mut difference)) => {
                mesh.check_structure().expect("the structure is whole");
                let after = mesh.clone();
                difference.apply(&mut mesh);
                assert!(mesh == before, "undone");
                difference.apply(&mut mesh);
                assert!(mesh == after, "redone");
                Ok((mesh, result))
            }
            Err(refusal) => {
                assert!(mesh == before, "refused ({refusal}), but changed");
                Err(refusal)
            }
        }
    }

    /// Those faces of a mesh whose bit is set; bits repeat.
    pub(crate) fn chosen_faces(mesh: &Mesh, bits: u64) -> Vec<FaceId> {
        (0..mesh.face_count() as u32).filter(|face| bits >> (face % 64) & 1 != 0).map(FaceId).collect()
    }

    /// The numbers of vertices, edges and faces.
    pub(crate) fn counts(mesh: &EditMesh) -> [usize; 3] {
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    /// How many edges are open borders.
    pub(crate) fn open_edges(mesh: &EditMesh) -> usize {
        mesh.edges().filter(|&edge| mesh.is_boundary(edge)).count()
    }

    /// Whether neighbours wind alike: each edge between two faces is run along in both directions.
    pub(crate) fn winds_consistently(mesh: &EditMesh) -> bool {
        let pairs = mesh.edges().filter_map(|edge| mesh.edge_pair(edge));
        pairs.into_iter().all(|[a, b]| mesh.corner_vertex(a) != mesh.corner_vertex(b))
    }

    #[test]
    fn a_border_names_each_edge_once_and_sheets_are_told_from_attached_parts() {
        // A row of three quads and one that stands alone.
        let mut mesh = EditMesh::from_mesh(&trigon_mesh::primitives::grid(3.0, 1.0, 3, 1)).0;
        let alone: Vec<VertexId> = [[9.0, 0.0], [10.0, 0.0], [9.0, 1.0]]
            .map(|[x, y]| mesh.add_vertex(trigon_math::Vec3::new(x, y, 0.0)).expect("room"))
            .to_vec();
        let alone = mesh.add_face(&alone).expect("a triangle");
        let region = Region::new(&mesh, &[alone, FaceId(0), FaceId(0)], "testing").expect("they exist");
        let border = region.border(&mesh);
        let mixed = border.iter().filter(|edge| edge.outer.is_some()).count();
        assert_eq!((border.len(), mixed), (7, 1), "four and three sides, one with a neighbour");
        assert_eq!(region.sheets(&mesh, &border), [alone], "the row goes on");
    }
}
