//! Exact counts and positions of rips, and properties of rips of any mesh.

use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::super::region::tests::{check_change, counts, open_edges, winds_consistently};
use super::*;
use crate::tests::{keeps_affine_values, meshes, with_affine_values};

/// A grid of 4×4 quads of 1 m around the origin, in the plane y = 0.
fn grid() -> trigon_mesh::Mesh {
    with_affine_values(primitives::grid(4.0, 4.0, 4, 4))
}

fn vertex_at(mesh: &EditMesh, x: f32, z: f32) -> VertexId {
    let position = Vec3::new(x, 0.0, z);
    mesh.vertices().find(|&vertex| mesh.position(vertex) == position).expect("a vertex is there")
}

/// The edges along x = 0, from one z to another.
fn edges_along_z(mesh: &EditMesh, from: i16, to: i16) -> Vec<EdgeId> {
    let between = |z: i16| {
        let ends = [z, z + 1].map(|z| vertex_at(mesh, 0.0, f32::from(z)));
        mesh.find_edge(ends[0], ends[1]).expect("they are joined")
    };
    (from..to).map(between).collect()
}

/// Moves the loose side, and checks that its faces alone moved.
fn check_loose(mesh: &mut EditMesh, ripped: &Ripped, is_loose: impl Fn(f64) -> bool) {
    for &vertex in &ripped.vertices {
        for face in mesh.vertex_faces(vertex).filter(|face| !ripped.faces.contains(face)) {
            assert!(is_loose(mesh.face_center(face).x), "{face} is on the side of the direction");
        }
        let position = mesh.position(vertex);
        mesh.set_position(vertex, position + Vec3::Y);
    }
}

#[test]
fn a_grid_ripped_across_falls_into_two() {
    for (direction, is_right) in [(DVec3::X, true), (DVec3::NEG_X, false)] {
        let (mut mesh, ripped) =
            check_change(&grid(), |mesh| mesh.rip(&edges_along_z(mesh, -2, 2), &[], direction, false))
                .expect("edges");
        assert_eq!(counts(&mesh), [30, 44, 16], "five vertices and four edges more");
        assert_eq!((ripped.vertices.len(), open_edges(&mesh)), (5, 16 + 8), "open on both sides");
        keeps_affine_values(&mesh).expect("values are those of the old corners");
        check_loose(&mut mesh, &ripped, |x| (x > 0.0) == is_right);
    }
}

#[test]
fn a_slit_stays_joined_where_it_ends_within_the_mesh() {
    let rip = |mesh: &mut EditMesh| mesh.rip(&edges_along_z(mesh, -2, 1), &[], DVec3::X, false);
    let (mut mesh, ripped) = check_change(&grid(), rip).expect("edges");
    // Vertices at z = -2, -1, 0; the one at z = 1 is the end.
    assert_eq!(counts(&mesh), [28, 43, 16], "three vertices and three edges more");
    check_loose(&mut mesh, &ripped, |x| x > 0.0);
    let end = vertex_at(&mesh, 0.0, 1.0);
    assert_eq!(mesh.vertex_faces(end).count(), 4, "the end is as it was");
}

#[test]
fn the_gap_of_a_rip_is_filled() {
    let rip = |mesh: &mut EditMesh| mesh.rip(&edges_along_z(mesh, -2, 1), &[], DVec3::X, true);
    let (mut mesh, ripped) = check_change(&grid(), rip).expect("edges");
    assert_eq!(ripped.faces.len(), 3, "two quads and the triangle at the end");
    assert_eq!(open_edges(&mesh), 16 + 1, "one edge more of the border");
    assert!(winds_consistently(&mesh), "new faces wind as their neighbours");
    check_loose(&mut mesh, &ripped, |x| x > 0.0);
    // A step of 1 m in height: two quads, and a triangle that is half as large.
    let area: f64 = ripped.faces.iter().map(|&face| mesh.face_area(face)).sum();
    assert!((area - 2.5).abs() < 1e-9, "{area} m²");
}

