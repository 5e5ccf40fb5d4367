//! Catmull-Clark subdivision: counts, closed forms, and the limit by the masks of Halstead, Kass and
//! DeRose ("Efficient, fair interpolation using Catmull-Clark surfaces", 1993).

use proptest::prelude::*;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::primitives;

use super::points::sharpness;
use super::*;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::tests::{check_operation, meshes};

fn editable(mesh: &trigon_mesh::Mesh) -> EditMesh {
    EditMesh::from_mesh(mesh).0
}

fn counts(mesh: &EditMesh) -> [usize; 3] {
    mesh.check_structure().expect("whole");
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

fn subdivided(mesh: &EditMesh, levels: u32) -> EditMesh {
    let mut mesh = mesh.clone();
    mesh.catmull_clark(levels).expect("there are faces");
    mesh
}

/// Positions are rounded to f32 at each level.
const ROUNDING: f64 = 1e-5;

/// Where a vertex of a closed mesh of quads is on the limit surface.
fn limit(mesh: &EditMesh, vertex: VertexId) -> DVec3 {
    let n = mesh.vertex_edges(vertex).count() as f64;
    let neighbors: DVec3 = mesh.vertex_neighbors(vertex).map(|other| mesh.point(other)).sum();
    let opposite = |corner: CornerId| mesh.corner_vertex(mesh.next_corner(mesh.next_corner(corner)));
    let opposites: DVec3 = mesh.vertex_corners(vertex).map(|corner| mesh.point(opposite(corner))).sum();
    (mesh.point(vertex) * n * n + neighbors * 4.0 + opposites) / (n * (n + 5.0))
}

#[test]
fn a_cube_has_26_vertices_48_edges_and_24_faces() {
    let cube = editable(&primitives::cube(2.0));
    let once = subdivided(&cube, 1);
    assert_eq!(counts(&once), [26, 48, 24], "one level");
    assert_eq!(counts(&subdivided(&cube, 3)), [386, 768, 384], "three levels");
    for vertex in cube.vertices() {
        let expected = cube.point(vertex) * 5.0 / 9.0;
        assert!(once.point(vertex).abs_diff_eq(expected, ROUNDING), "1/3 + 1/3·1/3 + 1/3·1/3 of a corner");
    }
    for index in 0..12 {
        let [a, b] = cube.edge_vertices(EdgeId(index)).map(|vertex| cube.point(vertex));
        let at = once.point(VertexId(8 + index));
        assert!(at.abs_diff_eq((a + b) * 0.375, ROUNDING), "¾ of an edge's middle: {at}");
    }
    for face in cube.faces() {
        let middle: DVec3 = cube.face_vertices(face).map(|vertex| cube.point(vertex)).sum::<DVec3>() / 4.0;
        assert!(once.point(VertexId(20 + face.0)).abs_diff_eq(middle, ROUNDING), "a face's middle stays");
    }
}

#[test]
fn the_limit_of_a_cube_is_that_of_the_masks() {
    let mut mesh = editable(&primitives::cube(2.0));
    let corner = VertexId(0);
    let expected = limit(&mesh, corner);
    assert!(expected.abs_diff_eq(mesh.point(corner) * 0.5, ROUNDING), "(9 + 4·1 - 1) / 24 of it");
    for _ in 0..4 {
        mesh.catmull_clark(1).expect("faces");
        assert!(limit(&mesh, corner).abs_diff_eq(expected, ROUNDING), "every level has the same limit");
    }
    // A level brings a corner of three edges nearer by about 0.41, the second eigenvalue, or more.
    assert!(mesh.point(corner).distance(expected) < 0.02 * expected.length(), "which it approaches");
    let face = VertexId(20);
    let limits = [1, 4].map(|levels| limit(&subdivided(&editable(&primitives::cube(2.0)), levels), face));
    assert!(limits[0].abs_diff_eq(limits[1], ROUNDING), "that in a face has its limit, too");
}

#[test]
fn a_plane_of_quads_stays_the_same_but_for_its_border() {
    let grid = editable(&primitives::grid(4.0, 4.0, 4, 4));
    let once = subdivided(&grid, 1);
    assert_eq!(counts(&once), [81, 144, 64], "a finer grid");
    let corner = grid.vertices().next().expect("it has vertices");
    for vertex in grid.vertices() {
        let (old, new) = (grid.point(vertex), once.point(vertex));
        let is_corner = old.x.abs() == 2.0 && old.z.abs() == 2.0;
        if !is_corner {
            assert!(new.abs_diff_eq(old, ROUNDING), "an even border is its own curve: {old}");
        }
    }
    // ¾·2 + ⅛·(2 + 1)
    let expected = grid.point(corner) * (1.875 / 2.0);
    assert!(once.point(corner).abs_diff_eq(expected, ROUNDING), "a corner of the border is rounded");
}

#[test]
fn a_cube_with_full_creases_stays_a_cube() {
    let mut cube = editable(&primitives::cube(2.0));
    (0..12).for_each(|index| cube.set_crease(EdgeId(index), 1.0));
    let mesh = subdivided(&cube, 3);
    assert_eq!(counts(&mesh), [386, 768, 384], "three levels");
    for vertex in mesh.vertices() {
        let point = mesh.point(vertex);
        assert_eq!(point.abs().max_element(), 1.0, "all are on its faces: {point}");
    }
    assert!(cube.vertices().all(|vertex| mesh.position(vertex) == cube.position(vertex)), "corners stay");
    assert_eq!(mesh.edges().filter(|&edge| mesh.crease(edge) == 1.0).count(), 12 * 8, "pieces are sharp");
}

#[test]
fn a_crease_ends_after_its_levels() {
    // 10·c² = 2.5 levels.
    let mut cube = editable(&primitives::cube(2.0));
    cube.set_crease(EdgeId(0), 0.5);
    let once = subdivided(&cube, 1);
    let left = sharpness(once.crease(EdgeId(0)));
    assert!((left - 1.5).abs() < 1e-6, "one less, but for a crease's rounding: {left}");
    let on_edge = once.point(VertexId(8));
    let [a, b] = cube.edge_vertices(EdgeId(0)).map(|vertex| cube.point(vertex));
    assert!(on_edge.abs_diff_eq((a + b) * 0.5, ROUNDING), "in the middle while it is sharp");
    assert_eq!(subdivided(&cube, 3).crease(EdgeId(0)), 0.0, "over");
    // 0.4 levels: 0.4 of the sharp place and 0.6 of the smooth one.
    cube.set_crease(EdgeId(0), 0.2);
    let on_edge = subdivided(&cube, 1).point(VertexId(8));
    assert!(on_edge.abs_diff_eq((a + b) * (0.5 * 0.4 + 0.375 * 0.6), ROUNDING), "blended");
}

#[test]
fn a_ring_of_half_sharp_edges_is_half_way_between_the_rules() {
    let mut cube = editable(&primitives::cube(2.0));
    let top: Vec<EdgeId> = cube.face_edges(FaceId(0)).collect();
    let corner = cube.face_vertices(FaceId(0)).next().expect("four");
    let position = |mesh: &EditMesh| subdivided(mesh, 1).point(corner);
    let smooth = position(&cube);
    top.iter().for_each(|&edge| cube.set_crease(edge, 1.0));
    let sharp = position(&cube);
    // Half a level.
    let crease = 0.05f32.sqrt();
    top.iter().for_each(|&edge| cube.set_crease(edge, crease));
    assert!(position(&cube).abs_diff_eq((smooth + sharp) * 0.5, ROUNDING), "half of each");
}

#[test]
fn wires_become_curves_and_faces_at_too_many_edges_have_corners() {
    let mut mesh = editable(&primitives::cube(2.0));
    let far = mesh.add_vertex(Vec3::new(3.0, 3.0, 3.0)).expect("room");
    let tip = mesh.add_vertex(Vec3::new(5.0, 3.0, 3.0)).expect("room");
    let near = VertexId(0);
    mesh.add_edge(near, far).expect("two vertices");
    mesh.add_edge(far, tip).expect("two vertices");
    let once = subdivided(&mesh, 1);
    assert_eq!(counts(&once), [26 + 4, 48 + 4, 24], "each wire is two");
    assert_eq!(once.position(near), mesh.position(near), "held by the wire");
    assert_eq!(once.position(tip), mesh.position(tip), "an end stays");
    let expected = mesh.point(far) * 0.75 + (mesh.point(near) + mesh.point(tip)) * 0.125;
    assert!(once.point(far).abs_diff_eq(expected, ROUNDING), "a curve between");
}

#[test]
fn values_of_corners_are_interpolated_in_each_face() {
    let cube = editable(&primitives::cube(2.0));
    let once = subdivided(&cube, 1);
    for face in cube.faces() {
        let corners: Vec<CornerId> = cube.face_corners(face).collect();
        let uvs: Vec<_> = corners.iter().map(|&corner| cube.uv(0, corner).expect("a set")).collect();
        let part: Vec<_> = once.face_corners(face).map(|corner| once.uv(0, corner).expect("a set")).collect();
        let middle = (uvs[0] + uvs[1] + uvs[2] + uvs[3]) / 4.0;
        assert_eq!(part, [uvs[0], (uvs[0] + uvs[1]) / 2.0, middle, (uvs[3] + uvs[0]) / 2.0], "{face}");
    }
}

#[test]
fn free_slots_stay_free() {
    let mut mesh = editable(&primitives::torus(2.0, 0.5, 6, 5));
    mesh.remove_vertex(VertexId(7)).expect("it is there");
    let [vertices, edges, faces] = counts(&mesh);
    let corners = mesh.corner_count();
    let once = subdivided(&mesh, 1);
    assert_eq!(counts(&once), [vertices + edges + faces, 2 * edges + corners, corners], "of what lives");
    assert!(!once.has_vertex(VertexId(7)), "the slot waits");
}

#[test]
fn what_cannot_be_subdivided_is_said() {
    let mut mesh = editable(&primitives::cube(2.0));
    let before = mesh.clone();
    for levels in [0, 11] {
        assert!(matches!(mesh.catmull_clark(levels), Err(Refusal::OutOfRange { .. })), "{levels}");
    }
    assert!(mesh == before, "nothing changed");
    assert!(EditMesh::new().catmull_clark(1).is_err(), "there is no face");
    let mut large = editable(&primitives::grid(1.0, 1.0, 64, 64));
    assert_eq!(large.catmull_clark(10), Err(Refusal::TooMany), "four milliard faces");
}

proptest! {
    #[test]
    fn catmull_clark_keeps_every_rule(
        start in meshes(), removed in any::<u32>(), crease in any::<u64>(), levels in 1u32..3,
    ) {
        let mut mesh = editable(&start);
        // Some have no edge.
        drop(mesh.remove_edge(EdgeId(removed % mesh.edge_capacity().max(1) as u32)));
        for edge in mesh.edges().collect::<Vec<_>>() {
            mesh.set_crease(edge, (crease >> (edge.0 % 32) & 7) as f32 / 7.0);
        }
        let outcome = check_operation(&mesh, |mesh| mesh.catmull_clark(levels));
        if let Some((after, ())) = outcome.map_err(TestCaseError::fail)? {
            prop_assert!(mesh.vertices().all(|vertex| after.has_vertex(vertex)));
            prop_assert!(after.faces().all(|face| after.face_size(face) == 4));
            // No weight is negative, so nothing leaves the box around the mesh; but for rounding.
            let reach = |mesh: &EditMesh, vertex| mesh.position(vertex).abs().max_element();
            let bounds = |mesh: &EditMesh| mesh.vertices().map(|v| reach(mesh, v)).fold(0.0, f32::max);
            prop_assert!(bounds(&after) <= bounds(&mesh) * 1.000_01);
        }
    }
}
