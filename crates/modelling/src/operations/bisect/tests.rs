use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

fn all(mesh: &EditMesh) -> Vec<FaceId> {
    mesh.faces().collect()
}

/// Whether as many steps go along each edge as back.
fn is_closed(mesh: &EditMesh) -> bool {
    let mut steps = BTreeMap::<[VertexId; 2], i32>::new();
    for corner in mesh.corners() {
        let (from, to) = (mesh.corner_vertex(corner), mesh.corner_vertex(mesh.next_corner(corner)));
        *steps.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
    }
    steps.values().all(|&sum| sum == 0)
}

const OUTER: BisectSettings =
    BisectSettings { clear_outer: true, clear_inner: false, fill: true, threshold: 0.0 };
const INNER: BisectSettings =
    BisectSettings { clear_outer: false, clear_inner: true, fill: true, threshold: 0.0 };

#[test]
fn a_cut_through_a_ring_is_an_annulus() {
    let (start, _) = EditMesh::from_mesh(&with_affine_values(primitives::torus(2.0, 0.5, 24, 12)));
    for settings in [OUTER, INNER] {
        let mut torus = start.clone();
        let made = torus.bisect(&all(&start), DVec3::ZERO, DVec3::Y, &settings).expect("possible");
        torus.check_structure().expect("whole");
        assert!(is_closed(&torus) && made.fill.len() > 1);
        // The polygons of 24 sides through the outermost and the innermost vertices.
        let polygon = |radius: f64| {
            12.0 * radius * radius * trigon_math::elementary::sin_cos(std::f64::consts::TAU / 24.0).0
        };
        let area: f64 = made.fill.iter().map(|&face| torus.face_area(face)).sum();
        assert!((area - (polygon(2.5) - polygon(1.5))).abs() < 1e-5, "{area}");
        let up = if settings.clear_outer { 1.0 } else { -1.0 };
        assert!(made.fill.iter().all(|&face| torus.face_normal(face).y * up > 0.999), "it looks outwards");
        assert!((torus.volume() - start.volume() / 2.0).abs() < 1e-5, "half");
    }
}

#[test]
fn a_cut_through_two_arms_is_two_discs() {
    let (mut torus, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 24, 12));
    let faces = all(&torus);
    let made = torus.bisect(&faces, DVec3::new(0.01, 0.0, 0.0), DVec3::X, &OUTER).expect("possible");
    assert_eq!((made.fill.len(), torus.is_watertight()), (2, true));
}

#[test]
fn without_clearing_faces_are_only_cut() {
    let (mut cube, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
    let faces = all(&cube);
    let made = cube.bisect(&faces, DVec3::ZERO, DVec3::Y, &BisectSettings::default()).expect("possible");
    assert_eq!((cube.face_count(), made.edges.len(), made.removed), (10, 4, 0));
    assert!(cube.is_watertight());
    let fill = BisectSettings { fill: true, ..BisectSettings::default() };
    let faces = all(&cube);
    let made = cube.bisect(&faces, DVec3::ZERO, DVec3::Y, &fill).expect("possible");
    assert_eq!((cube.face_count(), made.fill.len()), (11, 1), "a wall inside");
    assert!(cube.face_normal(made.fill[0]).y > 0.999, "it looks to the front");
    let both = BisectSettings { clear_outer: true, clear_inner: true, ..fill };
    let faces = all(&cube);
    let made = cube.bisect(&faces[..10], DVec3::Y * 0.5, DVec3::Y, &both).expect("possible");
    assert_eq!((made.fill.len(), made.removed), (1, 14));
}

#[test]
fn a_face_on_the_plane_is_part_of_the_solid_behind_it() {
    for (settings, volume) in [(OUTER, 8.0), (INNER, 0.0)] {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces = all(&cube);
        cube.bisect(&faces, DVec3::X, DVec3::X, &settings).expect("possible");
        assert!((cube.volume() - volume).abs() < 1e-12 && is_closed(&cube), "{settings:?}");
    }
}

/// A face with a notch that goes up and down, and crosses the plane again and again.
#[test]
fn no_part_of_a_face_that_is_not_flat_is_on_both_sides() {
    let mut mesh = EditMesh::new();
    let heights = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, -1.0];
    let outline = [[0.0, 0.0], [4.0, 0.0], [1.0, 1.0], [4.0, 4.0], [2.0, 1.5], [0.0, 4.0], [0.5, 2.0]];
    let vertices: Vec<VertexId> = outline
        .iter()
        .zip(heights)
        .map(|(&[x, y], z)| mesh.add_vertex(Vec3::new(x, y, z)).expect("room"))
        .collect();
    let face = mesh.add_face(&vertices).expect("simple");
    mesh.bisect(&[face], DVec3::ZERO, DVec3::new(0.1, 0.0, 1.0), &BisectSettings::default())
        .expect("possible");
    mesh.check_structure().expect("whole");
    for face in mesh.faces() {
        let heights = || mesh.face_vertices(face).map(|vertex| mesh.position(vertex).z);
        assert!(heights().all(|z| z > -0.9) || heights().all(|z| z < 0.9), "{face}");
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let before = cube.clone();
    let faces = all(&cube);
    let settings = BisectSettings::default();
    assert!(cube.bisect(&[], DVec3::ZERO, DVec3::X, &settings).is_err());
    assert!(cube.bisect(&faces, DVec3::ZERO, DVec3::ZERO, &settings).is_err());
    assert!(cube.bisect(&faces, DVec3::NAN, DVec3::X, &settings).is_err());
    let wrong = BisectSettings { threshold: -1.0, ..settings };
    assert!(cube.bisect(&faces, DVec3::ZERO, DVec3::X, &wrong).is_err());
    assert!(cube == before, "nothing changed");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The volumes of both halves sum up, and both are closed.
    #[test]
    fn halves_of_a_solid_are_the_whole(
        start in meshes(), point in prop::array::uniform3(-0.8f64..0.8), normal in prop::array::uniform3(-1.0f64..1.0),
        on_axis: bool,
    ) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        prop_assume!(!mesh.faces().collect::<Vec<_>>().is_empty());
        let point = if on_axis { DVec3::ZERO } else { DVec3::from(point) };
        let normal = if on_axis { DVec3::X } else { DVec3::from(normal) };
        prop_assume!(normal.length() > 0.1);
        let faces = all(&mesh);
        let mut sum = 0.0;
        for settings in [OUTER, INNER] {
            let outcome = check_operation(&mesh, |mesh| mesh.bisect(&faces, point, normal, &settings));
            let (half, made) = outcome.map_err(TestCaseError::fail)?.expect("possible");
            let sign = if settings.clear_outer { -1.0 } else { 1.0 };
            for vertex in made.faces.iter().flat_map(|&face| half.face_vertices(face)) {
                let distance = (half.point(vertex) - point).dot(normal.normalize());
                // New vertices are rounded to f32.
                prop_assert!(distance * sign > -1e-6 * (1.0 + half.point(vertex).length()), "{distance}");
            }
            if mesh.is_watertight() {
                prop_assert!(is_closed(&half), "{settings:?}");
            }
            sum += half.volume();
        }
        if mesh.is_watertight() {
            prop_assert!((sum - mesh.volume()).abs() < 1e-4, "{sum} of {}", mesh.volume());
        }
        let outcome = check_operation(&mesh, |mesh| mesh.bisect(&faces, point, normal, &BisectSettings::default()));
        let (cut, _) = outcome.map_err(TestCaseError::fail)?.expect("possible");
        prop_assert_eq!(keeps_affine_values(&cut), Ok(()));
    }
}
