//! Faces with explicit edges, as source D stores them in the end, and as the engine's
//! [`Mesh`] does: faces know their vertices and edges, edges their vertices, and nothing
//! leads from a vertex to its faces. Such questions read the whole list of corners.

use super::answer::{Found, Storage, in_order, nearest};
use super::triangles::{Triangles, mesh_of};
use trigon_math::Vec3;
use trigon_mesh::Mesh;

/// The engine's mesh.
pub struct Own {
    mesh: Mesh,
}

impl Own {
    /// Of a closed mesh, its edges found.
    #[must_use]
    pub fn new(triangles: &Triangles) -> Self {
        let mesh = mesh_of(triangles);
        mesh.edges();
        Self { mesh }
    }

    /// The vertices of a triangle.
    fn triangle(&self, face: usize) -> [u32; 3] {
        let vertices = self.mesh.face_vertices(face);
        [vertices[0], vertices[1], vertices[2]]
    }
}

impl Storage for Own {
    fn bytes(&self) -> usize {
        let indices = self.mesh.face_count() + 1 + 2 * self.mesh.corner_count() + 2 * self.mesh.edge_count();
        size_of_val(self.mesh.positions()) + indices * size_of::<u32>()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> Found<[u32; 2]> {
        let edges = self.mesh.face_corners(face as usize).filter_map(|corner| self.mesh.corner_edge(corner));
        let ends = edges.map(|edge| self.mesh.edges()[edge as usize]);
        Found { answer: nearest(ends, self.mesh.positions(), point), reads: 3 + 6 }
    }

    fn triangles_around(&self, vertex: u32) -> Found<Vec<[u32; 3]>> {
        let triangles = (0..self.mesh.face_count()).map(|face| self.triangle(face));
        let around = triangles.filter(|triangle| triangle.contains(&vertex)).collect();
        Found { answer: in_order(around), reads: self.mesh.corner_count() as u64 }
    }

    fn neighbours(&self, vertex: u32) -> Found<Vec<u32>> {
        let other = |&[a, b]: &[u32; 2]| if a == vertex { Some(b) } else { (b == vertex).then_some(a) };
        let mut answer: Vec<u32> = self.mesh.edges().iter().filter_map(other).collect();
        answer.sort_unstable();
        Found { answer, reads: 2 * self.mesh.edge_count() as u64 }
    }
}
