//! Joining pairs of triangles into quads.

use fixedbitset::FixedBitSet;
use trigon_math::{DVec3, elementary::acos};

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId};
use crate::layers::{LayerKind, LayerValues};
use crate::numbering::{Numbering, sorted_once};
use crate::records::{SEAM, SHARP};
use crate::refusal::Refusal;

/// Which pairs of triangles may become quads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadLimits {
    /// The largest angle between both triangles' normals, in radians, 0 to π.
    pub face_angle: f64,
    /// The largest deviation of each angle of a quad from a right angle, in radians, 0 to π.
    pub shape_angle: f64,
}

impl Default for QuadLimits {
    /// 40° each, as in Blender.
    fn default() -> Self {
        let angle = 40.0f64.to_radians();
        Self { face_angle: angle, shape_angle: angle }
    }
}

/// A pair of triangles that may be joined.
struct Candidate {
    /// How far it is from a level rectangle, in radians.
    error: f64,
    edge: EdgeId,
    faces: [FaceId; 2],
}

impl EditMesh {
    /// Joins pairs of triangles into convex quads, and returns these. Other faces may be given;
    /// they are unchanged.
    ///
    /// The pairs that differ least from a flat rectangle come first: by the angle between the
    /// normals plus the largest deviation of a corner's angle from 90°, then by the id of the edge.
    /// Each triangle is in at most one pair. A pair is not joined
    ///
    /// - beyond the limits,
    /// - along a seam, a sharp or a creased edge, or one with other than two sides,
    /// - where texture coordinates or colours differ on both sides of the edge,
    /// - if materials or shading of the faces differ, or their windings are opposite,
    /// - if a triangle has no area or a position that is not finite,
    /// - if the quad would lie on another face.
    ///
    /// A quad keeps the id of the face that comes first at the edge. Blender respects seams and values only
    /// on request.
    ///
    /// # Errors
    /// No face is given, one does not exist, or a limit is not within 0 to π.
    pub fn tris_to_quads(&mut self, faces: &[FaceId], limits: QuadLimits) -> Result<Vec<FaceId>, Refusal> {
        require(faces, "joining triangles", "at least two triangles")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        for value in [limits.face_angle, limits.shape_angle] {
            if !(0.0..=std::f64::consts::PI).contains(&value) {
                let (parameter, range) = ("the largest angle", "0 to π");
                return Err(Refusal::OutOfRange { parameter, value, range });
            }
        }
        let mut faces: Vec<u32> = sorted_once(faces.iter().map(|face| face.0).collect());
        faces.retain(|&face| self.faces[face].size == 3);
        let numbering = Numbering::new(&faces, self.face_capacity());
        let mut candidates = self.pairs_to_join(&faces, &numbering, limits);
        candidates.sort_unstable_by(|a, b| a.error.total_cmp(&b.error).then(a.edge.cmp(&b.edge)));
        let mut is_joined = FixedBitSet::with_capacity(faces.len());
        let mut quads = Vec::new();
        for candidate in candidates {
            let indices = candidate.faces.map(|face| numbering.get(face.0).expect("it is a candidate"));
            if indices.iter().all(|&index| !is_joined.contains(index)) {
                // A quad that would lie on another face is refused.
                if let Ok(quad) = self.join_faces(candidate.edge) {
                    indices.iter().for_each(|&index| is_joined.insert(index));
                    quads.push(quad);
                }
            }
        }
        quads.sort_unstable();
        Ok(quads)
    }

    fn pairs_to_join(&self, faces: &[u32], numbering: &Numbering, limits: QuadLimits) -> Vec<Candidate> {
        let mut candidates = Vec::new();
        for &face in faces {
            for corner in self.face_corners(FaceId(face)) {
                let edge = self.corner_edge(corner);
                let Some([one, two]) = self.edge_pair(edge) else { continue };
                // Each edge is looked at from its first side.
                let pair = [one, two].map(|corner| self.corner_face(corner));
                if one != corner || numbering.get(pair[1].0).is_none() || !self.may_join(edge, one, two) {
                    continue;
                }
                if let Some(error) = self.error_of_quad(one, two, limits) {
                    candidates.push(Candidate { error, edge, faces: pair });
                }
            }
        }
        candidates
    }