#[test]
fn a_loop_ripped_around_a_tube_parts_it() {
    let start = with_affine_values(primitives::torus(2.0, 0.5, 8, 6));
    for direction in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(-1.0, 0.5, 0.1)] {
        let rip = |mesh: &mut EditMesh| {
            let first = mesh.edges().next().expect("it has edges");
            // Across each quad to the opposite edge, on around the tube.
            let mut ring = vec![first];
            let mut corner = mesh.edge_corners(first).next().expect("a side");
            loop {
                corner = mesh.next_corner(mesh.radial_next(mesh.next_corner(corner)));
                if mesh.corner_edge(corner) == first {
                    break;
                }
                ring.push(mesh.corner_edge(corner));
            }
            mesh.rip(&ring, &[], direction, false).map(|ripped| (ring.len(), ripped))
        };
        let (mesh, (length, ripped)) = check_change(&start, rip).expect("a loop");
        assert_eq!((ripped.vertices.len(), open_edges(&mesh)), (length, 2 * length), "two borders");
        assert_eq!(counts(&mesh), [48 + length, 96 + length, 48], "one side has its own");
    }
}

#[test]
fn one_edge_opens_at_both_ends_with_the_face_on_one_side() {
    let rip = |mesh: &mut EditMesh| mesh.rip(&edges_along_z(mesh, 0, 1), &[], DVec3::X, false);
    let (mut mesh, ripped) = check_change(&grid(), rip).expect("an edge");
    assert_eq!(counts(&mesh), [27, 43, 16], "two vertices; the edge and those beside it are there twice");
    check_loose(&mut mesh, &ripped, |x| x == 0.5);
}

#[test]
fn at_a_vertex_the_nearest_face_comes_loose() {
    for fill in [false, true] {
        let direction = DVec3::new(1.0, 0.0, 0.5);
        let rip = |mesh: &mut EditMesh| {
            let middle = vertex_at(mesh, 0.0, 0.0);
            mesh.rip(&[], &[middle], direction, fill)
        };
        let (mesh, ripped) = check_change(&grid(), rip).expect("a vertex");
        let filled = 2 * usize::from(fill);
        assert_eq!((ripped.vertices.len(), ripped.faces.len()), (1, filled), "two triangles fill it");
        assert_eq!(counts(&mesh)[0], 26, "one vertex more");
        let faces: Vec<FaceId> =
            mesh.vertex_faces(ripped.vertices[0]).filter(|face| !ripped.faces.contains(face)).collect();
        let [face] = faces[..] else { panic!("one face is loose, not {faces:?}") };
        assert_eq!(mesh.face_center(face), DVec3::new(0.5, 0.0, 0.5), "in the direction");
        assert!(winds_consistently(&mesh), "alike");
    }
}

#[test]
fn what_cannot_be_ripped_is_said() {
    let border = |mesh: &mut EditMesh| {
        let edge = mesh.edges().find(|&edge| mesh.is_boundary(edge)).expect("a border");
        let corner = vertex_at(mesh, 2.0, 2.0);
        mesh.rip(&[edge], &[corner], DVec3::X, false)
    };
    let refusal = check_change(&grid(), border).expect_err("one face at each");
    assert!(refusal.to_string().contains("two faces"), "{refusal}");
    let missing = check_change(&grid(), |mesh| mesh.rip(&[EdgeId(999)], &[], DVec3::X, false));
    assert_eq!(missing.map(drop), Err(Refusal::NoSuchEdge(EdgeId(999))), "there is none");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn rips_keep_the_structure_the_faces_and_their_values(
        start in meshes(),
        bits in any::<[u64; 2]>(),
        direction in prop::array::uniform3(-1.0f64..1.0),
        fill: bool,
    ) {
        let chosen = |index: u32, bits: u64| bits >> (index % 64) & 1 != 0;
        let done = check_change(&start, |mesh| {
            let edges: Vec<EdgeId> = mesh.edges().filter(|edge| chosen(edge.0, bits[0])).collect();
            let vertices: Vec<VertexId> = mesh.vertices().filter(|vertex| chosen(vertex.0, bits[1])).collect();
            mesh.rip(&edges, &vertices, DVec3::from(direction), fill)
        });
        if let Ok((mesh, ripped)) = done {
            prop_assert_eq!(mesh.face_count(), start.face_count() + ripped.faces.len());
            prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
            prop_assert!(!ripped.vertices.is_empty());
        }
    }

    #[test]
    fn a_direction_that_is_no_number_does_no_harm(start in meshes(), bits in any::<u64>()) {
        let rip = |mesh: &mut EditMesh| {
            let edges: Vec<EdgeId> = mesh.edges().filter(|edge| bits >> (edge.0 % 64) & 1 != 0).collect();
            mesh.rip(&edges, &[], DVec3::NAN, true)
        };
        drop(check_change(&start, rip));
    }
}
