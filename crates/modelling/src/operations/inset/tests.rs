//! Insets with known results, and of random faces of random meshes.

use proptest::prelude::*;
use trigon_math::Vec3;
use trigon_mesh::{Attributes, Deltas, Mesh, MorphTarget, primitives};

use super::super::region::tests::{check_change, chosen_faces, counts, open_edges, winds_consistently};
use super::*;
use crate::VertexId;
use crate::tests::{keeps_affine_values, meshes, with_affine_values};

fn area(mesh: &EditMesh, faces: &[FaceId]) -> f64 {
    let of_face = |&face: &FaceId| {
        trigon_math::area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).length()
    };
    faces.iter().map(of_face).sum()
}

fn thickness(thickness: f64) -> Inset {
    Inset { thickness, ..Inset::default() }
}

/// A polygon in the plane z = 1.
fn polygon(outline: &[[f32; 2]]) -> Mesh {
    let mut builder = trigon_mesh::MeshBuilder::new();
    for [x, y] in outline {
        builder.push_vertex(Vec3::new(*x, *y, 1.0));
    }
    let all: Vec<u32> = (0..outline.len() as u32).collect();
    builder.push_face(&all).expect("a polygon");
    with_affine_values(builder.build())
}

/// How far each edge of a face is from the line of the edge below it in its wall.
fn distances(mesh: &EditMesh, rim: &[FaceId]) -> Vec<f64> {
    let of_quad = |&quad: &FaceId| {
        let at: Vec<DVec3> = mesh.face_vertices(quad).map(|vertex| mesh.point(vertex)).collect();
        let along = (at[1] - at[0]).normalize();
        [2, 3].map(|i: usize| along.cross(at[i] - at[0]).length())
    };
    rim.iter().flat_map(of_quad).collect()
}

#[test]
fn edges_of_convex_polygons_move_by_the_thickness() {
    for outline in [
        vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]],
        vec![[0.0, 0.0], [5.0, 1.0], [6.0, 4.0], [3.0, 6.0], [-1.0, 3.0]],
        vec![[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
    ] {
        let start = polygon(&outline);
        let inset = Inset { thickness: 0.25, depth: 0.5, open_borders: true };
        let individual = check_change(&start, |mesh| mesh.inset_individual(&[FaceId(0)], inset));
        let region = check_change(&start, |mesh| mesh.inset_region(&[FaceId(0)], inset));
        for (mesh, inset) in [individual.expect("a face"), region.expect("a face")] {
            assert_eq!(inset.rim.len(), outline.len(), "a quad for each edge");
            assert_eq!(inset.vertices.len(), outline.len(), "each vertex has an inset one");
            // In the plane 0.25, upwards 0.5.
            let expected = (0.25f64 * 0.25 + 0.5 * 0.5).sqrt();
            for distance in distances(&mesh, &inset.rim) {
                // Positions up to 6 are rounded to 24 bits.
                assert!((distance - expected).abs() < 1e-6, "{distance} for {expected}");
            }
            let upper = mesh.face_vertices(FaceId(0)).all(|vertex| mesh.position(vertex).z == 1.5);
            assert!(upper, "the face moved by the depth");
        }
    }
}

#[test]
fn a_square_with_a_square_in_it_has_affine_values() {
    let start = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    let inset = |mesh: &mut EditMesh| mesh.inset_individual(&[FaceId(0)], thickness(1.0));
    let (mesh, inset) = check_change(&start, inset).expect("a face");
    assert_eq!(counts(&mesh), [8, 12, 5], "a frame");
    assert!((area(&mesh, &[FaceId(0)]) - 4.0).abs() < 1e-9, "half as wide: exact numbers");
    assert!((area(&mesh, &inset.rim) - 12.0).abs() < 1e-9, "the rest");
    keeps_affine_values(&mesh).expect("interpolated");
    assert!(winds_consistently(&mesh), "all face the same way");
}