    /// Whether nothing but the shape speaks against a quad.
    fn may_join(&self, edge: EdgeId, one: CornerId, two: CornerId) -> bool {
        let record = &self.edges[edge.0];
        let faces = [one, two].map(|corner| &self.faces[self.corners[corner.0].face]);
        let is_marked = record.flags & (SEAM | SHARP) != 0 || record.crease > 0.0;
        let is_wound_alike = self.corner_vertex(one) != self.corner_vertex(two);
        let tips = [one, two].map(|corner| self.corner_vertex(self.previous_corner(corner)));
        !is_marked
            && is_wound_alike
            && tips[0] != tips[1]
            && faces[0].material == faces[1].material
            && faces[0].flags == faces[1].flags
            && self.has_equal_values(one, self.next_corner(two))
            && self.has_equal_values(self.next_corner(one), two)
    }

    fn has_equal_values(&self, a: CornerId, b: CornerId) -> bool {
        self.corner_layers.iter().all(|layer| match (&layer.values, layer.kind) {
            (LayerValues::Vec2(column), LayerKind::Uv) => column[a.0] == column[b.0],
            (LayerValues::Vec4(column), LayerKind::Color) => column[a.0] == column[b.0],
            _ => true,
        })
    }

    /// How far the quad of two triangles is from a level rectangle; `None` beyond the limits.
    fn error_of_quad(&self, one: CornerId, two: CornerId, limits: QuadLimits) -> Option<f64> {
        let point = |corner: CornerId| self.point(self.corner_vertex(corner));
        let (a, b) = (point(one), point(two));
        let [p, q] = [one, two].map(|corner| point(self.previous_corner(corner)));
        let normals = [(b - a).cross(p - a), (a - b).cross(q - b)];
        let face_angle = angle(normals[0], normals[1])?;
        // At the ends of the edge both triangles add up, so that a reflex corner is seen.
        let corners = [
            angle(b - a, p - a)? + angle(b - a, q - a)?,
            angle(a - b, p - b)? + angle(a - b, q - b)?,
            angle(a - p, b - p)?,
            angle(a - q, b - q)?,
        ];
        let right = std::f64::consts::FRAC_PI_2;
        let shape = corners.iter().fold(0.0f64, |most, corner| most.max((corner - right).abs()));
        let is_convex = corners.iter().all(|&corner| corner < std::f64::consts::PI);
        let is_within = face_angle <= limits.face_angle && shape <= limits.shape_angle;
        (is_convex && is_within).then_some(face_angle + shape)
    }
}

