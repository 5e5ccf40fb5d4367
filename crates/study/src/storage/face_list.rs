//! Face lists: each face stores its vertices, and each vertex its neighbours and the faces around it.

use super::Triangles;
use super::answer::{Storage, byte_count, in_order, nearest};
use super::groups::Groups;
use super::reads::List;
use trigon_math::Vec3;

/// Faces and vertices that know each other.
pub struct FaceList<const COUNTED: bool> {
    positions: Vec<Vec3>,
    faces: List<[u32; 3], COUNTED>,
    neighbours: Groups<COUNTED>,
    faces_around: Groups<COUNTED>,
}

impl<const COUNTED: bool> FaceList<COUNTED> {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let corners = (0..).zip(triangles).flat_map(|(face, triangle)| triangle.map(|vertex| [vertex, face]));
        Self {
            positions: positions.clone(),
            faces: List::new(triangles.clone()),
            neighbours: Groups::new(positions.len(), sides),
            faces_around: Groups::new(positions.len(), corners),
        }
    }

    fn triangle(&self, face: u32) -> [u32; 3] {
        self.faces.read(face, |vertices| *vertices)
    }
}

impl<const COUNTED: bool> Storage for FaceList<COUNTED> {
    fn bytes(&self) -> usize {
        let lists = self.neighbours.bytes() + self.faces_around.bytes();
        byte_count(&self.positions) + self.faces.bytes() + lists
    }

    fn reads(&self) -> u64 {
        self.faces.reads() + self.neighbours.reads() + self.faces_around.reads()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let [a, b, c] = self.triangle(face);
        nearest([[a, b], [b, c], [c, a]], &self.positions, point)
    }

    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        in_order(self.faces_around.of(vertex).map(|face| self.triangle(face)).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut answer: Vec<u32> = self.neighbours.of(vertex).collect();
        answer.sort_unstable();
        answer
    }
}
