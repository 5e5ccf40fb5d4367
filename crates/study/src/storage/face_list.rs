//! Face lists: faces know their vertices, and each vertex its neighbours and the faces
//! around it.

use super::Triangles;
use super::answer::{Found, Storage, byte_count, in_order, nearest};
use super::groups::Groups;
use trigon_math::Vec3;

/// Faces and vertices that know each other.
pub struct FaceList {
    positions: Vec<Vec3>,
    faces: Vec<[u32; 3]>,
    neighbours: Groups,
    faces_around: Groups,
}

impl FaceList {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let corners = (0..).zip(triangles).flat_map(|(face, triangle)| triangle.map(|vertex| [vertex, face]));
        Self {
            positions: positions.clone(),
            faces: triangles.clone(),
            neighbours: Groups::new(positions.len(), sides),
            faces_around: Groups::new(positions.len(), corners),
        }
    }
}

impl Storage for FaceList {
    fn bytes(&self) -> usize {
        let lists = self.neighbours.bytes() + self.faces_around.bytes();
        byte_count(&self.positions) + byte_count(&self.faces) + lists
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> Found<[u32; 2]> {
        let [a, b, c] = self.faces[face as usize];
        Found { answer: nearest([[a, b], [b, c], [c, a]], &self.positions, point), reads: 3 }
    }

    fn triangles_around(&self, vertex: u32) -> Found<Vec<[u32; 3]>> {
        let faces = self.faces_around.of(vertex);
        let triangles = faces.iter().map(|&face| self.faces[face as usize]).collect();
        Found { answer: in_order(triangles), reads: 4 * faces.len() as u64 }
    }

    fn neighbours(&self, vertex: u32) -> Found<Vec<u32>> {
        let mut answer = self.neighbours.of(vertex).to_vec();
        answer.sort_unstable();
        Found { reads: answer.len() as u64, answer }
    }
}
