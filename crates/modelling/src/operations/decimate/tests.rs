use proptest::prelude::*;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};

use super::*;
use crate::tests::{affine_uv, check_operation, keeps_affine_values, meshes, with_affine_values};
use crate::{EdgeId, VertexId};

fn all(mesh: &EditMesh) -> Vec<FaceId> {
    mesh.faces().collect()
}

fn to_faces(faces: u32) -> DecimateSettings {
    DecimateSettings { goal: DecimateGoal::Faces, faces, ..DecimateSettings::default() }
}

fn decimated(mesh: &Mesh, settings: &DecimateSettings) -> (EditMesh, Decimated) {
    let (mesh, _) = EditMesh::from_mesh(&with_affine_values(mesh.clone()));
    let faces = all(&mesh);
    let outcome = check_operation(&mesh, |mesh| mesh.decimate(&faces, settings));
    outcome.expect("in order").expect("possible")
}

/// Vertices − edges + faces.
fn euler(mesh: &EditMesh) -> i64 {
    mesh.vertex_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

#[test]
fn closed_surfaces_keep_their_genus_down_to_little() {
    for (solid, number, least) in [
        (primitives::icosphere(1.0, 3), 2, 4),
        (primitives::torus(2.0, 0.5, 40, 20), 0, 14),
        (primitives::cube(2.0), 2, 4),
    ] {
        for faces in [300, 100, 0] {
            let (mesh, made) = decimated(&solid, &to_faces(faces));
            assert!(mesh.is_watertight(), "{faces}");
            assert_eq!(euler(&mesh), number, "{faces}");
            assert_eq!(mesh.face_count(), made.faces.len());
            // A torus cannot have fewer (A. Möbius).
            assert!(mesh.face_count() >= least, "{} faces", mesh.face_count());
            assert!(mesh.face_count() <= 100.max(faces as usize), "{} faces for {faces}", mesh.face_count());
        }
    }
}

/// What is flat loses nothing. Twelve triangles would do; vertices that could only leave by edges that turn may stay.
#[test]
fn a_subdivided_box_becomes_few_triangles_without_error() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let edges: Vec<EdgeId> = cube.edges().collect();
    cube.subdivide(&edges, 7).expect("possible");
    let faces = all(&cube);
    let settings = DecimateSettings { goal: DecimateGoal::Error, error: 1e-5, ..DecimateSettings::default() };
    let made = cube.decimate(&faces, &settings).expect("possible");
    assert!((12..=24).contains(&cube.face_count()), "{} of 768 faces", cube.face_count());
    assert!(made.error <= 1e-5 && (cube.volume() - 8.0).abs() < 1e-4, "{}", cube.volume());
    assert!(cube.is_watertight());
}

#[test]
fn a_flat_grid_keeps_its_outline_and_values() {
    for faces in [200, 40, 2] {
        let (mesh, _) = decimated(&primitives::grid(4.0, 3.0, 20, 15), &to_faces(faces));
        assert!(mesh.face_count() <= faces as usize, "{}", mesh.face_count());
        assert!((mesh.surface_area() - 12.0).abs() < 1e-4, "{}", mesh.surface_area());
        keeps_affine_values(&mesh).expect("linear values stay linear");
        let up = mesh.face_normal(mesh.faces().next().expect("some"));
        assert!(mesh.faces().all(|face| mesh.face_normal(face).dot(up) > 0.999), "none turns over");
    }
}

/// The volume of a sphere is an outside measure of the error.
#[test]
fn a_sphere_stays_round() {
    let (mesh, made) = decimated(&primitives::icosphere(1.0, 5), &to_faces(2000));
    assert_eq!((mesh.face_count(), made.removed), (2000, 18480));
    for vertex in mesh.vertices() {
        let radius = mesh.point(vertex).length();
        assert!((radius - 1.0).abs() < 0.004, "{radius}");
    }
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    assert!((mesh.volume() / ball - 1.0).abs() < 0.01, "{}", mesh.volume() / ball);
    assert!(made.error > 0.0 && made.error < 0.01, "{}", made.error);
}

