//! Faces with explicit edges, as source D finally stores them, and as the engine's [`Mesh`] does: faces store
//! their vertices and edges, edges their vertices, and nothing leads from a vertex to its faces. Finding
//! these reads the whole list of corners.

use super::answer::{Storage, in_order, nearest};
use super::reads::Reads;
use super::triangles::{Triangles, mesh_of};
use trigon_math::Vec3;
use trigon_mesh::Mesh;

/// The engine's mesh.
pub struct Own<const COUNTED: bool> {
    mesh: Mesh,
    reads: Reads<COUNTED>,
}

impl<const COUNTED: bool> Own<COUNTED> {
    /// Of a closed mesh, its edges found.
    #[must_use]
    pub fn new(triangles: &Triangles) -> Self {
        let mesh = mesh_of(triangles);
        mesh.edges();
        Self { mesh, reads: Reads::default() }
    }

    /// The vertices of a triangle.
    fn triangle(&self, face: usize) -> [u32; 3] {
        let vertices = self.mesh.face_vertices(face);
        [vertices[0], vertices[1], vertices[2]].map(|vertex| self.reads.note(vertex))
    }

    /// The ends of an edge.
    fn ends(&self, edge: u32) -> [u32; 2] {
        self.mesh.edges()[edge as usize].map(|vertex| self.reads.note(vertex))
    }
}

impl<const COUNTED: bool> Storage for Own<COUNTED> {
    fn bytes(&self) -> usize {
        let indices = self.mesh.face_count() + 1 + 2 * self.mesh.corner_count() + 2 * self.mesh.edge_count();
        size_of_val(self.mesh.positions()) + indices * size_of::<u32>()
    }

    fn reads(&self) -> u64 {
        self.reads.count()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let edges = self.mesh.face_corners(face as usize).filter_map(|corner| self.mesh.corner_edge(corner));
        let ends = edges.map(|edge| self.ends(self.reads.note(edge)));
        nearest(ends, self.mesh.positions(), point)
    }

    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let triangles = (0..self.mesh.face_count()).map(|face| self.triangle(face));
        in_order(triangles.filter(|triangle| triangle.contains(&vertex)).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let other = |[a, b]: [u32; 2]| if a == vertex { Some(b) } else { (b == vertex).then_some(a) };
        let mut answer: Vec<u32> =
            (0..self.mesh.edge_count() as u32).map(|edge| self.ends(edge)).filter_map(other).collect();
        answer.sort_unstable();
        answer
    }
}