/// The angle between two vectors; `None` if one has no direction.
fn angle(a: DVec3, b: DVec3) -> Option<f64> {
    let (a, b) = (a.try_normalize()?, b.try_normalize()?);
    Some(acos(a.dot(b).clamp(-1.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{Vec2, Vec3};
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::VertexId;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    fn all(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    fn triangles(mesh: trigon_mesh::Mesh) -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(mesh));
        mesh.triangulate_faces(&all(&mesh)).expect("faces");
        mesh
    }

    #[test]
    fn triangulated_boxes_and_grids_come_back() {
        let mut mesh = triangles(primitives::cube(2.0));
        let quads = mesh.tris_to_quads(&all(&mesh), QuadLimits::default()).expect("triangles");
        assert_eq!((quads.len(), mesh.face_count(), mesh.edge_count()), (6, 6, 12), "a cube");
        let mut mesh = triangles(primitives::grid(5.0, 4.0, 5, 4));
        mesh.tris_to_quads(&all(&mesh), QuadLimits::default()).expect("triangles");
        assert!(mesh.face_count() == 20 && mesh.faces().all(|face| mesh.face_size(face) == 4), "a grid");
        mesh.check_structure().expect("whole");
        keeps_affine_values(&mesh).expect("corners keep their values");
    }

    #[test]
    fn seams_marks_and_materials_keep_triangles_apart() {
        let count = |change: &dyn Fn(&mut EditMesh, EdgeId, FaceId)| {
            let mut mesh = triangles(primitives::plane(1.0, 1.0));
            let inner = mesh.edges().find(|&edge| !mesh.is_boundary(edge)).expect("a diagonal");
            change(&mut mesh, inner, FaceId(1));
            mesh.tris_to_quads(&all(&mesh), QuadLimits::default()).expect("triangles").len()
        };
        assert_eq!(count(&|_, _, _| {}), 1, "a quad");
        assert_eq!(count(&|mesh, edge, _| mesh.set_seam(edge, true)), 0, "a seam");
        assert_eq!(count(&|mesh, edge, _| mesh.set_sharp(edge, true)), 0, "a sharp edge");
        assert_eq!(count(&|mesh, edge, _| mesh.set_crease(edge, 0.5)), 0, "a crease");
        assert_eq!(count(&|mesh, _, face| mesh.set_material(face, 1)), 0, "two materials");
        let move_uv = |mesh: &mut EditMesh, edge: EdgeId, _: FaceId| {
            let corner = mesh.edge_corners(edge).next().expect("two");
            mesh.set_uv(0, corner, Vec2::ONE * 9.0);
        };
        assert_eq!(count(&move_uv), 0, "texture coordinates are cut there");
        let turn = |mesh: &mut EditMesh, _: EdgeId, face: FaceId| mesh.flip_face(face).expect("it is there");
        assert_eq!(count(&turn), 0, "wound in opposite ways");
    }

    #[test]
    fn the_best_pair_comes_first_and_limits_hold() {
        // A square in two triangles, and a third beside it that would make a leaning quad.
        let mut mesh = EditMesh::new();
        let places = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 1.0)];
        let v: Vec<VertexId> =
            places.iter().map(|&(x, y)| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room")).collect();
        for [a, b, c] in [[1, 4, 2], [0, 1, 2], [0, 2, 3]] {
            mesh.add_face(&[v[a], v[b], v[c]]).expect("three");
        }
        let wide = QuadLimits { face_angle: 1.0, shape_angle: 1.0 };
        let mut first = mesh.clone();
        first.tris_to_quads(&all(&mesh), wide).expect("triangles");
        assert_eq!(first.face_size(FaceId(0)), 3, "the square was better");
        let narrow = QuadLimits { shape_angle: 0.7, ..wide };
        let both = [FaceId(0), FaceId(1)];
        assert_eq!(mesh.clone().tris_to_quads(&both, narrow).expect("triangles").len(), 0, "45° off");
        assert_eq!(mesh.clone().tris_to_quads(&both, wide).expect("triangles").len(), 1, "within 1 rad");
        mesh.set_position(v[3], Vec3::new(0.0, 0.0, 1.0));
        let both = [FaceId(1), FaceId(2)];
        let wide = QuadLimits { shape_angle: 3.0, ..wide };
        assert_eq!(mesh.tris_to_quads(&both, wide).expect("triangles").len(), 0, "not level");
        let limits = QuadLimits { face_angle: f64::NAN, ..wide };
        assert!(matches!(mesh.tris_to_quads(&both, limits), Err(Refusal::OutOfRange { .. })), "no angle");
    }

    proptest! {
        #[test]
        fn joining_triangles_keeps_every_rule(start in meshes(), chosen in any::<u64>(), angle in 0.0..3.1) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let all: Vec<FaceId> = mesh.faces().collect();
            // Some have no face.
            drop(mesh.triangulate_faces(&all));
            let faces: Vec<FaceId> = mesh.faces().filter(|face| chosen >> (face.0 % 64) & 1 != 0).collect();
            let limits = QuadLimits { face_angle: angle, shape_angle: angle };
            let outcome = check_operation(&mesh, |mesh| mesh.tris_to_quads(&faces, limits));
            if let Some((after, quads)) = outcome.map_err(TestCaseError::fail)? {
                keeps_affine_values(&after).map_err(TestCaseError::fail)?;
                prop_assert_eq!(after.face_count() + quads.len(), mesh.face_count());
                prop_assert!(quads.iter().all(|&face| after.face_size(face) == 4));
            }
        }
    }
}
