//! Tests of bridges between loops of edges.

use proptest::prelude::*;
use trigon_math::{Vec3, elementary::sin_cos};
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

fn counts(mesh: &EditMesh) -> [usize; 3] {
    mesh.check_structure().expect("whole");
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

/// A ring of edges around the Z axis, from an angle in turns.
fn ring(mesh: &mut EditMesh, sides: usize, z: f64, turn: f64) -> Vec<EdgeId> {
    let vertices: Vec<VertexId> = (0..sides)
        .map(|i| {
            let (sin, cos) = sin_cos(std::f64::consts::TAU * (i as f64 / sides as f64 + turn));
            mesh.add_vertex(DVec3::new(cos, sin, z).as_vec3()).expect("room")
        })
        .collect();
    let next = vertices.iter().cycle().skip(1);
    vertices.iter().zip(next).map(|(&a, &b)| mesh.add_edge(a, b).expect("two")).collect()
}

/// Positive where the faces of a tube around the origin face outwards.
fn sum_of_outward_areas(mesh: &EditMesh) -> f64 {
    let of_face = |face| {
        let points: Vec<DVec3> = mesh.face_vertices(face).map(|vertex| mesh.point(vertex)).collect();
        area_vector(points.iter().copied()).dot(points[0])
    };
    mesh.faces().map(of_face).sum()
}

#[test]
fn two_rings_make_a_tube_whatever_the_order() {
    for turn in [0.0, 0.2, 0.5, 0.9] {
        let mut mesh = EditMesh::new();
        let mut edges = ring(&mut mesh, 8, 0.0, 0.0);
        edges.extend(ring(&mut mesh, 8, 1.0, turn));
        let mut turned = mesh.clone();
        let filled = mesh.bridge_edges(&edges, &BridgeSettings::default()).expect("two loops");
        assert_eq!((counts(&mesh), filled.edges.len()), ([16, 24, 8], 8), "eight quads");
        assert!(sum_of_outward_areas(&mesh) > 0.0, "they face outwards");
        // A turn by less than half a side: the nearest vertex is at most that far away.
        let longest = filled.edges.iter().map(|&edge| {
            let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex));
            a.distance(b)
        });
        // √(1² + (2 sin(π/16))²) and a margin for rounding.
        assert!(longest.fold(0.0, f64::max) < 1.074, "no twist at {turn}");
        edges.reverse();
        turned.bridge_edges(&edges, &BridgeSettings::default()).expect("two loops");
        assert!(turned == mesh, "the order does not matter");
    }
}

#[test]
fn loops_of_unequal_counts_are_joined_evenly() {
    let mut mesh = EditMesh::new();
    let mut edges = ring(&mut mesh, 12, 0.0, 0.0);
    edges.extend(ring(&mut mesh, 5, 1.0, 0.0));
    let filled = mesh.bridge_edges(&edges, &BridgeSettings::default()).expect("two loops");
    counts(&mesh);
    let corners: usize = filled.faces.iter().map(|&face| mesh.face_size(face)).sum();
    // Each side of both loops is in one face, each edge across in two.
    assert_eq!(corners, 12 + 5 + 2 * filled.edges.len(), "a closed strip");
    assert!(edges.iter().all(|&edge| mesh.is_boundary(edge)), "each side is used once");
    assert!(filled.edges.iter().all(|&edge| mesh.edge_pair(edge).is_some()), "no gap");
}

#[test]
fn the_missing_side_of_a_box_is_wound_like_the_faces_around_it() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let is_lid = |mesh: &EditMesh, face: FaceId| {
        mesh.face_vertices(face).all(|vertex| mesh.position(vertex).y == 1.0)
            || mesh.face_vertices(face).all(|vertex| mesh.position(vertex).y == -1.0)
    };
    let lids: Vec<FaceId> = mesh.faces().filter(|&face| is_lid(&mesh, face)).collect();
    let sides: Vec<FaceId> = mesh.faces().filter(|face| !lids.contains(face)).collect();
    sides.iter().for_each(|&face| mesh.set_material(face, 3));
    mesh.delete_faces(&lids).expect("they are there");
    mesh.delete_faces(&sides[..1]).expect("it is there");
    // What is left is a U of three sides: its open ends are two chains.
    let ends: Vec<EdgeId> = mesh
        .edges()
        .filter(|&edge| {
            let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.position(vertex));
            mesh.is_boundary(edge) && a.y != b.y
        })
        .collect();
    let filled = mesh.bridge_edges(&ends, &BridgeSettings::default()).expect("two edges");
    assert_eq!((filled.faces.len(), counts(&mesh)), (1, [8, 12, 4]), "the fourth side");
    assert_eq!(mesh.material(filled.faces[0]), 3, "like its neighbours");
    let is_opposite = |[a, b]: [CornerId; 2]| mesh.corner_vertex(a) != mesh.corner_vertex(b);
    assert!(ends.iter().all(|&edge| mesh.edge_pair(edge).is_some_and(is_opposite)), "wound alike");
}

