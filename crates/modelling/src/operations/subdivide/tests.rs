//! Subdivision: the table of patterns by counts, areas that stay, values that stay affine.

use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

fn editable(mesh: trigon_mesh::Mesh) -> EditMesh {
    EditMesh::from_mesh(&with_affine_values(mesh)).0
}

fn counts(mesh: &EditMesh) -> [usize; 3] {
    mesh.check_structure().expect("whole");
    keeps_affine_values(mesh).expect("values are interpolated");
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

fn area(mesh: &EditMesh, face: FaceId) -> f64 {
    area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).length()
}

fn total_area(mesh: &EditMesh) -> f64 {
    mesh.faces().map(|face| area(mesh, face)).sum()
}

/// One regular polygon.
fn polygon(sides: usize) -> EditMesh {
    let mut mesh = EditMesh::new();
    let vertices: Vec<VertexId> = (0..sides)
        .map(|i| {
            let (sin, cos) =
                trigon_math::elementary::sin_cos(std::f64::consts::TAU * i as f64 / sides as f64);
            mesh.add_vertex(Vec3::new(cos as f32, sin as f32, 0.0)).expect("room")
        })
        .collect();
    mesh.add_face(&vertices).expect("a polygon");
    editable(mesh.to_mesh().0)
}

/// How many faces with each number of sides, from 3 on, a polygon is divided into.
fn parts(sides: usize, cut: &[usize], cuts: u32) -> Vec<usize> {
    let mut mesh = polygon(sides);
    let before = total_area(&mesh);
    let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
    let chosen: Vec<EdgeId> = cut.iter().map(|&side| edges[side]).collect();
    let made = mesh.subdivide(&chosen, cuts).expect("edges");
    counts(&mesh);
    assert!((total_area(&mesh) - before).abs() < 1e-6, "parts of {sides} cover it but for rounding");
    assert_eq!(made.faces.len(), mesh.face_count(), "all parts are told");
    assert_eq!(made.faces[0], FaceId(0), "the old face is the first of them");
    let longest = mesh.faces().map(|face| mesh.face_size(face)).max().expect("there are faces");
    (3..=longest).map(|size| mesh.faces().filter(|&face| mesh.face_size(face) == size).count()).collect()
}

#[test]
fn each_row_of_the_table_has_its_parts() {
    for shift in 0..3 {
        let sides = |list: &[usize]| list.iter().map(|side| (side + shift) % 3).collect::<Vec<_>>();
        assert_eq!(parts(3, &sides(&[0, 1, 2]), 1), [4], "a triangular grid");
        assert_eq!(parts(3, &sides(&[0, 1, 2]), 4), [25], "a triangular grid");
        assert_eq!(parts(3, &sides(&[0, 1]), 3), [1, 3], "from the common corner");
        assert_eq!(parts(3, &sides(&[0]), 3), [4], "a fan");
    }
    for shift in 0..4 {
        let sides = |list: &[usize]| list.iter().map(|side| (side + shift) % 4).collect::<Vec<_>>();
        assert_eq!(parts(4, &sides(&[0, 1, 2, 3]), 1), [0, 4], "a grid");
        assert_eq!(parts(4, &sides(&[0, 1, 2, 3]), 4), [0, 25], "a grid");
        assert_eq!(parts(4, &sides(&[0, 1, 2]), 1), [3, 1], "a quad at the whole side");
        assert_eq!(parts(4, &sides(&[0, 1, 2]), 2), [2, 3], "two quads and a strip");
        assert_eq!(parts(4, &sides(&[0, 2]), 3), [0, 4], "strips");
        assert_eq!(parts(4, &sides(&[0, 1]), 1), [0, 3], "around the corner");
        assert_eq!(parts(4, &sides(&[0, 1]), 3), [0, 7], "around the corner");
        assert_eq!(parts(4, &sides(&[0]), 1), [3], "triangles");
        assert_eq!(parts(4, &sides(&[0]), 2), [2, 1], "a quad in the middle");
    }
    for shift in 0..6 {
        let sides = |list: &[usize]| list.iter().map(|side| (side + shift) % 6).collect::<Vec<_>>();
        assert_eq!(parts(6, &sides(&[0]), 1), [0, 0, 0, 0, 1], "whole");
        assert_eq!(parts(6, &sides(&[0, 1]), 1), [1, 0, 0, 0, 1], "a corner and the rest");
        assert_eq!(parts(6, &sides(&[0, 1]), 3), [1, 2, 0, 0, 1], "strips at a corner");
        assert_eq!(parts(6, &sides(&[0, 3]), 1), [0, 0, 2], "two halves");
        assert_eq!(parts(6, &sides(&[0, 3]), 3), [0, 2, 2], "strips between halves");
        assert_eq!(parts(6, &sides(&[0, 1, 2, 3, 4, 5]), 1), [6, 0, 0, 1], "corners and a hexagon");
        assert_eq!(parts(6, &sides(&[0, 1, 2]), 1), [2, 0, 0, 0, 1], "two corners");
    }
}

