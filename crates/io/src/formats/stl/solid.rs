//! The triangles of a solid, with merged vertices.

use std::collections::HashMap;

use trigon_math::DVec3;

use crate::error::LoadError;
use crate::import::Import;
use crate::polygons::{Polygons, check_vertices};

/// The triangles of a solid, whose vertices are united.
#[derive(Default)]
pub(super) struct Solid {
    pub(super) polygons: Polygons,
    /// Vertices by the bits of their coordinates.
    known: HashMap<[u64; 3], u32>,
}

impl Solid {
    pub(super) fn named(name: String) -> Self {
        Self { polygons: Polygons { name, ..Polygons::default() }, known: HashMap::new() }
    }

    fn vertex(&mut self, place: DVec3) -> u32 {
        // Adding zero makes −0 and +0 the same.
        let bits = (place + DVec3::ZERO).to_array().map(f64::to_bits);
        *self.known.entry(bits).or_insert_with(|| {
            self.polygons.positions.push(place);
            self.polygons.positions.len() as u32 - 1
        })
    }

    pub(super) fn push(&mut self, import: &Import<'_>, corners: &[DVec3]) -> Result<(), LoadError> {
        for &corner in corners {
            let vertex = self.vertex(corner);
            self.polygons.corner_vertices.push(vertex);
        }
        self.polygons.face_sizes.push(corners.len() as u32);
        check_vertices(import, self.polygons.positions.len() as u64)
    }
}
