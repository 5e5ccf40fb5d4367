//! Connecting vertices: counts, straight paths, and values that stay affine.

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

fn polygon(positions: &[[f32; 2]]) -> (EditMesh, Vec<VertexId>) {
    let mut mesh = EditMesh::new();
    let add = |&[x, y]: &[f32; 2]| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room");
    let vertices: Vec<VertexId> = positions.iter().map(add).collect();
    mesh.add_face(&vertices).expect("a polygon");
    (editable(mesh.to_mesh().0), vertices)
}

#[test]
fn two_corners_of_a_quad_are_joined_by_its_diagonal() {
    let mut mesh = editable(primitives::cube(2.0));
    let v: Vec<VertexId> = mesh.face_vertices(FaceId(0)).collect();
    let connected = mesh.connect_vertices(&[v[2], v[0]]).expect("a diagonal");
    assert_eq!((counts(&mesh), connected.edges.len()), ([8, 13, 7], 1), "two triangles");
    assert!(mesh.find_edge(v[0], v[2]) == Some(connected.edges[0]), "between both");
    assert!(mesh.connect_vertices(&[v[0], v[2]]).is_err(), "they are joined");
    assert!(mesh.connect_vertices(&[v[0], v[1]]).is_err(), "they always were");
}

#[test]
fn every_second_vertex_of_a_hexagon_makes_a_triangle_in_it() {
    let positions = [[2.0, 0.0], [1.0, 2.0], [-1.0, 2.0], [-2.0, 0.0], [-1.0, -2.0], [1.0, -2.0]];
    let (mut mesh, v) = polygon(&positions);
    let connected = mesh.connect_vertices(&[v[0], v[2], v[4]]).expect("three cuts");
    assert_eq!((counts(&mesh), connected.edges.len()), ([6, 9, 4], 3), "four triangles");
    let (mut mesh, v) = polygon(&positions);
    mesh.connect_vertices(&v[..4]).expect("one cut: the others are neighbours");
    assert_eq!(counts(&mesh), [6, 7, 2], "two quads");
}

#[test]
fn a_cut_does_not_leave_a_concave_face() {
    // A U: between its tips is nothing.
    let positions =
        [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let (mut mesh, v) = polygon(&positions);
    let before = mesh.clone();
    assert!(mesh.connect_vertices(&[v[3], v[6]]).is_err(), "across the gap");
    assert!(mesh.connect_vertices(&[v[2], v[7]]).is_err(), "through both tips");
    assert!(mesh == before, "nothing changed");
    mesh.connect_vertices(&[v[0], v[5]]).expect("inside");
    assert_eq!(counts(&mesh), [8, 9, 2], "two parts");
}

#[test]
fn a_path_runs_straight_over_several_faces() {
    let start = editable(primitives::grid(4.0, 4.0, 4, 4));
    let at = |x: f32, z: f32| {
        start.vertices().find(|&v| start.position(v) == Vec3::new(x, 0.0, z)).expect("a grid point")
    };
    // Three quads beside one another: two edges are crossed.
    let mut mesh = start.clone();
    let connected = mesh.connect_vertices(&[at(-2.0, 0.0), at(1.0, 1.0)]).expect("a path");
    assert_eq!((connected.vertices.len(), connected.edges.len()), (2, 3), "cut at two edges");
    assert_eq!(counts(&mesh), [25 + 2, 40 + 2 + 3, 16 + 3], "each face in two");
    for vertex in connected.vertices {
        let position = mesh.position(vertex);
        // z = (x + 2) / 3, rounded once.
        assert!((position.z - (position.x + 2.0) / 3.0).abs() < 1e-6, "{position} is on the line");
    }
    // Through vertices: four diagonals, no new vertex.
    let mut mesh = start.clone();
    let connected = mesh.connect_vertices(&[at(-2.0, -2.0), at(2.0, 2.0)]).expect("a path");
    assert_eq!((counts(&mesh), connected.edges.len()), ([25, 44, 20], 4), "four diagonals");
    // Along edges: nothing is cut.
    let mut mesh = start.clone();
    let connected = mesh.connect_vertices(&[at(-2.0, 0.0), at(2.0, 0.0)]).expect("a path");
    assert_eq!((counts(&mesh), connected.edges.len()), ([25, 40, 16], 4), "the edges between");
}

#[test]
fn a_path_over_the_edge_of_a_cube_is_found() {
    let mut mesh = editable(primitives::cube(2.0));
    let all: Vec<EdgeId> = mesh.edges().collect();
    mesh.subdivide(&all, 1).expect("edges");
    let middle = |mesh: &EditMesh, position: Vec3| {
        mesh.vertices().find(|&vertex| mesh.position(vertex) == position).expect("a face's middle")
    };
    let ends = [middle(&mesh, Vec3::X), middle(&mesh, Vec3::Y)];
    let connected = mesh.connect_vertices(&ends).expect("a path");
    assert_eq!(connected.edges.len(), 2, "over the edge between both faces");
    let before = mesh.clone();
    let opposite = [ends[0], middle(&mesh, Vec3::NEG_X)];
    assert!(mesh.connect_vertices(&opposite).is_err(), "no plane is better than another");
    assert!(mesh == before, "nothing changed");
}

proptest! {
    #[test]
    fn connecting_keeps_every_rule(start in meshes(), chosen in any::<u64>(), pair: bool) {
        let (mesh, _) = EditMesh::from_mesh(&start);
        let mut vertices: Vec<VertexId> = mesh.vertices().filter(|v| chosen >> (v.0 % 64) & 1 != 0).collect();
        if pair {
            vertices.truncate(2);
        }
        let outcome = check_operation(&mesh, |mesh| mesh.connect_vertices(&vertices));
        if let Some((after, connected)) = outcome.map_err(TestCaseError::fail)? {
            keeps_affine_values(&after).map_err(TestCaseError::fail)?;
            prop_assert_eq!(after.vertex_count(), mesh.vertex_count() + connected.vertices.len());
            prop_assert_eq!(after.face_count(), mesh.face_count() + connected.faces.len());
        }
    }
}

/// A side far from a cut, whose line the cut crosses without crossing the side itself.
#[test]
fn a_cut_that_crosses_only_the_line_of_a_side_is_made() {
    let positions = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let (mut mesh, vertices) = polygon(&positions);
    let connected = mesh.connect_vertices(&[vertices[0], vertices[2]]).expect("within the L");
    assert_eq!((counts(&mesh), connected.edges.len()), ([6, 7, 2], 1), "cut in two");
}

/// Between opposite corners of three by three squares, the path meets the inner vertices of the diagonal exactly.
#[test]
fn a_path_through_vertices_makes_no_others() {
    for [x, z] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let mut mesh = editable(primitives::grid(3.0, 3.0, 3, 3));
        let at = |mesh: &EditMesh, scale: f32| {
            let position = Vec3::new(1.5 * x * scale, 0.0, 1.5 * z * scale);
            mesh.vertices().find(|&vertex| mesh.position(vertex) == position).expect("a corner")
        };
        let ends = [at(&mesh, 1.0), at(&mesh, -1.0)];
        let connected = mesh.connect_vertices(&ends).expect("a straight path");
        assert_eq!((counts(&mesh), connected.edges.len()), ([16, 27, 12], 3), "towards {x}, {z}");
    }
}