#[test]
fn a_region_of_a_grid_is_inset_as_one() {
    let start = with_affine_values(primitives::grid(4.0, 4.0, 4, 4));
    // The middle four of sixteen quads of area 1.
    let middle = [FaceId(5), FaceId(6), FaceId(9), FaceId(10)];
    let inset = |mesh: &mut EditMesh| mesh.inset_region(&middle, thickness(0.25));
    let (mesh, inset) = check_change(&start, inset).expect("faces");
    assert_eq!((inset.rim.len(), inset.vertices.len()), (8, 9), "around eight edges");
    assert!((area(&mesh, &middle) - 1.5 * 1.5).abs() < 1e-6, "smaller by a quarter on each side");
    assert!((area(&mesh, &inset.rim) - (4.0 - 2.25)).abs() < 1e-6, "what it left");
    keeps_affine_values(&mesh).expect("interpolated in each face");
    assert!(winds_consistently(&mesh), "all face the same way");

    let outset = |mesh: &mut EditMesh| mesh.outset_region(&middle, thickness(0.25));
    let (mesh, outset) = check_change(&start, outset).expect("faces");
    assert!((area(&mesh, &middle) - 4.0).abs() < 1e-6, "it stays");
    assert!((area(&mesh, &outset.rim) - (2.5 * 2.5 - 4.0)).abs() < 1e-6, "a ring around it");
    keeps_affine_values(&mesh).expect("interpolated in each face outside");
    assert!(winds_consistently(&mesh), "all face the same way");
}

#[test]
fn at_an_open_border_vertices_slide_along_it_or_leave_it() {
    let start = with_affine_values(primitives::grid(2.0, 1.0, 2, 1));
    let inset = |open_borders| {
        let inset = Inset { open_borders, ..thickness(0.25) };
        check_change(&start, |mesh| mesh.inset_region(&[FaceId(0)], inset)).expect("a face")
    };
    let (mesh, along) = inset(false);
    assert_eq!((along.rim.len(), counts(&mesh)), (1, [8, 10, 3]), "one quad beside the neighbour");
    assert!((area(&mesh, &[FaceId(0)]) - 0.75).abs() < 1e-6, "shorter, as wide as before");
    assert_eq!(distances(&mesh, &along.rim), [0.25, 0.25], "exact numbers");
    keeps_affine_values(&mesh).expect("interpolated");

    let (mesh, around) = inset(true);
    assert_eq!(around.rim.len(), 4, "a quad on each side");
    assert!((area(&mesh, &[FaceId(0)]) - 0.25).abs() < 1e-6, "half as long and wide");
    keeps_affine_values(&mesh).expect("interpolated");
}

#[test]
fn parts_that_touch_in_a_vertex_shrink_apart() {
    let start = with_affine_values(primitives::grid(2.0, 2.0, 2, 2));
    let diagonal = [FaceId(0), FaceId(3)];
    for open_borders in [true, false] {
        let inset = Inset { open_borders, ..thickness(0.25) };
        let (mesh, inset) = check_change(&start, |mesh| mesh.inset_region(&diagonal, inset)).expect("two");
        let expected = if open_borders { 2.0 * 0.25 } else { 2.0 * 0.75 * 0.75 };
        assert!((area(&mesh, &diagonal) - expected).abs() < 1e-6, "each from its own middle");
        assert_eq!(inset.vertices.len(), 8, "no vertex is shared");
        keeps_affine_values(&mesh).expect("interpolated");
        let outset = check_change(&start, |mesh| mesh.outset_region(&diagonal, thickness(0.25)));
        let (mesh, outset) = outset.expect("two");
        assert_eq!((outset.rim.len(), outset.vertices.len()), (4, 7), "the region stays joined");
        assert!((area(&mesh, &[FaceId(1), FaceId(2)]) - 2.0 * 0.75 * 0.75).abs() < 1e-6, "the others shrink");
        keeps_affine_values(&mesh).expect("interpolated");
    }
}

#[test]
fn faces_without_area_get_their_rim() {
    let outline = [[0., 0.], [8., 0.], [8., 4.], [0., 4.], [2., 3.]];
    let mut mesh = EditMesh::new();
    let at = |[x, y]: [f32; 2]| Vec3::new(x, y, 0.0);
    let vertices: Vec<VertexId> =
        outline.iter().map(|&place| mesh.add_vertex(at(place)).expect("room")).collect();
    let face = mesh.add_face(&vertices).expect("a face");
    let flat = mesh.add_face(&[vertices[0], vertices[1], vertices[2]]).expect("a triangle");
    for &vertex in &[vertices[1], vertices[2]] {
        mesh.set_position(vertex, mesh.position(vertices[1]));
    }
    let inset = mesh.inset_individual(&[face, flat], thickness(0.25)).expect("two faces");
    mesh.check_structure().expect("whole");
    assert_eq!(inset.rim.len(), 8, "a quad for each corner");
    assert!(mesh.vertices().all(|vertex| mesh.position(vertex).is_finite()), "no corner is lost");
}

