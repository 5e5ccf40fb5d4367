use std::cmp::Ordering;

use proptest::prelude::*;
use trigon_math::{DVec3, Vec3, side_of_triangle};
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, meshes};

fn hull_of(points: &[[i8; 3]]) -> Result<(EditMesh, ConvexHull), Refusal> {
    let mut mesh = EditMesh::new();
    let vertices: Vec<VertexId> = points
        .iter()
        .map(|&point| mesh.add_vertex(Vec3::from(point.map(f32::from))).expect("room"))
        .collect();
    let hull = mesh.convex_hull(&vertices, &HullSettings::default())?;
    mesh.check_structure().expect("whole");
    Ok((mesh, hull))
}

/// Whether no point is in front of a face, tested with each three of its corners that are not on a line.
fn contains(mesh: &EditMesh, face: FaceId, points: &[DVec3]) -> bool {
    let corners: Vec<DVec3> = mesh.face_vertices(face).map(|vertex| mesh.point(vertex)).collect();
    let triples = (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]);
    triples.into_iter().all(|triple| {
        points.iter().all(|&point| side_of_triangle(triple, point) != Ordering::Greater)
            && corners.iter().all(|&corner| side_of_triangle(triple, corner) == Ordering::Equal)
    })
}

#[test]
fn a_full_grid_of_points_becomes_a_cube() {
    let points: Vec<[i8; 3]> =
        (0..4).flat_map(|x| (0..4).flat_map(move |y| (0..4).map(move |z| [x, y, z]))).collect();
    let (mesh, hull) = hull_of(&points).expect("possible");
    assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (8, 12, 6), "quads");
    assert_eq!((hull.faces.len(), mesh.volume()), (6, 27.0));
}

#[test]
fn a_closed_box_is_its_own_hull_and_inner_faces_go() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let before = cube.clone();
    let vertices: Vec<VertexId> = cube.vertices().collect();
    let hull = cube.convex_hull(&vertices, &HullSettings::default()).expect("possible");
    assert_eq!((hull.faces.len(), hull.removed), (6, 0));
    assert!(cube == before, "nothing changed");
    cube.flip_face(FaceId(0)).expect("it exists");
    let hull = cube.convex_hull(&vertices, &HullSettings::default()).expect("possible");
    assert_eq!(hull.removed, 1, "the one that looked inwards");
    assert!(cube.is_watertight());
    assert!((cube.volume() - 8.0).abs() < 1e-12, "{}", cube.volume());
}

#[test]
fn what_is_flat_or_not_finite_is_refused() {
    let flat = hull_of(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [3, 7, 0]]).expect_err("flat");
    assert!(flat.to_string().contains("plane"), "{flat}");
    assert!(hull_of(&[[0, 0, 0], [1, 1, 1], [2, 2, 2], [3, 3, 3]]).is_err(), "a line");
    assert!(hull_of(&[[1, 1, 1]; 5]).is_err(), "a point");
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    cube.set_position(VertexId(0), Vec3::NAN);
    let vertices: Vec<VertexId> = cube.vertices().collect();
    assert!(cube.convex_hull(&vertices, &HullSettings::default()).is_err());
}

proptest! {
    /// Small coordinates: many points in one plane, on one line, or in the same position.
    #[test]
    fn a_hull_contains_all_points_and_is_convex(
        points in prop::collection::vec(prop::array::uniform3(-3i8..4), 4..60),
    ) {
        if let Ok((mesh, hull)) = hull_of(&points) {
            prop_assert!(mesh.is_watertight());
            prop_assert_eq!(mesh.vertex_count() + mesh.face_count(), mesh.edge_count() + 2);
            let points: Vec<DVec3> = points.iter().map(|&point| DVec3::from(point.map(f64::from))).collect();
            for &face in &hull.faces {
                prop_assert!(contains(&mesh, face, &points), "{face}");
            }
            // Each vertex is a corner: three planes at least.
            prop_assert!(mesh.vertices().all(|vertex| mesh.vertex_faces(vertex).count() > 2));
        }
    }

    #[test]
    fn a_hull_of_any_vertices_keeps_every_rule(start in meshes(), bits in any::<u64>(), replace: bool) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        let vertices: Vec<VertexId> = mesh.vertices().filter(|vertex| bits >> (vertex.0 % 64) & 1 != 0).collect();
        let outcome = check_operation(&mesh, |mesh| mesh.convex_hull(&vertices, &HullSettings { replace }));
        if let Some((after, hull)) = outcome.map_err(TestCaseError::fail)? {
            let points: Vec<DVec3> = vertices.iter().map(|&vertex| mesh.point(vertex)).collect();
            prop_assert!(hull.faces.iter().all(|&face| contains(&after, face, &points)));
        }
    }
}
