//! Triangulating faces.

use trigon_math::{Vec3, area_vector};
use trigon_mesh::Triangulator;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::euler::{Divided, PartPoint, Parts};
use crate::ids::{EdgeId, FaceId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// The result of a triangulation.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Triangulated {
    /// The triangles, including those that were triangles before; for each face the one with its id
    /// comes first.
    pub faces: Vec<FaceId>,
    /// The new edges.
    pub edges: Vec<EdgeId>,
}

/// Memory that is used for one face after another.
#[derive(Default)]
struct TriangulationScratch {
    points: Vec<PartPoint>,
    positions: Vec<Vec3>,
    triangulator: Triangulator,
    triangles: Vec<[u32; 3]>,
    parts: Parts,
}

impl EditMesh {
    /// Cuts faces into triangles over their corners; nothing moves and no vertex is added.
    ///
    /// The triangles are those of [`triangulate_polygon`](trigon_mesh::triangulate_polygon), which are also drawn:
    /// a quad is cut along its shorter diagonal, a concave polygon inside its outline. Others join them where a
    /// polygon has no area or crosses itself, so that there are n − 2 in all and a closed mesh stays closed
    /// ([`Triangulator::complete_polygon`]). Where one of them would lie on another face, on the same vertices, the
    /// polygon is cut from one corner instead. Corners keep their values, and triangles the face's material.
    ///
    /// # Errors
    /// No face is given, one does not exist, or the mesh would have too many elements.
    pub fn triangulate_faces(&mut self, faces: &[FaceId]) -> Result<Triangulated, Refusal> {
        require(faces, "triangulating", "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        let faces = sorted_once(faces.to_vec());
        let cuts: u64 = faces.iter().map(|&face| self.face_size(face) as u64 - 3).sum();
        self.check_capacity_for(NewElements {
            edges: cuts,
            corners: 2 * cuts,
            faces: cuts,
            ..NewElements::default()
        })?;
        let (mut scratch, mut divided) = (TriangulationScratch::default(), Divided::default());
        for face in faces {
            if self.face_size(face) == 3 {
                divided.faces.push(face);
                continue;
            }
            self.triangulate_face(face, &mut scratch, &mut divided);
        }
        Ok(Triangulated { faces: divided.faces, edges: divided.edges })
    }

    fn triangulate_face(&mut self, face: FaceId, scratch: &mut TriangulationScratch, divided: &mut Divided) {
        let TriangulationScratch { points, positions, triangulator, triangles, parts } = scratch;
        points.clear();
        points.extend(self.face_corners(face).map(|corner| PartPoint {
            vertex: self.corner_vertex(corner),
            corner,
            is_taken: false,
        }));
        positions.clear();
        positions.extend(points.iter().map(|point| self.position(point.vertex)));
        triangles.clear();
        triangulator.complete_polygon(positions, triangles);
        if self.doubles_face(face, points, triangles)
            && let Some(fan) = self.fan_beside_faces(face, points)
        {
            *triangles = fan;
        }
        parts.clear();
        triangles.iter().for_each(|&triangle| parts.push(triangle));
        self.divide_face(face, points, parts, divided);
    }

    /// Whether one of the triangles of a face has the vertices of another face.
    fn doubles_face(&self, face: FaceId, points: &[PartPoint], triangles: &[[u32; 3]]) -> bool {
        triangles.iter().any(|triangle| {
            let [a, b, c] = triangle.map(|point| points[point as usize].vertex);
            let Some(edge) = self.find_edge(a, b) else { return false };
            self.edge_faces(edge).any(|other| {
                other != face && self.face_size(other) == 3 && self.face_vertices(other).any(|at| at == c)
            })
        })
    }

    /// The triangles from one corner of a face to all its other edges, where none of them lies on another face: of those
    /// from all corners the ones with the least area in sum, which fold the least.
    fn fan_beside_faces(&self, face: FaceId, points: &[PartPoint]) -> Option<Vec<[u32; 3]>> {
        let count = points.len() as u32;
        let fan = |from: u32| -> Vec<[u32; 3]> {
            let corner = |step: u32| (from + step) % count;
            (1..count - 1).map(|step| [from, corner(step), corner(step + 1)]).collect()
        };
        let area = |fan: &Vec<[u32; 3]>| -> f64 {
            let of = |triangle: &[u32; 3]| {
                area_vector(triangle.map(|point| self.point(points[point as usize].vertex))).length()
            };
            fan.iter().map(of).sum()
        };
        let fans = (0..count).map(fan).filter(|fan| !self.doubles_face(face, points, fan));
        fans.min_by(|a, b| area(a).total_cmp(&area(b)))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::VertexId;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    fn all(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    fn polygon(places: &[[f32; 2]]) -> EditMesh {
        let mut mesh = EditMesh::new();
        let add = |&[x, y]: &[f32; 2]| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room");
        let vertices: Vec<VertexId> = places.iter().map(add).collect();
        mesh.add_face(&vertices).expect("a polygon");
        mesh
    }

    #[test]
    fn a_cube_has_twelve_triangles() {
        let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
        let made = mesh.triangulate_faces(&all(&mesh)).expect("six faces");
        assert_eq!(counts(&mesh), [8, 18, 12], "two in each face");
        assert_eq!((made.faces.len(), made.edges.len()), (12, 6), "all is told");
        keeps_affine_values(&mesh).expect("corners keep their values");
        let again = mesh.triangulate_faces(&made.faces).expect("triangles stay");
        assert_eq!((again.faces.len(), again.edges.len()), (12, 0), "nothing is left to do");
    }

    #[test]
    fn a_concave_polygon_is_cut_inside() {
        let mut mesh = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 1.0], [1.0, 1.0], [0.0, 4.0]]);
        mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        let area = |face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).z;
        assert!(all(&mesh).iter().all(|&face| area(face) > 0.0), "none is turned over");
        let sum: f64 = mesh.faces().map(area).sum();
        // The square without the trapezoid between the horns: 16 - (4 + 2) / 2 · 3.
        assert_eq!((sum, mesh.face_count()), (7.0, 4), "n - 2, and together the polygon");
    }

    #[test]
    fn polygons_without_area_have_triangles_too() {
        let mut mesh = polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 0.0]]);
        mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        assert_eq!(counts(&mesh), [5, 7, 3], "any three");
        let mut mesh = polygon(&[[f32::NAN; 2], [1.0, 0.0], [2.0, 0.0], [f32::INFINITY; 2]]);
        mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        assert_eq!(counts(&mesh), [4, 5, 2], "places do not matter");
    }

    /// A cap of three vertices lies in a corner of a polygon that runs around its third one: as a cut corner of a solid
    /// whose edge was dissolved.
    #[test]
    fn triangulating_laid_a_triangle_on_its_neighbour() {
        let mut mesh = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.2], [0.0, 2.0]]);
        let vertices: Vec<VertexId> = mesh.face_vertices(FaceId(0)).collect();
        let cap = mesh.add_face(&[vertices[4], vertices[3], vertices[2]]).expect("on the other side");
        let made = mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        mesh.check_structure().expect("whole");
        let set = |face: FaceId| {
            let mut vertices: Vec<VertexId> = mesh.face_vertices(face).collect();
            vertices.sort_unstable();
            vertices
        };
        assert_eq!(made.faces.len(), 3);
        assert!(made.faces.iter().all(|&face| set(face) != set(cap)), "none lies on the cap");
        let area = |face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).z;
        assert!(made.faces.iter().all(|&face| area(face) > 0.0), "and none is turned over");
    }

    proptest! {
        #[test]
        fn triangulating_keeps_every_rule(start in meshes(), chosen in any::<u64>()) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let faces: Vec<FaceId> = mesh.faces().filter(|face| chosen >> (face.0 % 64) & 1 != 0).collect();
            let outcome = check_operation(&mesh, |mesh| mesh.triangulate_faces(&faces));
            if let Some((after, made)) = outcome.map_err(TestCaseError::fail)? {
                keeps_affine_values(&after).map_err(TestCaseError::fail)?;
                prop_assert_eq!(after.vertex_count(), mesh.vertex_count());
                prop_assert!(made.faces.iter().all(|&face| after.face_size(face) == 3));
                // Each cut adds one face and two corners, whatever the shape.
                let cuts = after.face_count() - mesh.face_count();
                prop_assert_eq!(after.corner_count(), mesh.corner_count() + 2 * cuts);
                for face in &faces {
                    prop_assert!(after.has_face(*face), "it is one of its triangles");
                }
            }
        }
    }
}