#[test]
fn what_cannot_be_bridged_is_said() {
    let mut mesh = EditMesh::new();
    let one = ring(&mut mesh, 4, 0.0, 0.0);
    assert!(mesh.bridge_edges(&one, &BridgeSettings::default()).is_err(), "one loop");
    let two = ring(&mut mesh, 4, 1.0, 0.0);
    let (open, mut all) = ([&one[..], &two[1..]].concat(), [&one[..], &two].concat());
    assert!(mesh.bridge_edges(&open, &BridgeSettings::default()).is_err(), "a loop and a chain");
    all.extend(ring(&mut mesh, 4, 2.0, 0.0));
    assert!(mesh.bridge_edges(&all, &BridgeSettings::default()).is_err(), "three loops");
    assert!(mesh.bridge_edges(&[], &BridgeSettings::default()).is_err(), "nothing");
    mesh.set_position(VertexId(0), Vec3::NAN);
    mesh.bridge_edges(&all[..8], &BridgeSettings::default())
        .expect("places are not asked for more than they tell");
    counts(&mesh);
}

/// A loop of a torus around Z: its middle at an angle in turns on a circle, its plane through the axis.
fn torus_loop(mesh: &mut EditMesh, sides: usize, radii: [f64; 2], turn: f64) -> Vec<EdgeId> {
    let (sin, cos) = sin_cos(std::f64::consts::TAU * turn);
    let edges = ring(mesh, sides, 0.0, 0.0);
    let first = mesh.vertex_count() - sides;
    for i in first..mesh.vertex_count() {
        let vertex = VertexId(i as u32);
        let at = mesh.point(vertex);
        let out = radii[0] + radii[1] * at.x;
        mesh.set_position(vertex, DVec3::new(out * cos, out * sin, radii[1] * at.y).as_vec3());
    }
    edges
}

fn with_cuts(cuts: u32) -> BridgeSettings {
    BridgeSettings { cuts, ..BridgeSettings::default() }
}

/// The profiles are those of Blender 5.0, as measured there for a square tube and three cuts.
#[test]
fn rings_lie_on_straight_lines_and_are_sized_by_the_profile() {
    let cases = [
        (BridgeProfile::Smooth, [1.25, 1.5, 1.25]),
        (BridgeProfile::Sphere, [1.433_012_7, 1.5, 1.433_012_7]),
        (BridgeProfile::Linear, [1.25, 1.5, 1.25]),
    ];
    for (profile_shape, sizes) in cases {
        for profile_factor in [0.0, 0.5] {
            let mut mesh = EditMesh::new();
            let mut edges = ring(&mut mesh, 4, 0.0, 0.0);
            edges.extend(ring(&mut mesh, 4, 4.0, 0.0));
            let settings = BridgeSettings { profile_factor, profile_shape, ..with_cuts(3) };
            let made = mesh.bridge_edges(&edges, &settings).expect("two loops");
            assert_eq!((counts(&mesh), made.vertices.len(), made.faces.len()), ([20, 36, 16], 12, 16));
            for &vertex in &made.vertices {
                let [x, y, z] = mesh.position(vertex).to_array();
                let size = 1.0 + (sizes[z as usize - 1] - 1.0) * 2.0 * profile_factor as f32;
                let radius = (x * x + y * y).sqrt();
                assert!((radius - size).abs() < 1e-6 && z.fract() == 0.0, "{x} {y} {z} for {size}");
                assert!(x.abs() < 1e-6 || y.abs() < 1e-6, "the square is not turned");
            }
        }
    }
}

#[test]
fn a_path_between_loops_of_a_torus_is_nearly_the_torus() {
    for turn in [0.125, 0.25] {
        let mut mesh = EditMesh::new();
        let mut edges = torus_loop(&mut mesh, 12, [3.0, 0.5], 0.0);
        edges.extend(torus_loop(&mut mesh, 12, [3.0, 0.5], turn));
        let settings = BridgeSettings { interpolation: BridgePath::Path, ..with_cuts(5) };
        let made = mesh.bridge_edges(&edges, &settings).expect("two loops");
        assert_eq!(made.vertices.len(), 60);
        for &vertex in &made.vertices {
            let at = mesh.point(vertex);
            let tube = DVec3::new(at.truncate().length() - 3.0, at.z, 0.0).length();
            // A cubic curve leaves a quarter of a circle by 2.7e-4 of its radius (M. Goldapp, 1991), and so do rings.
            assert!((tube - 0.5).abs() < 2e-3, "{at} is {tube} from the circle");
        }
    }
}

#[test]
fn loops_side_by_side_are_joined_by_an_arch() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(5.0, 3.0, 5, 3));
    let holes: Vec<FaceId> =
        mesh.faces().filter(|&face| (mesh.face_center(face).x.abs() - 1.0).abs() < 0.1).collect();
    let holes: Vec<FaceId> = holes.into_iter().filter(|&face| mesh.face_center(face).z.abs() < 0.1).collect();
    let up = mesh.face_normal(holes[0]);
    let settings = BridgeSettings { interpolation: BridgePath::Path, ..with_cuts(7) };
    let made = mesh.bridge_faces(&holes, &[], &settings).expect("two loops");
    counts(&mesh);
    assert!(made.vertices.iter().all(|&vertex| mesh.point(vertex).dot(up) > 0.0), "on the upper side");
    let sides = mesh.edges().filter(|&edge| mesh.is_boundary(edge)).count();
    assert_eq!(sides, 16, "only the border is open");
}

