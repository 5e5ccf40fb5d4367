//! Tests of tubes.

use proptest::prelude::*;

use super::*;
use crate::tests::{check_operation, meshes};

/// A chain through some points.
fn chain(points: &[DVec3], is_closed: bool) -> (EditMesh, Vec<EdgeId>) {
    let mut mesh = EditMesh::new();
    let vertices: Vec<VertexId> =
        points.iter().map(|point| mesh.add_vertex(point.as_vec3()).expect("room")).collect();
    let count = points.len();
    let steps = if is_closed { count } else { count - 1 };
    let edge = |i: usize| (vertices[i], vertices[(i + 1) % count]);
    let edges = (0..steps).map(edge).map(|(a, b)| mesh.add_edge(a, b).expect("two")).collect();
    (mesh, edges)
}

fn length(points: &[DVec3], is_closed: bool) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).take(points.len() - usize::from(!is_closed)).map(|(a, b)| a.distance(*b)).sum()
}

/// The area of a regular polygon.
fn area(sides: u32, radius: f64) -> f64 {
    let (sin, _) = elementary::sin_cos(TAU / f64::from(sides));
    0.5 * f64::from(sides) * radius * radius * sin
}

fn tube(points: &[DVec3], is_closed: bool, settings: &TubeSettings) -> EditMesh {
    let (mut mesh, edges) = chain(points, is_closed);
    let made = mesh.tube_edges(&edges, settings).expect("a chain");
    mesh.check_structure().expect("whole");
    assert_eq!(made.len(), mesh.face_count());
    mesh
}

fn circle(count: u32) -> Vec<DVec3> {
    let at = |i: u32| elementary::sin_cos(TAU * f64::from(i) / f64::from(count));
    (0..count).map(at).map(|(sin, cos)| DVec3::new(2.0 * cos, 0.0, 2.0 * sin)).collect()
}

#[test]
fn a_straight_chain_becomes_a_prism() {
    let points: Vec<DVec3> = (0..5).map(|i| DVec3::new(1.0, 2.0, 2.0) * f64::from(i * i)).collect();
    for sides in [3, 4, 9] {
        let settings = TubeSettings { radius: 0.5, sides, ..TubeSettings::default() };
        let mesh = tube(&points, false, &settings);
        assert!(mesh.is_watertight());
        assert_eq!(mesh.vertex_count() as u32, 5 * sides, "the chain is gone");
        let direction = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        for vertex in mesh.vertices() {
            let distance = mesh.point(vertex).cross(direction).length();
            assert!((distance - 0.5).abs() < 1e-5, "{distance} from the axis");
        }
        let expected = area(sides, 0.5) * 48.0;
        assert!((mesh.volume() - expected).abs() < 1e-4, "{} for {expected}", mesh.volume());
    }
}

/// A prism between two planes has the area of its polygon times the length of the line through the middle as its volume.
#[test]
fn bends_have_the_volume_of_prisms() {
    let zigzag = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 3.0, 0.0], [2.0, 3.0, 2.0], [5.0, 5.0, 3.0]];
    let zigzag = zigzag.map(DVec3::from);
    let around = circle(24);
    for (points, is_closed) in [(&zigzag[..], false), (&around, true)] {
        let settings = TubeSettings { radius: 0.25, sides: 7, ..TubeSettings::default() };
        let mesh = tube(points, is_closed, &settings);
        assert!(mesh.is_watertight());
        let expected = area(7, 0.25) * length(points, is_closed);
        assert!((mesh.volume() - expected).abs() < 1e-5, "{} for {expected}", mesh.volume());
        let euler = mesh.vertex_count() + mesh.face_count() - mesh.edge_count();
        assert_eq!(euler, if is_closed { 0 } else { 2 });
    }
}

