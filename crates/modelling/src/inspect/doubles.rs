//! Findings about duplicates: vertices at the same position, faces over the same vertices.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use smallvec::SmallVec;
use trigon_math::{DVec3, Vec3};

use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};

/// A vertex at the place of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct DoubledVertex {
    /// The one with the larger id.
    pub vertex: VertexId,
    /// The smallest one near it that is no double itself.
    pub of: VertexId,
}

/// A face with the vertices of another, in any order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct DoubledFace {
    /// The one with the larger id.
    pub face: FaceId,
    /// The smallest one with the same vertices.
    pub of: FaceId,
}

impl EditMesh {
    /// The vertices that are no farther than `within` metres (from 0 on) from one with a smaller
    /// id that is no double itself. Places that are not finite are not compared.
    #[must_use]
    pub fn doubled_vertices(&self, within: f64) -> Vec<DoubledVertex> {
        let mut grid = VertexGrid::new(within, self.vertex_count());
        let mut doubles = Vec::new();
        for vertex in self.vertices() {
            let position = self.position(vertex);
            if position.is_finite()
                && let Some(of) = grid.find_or_insert(vertex, position)
            {
                doubles.push(DoubledVertex { vertex, of });
            }
        }
        doubles
    }

    /// The faces with the same vertices as one with a smaller id.
    #[must_use]
    pub fn doubled_faces(&self) -> Vec<DoubledFace> {
        let mut firsts: HashMap<SmallVec<[u32; 4]>, FaceId> = HashMap::with_capacity(self.face_count());
        let mut doubles = Vec::new();
        for face in self.faces() {
            let mut vertices: SmallVec<[u32; 4]> = self.face_vertices(face).map(|vertex| vertex.0).collect();
            vertices.sort_unstable();
            vertices.dedup();
            match firsts.entry(vertices) {
                Entry::Occupied(first) => doubles.push(DoubledFace { face, of: *first.get() }),
                Entry::Vacant(slot) => {
                    slot.insert(face);
                }
            }
        }
        doubles
    }
}

/// The places of vertices that are no doubles, by cells of space. The map is only looked into, never
/// gone through, so that its order does not matter.
struct VertexGrid {
    within: f64,
    /// A cell of twice the distance holds few of them, since they are farther from each other; and
    /// what is near a place is in one of eight cells.
    cells: HashMap<[u64; 3], SmallVec<[(VertexId, Vec3); 2]>>,
}

impl VertexGrid {
    fn new(within: f64, expected: usize) -> Self {
        Self { within: within.max(0.0), cells: HashMap::with_capacity(expected) }
    }

    /// The smallest vertex that was kept near a place, else keeps this one.
    fn find_or_insert(&mut self, vertex: VertexId, position: Vec3) -> Option<VertexId> {
        let wide = position.as_dvec3();
        let at = self.cell(wide);
        let mut found: Option<VertexId> = None;
        for cell in self.near_cells(wide) {
            for &(other, at) in self.cells.get(&cell).into_iter().flatten() {
                if at.as_dvec3().distance(wide) <= self.within && found.is_none_or(|known| other < known) {
                    found = Some(other);
                }
            }
        }
        if found.is_none() {
            self.cells.entry(at).or_default().push((vertex, position));
        }
        found
    }

    /// Numbers as bits: no coordinate is too large for them.
    fn cell(&self, position: DVec3) -> [u64; 3] {
        let size = 2.0 * self.within;
        // Adding zero makes −0 the same as 0.
        let number = |at: f64| if size > 0.0 { (at / size).floor() + 0.0 } else { at + 0.0 };
        position.to_array().map(|at| number(at).to_bits())
    }

    /// The cells that a sphere around a place reaches.
    fn near_cells(&self, position: DVec3) -> SmallVec<[[u64; 3]; 8]> {
        let low = self.cell(position - DVec3::splat(self.within));
        let high = self.cell(position + DVec3::splat(self.within));
        let mut cells = SmallVec::new();
        for corner in 0..8u32 {
            let cell = [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
            if !cells.contains(&cell) {
                cells.push(cell);
            }
        }
        cells
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_face_over_the_same_vertices_is_found_whichever_way_it_winds() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let mut vertices: Vec<VertexId> = cube.face_vertices(FaceId(2)).collect();
        vertices.reverse();
        let face = cube.add_face(&vertices).expect("it was one");
        assert_eq!(cube.doubled_faces(), [DoubledFace { face, of: FaceId(2) }], "turned over");
    }

    #[test]
    fn a_hundred_thousand_vertices_at_one_place_are_doubles_of_the_first() {
        let mut mesh = EditMesh::new();
        for _ in 0..100_000 {
            mesh.add_vertex(Vec3::new(-0.0, 3e38, 1.0)).expect("room");
        }
        for within in [0.0, 1e-6, 1.0] {
            let doubles = mesh.doubled_vertices(within);
            // In quadratic time this would not end.
            assert_eq!(doubles.len(), 99_999, "all but one");
            assert!(doubles.iter().all(|double| double.of == VertexId(0)), "of the first");
        }
    }

    proptest! {
        #[test]
        fn doubles_are_those_of_a_search_through_all(
            places in prop::collection::vec(prop::array::uniform3(-4i8..4), 0..60),
            within in prop_oneof![Just(0.0), Just(1.0), 0.1f64..3.0],
        ) {
            let mut mesh = EditMesh::new();
            for place in &places {
                let [x, y, z] = place.map(|at| f32::from(at) * 0.5);
                mesh.add_vertex(Vec3::new(x, y, z)).expect("room");
            }
            let mut kept: Vec<VertexId> = Vec::new();
            let mut expected = Vec::new();
            for vertex in mesh.vertices() {
                let is_near = |other: &&VertexId| mesh.point(**other).distance(mesh.point(vertex)) <= within;
                match kept.iter().find(is_near) {
                    Some(&of) => expected.push(DoubledVertex { vertex, of }),
                    None => kept.push(vertex),
                }
            }
            prop_assert_eq!(mesh.doubled_vertices(within), expected);
        }
    }
}
