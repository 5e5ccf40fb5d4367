//! Triangulating faces.

use smallvec::SmallVec;
use trigon_math::Vec3;
use trigon_mesh::Triangulator;

use super::delete::require;
use super::parts::{Divided, PartPoint, Parts};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
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
    /// Faces that stay polygons, in part or whole: they visit vertices several times, so not all triangles
    /// over their corners would have three different ones.
    pub left: Vec<FaceId>,
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
    /// a quad is cut along its shorter diagonal, a concave polygon inside its outline. A polygon without such
    /// triangles (without area, or self-intersecting) is cut into any n − 2 triangles, so that all faces are
    /// triangles afterwards except those in [`Triangulated::left`]. Corners keep their values, and triangles
    /// the face's material.
    ///
    /// # Errors
    /// No face is given, one does not exist, or the mesh would have too many elements.
    pub fn triangulate_faces(&mut self, faces: &[FaceId]) -> Result<Triangulated, Refusal> {
        require(faces, "triangulating", "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        let faces = sorted_once(faces.to_vec());
        let corners: u64 = faces.iter().map(|&face| self.face_size(face) as u64).sum();
        self.check_capacity_for(NewElements {
            edges: corners,
            corners: 2 * corners,
            faces: corners,
            ..NewElements::default()
        })?;
        let (mut scratch, mut divided) = (TriangulationScratch::default(), Divided::default());
        let mut left = Vec::new();
        for face in faces {
            if self.face_size(face) == 3 {
                divided.faces.push(face);
                continue;
            }
            let first = divided.faces.len();
            self.triangulate_face(face, &mut scratch, &mut divided);
            left.extend(divided.faces[first..].iter().filter(|&&part| self.face_size(part) > 3));
        }
        divided.faces.retain(|&face| self.face_size(face) == 3);
        Ok(Triangulated { faces: divided.faces, edges: divided.edges, left })
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
        triangulator.polygon(positions, triangles);
        let are_triangles = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|index| points[index as usize].vertex);
            a != b && b != c && c != a
        };
        parts.clear();
        if triangles.len() + 2 == points.len() && triangles.iter().all(are_triangles) {
            triangles.iter().for_each(|&triangle| parts.push(triangle));
        } else {
            clip_any(points, parts);
        }
        self.divide_face(face, points, parts, divided);
    }
}

/// Cuts triangles off a polygon whatever its shape, as long as they have three different
/// vertices and the rest has. What is left when none can be cut off is the last part.
fn clip_any(points: &[PartPoint], parts: &mut Parts) {
    let vertices = sorted_once(points.iter().map(|point| point.vertex).collect());
    let number = |index: u32| {
        let vertex: VertexId = points[index as usize].vertex;
        vertices.binary_search(&vertex).expect("it is one of them")
    };
    // How often each vertex is visited by what is left, and how many are.
    let mut visits = vec![0u32; vertices.len()];
    (0..points.len() as u32).for_each(|index| visits[number(index)] += 1);
    let mut different = vertices.len();
    // The outline as a stack that the rest of the polygon is moved to, round after round.
    let mut rest: Vec<u32> = (0..points.len() as u32).collect();
    loop {
        let before = rest.len();
        let mut outline: Vec<u32> = Vec::with_capacity(before);
        for (i, &index) in rest.iter().enumerate() {
            outline.push(index);
            let left = outline.len() + before - i - 1;
            let [.., a, b, c] = outline[..] else { continue };
            let needed = visits[number(b)] == 1;
            if left > 3 && number(a) != number(c) && !(needed && different == 3) {
                parts.push([a, b, c]);
                visits[number(b)] -= 1;
                different -= usize::from(needed);
                outline.truncate(outline.len() - 2);
                outline.push(c);
            }
        }
        // The next round begins elsewhere, so that the ends of this one are in its middle.
        outline.rotate_left(1);
        rest = outline;
        if rest.len() == before || rest.len() == 3 {
            break;
        }
    }
    parts.push(rest.iter().copied().collect::<SmallVec<[u32; 8]>>());
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::area_vector;
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::CornerId;
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
        assert_eq!((made.faces.len(), made.edges.len(), made.left.len()), (12, 6, 0), "all is told");
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
        let made = mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        assert_eq!((counts(&mesh), made.left.len()), ([5, 7, 3], 0), "any three");
        let mut mesh = polygon(&[[f32::NAN; 2], [1.0, 0.0], [2.0, 0.0], [f32::INFINITY; 2]]);
        mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        assert_eq!(counts(&mesh), [4, 5, 2], "places do not matter");
    }

    #[test]
    fn a_face_that_visits_a_vertex_twice_is_cut_there() {
        let mut mesh = EditMesh::new();
        let v: Vec<VertexId> = (0..3).map(|_| mesh.add_vertex(Vec3::ZERO).expect("room")).collect();
        mesh.add_face(&[v[0], v[1], v[0], v[2]]).expect("three different");
        let made = mesh.triangulate_faces(&[FaceId(0)]).expect("a face");
        assert_eq!((counts(&mesh), made.left.len()), ([3, 3, 2], 0), "two over the same vertices");
    }

    /// The number of different vertices at these points.
    fn different(points: &[PartPoint], places: &[u32]) -> usize {
        sorted_once(places.iter().map(|&place| points[place as usize].vertex).collect()).len()
    }

    proptest! {
        /// Round a few vertices again and again: no part may lie between two, and together they are the polygon.
        #[test]
        fn every_part_of_any_polygon_has_three_vertices(
            walk in prop::collection::vec(0..6_u32, 3..24)
        ) {
            let mut walk = walk;
            walk.dedup();
            while walk.len() > 1 && walk.first() == walk.last() {
                walk.pop();
            }
            let point = |&vertex: &u32| PartPoint { vertex: VertexId(vertex), corner: CornerId(0), is_taken: false };
            let points: Vec<PartPoint> = walk.iter().map(point).collect();
            let all: Vec<u32> = (0..points.len() as u32).collect();
            prop_assume!(different(&points, &all) >= 3);
            let mut parts = Parts::default();
            clip_any(&points, &mut parts);
            for part in parts.iter() {
                prop_assert!(different(&points, part) >= 3, "{walk:?}: {part:?}");
            }
            let cut = parts.iter().take(parts.len() - 1);
            prop_assert!(cut.clone().all(|part| part.len() == 3 && different(&points, part) == 3), "{parts:?}");
            prop_assert_eq!(parts.iter().map(|part| part.len() - 2).sum::<usize>(), walk.len() - 2, "{:?}", parts);
        }

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
                for face in faces.iter().filter(|face| !made.left.contains(face)) {
                    prop_assert!(after.has_face(*face), "it is one of its triangles");
                }
            }
        }
    }
}
