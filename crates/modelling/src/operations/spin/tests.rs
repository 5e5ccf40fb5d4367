use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, meshes, with_affine_values};

/// A closed or open row of edges in the plane z = 0.
fn profile(points: &[[f32; 2]], is_closed: bool) -> (EditMesh, Vec<EdgeId>) {
    let mut mesh = EditMesh::new();
    let vertices: Vec<VertexId> =
        points.iter().map(|&[x, y]| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room")).collect();
    let mut pairs: Vec<[VertexId; 2]> = vertices.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    if is_closed {
        pairs.push([vertices[vertices.len() - 1], vertices[0]]);
    }
    let edges = pairs.into_iter().map(|[a, b]| mesh.add_edge(a, b).expect("two")).collect();
    (mesh, edges)
}

/// The area of a regular polygon in a circle.
fn polygon_area(sides: u32, radius: f64) -> f64 {
    let n = f64::from(sides);
    n / 2.0 * radius * radius * elementary::sin_cos(TAU / n).0
}

#[test]
fn a_vertex_becomes_a_circle() {
    let (mut mesh, _) = profile(&[[2.0, 1.0]], false);
    let made =
        mesh.spin(&[], &[VertexId(0)], &SpinSettings { steps: 5, ..Default::default() }).expect("possible");
    assert_eq!((mesh.vertex_count(), mesh.edge_count(), made.vertices), (5, 5, vec![VertexId(0)]));
    for vertex in mesh.vertices() {
        let point = mesh.point(vertex);
        assert!((DVec3::new(point.x, 0.0, point.z).length() - 2.0).abs() < 1e-6 && point.y == 1.0, "{point}");
    }
}

#[test]
fn a_positive_angle_turns_counter_clockwise() {
    let (mut mesh, _) = profile(&[[1.0, 0.0]], false);
    let quarter = SpinSettings { axis: [0.0, 0.0, 3.0], angle: TAU / 4.0, steps: 1, ..Default::default() };
    let made = mesh.spin(&[], &[VertexId(0)], &quarter).expect("possible");
    assert!(mesh.point(made.vertices[0]).abs_diff_eq(DVec3::Y, 1e-7));
}

/// Three turns of a spring: two ends stay open, and each turn rises by the height.
#[test]
fn a_screw_rises_with_each_turn() {
    let (mut mesh, edges) = profile(&[[2.0, 0.0], [2.5, 0.0], [2.5, 0.5], [2.0, 0.5]], true);
    let settings = SpinSettings { steps: 12, turns: 3, height: 1.0, ..Default::default() };
    let made = mesh.spin(&edges, &[], &settings).expect("possible");
    assert_eq!((made.faces.len(), mesh.vertex_count()), (4 * 36, 4 * 37));
    assert_eq!(mesh.edges().filter(|&edge| mesh.is_boundary(edge)).count(), 8, "both ends");
    let lowest = made.vertices.iter().map(|&vertex| mesh.point(vertex).y).fold(f64::INFINITY, f64::min);
    assert!((lowest - 3.0).abs() < 1e-6, "{lowest}");
    let outwards = made.faces.iter().filter(|&&face| {
        let center = mesh.face_center(face);
        DVec3::new(center.x, 0.0, center.z).length() > 2.4
            && mesh.face_normal(face).dot(DVec3::new(center.x, 0.0, center.z)) > 0.5
    });
    assert_eq!(outwards.count(), 36, "the outer side looks outwards");
}

#[test]
fn faces_continue_the_one_at_the_border() {
    let (mut grid, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(2.0, 2.0, 1, 1)));
    grid.set_material(FaceId(0), 3);
    let edge = grid.edges().find(|&edge| grid.edge_vertices(edge).iter().all(|&v| grid.position(v).x > 0.5));
    let settings = SpinSettings {
        center: [1.0, 2.0, 0.0],
        axis: [0.0, 0.0, 1.0],
        angle: TAU / 4.0,
        steps: 3,
        ..Default::default()
    };
    let made = grid.spin(&[edge.expect("the right one")], &[], &settings).expect("possible");
    grid.check_structure().expect("whole");
    assert!(made.faces.iter().all(|&face| grid.material(face) == 3));
    for edge in grid.edges() {
        let Some([a, b]) = grid.edge_pair(edge) else { continue };
        assert_ne!(grid.corner_vertex(a), grid.corner_vertex(b), "neighbours are wound alike");
    }
}

