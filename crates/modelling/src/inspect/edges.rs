//! Findings about edges: too many faces, too few, in the same direction, without length.

use fixedbitset::FixedBitSet;
use trigon_mesh::EdgeJoin;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, VertexId};

/// Edges with one side of a face each, in the order in which they follow each other.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct BoundaryLoop {
    /// Each ends where the next begins.
    pub edges: Vec<EdgeId>,
    /// Whether the last one ends where the first begins. If not, the chain ends where more than two
    /// faces share an edge.
    pub is_closed: bool,
}

impl EditMesh {
    /// How the faces at an edge join.
    #[must_use]
    pub fn edge_join(&self, edge: EdgeId) -> EdgeJoin {
        let [start, _] = self.edge_vertices(edge);
        EdgeJoin::of(self.edge_corners(edge).map(|corner| self.corner_vertex(corner) == start))
    }

    /// The edges with three or more sides of faces.
    #[must_use]
    pub fn non_manifold_edges(&self) -> Vec<EdgeId> {
        self.edges_that(EdgeJoin::NonManifold)
    }

    /// The edges whose two faces run along them in the same direction, so that one of these shows its
    /// inside. [`Self::recalculate_normals`] repairs them, but for surfaces with one side.
    #[must_use]
    pub fn inconsistent_edges(&self) -> Vec<EdgeId> {
        self.edges_that(EdgeJoin::Turned)
    }

    fn edges_that(&self, join: EdgeJoin) -> Vec<EdgeId> {
        self.edges().filter(|&edge| self.edge_join(edge) == join).collect()
    }

    /// The edges no longer than `most` metres.
    #[must_use]
    pub fn zero_length_edges(&self, most: f64) -> Vec<EdgeId> {
        self.edges().filter(|&edge| self.edge_length(edge) <= most).collect()
    }

    /// The edges with exactly one side of a face, in chains: each is the rim of a hole or of an open
    /// surface. Where two rims touch in a vertex each follows its own faces.
    #[must_use]
    pub fn boundary_loops(&self) -> Vec<BoundaryLoop> {
        let mut visited = FixedBitSet::with_capacity(self.edge_capacity());
        let mut loops = Vec::new();
        for edge in self.edges().filter(|&edge| self.is_boundary(edge)) {
            if visited.contains(edge.0 as usize) {
                continue;
            }
            let [a, b] = self.edge_vertices(edge);
            let mut edges = vec![edge];
            visited.insert(edge.0 as usize);
            let is_closed = self.follow_boundary(edge, b, &mut edges, &mut visited);
            if !is_closed {
                // The other way from the first one.
                edges.reverse();
                self.follow_boundary(edge, a, &mut edges, &mut visited);
            }
            loops.push(BoundaryLoop { edges, is_closed });
        }
        loops
    }

    /// Follows a boundary from the end of an edge; whether it comes back to that edge.
    fn follow_boundary(
        &self,
        first: EdgeId,
        end: VertexId,
        edges: &mut Vec<EdgeId>,
        visited: &mut FixedBitSet,
    ) -> bool {
        let (mut edge, mut vertex) = (first, end);
        while let Some(next) = self.next_boundary_edge(edge, vertex) {
            if next == first {
                return true;
            }
            if visited.put(next.0 as usize) {
                // Never, as each step can be taken back; but a chain has to end.
                return false;
            }
            edges.push(next);
            vertex = self.other_vertex(next, vertex);
            edge = next;
        }
        false
    }

    /// The boundary edge at which the fan of faces ends that begins at another one at a vertex.
    /// `None` where it meets an edge of three or more sides.
    fn next_boundary_edge(&self, from: EdgeId, vertex: VertexId) -> Option<EdgeId> {
        let mut side = self.edge_corners(from).next()?;
        let mut edge = from;
        loop {
            // The corner of this face at the vertex, and the other edge there.
            let corner = self.end_of_side(side, vertex);
            let (other, other_side) = if self.corner_edge(corner) == edge {
                let previous = self.previous_corner(corner);
                (self.corner_edge(previous), previous)
            } else {
                (self.corner_edge(corner), corner)
            };
            if self.is_boundary(other) {
                return Some(other);
            }
            let [one, two] = self.edge_pair(other)?;
            (side, edge) = (if one == other_side { two } else { one }, other);
        }
    }

    /// Of a side of a face, the corner at one of its ends.
    fn end_of_side(&self, side: CornerId, vertex: VertexId) -> CornerId {
        if self.corner_vertex(side) == vertex { side } else { self.next_corner(side) }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::{MeshBuilder, primitives};

    use super::*;
    use crate::FaceId;
    use crate::tests::meshes;

    #[test]
    fn each_hole_has_a_rim() {
        let (mut torus, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 12, 8));
        assert_eq!(torus.boundary_loops(), vec![], "closed");
        let faces: Vec<FaceId> = torus.faces().collect();
        torus.delete_faces(&[faces[0]]).expect("it exists");
        let apart = faces.iter().copied().skip(1).find(|&face| {
            torus.face_vertices(face).all(|vertex| torus.vertex_edges(vertex).all(|e| !torus.is_boundary(e)))
        });
        torus.delete_faces(&[apart.expect("it is large")]).expect("it exists");
        let loops = torus.boundary_loops();
        assert_eq!(loops.len(), 2, "two holes");
        assert!(loops.iter().all(|rim| rim.is_closed && rim.edges.len() == 4), "of a quad each");
    }

