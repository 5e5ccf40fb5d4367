//! Extrusions with known results, and of random faces of random meshes.

use proptest::prelude::*;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};

use super::super::region::tests::{check_change, chosen_faces, counts, open_edges, winds_consistently};
use super::*;
use crate::tests::{meshes, with_affine_values};
use crate::{EdgeId, VertexId};

fn volume(mesh: &EditMesh) -> f64 {
    mesh.to_mesh().0.volume()
}

fn all_faces(mesh: &Mesh) -> Vec<FaceId> {
    (0..mesh.face_count() as u32).map(FaceId::new).collect()
}

/// Squares of side 1 in the plane z = 0, seen from above.
fn squares(x: u32, y: u32) -> Mesh {
    let mut builder = trigon_mesh::MeshBuilder::new();
    for row in 0..=y {
        for column in 0..=x {
            builder.push_vertex(Vec3::new(column as f32, row as f32, 0.0));
        }
    }
    for row in 0..y {
        for column in 0..x {
            let first = row * (x + 1) + column;
            builder.push_face(&[first, first + 1, first + x + 2, first + x + 1]).expect("a quad");
        }
    }
    builder.build()
}

#[test]
fn a_face_of_a_cube_that_is_extruded_makes_it_longer() {
    let start = with_affine_values(primitives::cube(2.0));
    let extrude = |mesh: &mut EditMesh| mesh.extrude_region(&[FaceId(2)], ExtrudeOffset::Along(3.0));
    let (mesh, extruded) = check_change(&start, extrude).expect("a face");
    assert_eq!(counts(&mesh), [12, 20, 10], "four new vertices, four walls");
    assert_eq!(open_edges(&mesh), 0, "still closed");
    assert!(winds_consistently(&mesh), "still one outside");
    assert!((volume(&mesh) - (8.0 + 12.0)).abs() < 1e-6, "whole numbers: {}", volume(&mesh));
    let before = EditMesh::from_mesh(&start).0;
    let outline: Vec<VertexId> = mesh.face_vertices(FaceId(2)).collect();
    assert_eq!(outline, before.face_vertices(FaceId(2)).collect::<Vec<_>>(), "the cap keeps its vertices");
    assert_eq!(extruded.vertices, outline, "and these move");
    for &wall in &extruded.walls {
        assert!(mesh.unit_normal(wall).dot(mesh.unit_normal(FaceId(2))).abs() < 1e-6, "walls stand upright");
        for corner in mesh.face_corners(wall) {
            // At the cap as in the cap, at the base as in the face that was there.
            let vertex = mesh.corner_vertex(corner);
            let of_cap = mesh.face_corner_at(FaceId(2), vertex);
            let other = of_cap.or_else(|| {
                let edge = mesh.vertex_edges(vertex).find(|&edge| {
                    mesh.face_corner_at(FaceId(2), mesh.other_vertex(edge, vertex)).is_some()
                })?;
                mesh.face_corner_at(FaceId(2), mesh.other_vertex(edge, vertex))
            });
            let source = other.expect("each corner is above or below one of the cap");
            assert_eq!(mesh.uv(0, corner), mesh.uv(0, source), "carried up and down");
            assert_eq!(mesh.color(corner), mesh.color(source), "carried up and down");
        }
    }
}

#[test]
fn walls_have_no_normals_of_the_cap_and_bottoms_the_opposite_ones() {
    let mut start = squares(2, 1);
    let normals = Some(vec![Vec3::Z; start.corner_count()]);
    let attributes = trigon_mesh::Attributes {
        corner_normals: normals,
        face_materials: Some(vec![3, 5]),
        face_smooth: Some(vec![true, false]),
        ..start.attributes().clone()
    };
    start.set_attributes(attributes).expect("one for each");
    let all = all_faces(&start);
    let extrude = |mesh: &mut EditMesh| mesh.extrude_region(&all, ExtrudeOffset::Zero);
    let (mesh, extruded) = check_change(&start, extrude).expect("all");
    let normals = |face| mesh.face_corners(face).map(|corner| mesh.custom_normal(corner));
    assert!(extruded.walls.iter().all(|&wall| normals(wall).all(|normal| normal.is_none())), "none");
    let down = |face| normals(face).all(|normal| normal == Some(-Vec3::Z));
    assert!(extruded.bottoms.iter().all(|&bottom| down(bottom)), "turned over");
    let materials: Vec<u32> = extruded.bottoms.iter().map(|&bottom| mesh.material(bottom)).collect();
    assert_eq!(materials, [3, 5], "of the faces above");
    let mut of_walls = [0; 2];
    for &wall in &extruded.walls {
        of_walls[usize::from(mesh.material(wall) == 5)] += 1;
        assert_eq!(mesh.is_smooth(wall), mesh.material(wall) == 3, "as the face on which it stands");
    }
    assert_eq!(of_walls, [3, 3], "three walls on each square");
}

