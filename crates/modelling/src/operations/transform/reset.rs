//! Moves vertices back to their original positions.

use super::super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::VertexId;
use crate::refusal::Refusal;

impl EditMesh {
    /// Puts vertices back to their first positions: where they were made, or where
    /// [`Self::set_first_position`] said. Normals that were given at the faces there are cleared. How
    /// many vertices moved.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn reset_vertices(&mut self, vertices: &[VertexId]) -> Result<usize, Refusal> {
        require(vertices, "resetting vertices", "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let is_away = |vertex: &VertexId| {
            // By bits: also a place that is not a number is left or returned to.
            let bits = |position: trigon_math::Vec3| position.to_array().map(f32::to_bits);
            bits(self.position(*vertex)) != bits(self.first_position(*vertex))
        };
        let mut moved: Vec<VertexId> = vertices.iter().copied().filter(is_away).collect();
        moved.sort_unstable();
        moved.dedup();
        let mut faces: Vec<_> = moved.iter().flat_map(|&vertex| self.vertex_faces(vertex)).collect();
        faces.sort_unstable();
        faces.dedup();
        for face in faces {
            self.clear_custom_normals(face);
        }
        for &vertex in &moved {
            self.set_position(vertex, self.first_position(vertex));
        }
        Ok(moved.len())
    }
}