    #[test]
    fn rims_that_touch_in_a_vertex_are_two() {
        let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(4.0, 4.0, 4, 4));
        let middle = grid.vertices().find(|&vertex| grid.position(vertex) == Vec3::ZERO).expect("the middle");
        let faces: Vec<FaceId> = grid.vertex_faces(middle).collect();
        let across = |face: FaceId| grid.face_center(face).x * grid.face_center(face).z > 0.0;
        let holes: Vec<FaceId> = faces.into_iter().filter(|&face| across(face)).collect();
        grid.delete_faces(&holes).expect("they exist");
        let mut sizes: Vec<usize> = grid.boundary_loops().iter().map(|rim| rim.edges.len()).collect();
        sizes.sort_unstable();
        // At the vertex between them a fan of faces leads from one hole to the other.
        assert_eq!(sizes, [8, 16], "both holes in one chain, and the outside");
    }

    #[test]
    fn three_faces_at_an_edge_and_two_in_one_direction_are_found() {
        let mut mesh = EditMesh::new();
        let mut add = |x: f32, y: f32, z: f32| mesh.add_vertex(Vec3::new(x, y, z)).expect("room");
        let (a, b) = (add(0.0, 0.0, 0.0), add(0.0, 1.0, 0.0));
        let tips = [add(1.0, 0.0, 0.0), add(0.0, 0.0, 1.0), add(-1.0, 0.0, 0.0)];
        mesh.add_face(&[a, b, tips[0]]).expect("a triangle");
        mesh.add_face(&[a, b, tips[1]]).expect("a triangle");
        let shared = mesh.find_edge(a, b).expect("it is there");
        assert_eq!((mesh.inconsistent_edges(), mesh.non_manifold_edges()), (vec![shared], vec![]), "two");
        mesh.add_face(&[b, a, tips[2]]).expect("a triangle");
        assert_eq!((mesh.inconsistent_edges(), mesh.non_manifold_edges()), (vec![], vec![shared]), "three");
        let loops = mesh.boundary_loops();
        assert_eq!(loops.len(), 3, "from the edge that they share back to it");
        assert!(loops.iter().all(|rim| !rim.is_closed && rim.edges.len() == 2), "two edges each");
        mesh.set_position(b, Vec3::ZERO);
        assert_eq!(mesh.zero_length_edges(0.0), [shared], "its ends are at one place");
    }

    proptest! {
        /// The surface of a mesh finds edges in its own way; both must see the same ones.
        #[test]
        fn the_mesh_has_the_same_edges(faces in prop::collection::vec([0u32..9, 0u32..9, 0u32..9], 1..30)) {
            let mut builder = MeshBuilder::new();
            for i in 0u8..9 {
                builder.push_vertex(Vec3::new(f32::from(i), f32::from(i * i), 1.0));
            }
            for face in faces.into_iter().filter(|[a, b, c]| a != b && b != c && c != a) {
                builder.push_face(&face).expect("a triangle");
            }
            let mesh = builder.build();
            let (edited, _) = EditMesh::from_mesh(&mesh);
            let surface = mesh.surface();
            prop_assert_eq!(surface.non_manifold_edges.len(), edited.non_manifold_edges().len());
            prop_assert_eq!(surface.turned_edges.len(), edited.inconsistent_edges().len());
            let open: usize = edited.boundary_loops().iter().map(|rim| rim.edges.len()).sum();
            prop_assert_eq!(surface.open_edges.len(), open);
        }

        #[test]
        fn every_boundary_edge_is_in_one_chain(start in meshes(), holes in prop::collection::vec(any::<u32>(), 0..4)) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            for hole in holes {
                let faces: Vec<FaceId> = mesh.faces().collect();
                if !faces.is_empty() {
                    mesh.delete_faces(&[faces[hole as usize % faces.len()]]).expect("it exists");
                }
            }
            let loops = mesh.boundary_loops();
            let mut found: Vec<EdgeId> = loops.iter().flat_map(|rim| rim.edges.iter().copied()).collect();
            found.sort_unstable();
            let expected: Vec<EdgeId> = mesh.edges().filter(|&edge| mesh.is_boundary(edge)).collect();
            prop_assert_eq!(found, expected);
            for rim in loops {
                let meet = |pair: &[EdgeId]| {
                    let [a, b] = [pair[0], pair[1]].map(|edge| mesh.edge_vertices(edge));
                    a.iter().any(|vertex| b.contains(vertex))
                };
                prop_assert!(rim.edges.windows(2).all(meet));
            }
        }
    }
}
