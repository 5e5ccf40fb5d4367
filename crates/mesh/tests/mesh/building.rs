//! Vertices, edges, faces and what the builder refuses.

use std::collections::BTreeMap;

use proptest::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, MeshError, primitives};

fn builder(vertices: u32) -> MeshBuilder {
    let mut builder = MeshBuilder::new();
    for i in 0..vertices {
        assert_eq!(builder.push_vertex(Vec3::splat(i as f32)), i, "vertices are numbered in order");
    }
    builder
}

#[test]
fn a_builder_counts_what_it_was_given() {
    let mut builder = builder(5);
    assert_eq!(builder.vertex_count(), 5, "whether faces use them or not");
    builder.push_face(&[0, 1, 2]).expect("a triangle");
    assert_eq!((builder.vertex_count(), builder.face_count()), (5, 1), "a face adds no vertex");
}

#[test]
fn faces_that_bound_nothing_are_refused() {
    let mut builder = builder(3);
    let refused = |result, face, distinct| {
        assert_eq!(result, Err(MeshError::TooFewVertices { face, distinct }), "a face of {distinct}");
    };
    refused(builder.push_face(&[]), 0, 0);
    refused(builder.push_face(&[1, 1, 1]), 0, 1);
    assert_eq!(builder.push_face(&[0, 1, 2]), Ok(0), "a triangle");
    refused(builder.push_face(&[0, 1, 0, 1]), 1, 2);
    let missing = builder.push_face(&[0, 1, 3]);
    assert!(
        matches!(
            missing,
            Err(MeshError::VertexOutOfRange { element: "face", index: 1, vertex: 3, vertex_count: 3 })
        ),
        "vertex 3 does not exist: {missing:?}"
    );
    assert_eq!(builder.build().face_count(), 1, "refused faces leave nothing behind");
}

#[test]
fn edges_come_in_the_order_of_the_faces() {
    let mut builder = builder(6);
    builder.push_loose_edge(5, 4).expect("both vertices exist");
    builder.push_face(&[2, 1, 0]).expect("a triangle");
    builder.push_face(&[0, 1, 3]).expect("a triangle");
    builder.push_loose_edge(1, 0).expect("both vertices exist");
    builder.push_loose_edge(4, 5).expect("both vertices exist");
    let mesh = builder.build();
    assert_eq!(mesh.edges(), [[1, 2], [0, 1], [0, 2], [1, 3], [0, 3], [4, 5]], "all edges, each once");
    assert_eq!(mesh.face_edge_count(), 5, "edges of faces");
    assert_eq!(mesh.loose_edges(), [[4, 5]], "an edge that a face has is not loose");
    let of_second = mesh.face_corners(1).map(|c| mesh.corner_edge(c));
    assert_eq!(of_second.collect::<Vec<_>>(), [Some(1), Some(3), Some(4)], "edges of the second face");
}

#[test]
fn a_repeated_vertex_has_no_edge() {
    let mut builder = builder(3);
    builder.push_face(&[0, 0, 1, 2]).expect("three distinct vertices");
    let mesh = builder.build();
    assert_eq!(mesh.corner_edge(0), None, "from a vertex to itself");
    assert_eq!(mesh.edges(), [[0, 1], [1, 2], [0, 2]], "the others");
    assert_eq!(mesh.corner_count(), 4, "no corner is lost");
}

#[test]
fn wires_and_points_need_no_faces() {
    let mut builder = builder(3);
    let to_itself = builder.push_loose_edge(1, 1);
    assert_eq!(to_itself, Err(MeshError::EdgeWithoutLength { index: 0, vertex: 1 }), "an edge to itself");
    builder.push_loose_edge(0, 1).expect("both vertices exist");
    for point in [2, 0, 2] {
        builder.push_loose_point(point).expect("the vertex exists");
    }
    assert!(builder.push_loose_point(3).is_err(), "vertex 3 does not exist");
    let mesh = builder.build();
    assert_eq!((mesh.face_edge_count(), mesh.loose_edges()), (0, &[[0, 1]][..]), "one loose edge");
    assert_eq!(mesh.loose_points(), [2, 0], "each point once");
    assert!(!mesh.is_closed(), "no faces, no volume");
    assert_eq!(Mesh::default().edge_count(), 0, "nothing has no edges");
}

#[test]
fn attributes_have_one_value_each() {
    let mut cube = primitives::cube(1.0);
    let wrong = [
        Attributes { corner_normals: Some(vec![Vec3::X; 23]), ..Attributes::default() },
        Attributes { uv_sets: vec![vec![Vec2::ZERO; 24], vec![]], ..Attributes::default() },
        Attributes { corner_colors: Some(vec![Vec4::ONE; 8]), ..Attributes::default() },
        Attributes { vertex_colors: Some(vec![Vec4::ONE; 24]), ..Attributes::default() },
        Attributes { face_materials: Some(vec![0; 24]), ..Attributes::default() },
        Attributes { face_smooth: Some(vec![]), ..Attributes::default() },
    ];
    let before = cube.clone();
    for attributes in wrong {
        let refused = cube.set_attributes(attributes);
        assert!(matches!(refused, Err(MeshError::AttributeLength { .. })), "{refused:?}");
    }
    assert_eq!(cube, before, "the mesh keeps what it had");
    let materials = Attributes { face_materials: Some(vec![3; 6]), ..Attributes::default() };
    assert_eq!(cube.set_attributes(materials), Ok(()), "six faces, six slots");
}

#[test]
fn one_vertex_may_have_any_number_of_edges() {
    // A fan: all edges of one vertex are one group in the search.
    let spokes = 100_000;
    let mut builder = builder(spokes + 1);
    for i in 1..spokes {
        builder.push_face(&[0, i, i + 1]).expect("a triangle");
    }
    let mesh = builder.build();
    assert_eq!(mesh.edge_count(), (2 * spokes - 1) as usize, "spokes and rim");
}

proptest! {
    #[test]
    fn edges_are_those_of_a_map(
        faces in prop::collection::vec(prop::collection::vec(0u32..12, 3..7), 0..30),
        loose in prop::collection::vec((0u32..12, 0u32..12), 0..10),
    ) {
        let mut builder = builder(12);
        let mut expected: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        let mut corner_edges = Vec::new();
        let mut number = |a: u32, b: u32| {
            let next = expected.len();
            *expected.entry([a.min(b), a.max(b)]).or_insert(next)
        };
        for face in &faces {
            if builder.push_face(face).is_ok() {
                for (i, &from) in face.iter().enumerate() {
                    let to = face[(i + 1) % face.len()];
                    corner_edges.push((from != to).then(|| number(from, to) as u32));
                }
            }
        }
        for &(from, to) in &loose {
            if builder.push_loose_edge(from, to).is_ok() {
                number(from, to);
            }
        }
        let mesh = builder.build();
        prop_assert_eq!(mesh.edge_count(), expected.len());
        for (edge, number) in expected {
            prop_assert_eq!(mesh.edges()[number], edge);
        }
        let found: Vec<_> = (0..mesh.corner_count()).map(|c| mesh.corner_edge(c)).collect();
        prop_assert_eq!(found, corner_edges);
    }
}
