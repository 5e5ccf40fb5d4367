//! Findings about walls: how thick the body is behind each face.

use trigon_math::{Bvh, DVec3, Ray, RayHit, Vec3};

use super::touching::FaceTriangle;
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;

/// How thick the body is behind a face.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FaceThickness {
    /// Which.
    pub face: FaceId,
    /// The shortest way through the body against the face's normal, in metres.
    pub thickness: f64,
}

/// Where each triangle is measured: the weights of its corners. Its middle, and a point near each corner, so that a wedge
/// is found where it is thin.
const SAMPLES: [[f64; 3]; 4] =
    [[1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0], [0.9, 0.05, 0.05], [0.05, 0.9, 0.05], [0.05, 0.05, 0.9]];

/// How far a sample may be off its face, as a fraction of the largest coordinate: what rounding to f32 makes of it.
const ROUNDING: f32 = 4.0 * f32::EPSILON;

impl EditMesh {
    /// The thickness behind every face, in ascending order of ids: from four points of each of its triangles, against
    /// its normal, to where the body ends. The ways are found in f32 and measured in f64.
    ///
    /// Without an entry are faces without area, faces at positions that are not finite, and those behind which the body
    /// does not end, as behind an open surface.
    #[must_use]
    pub fn face_thicknesses(&self) -> Vec<FaceThickness> {
        let triangles = self.triangles();
        let positions: Vec<[Vec3; 3]> = triangles.iter().map(|triangle| triangle.positions).collect();
        let walls = BodyRays { tree: Bvh::new(&positions), triangles: &triangles };
        let mut found: Vec<FaceThickness> = Vec::new();
        for triangle in &triangles {
            let normal = self.face_normal(triangle.face);
            let ways = SAMPLES.iter().filter_map(|weights| walls.thickness(triangle, normal, weights));
            let Some(thickness) = ways.min_by(f64::total_cmp) else { continue };
            // The triangles of a face follow each other.
            match found.last_mut().filter(|last| last.face == triangle.face) {
                Some(last) => last.thickness = last.thickness.min(thickness),
                None => found.push(FaceThickness { face: triangle.face, thickness }),
            }
        }
        found
    }

    /// The faces behind which the body is thinner than `least` metres. See [`Self::face_thicknesses`].
    #[must_use]
    pub fn thin_faces(&self, least: f64) -> Vec<FaceThickness> {
        let mut found = self.face_thicknesses();
        found.retain(|face| face.thickness < least);
        found
    }
}

/// The faces that rays end at.
struct BodyRays<'a> {
    tree: Bvh,
    triangles: &'a [FaceTriangle],
}

impl BodyRays<'_> {
    /// The way from a point of a triangle against the normal of its face, to the first face that looks away.
    fn thickness(&self, from: &FaceTriangle, normal: DVec3, weights: &[f64; 3]) -> Option<f64> {
        let corners = from.positions.map(Vec3::as_dvec3);
        let origin = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let ray = Ray { origin: origin.as_vec3(), direction: (-normal).as_vec3() };
        if ray.direction == Vec3::ZERO {
            return None;
        }
        let start = -ROUNDING * ray.origin.abs().max_element();
        let is_end = |hit: &RayHit| {
            let other = &self.triangles[hit.triangle as usize];
            other.face != from.face && normal.dot(area_vector(other)) < 0.0
        };
        let hit = self.tree.nearest_of(&ray, start..f32::INFINITY, is_end)?;
        let end = &self.triangles[hit.triangle as usize];
        let across = area_vector(end);
        let distance = (end.positions[0].as_dvec3() - origin).dot(across) / -normal.dot(across);
        // Along a plane nearly parallel to the ray the tree knows better.
        let hit_distance = f64::from(hit.distance);
        let is_sound = (distance - hit_distance).abs() <= 1e-3 * hit_distance.abs() + f64::from(-start);
        Some(if is_sound { distance } else { hit_distance }.max(0.0))
    }
}