#[test]
fn a_knot_is_closed_without_a_jump() {
    let knot: Vec<DVec3> = (0..90_u32)
        .map(|i| {
            let turn = TAU * f64::from(i) / 90.0;
            let ((s2, c2), (s3, c3)) = (elementary::sin_cos(2.0 * turn), elementary::sin_cos(3.0 * turn));
            DVec3::new((2.0 + c3) * c2, (2.0 + c3) * s2, s3)
        })
        .collect();
    let mesh = tube(&knot, true, &TubeSettings { radius: 0.2, sides: 6, ..TubeSettings::default() });
    assert!(mesh.is_watertight());
    // Rings follow the chain in the order of their vertices. What is left of the twist, at most half a turn, is spread
    // along it: a step turns a ring by its part of the length.
    let made: Vec<DVec3> = mesh.vertices().map(|vertex| mesh.point(vertex)).collect();
    let rings: Vec<&[DVec3]> = made.chunks(6).collect();
    let middle = |ring: usize| rings[ring % 90].iter().sum::<DVec3>() / 6.0;
    for ring in 0..90 {
        let step = middle(ring + 1) - middle(ring);
        let (direction, most) = (step.normalize(), 0.1 * TAU * step.length() / length(&knot, true));
        for (from, to) in rings[ring].iter().zip(rings[(ring + 1) % 90]) {
            let across = (*to - *from).cross(direction).length();
            assert!(across < most + 1e-5, "{across} at {ring}");
        }
    }
    let expected = area(6, 0.2) * length(&knot, true);
    // Quads are not flat: what they are cut into adds half of a tetrahedron each, a side times a step times the twist.
    assert!((mesh.volume() / expected - 1.0).abs() < 1e-2, "{} for {expected}", mesh.volume());
}

#[test]
fn texture_coordinates_run_along_the_tube() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::X * 4.0];
    let mesh = tube(&points, false, &TubeSettings { caps: false, ..TubeSettings::default() });
    assert_eq!(mesh.face_count(), 16, "without caps");
    for face in mesh.faces() {
        let uvs: Vec<Vec2> =
            mesh.face_corners(face).map(|corner| mesh.uv(0, corner).expect("a set")).collect();
        for (corner, uv) in mesh.face_corners(face).zip(&uvs) {
            let along = mesh.position(mesh.corner_vertex(corner)).x / 4.0;
            assert!((uv.y - along).abs() < 1e-6, "{uv} at {along}");
        }
        assert!((uvs[1].x - uvs[0].x - 0.125).abs() < 1e-6, "an eighth around: {uvs:?}");
    }
}

#[test]
fn what_is_no_chain_is_refused() {
    let (mut star, mut edges) = chain(&[DVec3::ZERO, DVec3::X, DVec3::X * 2.0], false);
    let middle = star.edge_vertices(edges[1])[0];
    let tip = star.add_vertex(trigon_math::Vec3::Y).expect("room");
    edges.push(star.add_edge(middle, tip).expect("two"));
    let settings = TubeSettings::default();
    assert!(star.tube_edges(&edges, &settings).expect_err("three").to_string().contains("at most two"));
    assert!(star.tube_edges(&[], &settings).is_err());
    for wrong in [
        TubeSettings { radius: 0.0, ..settings },
        TubeSettings { radius: f64::NAN, ..settings },
        TubeSettings { sides: 2, ..settings },
        TubeSettings { sides: 1001, ..settings },
    ] {
        assert!(star.tube_edges(&edges[..1], &wrong).is_err(), "{wrong:?}");
    }
    let (mut point, edges) = chain(&[DVec3::ONE; 3], true);
    assert!(point.tube_edges(&edges, &settings).expect_err("a point").to_string().contains("apart"));
    let (mut back, edges) = chain(&[DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::ZERO, DVec3::Y], false);
    back.tube_edges(&edges, &settings).expect("back and forth is a chain");
    assert!(back.vertices().all(|vertex| back.position(vertex).is_finite()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn tubes_keep_every_rule(start in meshes(), picks in prop::collection::vec(any::<u32>(), 1..5), replace: bool) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        let all: Vec<EdgeId> = mesh.edges().collect();
        let edges = picks.iter().filter_map(|&pick| all.get(pick as usize % all.len().max(1)).copied());
        let edges: Vec<EdgeId> = edges.collect();
        let settings = TubeSettings { sides: 3, replace, ..TubeSettings::default() };
        let outcome = check_operation(&mesh, |mesh| mesh.tube_edges(&edges, &settings));
        if let Some((after, made)) = outcome.map_err(TestCaseError::fail)? {
            prop_assert_eq!(after.face_count(), mesh.face_count() + made.len());
            let is_closed = |face: FaceId| {
                after.face_edges(face).all(|edge| after.edge_pair(edge).is_some())
            };
            prop_assert!(made.into_iter().all(is_closed));
        }
    }
}