#[test]
fn cuts_change_neither_the_volume_nor_the_genus_and_spread_values_evenly() {
    let (mut cube, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
    let open: Vec<FaceId> = cube.faces().filter(|&face| cube.face_center(face).x > 0.5).collect();
    let border: Vec<EdgeId> = cube.face_edges(open[0]).step_by(2).collect();
    cube.delete_only_faces(&open).expect("it is there");
    for interpolation in [BridgePath::Linear, BridgePath::Path] {
        for cuts in [0, 1, 4] {
            let mut mesh = cube.clone();
            // A smoothness of 0: the path is straight, although the sides beside it lead elsewhere.
            let settings = BridgeSettings { interpolation, smoothness: 0.0, ..with_cuts(cuts) };
            let made = mesh.bridge_edges(&border, &settings).expect("two chains");
            assert_eq!((made.faces.len() as u32, made.vertices.len() as u32), (cuts + 1, 2 * cuts));
            counts(&mesh);
            if interpolation == BridgePath::Linear {
                keeps_affine_values(&mesh).expect("between both ends");
            }
        }
    }
    let mut tube = EditMesh::from_mesh(&primitives::cube(2.0)).0;
    let lids: Vec<FaceId> = tube.faces().filter(|&face| tube.face_center(face).y.abs() > 0.5).collect();
    let sides: Vec<FaceId> = tube.faces().filter(|&face| tube.face_center(face).y.abs() < 0.5).collect();
    let edges: Vec<EdgeId> = lids.iter().flat_map(|&face| tube.face_edges(face)).collect();
    tube.delete_only_faces(&sides).expect("four");
    for interpolation in [BridgePath::Linear, BridgePath::Path] {
        let mut mesh = tube.clone();
        // Loops between which edges are left.
        mesh.bridge_edges(&edges, &BridgeSettings { interpolation, ..with_cuts(6) }).expect("two loops");
        assert!((mesh.volume() - 8.0).abs() < 1e-5, "{}", mesh.volume());
        assert_eq!(mesh.face_count(), 2 + 4 * 7);
    }
}

#[test]
fn a_twist_turns_the_second_loop() {
    for (twist, length) in [(0, 1.0), (1, 2.0), (-1, 2.0), (2, 3.0), (6, 1.0), (5, 2.0)] {
        let mut mesh = EditMesh::new();
        let mut edges = ring(&mut mesh, 6, 0.0, 0.0);
        edges.extend(ring(&mut mesh, 6, 1.0, 0.0));
        let settings = BridgeSettings { twist, ..BridgeSettings::default() };
        let made = mesh.bridge_edges(&edges, &settings).expect("two loops");
        // Between vertices of a hexagon of radius 1: 0, 1 and √3, squared, and 1 for the height.
        for edge in made.edges {
            let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex));
            assert!((a.distance_squared(b) - [1.0, 2.0, 4.0][length as usize - 1]).abs() < 1e-6, "{twist}");
        }
    }
    let mut mesh = EditMesh::new();
    let mut edges = ring(&mut mesh, 6, 0.0, 0.0)[1..].to_vec();
    edges.extend(&ring(&mut mesh, 6, 1.0, 0.0)[1..]);
    for wrong in [
        BridgeSettings { twist: 1, ..BridgeSettings::default() },
        with_cuts(1001),
        BridgeSettings { smoothness: -1.0, ..BridgeSettings::default() },
        BridgeSettings { profile_factor: f64::NAN, ..BridgeSettings::default() },
    ] {
        assert!(mesh.bridge_edges(&edges, &wrong).is_err(), "{wrong:?}");
    }
}

proptest! {
    #[test]
    fn bridging_keeps_every_rule(start in meshes(), picks in prop::collection::vec(any::<u32>(), 2..4), cuts in 0u32..3, curved: bool) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        // Two edges without a common vertex are two chains.
        let all: Vec<EdgeId> = mesh.edges().collect();
        let edges = picks.iter().filter_map(|&pick| all.get(pick as usize % all.len().max(1)).copied());
        let edges: Vec<EdgeId> = edges.collect();
        let interpolation = if curved { BridgePath::Path } else { BridgePath::Linear };
        let settings = BridgeSettings { interpolation, ..with_cuts(cuts) };
        let outcome = check_operation(&mesh, |mesh| mesh.bridge_edges(&edges, &settings));
        if let Some((after, filled)) = outcome.map_err(TestCaseError::fail)? {
            prop_assert_eq!(after.face_count(), mesh.face_count() + filled.faces.len());
            prop_assert_eq!(after.edge_count(), mesh.edge_count() + filled.edges.len());
        }
    }
}
