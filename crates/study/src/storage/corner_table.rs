//! The corner table (J. Rossignac, A. Safonova and A. Szymczak, "3D compression made simple: Edgebreaker on a
//! corner table", 2001): for each corner its vertex and the opposite corner in the neighbouring triangle.
//! Everything else follows from the corner's number.

use super::Triangles;
use super::answer::{Storage, byte_count, in_order, nearest};
use super::reads::List;
use std::collections::BTreeMap;
use trigon_math::Vec3;

/// Two numbers for each corner, and one corner for each vertex.
pub struct CornerTable<const COUNTED: bool> {
    positions: Vec<Vec3>,
    vertices: List<u32, COUNTED>,
    opposites: List<u32, COUNTED>,
    /// A corner of each vertex.
    corners: List<u32, COUNTED>,
}

/// The corner after this one in its triangle.
fn next(corner: u32) -> u32 {
    corner - corner % 3 + (corner + 1) % 3
}

impl<const COUNTED: bool> CornerTable<COUNTED> {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let vertices: Vec<u32> = triangles.as_flattened().to_vec();
        let side = |corner: u32| [next(corner), next(next(corner))].map(|corner| vertices[corner as usize]);
        let all = 0..vertices.len() as u32;
        let sides: BTreeMap<[u32; 2], u32> = all.clone().map(|corner| (side(corner), corner)).collect();
        let opposite = |corner: u32| {
            let [from, to] = side(corner);
            sides[&[to, from]]
        };
        let opposites = all.clone().map(opposite).collect();
        let mut corners = vec![0; positions.len()];
        all.for_each(|corner| corners[vertices[corner as usize] as usize] = corner);
        Self {
            positions: positions.clone(),
            vertices: List::new(vertices),
            opposites: List::new(opposites),
            corners: List::new(corners),
        }
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.vertices.at(corner)
    }

    /// The corners of a vertex, in turn.
    fn corners_around(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.corners.at(vertex);
        // Across the side before the corner, the vertex's corner follows the opposite.
        let turn = |corner: u32| next(self.opposites.at(next(corner)));
        std::iter::successors(Some(first), move |&corner| {
            Some(turn(corner)).filter(|&corner| corner != first)
        })
    }
}

impl<const COUNTED: bool> Storage for CornerTable<COUNTED> {
    fn bytes(&self) -> usize {
        let corners = self.vertices.bytes() + self.opposites.bytes();
        byte_count(&self.positions) + corners + self.corners.bytes()
    }

    fn reads(&self) -> u64 {
        self.vertices.reads() + self.opposites.reads() + self.corners.reads()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let [a, b, c] = [0, 1, 2].map(|i| self.vertex(3 * face + i));
        nearest([[a, b], [b, c], [c, a]], &self.positions, point)
    }

    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let triangle =
            |corner: u32| [corner, next(corner), next(next(corner))].map(|corner| self.vertex(corner));
        in_order(self.corners_around(vertex).map(triangle).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut answer: Vec<u32> =
            self.corners_around(vertex).map(|corner| self.vertex(next(corner))).collect();
        answer.sort_unstable();
        answer
    }
}