fn area_vector(triangle: &FaceTriangle) -> DVec3 {
    let [a, b, c] = triangle.positions.map(Vec3::as_dvec3);
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::DMat3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::meshes;
    use crate::{Transform, VertexId};

    fn turned(mesh: &mut EditMesh, angle: f64) {
        let vertices: Vec<VertexId> = mesh.vertices().collect();
        let axis = DVec3::new(1.0, 2.0, 3.0);
        let turn = Transform::Rotate { center: DVec3::ZERO, axis, angle, orientation: DMat3::IDENTITY };
        mesh.transform_vertices(&vertices, &turn, None).expect("possible");
    }

    #[test]
    fn a_box_is_as_thick_as_it_is_long() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(1.0));
        let vertices: Vec<VertexId> = mesh.vertices().collect();
        let size = Vec3::new(0.002, 0.03, 0.5);
        vertices.iter().for_each(|&vertex| mesh.set_position(vertex, mesh.position(vertex) * size));
        let expected: Vec<f64> =
            mesh.faces().map(|face| mesh.face_normal(face).abs().dot(size.as_dvec3())).collect();
        for angle in [0.0, 0.7] {
            turned(&mut mesh, angle);
            let found = mesh.face_thicknesses();
            assert_eq!(found.len(), 6, "each face");
            for (found, expected) in found.iter().zip(&expected) {
                // The corners are rounded to f32, at half a metre.
                assert!((found.thickness - expected).abs() < 1e-7, "{found:?} instead of {expected}");
            }
            assert_eq!(mesh.thin_faces(0.01).len(), 2, "both sides of the thin wall");
        }
    }

    #[test]
    fn a_hollow_body_is_as_thick_as_its_wall_and_an_open_surface_has_no_thickness() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces: Vec<Vec<VertexId>> = mesh.faces().map(|face| mesh.face_vertices(face).collect()).collect();
        let inner: Vec<VertexId> = mesh
            .vertices()
            .collect::<Vec<_>>()
            .into_iter()
            .map(|vertex| mesh.add_vertex(mesh.position(vertex) * 0.75).expect("room"))
            .collect();
        for face in faces {
            let inside: Vec<VertexId> =
                face.iter().rev().map(|vertex| inner[vertex.index() as usize]).collect();
            mesh.add_face(&inside).expect("it looks into the cavity");
        }
        let found = mesh.face_thicknesses();
        assert_eq!(found.len(), 12, "outside and inside");
        assert!(found.iter().all(|face| face.thickness == 0.25), "{found:?}");
        let (sheet, _) = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 2, 2));
        assert_eq!(sheet.face_thicknesses(), [], "nothing is behind it");
    }

    /// Whether a ray meets a triangle, and where, by Cramer's rule in f64.
    fn met(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
        let (u, v, w) = (b - a, c - a, origin - a);
        let across = direction.cross(v);
        let determinant = u.dot(across);
        let (s, t) = (w.dot(across) / determinant, direction.dot(w.cross(u)) / determinant);
        let distance = v.dot(w.cross(u)) / determinant;
        let slack = 1e-9;
        (determinant != 0.0 && s > slack && t > slack && s + t < 1.0 - slack && distance > 1e-6)
            .then_some(distance)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// No way is longer than one that a search through all triangles finds.
        #[test]
        fn thickness_is_what_rays_through_all_triangles_find(start in meshes(), angle in 0.0f64..1.0) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            turned(&mut mesh, angle);
            let triangles = mesh.triangles();
            for found in mesh.face_thicknesses() {
                let direction = -mesh.face_normal(found.face);
                let mut shortest = f64::INFINITY;
                for from in triangles.iter().filter(|triangle| triangle.face == found.face) {
                    let corners = from.positions.map(Vec3::as_dvec3);
                    for weights in SAMPLES {
                        let origin = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
                        for other in triangles.iter().filter(|other| other.face != found.face) {
                            if direction.dot(area_vector(other)) > 1e-9
                                && let Some(distance) = met(origin, direction, other.positions.map(Vec3::as_dvec3))
                            {
                                shortest = shortest.min(distance);
                            }
                        }
                    }
                }
                // Nearer are only faces that the search leaves out at their edges, or that touch.
                prop_assert!(found.thickness <= shortest * (1.0 + 1e-5) + 1e-5, "{found:?} {shortest}");
            }
        }
    }
}
