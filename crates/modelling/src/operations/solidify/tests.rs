use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, meshes, with_affine_values};

fn all(mesh: &EditMesh) -> Vec<FaceId> {
    mesh.faces().collect()
}

/// A flat polygon whose corners are on a circle at random angles, in a tilted plane.
fn polygon(angles: &[f64], tilt: f64) -> EditMesh {
    let mut mesh = EditMesh::new();
    let vertices: Vec<VertexId> = angles
        .iter()
        .map(|&angle| {
            let (sin, cos) = trigon_math::elementary::sin_cos(angle);
            let (up, along) = trigon_math::elementary::sin_cos(tilt);
            mesh.add_vertex(DVec3::new(cos, sin * along, sin * up).as_vec3()).expect("room")
        })
        .collect();
    mesh.add_face(&vertices).expect("a simple outline");
    mesh
}

#[test]
fn a_cube_becomes_hollow_with_walls_of_the_thickness() {
    for (offset, outer, inner) in [(-1.0, 2.0, 1.5), (0.0, 2.25, 1.75), (1.0, 2.5, 2.0)] {
        let (mut cube, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
        let settings = SolidifySettings { thickness: 0.25, offset, ..SolidifySettings::default() };
        let made = cube.solidify_faces(&all(&cube), &settings).expect("possible");
        assert_eq!((made.inner.len(), made.rim.len(), made.vertices.len()), (6, 0, 8));
        assert!(cube.is_watertight());
        let expected: f64 = outer * outer * outer - inner * inner * inner;
        // All positions are exact; the sum is rounded.
        assert!((cube.volume() - expected).abs() < 1e-13, "{} for {expected}", cube.volume());
    }
}

/// A triangle cut off a cube's corner: planes of four different directions, three at each vertex.
#[test]
fn planes_at_any_angle_keep_their_distance() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::dodecahedron(1.0));
    let before: Vec<(DVec3, DVec3)> =
        mesh.faces().map(|face| (mesh.face_center(face), mesh.face_normal(face))).collect();
    let settings = SolidifySettings { thickness: 0.1, ..SolidifySettings::default() };
    let made = mesh.solidify_faces(&all(&mesh), &settings).expect("possible");
    for ((center, normal), &inner) in before.iter().zip(&made.inner) {
        for vertex in mesh.face_vertices(inner) {
            let distance = (mesh.point(vertex) - *center).dot(*normal);
            // Positions of size 1 are rounded to f32.
            assert!((distance + 0.1).abs() < 1e-6, "{distance}");
        }
        assert!(mesh.face_normal(inner).dot(*normal) < -0.999, "it looks inwards");
    }
    let uneven = SolidifySettings { even: false, ..settings.clone() };
    let (mut other, _) = EditMesh::from_mesh(&primitives::dodecahedron(1.0));
    other.solidify_faces(&all(&other), &uneven).expect("possible");
    assert!(other.volume() < mesh.volume(), "thinner walls");
}

#[test]
fn rim_and_second_layer_have_their_materials() {
    let (mut grid, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(2.0, 2.0, 2, 2)));
    let settings =
        SolidifySettings { rim_material: Some(2), inner_material: Some(1), ..SolidifySettings::default() };
    let faces = all(&grid);
    let made = grid.solidify_faces(&faces[..1], &settings).expect("possible");
    assert_eq!((made.inner.len(), made.rim.len()), (1, 4), "the rim is all around");
    assert!(made.rim.iter().all(|&face| grid.material(face) == 2));
    assert_eq!((grid.material(made.inner[0]), grid.material(faces[0])), (1, 0));
    let without = SolidifySettings { rim: false, ..SolidifySettings::default() };
    assert!(grid.solidify_faces(&faces[1..2], &without).expect("possible").rim.is_empty());
}

#[test]
fn what_is_out_of_range_is_refused() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let before = cube.clone();
    let faces = all(&cube);
    let settings = SolidifySettings::default();
    for wrong in [
        SolidifySettings { thickness: -1.0, ..settings.clone() },
        SolidifySettings { thickness: f64::NAN, ..settings.clone() },
        SolidifySettings { offset: 1.5, ..settings.clone() },
    ] {
        assert!(cube.solidify_faces(&faces, &wrong).is_err(), "{wrong:?}");
    }
    assert!(cube.solidify_faces(&[], &settings).is_err(), "no face");
    assert!(cube == before, "nothing changed");
}

