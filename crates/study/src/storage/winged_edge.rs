//! Winged edges (B. G. Baumgart, "Winged edge polyhedron representation", Stanford
//! STAN-CS-320, 1972) as source D has them: vertices and faces know the edges around them,
//! and an edge knows its two vertices, its two faces and four edges next to it.

use super::Triangles;
use super::answer::{Found, Storage, byte_count, in_order, nearest};
use super::groups::Groups;
use std::collections::BTreeMap;
use trigon_math::Vec3;

/// An edge with all that meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wings {
    vertices: [u32; 2],
    /// The face that runs along the edge as it does, and the one that runs against it.
    faces: [u32; 2],
    /// The edges before and after it in the first face, then in the second.
    wings: [u32; 4],
}

/// Vertices, edges and faces that know each other.
pub struct WingedEdge {
    positions: Vec<Vec3>,
    edges: Vec<Wings>,
    face_edges: Vec<[u32; 3]>,
    vertex_edges: Groups,
}

impl WingedEdge {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let mut numbers = BTreeMap::new();
        for &[a, b, c] in triangles {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let next = numbers.len() as u32;
                numbers.entry(super::answer::edge(from, to)).or_insert(next);
            }
        }
        let unknown = Wings { vertices: [0; 2], faces: [0; 2], wings: [0; 4] };
        let mut edges = vec![unknown; numbers.len()];
        let mut face_edges = Vec::with_capacity(triangles.len());
        for (face, &[a, b, c]) in (0..).zip(triangles) {
            let sides = [[a, b], [b, c], [c, a]];
            let around = sides.map(|[from, to]| numbers[&super::answer::edge(from, to)]);
            for (i, [from, to]) in sides.into_iter().enumerate() {
                let wings = &mut edges[around[i] as usize];
                wings.vertices = super::answer::edge(from, to);
                let side = usize::from(from > to);
                wings.faces[side] = face;
                [wings.wings[2 * side], wings.wings[2 * side + 1]] =
                    [around[(i + 2) % 3], around[(i + 1) % 3]];
            }
            face_edges.push(around);
        }
        let ends = (0..).zip(&edges).flat_map(|(edge, wings)| wings.vertices.map(|vertex| [vertex, edge]));
        let vertex_edges = Groups::new(positions.len(), ends);
        Self { positions: positions.clone(), edges, face_edges, vertex_edges }
    }

    fn vertices(&self, edge: u32) -> [u32; 2] {
        self.edges[edge as usize].vertices
    }
}

impl Storage for WingedEdge {
    fn bytes(&self) -> usize {
        let lists = byte_count(&self.edges) + byte_count(&self.face_edges);
        byte_count(&self.positions) + lists + self.vertex_edges.bytes()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> Found<[u32; 2]> {
        let edges = self.face_edges[face as usize].map(|edge| self.vertices(edge));
        Found { answer: nearest(edges, &self.positions, point), reads: 3 + 6 }
    }

    /// Each edge of the vertex leads to the face on one side of it, and a wing to that
    /// face's third vertex.
    fn triangles_around(&self, vertex: u32) -> Found<Vec<[u32; 3]>> {
        let around = self.vertex_edges.of(vertex);
        let triangle = |&edge: &u32| {
            let Wings { vertices: [a, b], wings, .. } = self.edges[edge as usize];
            // The face that runs along the edge away from the vertex.
            let wing = if a == vertex { wings[1] } else { wings[3] };
            let [c, d] = self.vertices(wing);
            [a, b, if c == a || c == b { d } else { c }]
        };
        Found { answer: in_order(around.iter().map(triangle).collect()), reads: 6 * around.len() as u64 }
    }

    fn neighbours(&self, vertex: u32) -> Found<Vec<u32>> {
        let around = self.vertex_edges.of(vertex);
        let other = |&edge: &u32| {
            let [a, b] = self.vertices(edge);
            if a == vertex { b } else { a }
        };
        let mut answer: Vec<u32> = around.iter().map(other).collect();
        answer.sort_unstable();
        Found { answer, reads: 3 * around.len() as u64 }
    }
}
