//! Vertex lists: each vertex stores its neighbours. There are no faces or edges; they have to be found from
//! the neighbours.

use super::Triangles;
use super::answer::{Storage, byte_count, in_order, nearest};
use super::groups::Groups;
use trigon_math::Vec3;

/// Vertices that know their neighbours.
pub struct VertexList<const COUNTED: bool> {
    positions: Vec<Vec3>,
    neighbours: Groups<COUNTED>,
}

impl<const COUNTED: bool> VertexList<COUNTED> {
    /// Of a closed mesh, where each side of a triangle is that of another, reversed.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        Self { positions: positions.clone(), neighbours: Groups::new(positions.len(), sides) }
    }
}

impl<const COUNTED: bool> Storage for VertexList<COUNTED> {
    fn bytes(&self) -> usize {
        byte_count(&self.positions) + self.neighbours.bytes()
    }

    fn reads(&self) -> u64 {
        self.neighbours.reads()
    }

    /// Without faces, among all edges.
    fn nearest_edge(&self, _: u32, point: Vec3) -> [u32; 2] {
        let vertices = 0..self.positions.len() as u32;
        let edges = vertices.flat_map(|a| self.neighbours.of(a).map(move |b| [a, b]));
        nearest(edges, &self.positions, point)
    }

    /// Neighbours that are neighbours of each other.
    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let around = self.neighbours.of(vertex);
        let mut triangles = Vec::new();
        for one in around.clone() {
            let later = self.neighbours.of(one).filter(|&other| other > one);
            let shared = later.filter(|&other| around.clone().any(|third| third == other));
            triangles.extend(shared.map(|other| [vertex, one, other]));
        }
        in_order(triangles)
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut answer: Vec<u32> = self.neighbours.of(vertex).collect();
        answer.sort_unstable();
        answer
    }
}
