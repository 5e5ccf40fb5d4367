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

/// A rectangle of the plane z = 0 in so many cells.
fn sheet(cells: u32, [left, right]: [f32; 2]) -> EditMesh {
    let mut grid = primitives::grid(right - left, 1.0, cells, cells);
    let turn = |p: &Vec3| Vec3::new(p.x + 0.5 * (left + right), p.z, 0.0);
    let positions: Vec<Vec3> = grid.positions().iter().map(turn).collect();
    grid.positions_mut().copy_from_slice(&positions);
    EditMesh::from_mesh(&grid).0
}

/// A disc left a face within its ring, and both ends of a spring open.
#[test]
fn faces_close_the_ends_and_leave_no_wall_inside() {
    for (cells, angle, steps) in [(1, 0.25, 3), (3, 0.5, 5), (2, -0.25, 4), (3, 1.0, 12), (1, -1.0, 7)] {
        let mesh = sheet(cells, [1.0, 3.0]);
        let edges: Vec<EdgeId> = mesh.edges().collect();
        let settings = SpinSettings { angle: TAU * angle, steps, ..Default::default() };
        let spin = |mesh: &mut EditMesh| mesh.spin(&edges, &[], &settings);
        let (solid, made) = check_operation(&mesh, spin).expect("sound").expect("possible");
        assert!(solid.is_watertight(), "{cells} cells, {angle} of a turn");
        let sides = (f64::from(steps) / angle.abs()).round() as u32;
        let expected = (polygon_area(sides, 3.0) - polygon_area(sides, 1.0)) * angle.abs();
        assert!((solid.volume() - expected).abs() < 1e-5, "{} for {expected}", solid.volume());
        let ends = if angle.abs() == 1.0 { 0 } else { cells * cells };
        assert_eq!(made.ends.len() as u32, ends);
        assert_eq!(solid.face_count() as u32, 4 * cells * steps + 2 * ends);
        assert!(made.edges.iter().all(|&edge| solid.has_edge(edge)), "those at the end exist");
    }
}

/// The surface goes on along the sweep: a cube with a bent arm instead of a face.
#[test]
fn a_face_of_a_solid_is_swept_without_a_wall_inside() {
    let (mesh, _) = EditMesh::from_mesh(&primitives::cube(1.0));
    let face = mesh.faces().find(|&face| mesh.face_normal(face).dot(DVec3::Z) > 0.9).expect("the front");
    let edges: Vec<EdgeId> = mesh.face_edges(face).collect();
    let settings =
        SpinSettings { center: [2.0, 0.0, 0.5], angle: -TAU / 4.0, steps: 6, ..Default::default() };
    let (solid, made) =
        check_operation(&mesh, |mesh| mesh.spin(&edges, &[], &settings)).expect("sound").expect("possible");
    assert!(solid.is_watertight() && made.ends.len() == 1 && solid.face_count() == 6 + 4 * 6);
    let arm = 0.25 * (polygon_area(24, 2.5) - polygon_area(24, 1.5));
    let volume = solid.volume();
    assert!((volume - 1.0 - arm).abs() < 1e-5 || (volume - 1.0 + arm).abs() < 1e-5, "{volume} for 1 ± {arm}");
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
            let most = mesh.face_count() + made.faces.len() + made.ends.len();
            let is_whole = |&face: &FaceId| mesh.face_edges(face).all(|edge| edges.contains(&edge));
            let least = most - mesh.faces().filter(is_whole).count();
            prop_assert!((least..=most).contains(&after.face_count()), "{} of {least} to {most}", after.face_count());
            prop_assert!(made.faces.len() <= (steps * turns) as usize * edges.len());
        }
    }
}
