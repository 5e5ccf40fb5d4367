//! The triangles of a solid, with merged vertices.

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
}

impl Solid {
    pub(super) fn named(name: String) -> Self {
        Self { polygons: Polygons { name, ..Polygons::default() }, known: VertexTable::default() }
    }

    /// A solid with room for so many triangles.
    pub(super) fn with_room(triangles: usize) -> Self {
        let mut solid = Self::default();
        solid.polygons.corner_vertices.reserve_exact(3 * triangles);
        solid.polygons.face_sizes.reserve_exact(triangles);
        solid
    }

    fn vertex(&mut self, place: DVec3) -> u32 {
        // Adding zero makes −0 and +0 the same.
        let bits = |place: DVec3| (place + DVec3::ZERO).to_array().map(f64::to_bits);
        let positions = &mut self.polygons.positions;
        self.known.number(&bits(place), |vertex| bits(positions[vertex as usize])).unwrap_or_else(|new| {
            positions.push(place);
            new
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
