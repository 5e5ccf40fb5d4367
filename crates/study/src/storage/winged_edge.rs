//! Winged edges (B. G. Baumgart, "Winged edge polyhedron representation", Stanford STAN-CS-320, 1972) as in source
//! D. Vertices and faces store the edges around them, and an edge stores its two vertices, its two faces and its
//! four neighbouring edges.

use super::Triangles;
use super::answer::{Storage, byte_count, in_order, nearest};
use super::groups::Groups;
use super::reads::List;
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
pub struct WingedEdge<const COUNTED: bool> {
    positions: Vec<Vec3>,
    edges: List<Wings, COUNTED>,
    face_edges: List<[u32; 3], COUNTED>,
    vertex_edges: Groups<COUNTED>,
}

impl<const COUNTED: bool> WingedEdge<COUNTED> {
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
        let (edges, face_edges) = (List::new(edges), List::new(face_edges));
        Self { positions: positions.clone(), edges, face_edges, vertex_edges }
    }

    fn vertices(&self, edge: u32) -> [u32; 2] {
        self.edges.read(edge, |wings| wings.vertices)
    }
}

impl<const COUNTED: bool> Storage for WingedEdge<COUNTED> {
    fn bytes(&self) -> usize {
        let lists = self.edges.bytes() + self.face_edges.bytes();
        byte_count(&self.positions) + lists + self.vertex_edges.bytes()
    }

    fn reads(&self) -> u64 {
        self.edges.reads() + self.face_edges.reads() + self.vertex_edges.reads()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let edges = self.face_edges.read(face, |edges| *edges).map(|edge| self.vertices(edge));
        nearest(edges, &self.positions, point)
    }

    /// Each edge of the vertex leads to the face on one side of it, and a wing to that
    /// face's third vertex.
    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let triangle = |edge: u32| {
            let [a, b] = self.vertices(edge);
            // The face that runs along the edge away from the vertex.
            let side = if a == vertex { 1 } else { 3 };
            let [wing] = self.edges.read(edge, |edge| [edge.wings[side]]);
            let [c, d] = self.vertices(wing);
            [a, b, if c == a || c == b { d } else { c }]
        };
        in_order(self.vertex_edges.of(vertex).map(triangle).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let other = |edge: u32| {
            let [a, b] = self.vertices(edge);
            if a == vertex { b } else { a }
        };
        let mut answer: Vec<u32> = self.vertex_edges.of(vertex).map(other).collect();
        answer.sort_unstable();
        answer
    }
}