#[test]
fn seams_materials_and_marks_hold() {
    let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(4.0, 4.0, 16, 16)));
    let faces = all(&mesh);
    let right: Vec<FaceId> = faces.iter().copied().filter(|&face| mesh.face_center(face).x > 0.0).collect();
    mesh.assign_material(&right, 1).expect("faces");
    let along = |mesh: &EditMesh, edge: EdgeId| mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex));
    let middle: Vec<EdgeId> =
        mesh.edges().filter(|&edge| along(&mesh, edge).iter().all(|point| point.x.abs() < 1e-6)).collect();
    mesh.mark_seams(&middle).expect("edges");
    // Texture coordinates of the right half are elsewhere.
    for &face in &right {
        for corner in mesh.face_corners(face).collect::<Vec<_>>() {
            let uv = affine_uv(mesh.position(mesh.corner_vertex(corner)));
            mesh.set_uv(0, corner, uv + trigon_math::Vec2::splat(10.0));
        }
    }
    // A bump, so that it is not flat.
    for vertex in mesh.vertices().collect::<Vec<VertexId>>() {
        let Vec3 { x, y, z } = mesh.position(vertex);
        mesh.set_position(vertex, Vec3::new(x, y + 0.3 * x * x, z));
    }
    mesh.decimate(&faces, &to_faces(60)).expect("possible");
    mesh.check_structure().expect("whole");
    assert!(mesh.face_count() <= 60);
    let area = |material: u32| -> f64 {
        let flat = |face: FaceId| mesh.face_area_vector(face).y.abs();
        mesh.faces().filter(|&face| mesh.material(face) == material).map(flat).sum()
    };
    for material in [0, 1] {
        assert!((area(material) - 8.0).abs() < 1e-3, "{}", area(material));
    }
    let seams: f64 = mesh.edges().filter(|&edge| mesh.is_seam(edge)).map(|edge| mesh.edge_length(edge)).sum();
    assert!((seams - 4.0).abs() < 1e-5, "the seam goes all the way: {seams}");
    for face in mesh.faces() {
        for corner in mesh.face_corners(face) {
            let uv = mesh.uv(0, corner).expect("there is one");
            assert_eq!(mesh.material(face) == 1, uv.y > 5.0, "no value crosses the seam: {uv}");
        }
    }
}

#[test]
fn other_faces_stay_as_they_are() {
    let (mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::icosphere(1.0, 3)));
    let (given, others): (Vec<FaceId>, Vec<FaceId>) =
        mesh.faces().partition(|&face| mesh.face_center(face).y > 0.2);
    let outcome = check_operation(&mesh, |mesh| mesh.decimate(&given, &to_faces(0)));
    let (after, made) = outcome.expect("in order").expect("possible");
    assert!(after.is_watertight() && made.removed > given.len() / 2, "{} of {}", made.removed, given.len());
    for face in others {
        let points = |mesh: &EditMesh| -> Vec<Vec3> {
            mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).collect()
        };
        assert_eq!(points(&after), points(&mesh));
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let before = cube.clone();
    let faces = all(&cube);
    let settings = DecimateSettings::default();
    for wrong in [
        DecimateSettings { ratio: 1.5, ..settings.clone() },
        DecimateSettings { ratio: f64::NAN, ..settings.clone() },
        DecimateSettings { error: -1.0, ..settings.clone() },
    ] {
        assert!(cube.decimate(&faces, &wrong).is_err(), "{wrong:?}");
    }
    assert!(cube.decimate(&[], &settings).is_err(), "no face");
    assert!(cube == before, "nothing changed");
}

#[test]
fn positions_that_are_no_numbers_end() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::icosphere(1.0, 2));
    mesh.set_position(VertexId(3), Vec3::new(f32::NAN, 0.0, f32::INFINITY));
    let faces = all(&mesh);
    mesh.decimate(&faces, &to_faces(10)).expect("possible");
    mesh.check_structure().expect("whole");
}