#[test]
fn all_edges_of_a_cube_make_four_quads_of_each_face() {
    for cuts in 1..4 {
        let mut mesh = editable(primitives::cube(2.0));
        let all: Vec<EdgeId> = mesh.edges().collect();
        let made = mesh.subdivide(&all, cuts).expect("edges");
        let pieces = cuts as usize + 1;
        let faces = 6 * pieces * pieces;
        assert_eq!(counts(&mesh), [faces + 2, 2 * faces, faces], "closed, of quads");
        assert_eq!((made.vertices.len(), made.edges.len()), (faces + 2 - 8, 2 * faces), "all is told");
        let expected = 4.0 / (pieces * pieces) as f64;
        assert!(
            mesh.faces().all(|face| (area(&mesh, face) - expected).abs() < 1e-6),
            "equal but for rounding"
        );
    }
}

#[test]
fn marks_and_materials_are_inherited() {
    let mut mesh = editable(primitives::cube(2.0));
    let edge = EdgeId(3);
    mesh.set_crease(edge, 0.25);
    mesh.set_seam(edge, true);
    mesh.faces().collect::<Vec<_>>().iter().for_each(|&face| mesh.set_material(face, 7));
    let made = mesh.subdivide(&[edge, edge], 2).expect("one edge");
    let marked = |mesh: &EditMesh, edge| (mesh.crease(edge), mesh.is_seam(edge)) == (0.25, true);
    assert_eq!(mesh.edges().filter(|&edge| marked(&mesh, edge)).count(), 3, "its pieces");
    assert!(mesh.faces().all(|face| mesh.material(face) == 7), "all parts");
    assert_eq!(
        (made.vertices.len(), made.edges.len(), made.faces.len()),
        (2, 3 + 4, 6),
        "two in each of two"
    );
}

#[test]
fn a_reflex_corner_is_not_cut_off() {
    // An L, whose corner 3 turns right.
    let mut mesh = EditMesh::new();
    let positions = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    let vertices: Vec<VertexId> = positions
        .iter()
        .map(|&(x, y)| mesh.add_vertex(Vec3::new(x as f32, y as f32, 0.0)).expect("room"))
        .collect();
    mesh.add_face(&vertices).expect("a polygon");
    let mut mesh = editable(mesh.to_mesh().0);
    let all: Vec<EdgeId> = mesh.edges().collect();
    mesh.subdivide(&all, 1).expect("edges");
    assert_eq!(counts(&mesh), [12, 17, 6], "five corners and the rest");
    assert!((total_area(&mesh) - 3.0).abs() < 1e-6, "nothing overlaps");
}

#[test]
fn what_cannot_be_subdivided_is_said() {
    let mut mesh = editable(primitives::cube(2.0));
    let before = mesh.clone();
    for cuts in [0, 1001] {
        assert!(matches!(mesh.subdivide(&[EdgeId(0)], cuts), Err(Refusal::OutOfRange { .. })), "{cuts}");
    }
    assert_eq!(mesh.subdivide(&[EdgeId(12)], 1), Err(Refusal::NoSuchEdge(EdgeId(12))), "there are twelve");
    assert!(mesh.subdivide(&[], 1).is_err(), "nothing is given");
    assert!(mesh == before, "nothing changed");
    let mut large = editable(primitives::grid(1.0, 1.0, 80, 80));
    let all: Vec<EdgeId> = large.edges().collect();
    assert_eq!(large.subdivide(&all, 1000), Err(Refusal::TooMany), "six milliard faces");
}

proptest! {
    #[test]
    fn subdividing_keeps_every_rule(start in meshes(), chosen in any::<u64>(), cuts in 1u32..5) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        let edges: Vec<EdgeId> = mesh.edges().filter(|edge| chosen >> (edge.0 % 64) & 1 != 0).collect();
        let outcome = check_operation(&mesh, |mesh| mesh.subdivide(&edges, cuts));
        if let Some((after, made)) = outcome.map_err(TestCaseError::fail)? {
            keeps_affine_values(&after).map_err(TestCaseError::fail)?;
            prop_assert!(mesh.vertices().all(|vertex| after.position(vertex) == mesh.position(vertex)));
            prop_assert_eq!(mesh.vertex_count() + made.vertices.len(), after.vertex_count());
            prop_assert!(mesh.faces().all(|face| after.has_face(face)) && mesh.edges().all(|edge| after.has_edge(edge)));
        }
    }
}