#[test]
fn what_cannot_be_spun_is_refused() {
    let (mut mesh, edges) = profile(&[[1.0, 0.0], [1.0, 1.0]], false);
    let (mut on_axis, axis) = profile(&[[0.0, 0.0], [0.0, 1.0]], false);
    let before = mesh.clone();
    let settings = SpinSettings::default();
    for wrong in [
        SpinSettings { axis: [0.0; 3], ..settings },
        SpinSettings { angle: f64::NAN, ..settings },
        SpinSettings { angle: 0.0, ..settings },
        SpinSettings { turns: 2, ..settings },
        SpinSettings { steps: 0, ..settings },
        SpinSettings { steps: 2, ..settings },
        SpinSettings { turns: 0, ..settings },
        SpinSettings { height: f64::INFINITY, ..settings },
        SpinSettings { steps: u32::MAX, turns: 2, height: 1.0, ..settings },
        SpinSettings { steps: 100_000_000, ..settings },
    ] {
        assert!(mesh.spin(&edges, &[], &wrong).is_err(), "{wrong:?}");
    }
    assert!(mesh.spin(&[], &[], &settings).is_err() && on_axis.spin(&axis, &[], &settings).is_err());
    assert!(mesh == before, "nothing changed");
}

proptest! {
    /// A rectangle around any axis: a ring of flat faces.
    #[test]
    fn a_rectangle_becomes_a_ring_of_the_polygons_volume(
        inner in 0.0f32..2.0, width in 0.1f32..2.0, height in 0.1f32..2.0, steps in 3u32..40, backwards: bool,
    ) {
        // On the axis, or clearly off it.
        let inner = if inner < 0.2 { 0.0 } else { inner };
        let (x, y) = (inner + width, height);
        let (mesh, edges) = profile(&[[inner, 0.0], [x, 0.0], [x, y], [inner, y]], true);
        let settings = SpinSettings { angle: if backwards { -TAU } else { TAU }, steps, ..Default::default() };
        let outcome = check_operation(&mesh, |mesh| mesh.spin(&edges, &[], &settings));
        let (ring, made) = outcome.map_err(TestCaseError::fail)?.expect("possible");
        let areas = [x, inner].map(|radius| polygon_area(steps, f64::from(radius)));
        let expected = (areas[0] - areas[1]) * f64::from(y);
        // A face on the axis has no area in that case, and is none.
        prop_assert_eq!(made.faces.len() as u32, if inner == 0.0 { 3 * steps } else { 4 * steps });
        prop_assert!((ring.volume() - expected).abs() < 1e-5 * (1.0 + expected), "{} for {expected}", ring.volume());
        prop_assert!(inner == 0.0 || ring.is_watertight());
    }

    #[test]
    fn any_edges_are_spun_in_order(
        start in meshes(), bits in any::<u64>(), steps in 1u32..9, angle in -6.0f64..6.0, height in -1.0f64..1.0,
        tilt in -1.0f64..1.0, turns in 1u32..3,
    ) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        let edges: Vec<EdgeId> = mesh.edges().filter(|edge| bits >> (edge.0 % 64) & 3 == 3).collect();
        let vertices: Vec<VertexId> = mesh.vertices().filter(|vertex| bits >> (vertex.0 % 60) & 3 == 1).collect();
        let height = if tilt > 0.0 { 0.0 } else { height };
        let settings = SpinSettings { axis: [tilt, 1.0, 0.0], steps, angle, height, turns, ..Default::default() };
        let outcome = check_operation(&mesh, |mesh| mesh.spin(&edges, &vertices, &settings));
        if let Some((after, made)) = outcome.map_err(TestCaseError::fail)? {
            prop_assert_eq!(after.face_count(), mesh.face_count() + made.faces.len());
            prop_assert!(made.faces.len() <= (steps * turns) as usize * edges.len());
        }
    }
}