#[test]
fn a_sheet_becomes_a_closed_box() {
    let start = squares(3, 2);
    let all = all_faces(&start);
    let by = ExtrudeOffset::By(DVec3::new(0.0, 0.0, 2.0));
    let (mesh, extruded) = check_change(&start, |mesh| mesh.extrude_region(&all, by)).expect("all");
    assert_eq!(counts(&mesh), [24, 44, 22], "twice 12 vertices, 17 edges, 6 faces; 10 walls with an edge");
    assert_eq!((extruded.walls.len(), extruded.bottoms.len()), (10, 6), "walls and a bottom");
    assert_eq!(open_edges(&mesh), 0, "closed");
    assert!(winds_consistently(&mesh), "one outside");
    assert!((volume(&mesh) - 12.0).abs() < 1e-9, "3 by 2 by 2: {}", volume(&mesh));
}

#[test]
fn a_closed_surface_becomes_hollow() {
    let start = primitives::cube(2.0);
    let all = all_faces(&start);
    let along = ExtrudeOffset::Along(3f64.sqrt());
    let (mesh, extruded) = check_change(&start, |mesh| mesh.extrude_region(&all, along)).expect("all");
    assert_eq!((counts(&mesh), extruded.walls.len()), ([16, 24, 12], 0), "two shells");
    // The corners move along the diagonals.
    assert!((volume(&mesh) - (64.0 - 8.0)).abs() < 1e-4, "the inner one is open space: {}", volume(&mesh));
}