/// In quadratic time these would not end.
#[test]
fn large_polygons_and_hubs_take_linear_time() {
    const COUNT: u32 = 50_000;
    let mut mesh = EditMesh::new();
    let at = |i: u32| {
        let angle = f64::from(i) / f64::from(COUNT) * std::f64::consts::TAU;
        let (sin, cos) = trigon_math::elementary::sin_cos(angle);
        Vec3::new(cos as f32, sin as f32, 0.0) * 1000.0
    };
    let hub = mesh.add_vertex(Vec3::ZERO).expect("room");
    let rim: Vec<VertexId> = (0..COUNT).map(|i| mesh.add_vertex(at(i)).expect("room")).collect();
    let fan: Vec<FaceId> =
        rim.windows(2).map(|pair| mesh.add_face(&[hub, pair[0], pair[1]]).expect("a triangle")).collect();
    let backwards: Vec<VertexId> = rim.iter().rev().copied().collect();
    let polygon = mesh.add_face(&backwards).expect("a polygon");
    let half = &fan[..fan.len() / 2];
    mesh.inset_individual(&[polygon], thickness(0.001)).expect("a polygon");
    mesh.inset_region(&[polygon], thickness(0.001)).expect("a polygon");
    mesh.outset_region(half, thickness(0.001)).expect("triangles");
    mesh.inset_region(half, thickness(0.001)).expect("triangles");
    mesh.extrude_region(half, crate::ExtrudeOffset::Along(1.0)).expect("triangles");
    mesh.split_off(half).expect("triangles");
    let united = mesh.dissolve_vertices(&[hub]).expect("half of the triangles").faces;
    assert_eq!(
        (united.len(), mesh.face_size(united[0])),
        (1, half.len() + 1),
        "all around the hub, without it"
    );
}

/// Morph targets and normals that were given are values of vertices and corners like others.
#[test]
fn vertices_move_along_in_morph_targets() {
    let mut start = primitives::grid(4.0, 4.0, 4, 4);
    let delta =
        |position: Vec3| Vec3::new(0.5 * position.x + 0.25 * position.z, 1.0 + position.x, -position.z);
    let deltas = Deltas::from_dense(start.positions().iter().map(|&position| delta(position)));
    let attributes = Attributes {
        corner_normals: Some(vec![Vec3::Y; start.corner_count()]),
        morph_targets: vec![MorphTarget { positions: deltas, ..MorphTarget::default() }],
        ..Attributes::default()
    };
    start.set_attributes(attributes).expect("one for each corner");
    let faces = [FaceId(5), FaceId(6), FaceId(9)];
    let thin = thickness(0.25);
    let results = [
        check_change(&start, |mesh| mesh.inset_individual(&faces, thin)),
        check_change(&start, |mesh| mesh.inset_region(&faces, thin)),
        check_change(&start, |mesh| mesh.outset_region(&faces, thin)),
    ];
    for result in results {
        let (mesh, _) = result.expect("three faces").0.to_mesh();
        let attributes = mesh.attributes();
        let mut moved = vec![Vec3::ZERO; mesh.vertex_count()];
        for (vertex, value) in attributes.morph_targets[0].positions.iter() {
            moved[vertex as usize] = value;
        }
        for (&position, moved) in mesh.positions().iter().zip(moved) {
            // One rounding of each, at most at 3.
            assert!(moved.abs_diff_eq(delta(position), 1e-6), "{moved} at {position}");
        }
        let normals = attributes.corner_normals.as_ref().expect("given");
        assert!(normals.iter().all(|&normal| normal == Vec3::Y), "all corners lie in the plane");
    }
}

/// The vertices at an edge or a corner of a solid used to move by the depth, and the faces by less.
#[test]
fn the_depth_of_a_region_is_how_far_each_of_its_faces_moves() {
    let start = primitives::cube(2.0);
    let corner = |vertex: VertexId| start.positions()[vertex.0 as usize] == Vec3::ONE;
    let before = EditMesh::from_mesh(&start).0;
    let faces: Vec<FaceId> = before.faces().filter(|&face| before.face_vertices(face).any(corner)).collect();
    let inset = Inset { depth: 0.25, ..thickness(0.5) };
    let (mesh, _) = check_change(&start, |mesh| mesh.inset_region(&faces, inset)).expect("it has a border");
    assert_eq!(faces.len(), 3, "those at one corner");
    for &face in &faces {
        let normal = before.face_normal(face);
        for vertex in mesh.face_vertices(face) {
            let height = mesh.position(vertex).as_dvec3().dot(normal);
            assert!((height - 1.25).abs() < 1e-6, "{height} instead of 1.25");
        }
    }
}

