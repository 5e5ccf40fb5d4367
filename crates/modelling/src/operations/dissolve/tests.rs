//! Dissolving with known results, and of random elements of random meshes.

use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::super::region::tests::{check_change, chosen_faces, counts, open_edges};
use super::*;
use crate::tests::{keeps_affine_values, meshes, with_affine_values};

fn edge_between(mesh: &EditMesh, a: u32, b: u32) -> EdgeId {
    mesh.find_edge(VertexId(a), VertexId(b)).expect("they are joined")
}

#[test]
fn a_region_of_a_grid_becomes_one_polygon() {
    let start = with_affine_values(primitives::grid(3.0, 3.0, 3, 3));
    let all: Vec<FaceId> = (0..9).map(FaceId).collect();
    let (mesh, dissolved) = check_change(&start, |mesh| mesh.dissolve_faces(&all)).expect("a square");
    assert_eq!(counts(&mesh), [12, 12, 1], "its outline");
    assert_eq!((dissolved.faces, dissolved.removed_vertices), (vec![FaceId(0)], 4), "the first face stays");
    assert_eq!(mesh.face_size(FaceId(0)), 12, "with all vertices on the outline");
    keeps_affine_values(&mesh).expect("corners keep their values");
    let area = mesh.to_mesh().0.surface_area();
    assert!((area - 9.0).abs() < 1e-5, "the same surface: {area}");
}

#[test]
fn holes_and_closed_surfaces_are_refused() {
    let ring: Vec<FaceId> = (0..9).filter(|&face| face != 4).map(FaceId).collect();
    let start = primitives::grid(3.0, 3.0, 3, 3);
    let ring = check_change(&start, |mesh| mesh.dissolve_faces(&ring)).map(drop).expect_err("a hole");
    assert!(ring.to_string().contains("hole"), "{ring}");
    let all: Vec<FaceId> = (0..6).map(FaceId).collect();
    let cube = primitives::cube(2.0);
    let closed = check_change(&cube, |mesh| mesh.dissolve_faces(&all)).map(drop).expect_err("closed");
    assert!(closed.to_string().contains("closed"), "{closed}");
    let apart = check_change(&start, |mesh| mesh.dissolve_faces(&[FaceId(0), FaceId(8)]));
    assert!(matches!(apart, Err(Refusal::NotPossible { .. })), "they are not joined");
}

#[test]
fn a_vertex_of_a_cube_leaves_a_hexagon() {
    let start = with_affine_values(primitives::cube(2.0));
    let dissolve = |mesh: &mut EditMesh| mesh.dissolve_vertices(&[VertexId(0)]);
    let (mesh, dissolved) = check_change(&start, dissolve).expect("three faces");
    assert_eq!(counts(&mesh), [7, 9, 4], "three faces became one");
    assert_eq!((mesh.face_size(dissolved.faces[0]), open_edges(&mesh)), (6, 0), "a hexagon, closed");
    keeps_affine_values(&mesh).expect("corners keep their values");
}

#[test]
fn vertices_on_borders_and_wires_leave_one_edge() {
    let start = with_affine_values(primitives::grid(2.0, 1.0, 2, 1));
    // In the middle of a long side, and at a corner.
    let middle = EditMesh::from_mesh(&start).0;
    let is_middle = |vertex: &VertexId| middle.vertex_edges(*vertex).count() == 3;
    let vertex = middle.vertices().find(is_middle).expect("two have three edges");
    let (mesh, _) = check_change(&start, |mesh| mesh.dissolve_vertices(&[vertex])).expect("two faces");
    assert_eq!(counts(&mesh), [5, 5, 1], "both faces are one");
    let (mesh, _) = check_change(&start, |mesh| mesh.dissolve_vertices(&[VertexId(0)])).expect("a corner");
    assert_eq!(counts(&mesh), [5, 6, 2], "a quad became a triangle");
    let mut wire = EditMesh::new();
    let line = [0.0, 1.0, 2.0].map(|x| wire.add_vertex(Vec3::new(x, 0.0, 0.0)).expect("room"));
    wire.add_edge(line[0], line[1]).expect("an edge");
    wire.add_edge(line[1], line[2]).expect("an edge");
    wire.dissolve_vertices(&[line[1]]).expect("between two edges");
    assert_eq!(counts(&wire), [2, 1, 0], "one edge");
}

#[test]
fn an_edge_of_a_grid_leaves_a_larger_face() {
    let start = with_affine_values(primitives::grid(2.0, 2.0, 2, 2));
    let mesh = EditMesh::from_mesh(&start).0;
    let inner: Vec<EdgeId> = mesh.edges().filter(|&edge| !mesh.is_boundary(edge)).collect();
    let (one, dissolved) = check_change(&start, |mesh| mesh.dissolve_edges(&inner[..1])).expect("an edge");
    // The border's vertex between the two faces goes along.
    assert_eq!((counts(&one), dissolved.removed_vertices), ([8, 10, 3], 1), "two faces became one");
    let (all, dissolved) = check_change(&start, |mesh| mesh.dissolve_edges(&inner)).expect("four edges");
    assert_eq!((counts(&all), dissolved.removed_vertices), ([4, 4, 1], 5), "one square is left");
    keeps_affine_values(&all).expect("corners keep their values");
    let border = check_change(&start, |mesh| {
        let border = mesh.edges().find(|&edge| mesh.is_boundary(edge)).expect("eight");
        mesh.dissolve_edges(&[border])
    });
    assert!(matches!(border, Err(Refusal::NotPossible { .. })), "there is nothing on its other side");
}