#[test]
fn only_sheets_get_a_bottom() {
    // The middle quad of a row, and a quad far away.
    let mut mesh = EditMesh::from_mesh(&squares(3, 1)).0;
    let far = [(9.0, 0.0), (10.0, 0.0), (10.0, 1.0), (9.0, 1.0)];
    let far = far.map(|(x, y)| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room"));
    let far = mesh.add_face(&far).expect("a quad");
    let extruded = mesh.extrude_region(&[FaceId(1), far], ExtrudeOffset::Along(1.0)).expect("two faces");
    mesh.check_structure().expect("whole");
    assert_eq!((extruded.walls.len(), extruded.bottoms.len()), (8, 1), "the far one is closed");
    // Open is what was: three sides of each outer quad, and two walls' lower edges in the middle.
    assert_eq!(open_edges(&mesh), 8, "the row stays open below");
}

#[test]
fn parts_that_touch_in_a_vertex_keep_it() {
    let start = squares(2, 2);
    let diagonal = [FaceId(0), FaceId(3)];
    let extrude = |mesh: &mut EditMesh| mesh.extrude_region(&diagonal, ExtrudeOffset::Along(1.0));
    let (mesh, extruded) = check_change(&start, extrude).expect("two faces");
    assert_eq!((extruded.walls.len(), extruded.vertices.len()), (8, 7), "four walls for each");
    // 7 vertices, 8 edges of the base and 7 upright ones are new.
    assert_eq!(counts(&mesh), [16, 27, 12], "one edge down from the middle");
    let middle = VertexId(4);
    let hinge = mesh.vertex_edges(middle).find(|&edge| mesh.edge_faces(edge).count() == 4);
    assert!(hinge.is_some(), "four walls share it");
}

#[test]
fn a_fin_inside_of_a_region_stays_joined_to_it() {
    let mut mesh = EditMesh::from_mesh(&squares(2, 1)).0;
    let up = [1, 4].map(|index| {
        let position = mesh.position(VertexId(index)) + Vec3::Z;
        mesh.add_vertex(position).expect("room")
    });
    let fin = mesh.add_face(&[VertexId(1), VertexId(4), up[1], up[0]]).expect("a quad");
    let extruded = mesh.extrude_region(&[FaceId(0), FaceId(1)], ExtrudeOffset::Along(0.5)).expect("two");
    mesh.check_structure().expect("whole");
    assert_eq!(
        (extruded.walls.len(), extruded.bottoms.len()),
        (7, 0),
        "six around, one below the fin's edge"
    );
    let stays = mesh.face_vertices(fin).filter(|&vertex| mesh.position(vertex).z == 0.0).count();
    assert_eq!(stays, 2, "the fin stays where it was");
}

#[test]
fn faces_that_are_extruded_alone_come_apart() {
    let start = with_affine_values(primitives::cube(2.0));
    let all = all_faces(&start);
    let extrude = |mesh: &mut EditMesh| mesh.extrude_individual(&all, ExtrudeOffset::Along(1.0));
    let (mesh, extruded) = check_change(&start, extrude).expect("all");
    assert_eq!(counts(&mesh), [8 + 24, 12 + 48, 6 + 24], "each face has vertices and walls of its own");
    assert_eq!((extruded.walls.len(), extruded.vertices.len()), (24, 24), "new ones");
    assert!((volume(&mesh) - (8.0 + 6.0 * 4.0)).abs() < 1e-5, "six boxes around one: {}", volume(&mesh));
}

#[test]
fn a_face_with_a_hole_is_extruded_around_it() {
    let mut builder = trigon_mesh::MeshBuilder::new();
    for (x, y) in [(0, 0), (8, 0), (8, 4), (0, 4), (2, 1), (2, 3), (6, 3), (6, 1)] {
        builder.push_vertex(Vec3::new(x as f32, y as f32, 0.0));
    }
    builder.push_face(&[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]).expect("a face with a hole");
    let start = builder.build();
    let (cut, left_out) = EditMesh::from_mesh(&start);
    assert_eq!(left_out.cut_faces, 1, "it is cut where it is opened");
    let faces: Vec<FaceId> = cut.faces().collect();
    let extrude = |mesh: &mut EditMesh| mesh.extrude_region(&faces, ExtrudeOffset::Along(2.0));
    let (mesh, extruded) = check_change(&start, extrude).expect("its parts");
    assert_eq!((extruded.walls.len(), mesh.vertex_count()), (8, 16), "outside and in the hole");
    assert_eq!(open_edges(&mesh), 0, "closed");
    assert!((volume(&mesh) - 2.0 * (32.0 - 8.0)).abs() < 1e-9, "but for the hole");
}

#[test]
fn walls_on_open_borders_continue_the_faces() {
    let start = with_affine_values(squares(2, 1));
    let border: Vec<EdgeId> = {
        let mesh = EditMesh::from_mesh(&start).0;
        mesh.edges().filter(|&edge| mesh.is_boundary(edge)).collect()
    };
    let extrude = |mesh: &mut EditMesh| mesh.extrude_edges(&border, DVec3::Z);
    let (mesh, extruded) = check_change(&start, extrude).expect("edges");
    assert_eq!(counts(&mesh), [12, 7 + 12, 2 + 6], "a box without a lid");
    assert!(winds_consistently(&mesh), "walls wind as the faces");
    for (&wall, &edge) in extruded.walls.iter().zip(&border) {
        let source = mesh.edge_corners(edge).find(|&corner| mesh.corner_face(corner) != wall);
        let source = source.expect("the face from before");
        let corner = mesh.face_corner_at(wall, mesh.corner_vertex(source)).expect("both have the edge");
        assert_eq!(mesh.uv(0, corner), mesh.uv(0, source), "{wall} has the values of {edge}");
    }
}

#[test]
fn walls_on_a_chain_of_wires_wind_alike() {
    let mut builder = trigon_mesh::MeshBuilder::new();
    for x in 0..5 {
        builder.push_vertex(Vec3::new(x as f32, 0.0, 0.0));
    }
    // In both directions, out of order.
    for (a, b) in [(2, 1), (3, 4), (0, 1), (2, 3)] {
        builder.push_loose_edge(a, b).expect("two vertices");
    }
    let start = builder.build();
    let edges: Vec<EdgeId> = EditMesh::from_mesh(&start).0.edges().collect();
    let extrude = |mesh: &mut EditMesh| mesh.extrude_edges(&edges, DVec3::Z);
    let (mesh, extruded) = check_change(&start, extrude).expect("edges");
    assert_eq!((counts(&mesh), extruded.vertices.len()), ([10, 4 + 4 + 5, 4], 5), "a fence");
    assert!(winds_consistently(&mesh), "all walls look to the same side");
}

#[test]
fn vertices_become_edges() {
    let start = primitives::cube(2.0);
    let given = [VertexId(3), VertexId(0), VertexId(3)];
    let extrude = |mesh: &mut EditMesh| mesh.extrude_vertices(&given, DVec3::X);
    let (mesh, extruded) = check_change(&start, extrude).expect("vertices");
    assert_eq!(counts(&mesh), [10, 14, 6], "two wires");
    let [from, to] = mesh.edge_vertices(extruded.edges[1]);
    assert_eq!((from, to), (VertexId(3), extruded.vertices[1]), "from the old one to the new");
    assert_eq!(mesh.position(to) - mesh.position(from), Vec3::X, "by the offset");
}

#[test]
fn what_cannot_be_extruded_is_refused() {
    let start = primitives::cube(2.0);
    let nothing = check_change(&start, |mesh| mesh.extrude_region(&[], ExtrudeOffset::Zero));
    assert!(matches!(nothing, Err(Refusal::NothingGiven { .. })), "no face");
    let gone = check_change(&start, |mesh| mesh.extrude_individual(&[FaceId(9)], ExtrudeOffset::Zero));
    assert_eq!(gone.map(drop), Err(Refusal::NoSuchFace(FaceId(9))), "no such face");
    let far = ExtrudeOffset::Along(f64::INFINITY);
    let far = check_change(&start, |mesh| mesh.extrude_region(&[FaceId(0)], far));
    assert!(matches!(far, Err(Refusal::OutOfRange { .. })), "not finite");
    let by = DVec3::new(0.0, f64::NAN, 0.0);
    let nowhere = check_change(&start, |mesh| mesh.extrude_vertices(&[VertexId(0)], by));
    assert!(matches!(nowhere, Err(Refusal::OutOfRange { .. })), "not a number");
}

proptest! {
    #[test]
    fn any_faces_can_be_extruded(start in meshes(), bits in any::<u64>(), along in -1.0f64..1.0) {
        let faces = chosen_faces(&start, bits);
        let before = EditMesh::from_mesh(&start).0;
        // Where three faces meet at an edge, a wall may end.
        let was_closed = before.edges().all(|edge| before.edge_pair(edge).is_some());
        let offset = ExtrudeOffset::Along(along);
        if let Ok((mesh, extruded)) = check_change(&start, |mesh| mesh.extrude_region(&faces, offset)) {
            let caps = faces.iter().all(|&face| mesh.has_face(face));
            prop_assert!(caps, "the extruded faces keep their ids");
            let made = extruded.walls.len() + extruded.bottoms.len();
            prop_assert_eq!(mesh.face_count(), start.face_count() + made);
            if was_closed {
                prop_assert_eq!(open_edges(&mesh), 0, "what was closed stays closed");
            }
        }
        if let Ok((mesh, extruded)) = check_change(&start, |mesh| mesh.extrude_individual(&faces, offset)) {
            prop_assert_eq!(mesh.face_count(), start.face_count() + extruded.walls.len());
        }
    }

    #[test]
    fn any_edges_and_vertices_can_be_extruded(start in meshes(), picks in prop::collection::vec(any::<u32>(), 1..9)) {
        let offset = DVec3::new(0.0, 0.5, 1.0);
        let pick = |count: usize| picks.iter().map(move |pick| pick % count.max(1) as u32);
        let edges: Vec<EdgeId> = pick(start.edge_count()).map(EdgeId::new).collect();
        if let Ok((mesh, extruded)) = check_change(&start, |mesh| mesh.extrude_edges(&edges, offset)) {
            prop_assert_eq!(mesh.face_count(), start.face_count() + extruded.walls.len());
        }
        let vertices: Vec<VertexId> = pick(start.vertex_count()).map(VertexId::new).collect();
        if let Ok((mesh, extruded)) = check_change(&start, |mesh| mesh.extrude_vertices(&vertices, offset)) {
            prop_assert_eq!(mesh.vertex_count(), start.vertex_count() + extruded.vertices.len());
        }
    }
}
