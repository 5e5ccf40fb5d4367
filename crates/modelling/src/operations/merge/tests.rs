//! Merging, against counts that are known and a search that compares every pair.

use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::primitives;

use super::*;
use crate::ids::FaceId;
use crate::tests::{check_operation, meshes};

fn editable(mesh: &trigon_mesh::Mesh) -> EditMesh {
    EditMesh::from_mesh(mesh).0
}

fn counts(mesh: &EditMesh) -> [usize; 3] {
    mesh.check_structure().expect("whole");
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

/// A cube whose six faces have vertices of their own.
fn cube_in_pieces() -> EditMesh {
    let cube = primitives::cube(2.0);
    let mut mesh = EditMesh::new();
    for range in cube.faces() {
        let vertices: Vec<VertexId> = cube.corner_vertices()[range]
            .iter()
            .map(|&vertex| mesh.add_vertex(cube.positions()[vertex as usize]).expect("room"))
            .collect();
        mesh.add_face(&vertices).expect("four vertices");
    }
    mesh
}

fn all(mesh: &EditMesh) -> Vec<VertexId> {
    mesh.vertices().collect()
}

#[test]
fn a_cube_in_pieces_becomes_whole() {
    for distance in [0.0, 1e-6, 1.9] {
        let mut mesh = cube_in_pieces();
        let merged = mesh.merge_by_distance(&all(&mesh), distance).expect("a distance");
        assert_eq!(counts(&mesh), [8, 12, 6], "a cube at {distance} m");
        assert_eq!((merged.vertices.len(), merged.removed), (8, 16), "three become one in each corner");
    }
    let mut mesh = cube_in_pieces();
    assert_eq!(mesh.merge_by_distance(&all(&mesh), 4.0).expect("a distance").removed, 23, "all into one");
    assert_eq!(counts(&mesh), [1, 0, 0], "no face has three vertices");
}

#[test]
fn a_chain_of_near_vertices_does_not_collapse_as_a_whole() {
    let mut mesh = EditMesh::new();
    for x in 0..10 {
        mesh.add_vertex(Vec3::X * x as f32).expect("room");
    }
    let mut given = all(&mesh);
    given.reverse();
    let merged = mesh.merge_by_distance(&given, 1.0).expect("a distance");
    assert_eq!(merged.vertices, [0, 2, 4, 6, 8].map(VertexId), "each takes the next one");
    assert!(mesh.vertices().all(|vertex| mesh.position(vertex).x == vertex.0 as f32), "none moved");
}

#[test]
fn four_corners_of_a_face_meet_where_they_are_told_to() {
    let cube = editable(&primitives::cube(2.0));
    let face: Vec<VertexId> = cube.face_vertices(FaceId(0)).collect();
    let center = face.iter().map(|&vertex| cube.position(vertex)).sum::<Vec3>() / 4.0;
    let position_after = |merge: &dyn Fn(&mut EditMesh) -> Result<MergedVertices, Refusal>| {
        let mut mesh = cube.clone();
        let merged = merge(&mut mesh).expect("four vertices");
        assert_eq!((merged.removed, counts(&mesh)), (3, [5, 8, 5]), "a pyramid");
        mesh.position(merged.vertices[0])
    };
    assert_eq!(position_after(&|mesh| mesh.merge_at_center(&face)), center, "the middle of the face");
    assert_eq!(position_after(&|mesh| mesh.merge_at_first(&face)), cube.position(face[0]), "the first");
    assert_eq!(position_after(&|mesh| mesh.merge_at_last(&face)), cube.position(face[3]), "the last");
    let edges: Vec<EdgeId> = cube.face_edges(FaceId(0)).collect();
    assert_eq!(position_after(&|mesh| mesh.collapse_edges(&edges)), center, "one part");
}

#[test]
fn each_part_collapses_to_its_own_center() {
    let mut mesh = editable(&primitives::grid(3.0, 1.0, 3, 1));
    // The two outer sides, which share no vertex.
    let sides: Vec<EdgeId> = mesh
        .edges()
        .filter(|&edge| mesh.edge_vertices(edge).iter().all(|&vertex| mesh.position(vertex).x.abs() == 1.5))
        .collect();
    let merged = mesh.collapse_edges(&sides).expect("two edges");
    assert_eq!((merged.removed, counts(&mesh)), (2, [6, 8, 3]), "two quads became triangles");
    for vertex in merged.vertices {
        assert_eq!(mesh.position(vertex).z, 0.0, "the middle of a side");
    }
}

#[test]
fn vertices_that_are_not_finite_stay() {
    let mut mesh = EditMesh::new();
    for x in [f32::NAN, f32::INFINITY, f32::INFINITY, 1.0, 1.0] {
        mesh.add_vertex(Vec3::new(x, 0.0, 0.0)).expect("room");
    }
    assert_eq!(mesh.merge_by_distance(&all(&mesh), 1.0).expect("a distance").removed, 1, "only the finite");
}

#[test]
fn what_cannot_be_merged_is_said() {
    let mut mesh = editable(&primitives::cube(2.0));
    let before = mesh.clone();
    for distance in [-1.0, f64::NAN, f64::INFINITY] {
        let refusal = mesh.merge_by_distance(&[VertexId(0)], distance).expect_err("no distance");
        assert!(matches!(refusal, Refusal::OutOfRange { .. }), "{refusal}");
    }
    let gone = VertexId(8);
    let missing = Err(Refusal::NoSuchVertex(gone));
    assert_eq!(mesh.merge_at_center(&[VertexId(0), gone]), missing, "there are eight");
    assert_eq!(mesh.merge_at_first(&[gone, VertexId(0)]), missing, "there are eight");
    assert_eq!(mesh.merge_at_last(&[VertexId(0), gone]), missing, "there are eight");
    assert!(mesh.collapse_edges(&[]).is_err(), "nothing is given");
    assert!(mesh == before, "nothing changed");
}

/// The stated rule, by comparing every pair.
fn expected_pairs(mesh: &EditMesh, vertices: &[VertexId], distance: f64) -> Vec<(VertexId, VertexId)> {
    let mut pairs: Vec<(VertexId, VertexId)> = Vec::new();
    for (i, &kept) in vertices.iter().enumerate() {
        if pairs.iter().any(|&(gone, _)| gone == kept) {
            continue;
        }
        for &other in &vertices[i + 1..] {
            let is_near = mesh.point(kept).distance_squared(mesh.point(other)) <= distance * distance;
            if is_near && !pairs.iter().any(|&(gone, _)| gone == other) {
                pairs.push((other, kept));
            }
        }
    }
    pairs
}

proptest! {
    #[test]
    fn the_tree_finds_what_comparing_every_pair_finds(
        positions in prop::collection::vec(prop::array::uniform3(-8i8..8), 1..200),
        distance in 0u8..40,
    ) {
        let mut mesh = EditMesh::new();
        for [x, y, z] in positions {
            // The rule has to hold where many distances are exactly the limit, too.
            mesh.add_vertex(Vec3::new(f32::from(x), f32::from(y), f32::from(z) / 4.0)).expect("room");
        }
        let (distance, vertices) = (f64::from(distance) / 4.0, all(&mesh));
        let pairs = expected_pairs(&mesh, &vertices, distance);
        let merged = mesh.merge_by_distance(&vertices, distance).expect("a distance");
        prop_assert_eq!(merged.removed, pairs.len());
        for (gone, kept) in pairs {
            prop_assert!(!mesh.has_vertex(gone) && mesh.has_vertex(kept));
            prop_assert!(merged.vertices.binary_search(&kept).is_ok());
        }
    }

    #[test]
    fn merging_keeps_every_rule(start in meshes(), kind in 0u8..5, chosen in any::<u64>(), distance in 0.0..3.0) {
        let mesh = editable(&start);
        let is_chosen = |index: u32| chosen >> (index % 64) & 1 != 0;
        let vertices: Vec<VertexId> = mesh.vertices().filter(|vertex| is_chosen(vertex.0)).collect();
        let edges: Vec<EdgeId> = mesh.edges().filter(|edge| is_chosen(edge.0)).collect();
        let merged = check_operation(&mesh, |mesh| match kind {
            0 => mesh.merge_by_distance(&vertices, distance),
            1 => mesh.merge_at_center(&vertices),
            2 => mesh.merge_at_first(&vertices),
            3 => mesh.merge_at_last(&vertices),
            _ => mesh.collapse_edges(&edges),
        });
        if let Some((after, merged)) = merged.map_err(TestCaseError::fail)? {
            prop_assert_eq!(after.vertex_count() + merged.removed, mesh.vertex_count());
            prop_assert!(merged.vertices.iter().all(|&vertex| after.has_vertex(vertex)));
        }
    }
}
