//! Vertex lists: each vertex knows those that it is joined to. There are neither faces nor
//! edges: they have to be found among the neighbours.

use super::Triangles;
use super::answer::{Found, Storage, byte_count, in_order, nearest};
use super::groups::Groups;
use trigon_math::Vec3;

/// Vertices that know their neighbours.
pub struct VertexList {
    positions: Vec<Vec3>,
    neighbours: Groups,
}

impl VertexList {
    /// Of a closed mesh, where each side of a triangle is that of another, reversed.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        Self { positions: positions.clone(), neighbours: Groups::new(positions.len(), sides) }
    }
}

impl Storage for VertexList {
    fn bytes(&self) -> usize {
        byte_count(&self.positions) + self.neighbours.bytes()
    }

    /// Without faces, among all edges.
    fn nearest_edge(&self, _: u32, point: Vec3) -> Found<[u32; 2]> {
        let vertices = 0..self.positions.len() as u32;
        let edges = vertices.flat_map(|a| self.neighbours.of(a).iter().map(move |&b| [a, b]));
        let reads = edges.clone().count() as u64;
        Found { answer: nearest(edges, &self.positions, point), reads }
    }

    /// Neighbours that are neighbours of each other.
    fn triangles_around(&self, vertex: u32) -> Found<Vec<[u32; 3]>> {
        let around = self.neighbours.of(vertex);
        let mut reads = around.len() as u64;
        let mut triangles = Vec::new();
        for &one in around {
            let others = self.neighbours.of(one);
            reads += others.len() as u64;
            let shared = others.iter().filter(|other| **other > one && around.contains(other));
            triangles.extend(shared.map(|&other| [vertex, one, other]));
        }
        Found { answer: in_order(triangles), reads }
    }

    fn neighbours(&self, vertex: u32) -> Found<Vec<u32>> {
        let mut answer = self.neighbours.of(vertex).to_vec();
        answer.sort_unstable();
        Found { reads: answer.len() as u64, answer }
    }
}