proptest! {
    /// A prism: its volume is the area of the polygon times the thickness.
    #[test]
    fn a_flat_polygon_becomes_a_prism(
        angles in prop::collection::btree_set(0u16..1000, 3..12),
        tilt in 0.0f64..1.5,
        thickness in 0.01f64..2.0,
        offset in -1.0f64..1.0,
    ) {
        let angles: Vec<f64> = angles.into_iter().map(|angle| f64::from(angle) / 160.0).collect();
        let mesh = polygon(&angles, tilt);
        let area = mesh.face_area(FaceId(0));
        prop_assume!(area > 0.01);
        let settings = SolidifySettings { thickness, offset, ..SolidifySettings::default() };
        let outcome = check_operation(&mesh, |mesh| mesh.solidify_faces(&[FaceId(0)], &settings));
        let (solid, made) = outcome.map_err(TestCaseError::fail)?.expect("possible");
        prop_assert!(solid.is_watertight());
        prop_assert_eq!(made.rim.len(), angles.len());
        // Positions below 4 are rounded by 2⁻²³ at most in each coordinate; the surface of the prism times that.
        let bound = (2.0 * area + 7.0 * thickness) * 4e-7;
        prop_assert!((solid.volume() - area * thickness).abs() < bound, "{} for {}", solid.volume(), area * thickness);
    }

    /// Of any faces: what is made is closed by itself, nothing of the old faces changes but positions.
    #[test]
    fn a_solidified_region_is_closed(start in meshes(), bits in any::<u64>(), even: bool, offset in -1.0f64..1.0) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        let faces: Vec<FaceId> = mesh.faces().filter(|face| bits >> (face.0 % 64) & 1 != 0).collect();
        prop_assume!(!faces.is_empty());
        let settings = SolidifySettings { thickness: 0.1, offset, even, ..SolidifySettings::default() };
        let outcome = check_operation(&mesh, |mesh| mesh.solidify_faces(&faces, &settings));
        let (after, made) = outcome.map_err(TestCaseError::fail)?.expect("possible");
        // Each step along an edge has one back, where neighbours were wound alike.
        let winds_alike = |mesh: &EditMesh| mesh.edges().all(|edge| {
            mesh.edge_pair(edge).is_none_or(|[a, b]| mesh.corner_vertex(a) != mesh.corner_vertex(b))
                && mesh.edge_corners(edge).count() < 3
        });
        if winds_alike(&mesh) {
            let shell = faces.iter().chain(&made.inner).chain(&made.rim);
            let mut steps = std::collections::BTreeMap::<[VertexId; 2], i32>::new();
            for corner in shell.flat_map(|&face| after.face_corners(face)) {
                let (from, to) = (after.corner_vertex(corner), after.corner_vertex(after.next_corner(corner)));
                *steps.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
            }
            prop_assert!(steps.values().all(|&sum| sum == 0), "open");
        }
        prop_assert!(after.vertices().all(|vertex| after.position(vertex).is_finite()));
        prop_assert!(mesh.faces().all(|face| after.face_vertices(face).eq(mesh.face_vertices(face))));
    }
}

#[test]
fn folded_faces_move_a_limited_way() {
    let mut mesh = EditMesh::new();
    let v = [Vec3::ZERO, Vec3::X, Vec3::new(0.0, 1.0, 1e-4), Vec3::new(0.0, 1.0, -1e-4)]
        .map(|position| mesh.add_vertex(position).expect("room"));
    mesh.add_face(&[v[0], v[1], v[2]]).expect("a triangle");
    mesh.add_face(&[v[1], v[0], v[3]]).expect("a triangle");
    mesh.solidify_faces(&all(&mesh), &SolidifySettings { thickness: 0.1, ..SolidifySettings::default() })
        .expect("possible");
    assert!(mesh.bounds().size().max_element() < 6.0, "{:?}", mesh.bounds());
}