/// One edge of the border in the selection used to refuse all.
#[test]
fn edges_of_the_border_stay_when_others_are_dissolved() {
    let start = primitives::grid(2.0, 2.0, 2, 2);
    let (mesh, dissolved) = check_change(&start, |mesh| {
        let all: Vec<EdgeId> = mesh.edges().collect();
        mesh.dissolve_edges(&all)
    })
    .expect("four of them are inside");
    assert_eq!((counts(&mesh), dissolved.left_edges), ([4, 4, 1], 8), "one square is left");
}

#[test]
fn a_cut_cube_becomes_a_cube_again() {
    let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
    // Each edge in three parts, and some cuts through faces.
    let edges: Vec<EdgeId> = mesh.edges().collect();
    for edge in edges {
        let split = mesh.split_edge(edge, 0.25).expect("an edge");
        mesh.split_edge(split.edge, 0.5).expect("its other part");
    }
    for face in [0, 2, 5].map(FaceId) {
        let corners: Vec<_> = mesh.face_corners(face).collect();
        mesh.split_face(corners[1], corners[6]).expect("across");
    }
    let all: Vec<FaceId> = mesh.faces().collect();
    let limits = LimitedDissolve::default();
    let (mut apart, dissolved) = (mesh.clone(), mesh.dissolve_limited(&all, limits).expect("faces"));
    mesh.check_structure().expect("whole");
    assert_eq!((counts(&mesh), dissolved.removed_vertices), ([8, 12, 6], 24), "a cube");
    keeps_affine_values(&mesh).expect("corners keep their values");
    // Materials are kept apart.
    let cut = apart.faces().last().expect("the last cut");
    apart.set_material(cut, 3);
    apart.dissolve_limited(&all, limits).expect("faces");
    assert_eq!(apart.face_count(), 7, "one cut is left");
}

#[test]
fn a_curve_is_not_dissolved_as_a_whole() {
    // Sides of a prism that turn by 7.5° each: within 20° of a first one are two more on each side at most.
    let start = primitives::cylinder(1.0, 2.0, 48);
    let all: Vec<FaceId> = (0..start.face_count() as u32).map(FaceId).collect();
    let limits = LimitedDissolve { angle: 20f64.to_radians() };
    let (mesh, _) = check_change(&start, |mesh| mesh.dissolve_limited(&all, limits)).expect("faces");
    let sides = mesh.faces().filter(|&face| mesh.unit_normal(face).y.abs() < 0.5).count();
    assert!((48 / 5..=48 / 3).contains(&sides), "{sides} sides are left of 48");
    let nonsense = LimitedDissolve { angle: -1.0 };
    let nonsense = check_change(&start, |mesh| mesh.dissolve_limited(&all, nonsense));
    assert!(matches!(nonsense, Err(Refusal::OutOfRange { .. })), "no such angle");
}

#[test]
fn faces_around_a_fin_are_not_united() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 1.0, 2, 1));
    let shared = mesh.edges().find(|&edge| mesh.edge_pair(edge).is_some()).expect("one");
    mesh.extrude_edges(&[shared], trigon_math::DVec3::Y).expect("a fin");
    let before = mesh.clone();
    let refusal = mesh.dissolve_edges(&[shared]).expect_err("three faces meet");
    assert!(refusal.to_string().contains("exactly two"), "{refusal}");
    let [a, _] = mesh.edge_vertices(shared);
    mesh.dissolve_vertices(&[a]).expect_err("three faces meet");
    assert!(mesh == before, "nothing was done");
    assert_eq!(edge_between(&mesh, a.0, mesh.other_vertex(shared, a).0), shared, "it is still there");
}

proptest! {
    #[test]
    fn anything_can_be_dissolved_or_is_refused(
        start in meshes(),
        bits in any::<u64>(),
        picks in prop::collection::vec(any::<u32>(), 1..6),
        angle in 0.0f64..3.0,
    ) {
        let was_affine = |mesh: &EditMesh| keeps_affine_values(mesh);
        let faces = chosen_faces(&start, bits);
        let pick = |count: usize| picks.iter().map(move |pick| pick % count.max(1) as u32);
        let edges: Vec<EdgeId> = pick(start.edge_count()).map(EdgeId).collect();
        let vertices: Vec<VertexId> = pick(start.vertex_count()).map(VertexId).collect();
        let limits = LimitedDissolve { angle };
        let results = [
            check_change(&start, |mesh| mesh.dissolve_faces(&faces)),
            check_change(&start, |mesh| mesh.dissolve_edges(&edges)),
            check_change(&start, |mesh| mesh.dissolve_vertices(&vertices)),
            check_change(&start, |mesh| mesh.dissolve_limited(&faces, limits)),
        ];
        for (mesh, dissolved) in results.into_iter().flatten() {
            prop_assert_eq!(was_affine(&mesh), Ok(()));
            prop_assert_eq!(mesh.vertex_count() + dissolved.removed_vertices, start.vertex_count());
            prop_assert!(dissolved.faces.iter().all(|&face| mesh.has_face(face)), "they are there");
        }
    }
}