/// At the inner corner of an L the open border leads away from the rim: its vertex left the border, and area was lost.
#[test]
fn an_outset_keeps_open_borders_at_inner_corners() {
    let (mut angle, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 2));
    let faces: Vec<FaceId> = angle.faces().collect();
    angle.delete_faces(&faces[3..]).expect("it is there");
    let area = |mesh: &EditMesh| mesh.faces().map(|face| mesh.face_area(face)).sum::<f64>();
    assert_eq!(area(&angle), 3.0, "three squares");
    for &face in &faces[..3] {
        let mut mesh = angle.clone();
        mesh.outset_region(&[face], thickness(0.125)).expect("others are around it");
        assert!((area(&mesh) - 3.0).abs() < 1e-6, "{face}: {}", area(&mesh));
        mesh.check_structure().expect("whole");
    }
}

#[test]
fn what_cannot_be_inset_is_refused() {
    let start = primitives::cube(2.0);
    let all: Vec<FaceId> = (0..6).map(FaceId).collect();
    let closed = check_change(&start, |mesh| mesh.inset_region(&all, thickness(0.1)));
    assert!(matches!(closed, Err(Refusal::NotPossible { .. })), "no border");
    let negative = check_change(&start, |mesh| mesh.inset_individual(&all, thickness(-0.1)));
    assert!(matches!(negative, Err(Refusal::OutOfRange { .. })), "outset is another operation");
    let inset = Inset { depth: f64::NAN, ..thickness(0.1) };
    let deep = check_change(&start, |mesh| mesh.outset_region(&[FaceId(0)], inset));
    assert!(matches!(deep, Err(Refusal::OutOfRange { .. })), "not a number");
}

proptest! {
    #[test]
    fn any_faces_can_be_inset(
        start in meshes(),
        bits in any::<u64>(),
        inset in (0.0f64..0.3, -0.5f64..0.5, any::<bool>()),
    ) {
        let faces = chosen_faces(&start, bits);
        let inset = Inset { thickness: inset.0, depth: inset.1, open_borders: inset.2 };
        let before = EditMesh::from_mesh(&start).0;
        // Where three faces meet at an edge, a rim may end.
        let was_closed = before.edges().all(|edge| before.edge_pair(edge).is_some());
        if let Ok((mesh, result)) = check_change(&start, |mesh| mesh.inset_individual(&faces, inset)) {
            prop_assert_eq!(mesh.face_count(), start.face_count() + result.rim.len());
        }
        let flat = Inset { depth: 0.0, ..inset };
        if let Ok((mesh, _)) = check_change(&start, |mesh| mesh.inset_individual(&faces, flat)) {
            prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
        }
        for is_outset in [false, true] {
            let result = check_change(&start, |mesh| match is_outset {
                false => mesh.inset_region(&faces, inset),
                true => mesh.outset_region(&faces, inset),
            });
            if let Ok((mesh, result)) = result {
                prop_assert_eq!(mesh.face_count(), start.face_count() + result.rim.len());
                if was_closed {
                    prop_assert_eq!(open_edges(&mesh), 0, "what was closed stays closed");
                }
            }
        }
    }

    #[test]
    fn regions_of_a_plane_keep_affine_values(
        size in (1u32..5, 1u32..5),
        bits in any::<u64>(),
        inset in (0.0f64..0.2, any::<bool>()),
    ) {
        let start = with_affine_values(primitives::grid(2.0, 3.0, size.0, size.1));
        let faces = chosen_faces(&start, bits);
        let inset = Inset { thickness: inset.0, depth: 0.0, open_borders: inset.1 };
        for is_outset in [false, true] {
            let result = check_change(&start, |mesh| match is_outset {
                false => mesh.inset_region(&faces, inset),
                true => mesh.outset_region(&faces, inset),
            });
            if let Ok((mesh, _)) = result {
                prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
            }
        }
    }
}
