//! How large the result of a modifier may be: known before it runs, so that what would take too long or too much memory does
//! not begin.

use crate::edit_mesh::EditMesh;
use crate::modifier::{BevelModifier, Modifier};
use crate::refusal::Refusal;

impl EditMesh {
    /// The most faces of an evaluated mesh.
    pub const MOST_EVALUATED_FACES: u64 = 1 << 24;

    /// How many faces the surface has after so many levels of subdivision.
    #[must_use]
    pub fn subdivided_face_count(&self, levels: u32) -> u64 {
        match levels {
            0 => self.face_count() as u64,
            // One quad for each corner, then four for each quad.
            _ => (self.corner_count() as u64).saturating_mul(4u64.saturating_pow(levels - 1)),
        }
    }

    /// At most so many faces, or vertices of a mesh with more of these, has the mesh after a modifier.
    #[must_use]
    pub fn size_after(&self, modifier: &Modifier) -> u64 {
        let size = self.face_count().max(self.vertex_count()) as u64;
        match modifier {
            Modifier::Subdivision(settings) if self.face_count() > 0 => {
                self.subdivided_face_count(settings.levels)
            }
            Modifier::Mirror(settings) => {
                size << settings.axes.iter().filter(|is_mirrored| **is_mirrored).count()
            }
            Modifier::Array(settings) => size.saturating_mul(u64::from(settings.count)),
            Modifier::Bevel(settings) => size.saturating_add(self.bevel_size(settings)),
            // Cuts make parts of faces. How large the other object is, is checked where it is known.
            Modifier::Boolean(_) => 4 * size,
            // Two layers, and a rim along each edge.
            Modifier::Solidify(_) => 2 * size + self.edge_count() as u64,
            Modifier::Triangulate(_) | Modifier::Decimate(_) => (self.corner_count() as u64).max(size),
            Modifier::Screw(settings) => {
                let swept = self.edges_to_sweep().len() + self.vertices_to_sweep().len();
                let steps = u64::from(settings.steps) * u64::from(settings.turns);
                // A step adds as many vertices as edges, and one more for each outline.
                size.saturating_add(steps.saturating_mul(2 * swept as u64))
            }
            Modifier::Subdivision(_) | Modifier::Weld(_) => size,
        }
    }

    /// How many faces a bevel adds: a strip along each edge, and a patch at each end.
    fn bevel_size(&self, settings: &BevelModifier) -> u64 {
        let edges = self.edges_to_bevel(settings).len() as u64;
        let segments = u64::from(settings.segments);
        edges.saturating_mul(segments.saturating_add(2 * segments * segments))
    }

    /// Refuses a modifier whose result would be larger than any that is evaluated.
    pub(super) fn check_size_after(&self, modifier: &Modifier) -> Result<(), Refusal> {
        if self.size_after(modifier) > Self::MOST_EVALUATED_FACES {
            let reason = match modifier {
                Modifier::Subdivision(_) => {
                    "the surface would have more than 16,777,216 faces: take fewer levels"
                }
                _ => {
                    "the result could have more than 16,777,216 faces: use smaller parameters, or do it to a part"
                }
            };
            return Err(Refusal::NotPossible { operation: modifier.name(), reason });
        }
        Ok(())
    }
}