/// The distance of a point from a triangle, by its parts in the plane and along the sides.
fn distance(point: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_side = |from: DVec3, to: DVec3| {
        let way = to - from;
        let t = ((point - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        point.distance(from + way * t)
    };
    let normal = (b - a).cross(c - a);
    let is_within =
        [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| (to - from).cross(point - from).dot(normal) >= 0.0);
    let plane = if is_within { (point - a).dot(normal.normalize()).abs() } else { f64::INFINITY };
    [to_side(a, b), to_side(b, c), to_side(c, a), plane].into_iter().fold(f64::INFINITY, f64::min)
}

#[test]
fn a_largest_error_holds_for_the_distance_of_the_old_vertices() {
    let (before, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 48, 24));
    for error in [0.003, 0.01, 0.03] {
        let mut mesh = before.clone();
        let settings = DecimateSettings { goal: DecimateGoal::Error, error, ..DecimateSettings::default() };
        let made = mesh.decimate(&all(&before), &settings).expect("possible");
        assert!(made.error <= error && made.removed > 100, "{} removed", made.removed);
        let triangles: Vec<[DVec3; 3]> = mesh
            .faces()
            .map(|face| {
                let mut points = mesh.face_vertices(face).map(|vertex| mesh.point(vertex));
                std::array::from_fn(|_| points.next().expect("a triangle"))
            })
            .collect();
        let farthest = before.vertices().fold(0.0, |most: f64, vertex| {
            let near = triangles.iter().map(|&triangle| distance(before.point(vertex), triangle));
            most.max(near.fold(f64::INFINITY, f64::min))
        });
        // A mean square is less than the largest one; ten times is what torus and sphere need at most.
        assert!(farthest < 10.0 * error, "{farthest} for {error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Manifold meshes stay manifold and closed, and features of any kind are survived.
    #[test]
    fn any_faces_are_reduced_in_order(
        start in meshes(), bits in any::<u64>(), marks in any::<u64>(), is_whole: bool, faces in 0u32..40,
    ) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        let marked: Vec<EdgeId> = mesh.edges().filter(|edge| marks >> (edge.0 % 64) & 7 == 7).collect();
        mesh.mark_sharp(&marked).ok();
        let given: Vec<FaceId> = mesh.faces().filter(|face| is_whole || bits >> (face.0 % 64) & 1 != 0).collect();
        prop_assume!(!given.is_empty());
        let outcome = check_operation(&mesh, |mesh| mesh.decimate(&given, &to_faces(faces)));
        let (after, _) = outcome.map_err(TestCaseError::fail)?.expect("possible");
        if mesh.is_watertight() {
            prop_assert!(after.is_watertight());
            prop_assert_eq!(euler(&after), euler(&mesh));
        }
        // A diagonal of a polygon may meet an edge of others.
        let mut cut = mesh.clone();
        cut.triangulate_faces(&given).expect("possible");
        if cut.edges().all(|edge| cut.edge_faces(edge).count() < 3) {
            prop_assert!(after.edges().all(|edge| after.edge_faces(edge).count() < 3));
        }
    }
}

/// A box in three layers, whose faces all have the whole image: the corners between them lie at ends of texture coordinates.
fn tower() -> EditMesh {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let top = mesh.faces().max_by(|a, b| {
        let height =
            |face: FaceId| mesh.face_vertices(face).map(|vertex| mesh.position(vertex).y).sum::<f32>();
        height(*a).total_cmp(&height(*b))
    });
    let top = top.expect("a cube has faces");
    mesh.extrude_region(&[top], crate::ExtrudeOffset::Along(1.0)).expect("a face");
    mesh
}

fn height(mesh: &EditMesh) -> f32 {
    let heights = mesh.vertices().map(|vertex| mesh.position(vertex).y);
    let (low, high) = heights.fold((f32::MAX, f32::MIN), |(low, high), y| (low.min(y), high.max(y)));
    high - low
}

/// The corners of the top went, as those in the middle were held.
#[test]
fn what_texture_coordinates_hold_made_the_corners_of_a_box_go() {
    let mut mesh = tower();
    let faces: Vec<FaceId> = mesh.faces().collect();
    for ratio in [0.9, 0.6] {
        let mut held = mesh.clone();
        let settings = DecimateSettings { ratio, ..DecimateSettings::default() };
        let made = held.decimate(&faces, &settings).expect("it can be");
        assert_eq!(height(&held), 3.0, "{ratio}: all of the box stays");
        assert_eq!(made.is_held, held.face_count() > (20.0 * ratio) as usize, "and it is said");
        held.check_structure().expect("whole");
    }
    let settings = DecimateSettings { ratio: 0.6, hold_values: false, ..DecimateSettings::default() };
    let made = mesh.decimate(&faces, &settings).expect("it can be");
    assert_eq!((made.removed, made.is_held), (8, false), "the vertices in the middle");
    assert_eq!((height(&mesh), mesh.face_count()), (3.0, 12), "the box");
}
