//! Limited dissolve: flat areas become one face, straight lines one edge.

use trigon_math::{DVec3, elementary, unit_or_zero};

use super::super::region::Region;
use super::super::tables::IndexTable;
use super::Dissolved;
use super::merge::OnRefusal;
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
    /// Faces of different materials stay apart, as at seams and sharp edges; so do faces without area. Faces
    /// that would have a hole together stay as they are.
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
        let edges = self.flat_edges(&region, least_cosine);
        let vertices = region.vertices(self);
        let before = self.vertex_count();
        self.whole(|mesh| {
            let faces = mesh.merge_across(&edges, OnRefusal::Skip)?;
            for vertex in vertices {
                if mesh.has_vertex(vertex) && mesh.is_straight(vertex, least_cosine) {
                    // One that a face needs stays.
                    mesh.join_edges(vertex).ok();
                }
            }
            Ok(Dissolved { faces, removed_vertices: before - mesh.vertex_count() })
        })
    }

    /// The edges between faces of a region that were gathered around the same first face.
    fn flat_edges(&self, region: &Region, least_cosine: f64) -> Vec<EdgeId> {
        let mut seeds = IndexTable::new(self.face_capacity(), region.faces.len());
        let normals: Vec<DVec3> = region.faces.iter().map(|&face| self.unit_normal(face)).collect();
        let normal =
            |face: FaceId| region.faces.binary_search(&face).map_or(DVec3::ZERO, |index| normals[index]);
        let mut edges = Vec::new();
        let mut waiting = Vec::new();
        for &seed in &region.faces {
            if seeds.get(seed.0).is_some() || normal(seed) == DVec3::ZERO {
                continue;
            }
            seeds.insert(seed.0, seed.0);
            waiting.push(seed);
            while let Some(face) = waiting.pop() {
                for corner in self.face_corners(face) {
                    let edge = self.corner_edge(corner);
                    let other = self.corner_face(self.radial_next(corner));
                    if !self.may_dissolve(edge) || normal(other).dot(normal(seed)) < least_cosine {
                        continue;
                    }
                    match seeds.get(other.0) {
                        None if normal(other) != DVec3::ZERO => {
                            seeds.insert(other.0, seed.0);
                            waiting.push(other);
                            edges.push(edge);
                        }
                        Some(gathered) if gathered == seed.0 => edges.push(edge),
                        _ => {}
                    }
                }
            }
        }
        edges
    }

    /// Whether nothing but the faces' directions speaks for an edge.
    fn may_dissolve(&self, edge: EdgeId) -> bool {
        let is_marked = self.edges[edge.0].flags & (SEAM | SHARP) != 0;
        let material = |corner| self.material(self.corner_face(corner));
        !is_marked && self.merging_pair(edge).is_some_and(|[a, b]| material(a) == material(b))
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
