//! The triangles of a solid, with merged vertices.

use std::hash::{Hash, Hasher};

use trigon_math::DVec3;

use crate::error::LoadError;
use crate::import::Import;
use crate::polygons::{Polygons, check_vertices};
use crate::vertex_table::VertexTable;

/// The triangles of a solid, whose vertices are united.
#[derive(Default)]
pub(super) struct Solid {
    pub(super) polygons: Polygons,
    /// Vertices by the bits of their coordinates.
    known: VertexTable,
    /// Of the corners that are added.
    hashes: Vec<u64>,
}

impl Solid {
    pub(super) fn named(name: String) -> Self {
        Self { polygons: Polygons { name, ..Polygons::default() }, ..Self::default() }
    }

    /// Adds a face.
    pub(super) fn push(&mut self, import: &Import<'_>, corners: &[DVec3]) -> Result<(), LoadError> {
        self.push_corners(corners);
        self.polygons.face_sizes.push(corners.len() as u32);
        check_vertices(import, self.polygons.positions.len() as u64)
    }

    fn push_corners(&mut self, corners: &[DVec3]) {
        self.known.hash_all(corners.iter().map(Key::new), &mut self.hashes);
        for (corner, &hash) in corners.iter().zip(&self.hashes) {
            let positions = &mut self.polygons.positions;
            let known = |vertex: u32| Key::new(&positions[vertex as usize]);
            let vertex = self.known.number(&Key::new(corner), hash, known);
            let vertex = vertex.unwrap_or_else(|new| {
                positions.push(*corner);
                new
            });
            self.polygons.corner_vertices.push(vertex);
        }
    }
}

/// What tells vertices apart: the bits of their coordinates.
#[derive(PartialEq, Eq)]
struct Key([u64; 3]);

impl Key {
    fn new(position: &DVec3) -> Self {
        // Adding zero makes −0 and +0 the same.
        Self((*position + DVec3::ZERO).to_array().map(f64::to_bits))
    }
}

impl Hash for Key {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // As three numbers, which takes half as long as 24 bytes.
        self.0.iter().for_each(|&bits| state.write_u64(bits));
    }
}
