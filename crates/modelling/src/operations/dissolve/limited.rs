//! Limited dissolve: flat areas become one face, straight lines one edge.

use trigon_math::{DVec3, elementary, unit_or_zero};

use super::super::region::Region;
use super::Dissolved;
use super::discs::Discs;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::records::{SEAM, SHARP};
use crate::refusal::Refusal;

/// Settings of a limited dissolve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedDissolve {
    /// The largest angle between the normals of merged faces and that of the first of them, and the largest
    /// bend of a line at a removed vertex: radians, 0 to π.
    pub angle: f64,
}

impl Default for LimitedDissolve {
    /// Five degrees, as in Blender.
    fn default() -> Self {
        Self { angle: 5f64.to_radians() }
    }
}

impl EditMesh {
    /// Merges faces that are coplanar within an angle, and removes vertices on straight lines between two
    /// edges.
    ///
    /// Faces are gathered from the one with the lowest id on: each whose normal is within the angle of that
    /// first one's, so that a gentle curve is not dissolved as a whole. (Blender merges pair after pair.)
    /// Faces of different materials stay apart, as at seams and sharp edges; so do faces without area. A flat
    /// area with a hole becomes two faces or a few more, which meet between the hole and the outline.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the angle is out of its range.
    pub fn dissolve_limited(
        &mut self,
        faces: &[FaceId],
        limits: LimitedDissolve,
    ) -> Result<Dissolved, Refusal> {
        let region = Region::new(self, faces, "limited dissolve")?;
        if !(0.0..=std::f64::consts::PI).contains(&limits.angle) {
            let (parameter, range) = ("the angle", "0 to π");
            return Err(Refusal::OutOfRange { parameter, value: limits.angle, range });
        }
        /// Normals of f32 positions in one plane differ by this much, in radians, at the angle 0.
        const ROUNDING: f64 = 1e-5;
        let least_cosine = elementary::cos((limits.angle + ROUNDING).min(std::f64::consts::PI));
        let groups = Discs::new(self, &region, least_cosine).find();
        let vertices = region.vertices(self);
        let before = self.vertex_count();
        self.whole(|mesh| {
            let mut faces = Vec::new();
            let several = (0..groups.groups.len()).filter(|&number| groups.groups[number].len() > 1);
            for number in several {
                // A group that would lie on another face stays as it is.
                if let Ok(outline) = groups.outline(mesh, number) {
                    faces.push(mesh.unite(&groups, number, &outline));
                }
            }
            for vertex in vertices {
                if mesh.has_vertex(vertex) && mesh.is_straight(vertex, least_cosine) {
                    // One that a face needs stays.
                    mesh.join_edges(vertex).ok();
                }
            }
            Ok(Dissolved { faces, removed_vertices: before - mesh.vertex_count(), left_edges: 0 })
        })
    }

    /// Whether a vertex is between two edges that run straight on and have the same marks.
    fn is_straight(&self, vertex: VertexId, least_cosine: f64) -> bool {
        let mut edges = self.vertex_edges(vertex);
        let (Some(a), Some(b), None) = (edges.next(), edges.next(), edges.next()) else { return false };
        let marks = |edge: EdgeId| (self.edges[edge.0].flags & (SEAM | SHARP), self.crease(edge).to_bits());
        let here = self.point(vertex);
        let [to_a, to_b] =
            [a, b].map(|edge| unit_or_zero(self.point(self.other_vertex(edge, vertex)) - here));
        marks(a) == marks(b) && to_a != DVec3::ZERO && -to_a.dot(to_b) >= least_cosine
    }
}
