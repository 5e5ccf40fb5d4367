//! Cuts by other faces and by outlines: closed forms, and booleans as the oracle.

use proptest::prelude::*;
use trigon_math::{DAffine3, DQuat, DVec3, area_vector};
use trigon_mesh::primitives;

use super::*;
use crate::tests::{keeps_affine_values, with_affine_values};
use crate::{BooleanOperation, BooleanTool, IntersectWith, KnifeProjection};

fn edit(mesh: trigon_mesh::Mesh) -> EditMesh {
    EditMesh::from_mesh(&with_affine_values(mesh)).0
}

fn cube() -> EditMesh {
    edit(primitives::cube(2.0))
}

/// A mesh with the copies of others, one after the other.
fn joined(parts: &[(EditMesh, DAffine3)]) -> EditMesh {
    let mut mesh = EditMesh::new();
    for (part, transform) in parts {
        mesh.join_mesh(part, transform).expect("room");
    }
    mesh
}

fn area(mesh: &EditMesh) -> f64 {
    mesh.faces().map(|face| area_vector(mesh.face_vertices(face).map(|v| mesh.point(v))).length()).sum()
}

fn length(mesh: &EditMesh, edges: &[EdgeId]) -> f64 {
    let of = |&edge: &EdgeId| {
        let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex));
        a.distance(b)
    };
    edges.iter().map(of).sum()
}

fn euler(mesh: &EditMesh) -> i64 {
    mesh.check_structure().expect("whole");
    mesh.vertex_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

fn first_faces(mesh: &EditMesh, count: usize) -> Vec<FaceId> {
    mesh.faces().take(count).collect()
}

#[test]
fn a_corner_in_a_cube_cuts_three_faces_of_each() {
    let moved = DAffine3::from_translation(DVec3::ONE);
    let mut mesh = joined(&[(cube(), DAffine3::IDENTITY), (cube(), moved)]);
    let whole = area(&mesh);
    let faces = first_faces(&mesh, 6);
    let cut = mesh.intersect_faces(&faces, IntersectWith::Others).expect("they cross");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (12, 6, 0), "a hexagon on each");
    assert_eq!((mesh.vertex_count(), euler(&mesh)), (16 + 12, 4), "two spheres");
    assert!((area(&mesh) - whole).abs() < 1e-5 && (length(&mesh, &cut.edges) - 12.0).abs() < 1e-5);
    let again =
        mesh.clone().intersect_faces(&faces, IntersectWith::Themselves).expect_err("they do not cross");
    assert!(again.to_string().contains("no face crosses"), "{again}");
}

#[test]
fn a_sheet_is_cut_all_across_and_one_that_ends_within_is_counted() {
    let upright = DAffine3::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let sheet = |size: f32| edit(primitives::plane(size, size));
    let mut mesh = joined(&[(sheet(2.0), DAffine3::IDENTITY), (sheet(2.0), upright)]);
    let all: Vec<FaceId> = mesh.faces().collect();
    let cut = mesh.intersect_faces(&all, IntersectWith::Themselves).expect("they cross");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (2, 2, 0), "each is divided");
    let mut mesh = joined(&[(sheet(2.0), DAffine3::IDENTITY), (sheet(1.0), upright)]);
    let cut = mesh.intersect_faces(&first_faces(&mesh, 1), IntersectWith::Others).expect("they cross");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (1, 1, 1), "only the small one is divided");
}

#[test]
fn a_sheet_on_another_one_is_cut_out_of_it() {
    let sheet = |size: f32| edit(primitives::plane(size, size));
    let mut mesh = joined(&[(sheet(2.0), DAffine3::IDENTITY), (sheet(1.0), DAffine3::IDENTITY)]);
    let cut = mesh.intersect_faces(&first_faces(&mesh, 1), IntersectWith::Others).expect("they overlap");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (4, 2, 0), "a window and the ring around it");
    assert_eq!(mesh.face_count(), 4, "the small one is whole");
}

/// The edges of a mesh as positions, in any order.
fn edges_as_positions(mesh: &EditMesh) -> Vec<[[u32; 3]; 2]> {
    let mut all: Vec<[[u32; 3]; 2]> = mesh
        .edges()
        .map(|edge| {
            let mut ends = mesh.edge_vertices(edge).map(|vertex| position_key(mesh.position(vertex)));
            ends.sort_unstable();
            ends
        })
        .collect();
    all.sort_unstable();
    all
}

fn projection(cut_through: bool) -> KnifeProjection {
    KnifeProjection {
        transform: DAffine3::from_translation(DVec3::Y * 5.0),
        direction: DVec3::NEG_Y,
        cut_through,
    }
}

#[test]
fn a_projected_square_is_the_closed_cut_by_points() {
    let square = edit(primitives::plane(1.0, 1.0));
    let mut mesh = cube();
    let all: Vec<FaceId> = mesh.faces().collect();
    let top = all.iter().copied().find(|&face| mesh.face_normal(face).y > 0.5).expect("there is one");
    let cut = mesh.knife_project(&all, &square, &projection(false)).expect("it is above");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (4, 2, 0), "the upper side alone");
    let mut by_points = cube();
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]];
    let stroke = corners.map(|[x, z]| KnifePoint::Face(top, Vec3::new(x, 1.0, z))).to_vec();
    by_points.knife(&[stroke]).expect("it closes");
    assert_eq!(edges_as_positions(&mesh), edges_as_positions(&by_points), "the same edges, to the bit");
    keeps_affine_values(&mesh).expect("interpolated");
    let mut through = cube();
    let cut = through.knife_project(&all, &square, &projection(true)).expect("it is above");
    assert_eq!((cut.edges.len(), cut.faces.len(), euler(&through)), (8, 4, 2), "above and below");
    let aside = KnifeProjection { direction: DVec3::X, ..projection(true) };
    let refusal = through.knife_project(&all, &square, &aside).expect_err("it passes above");
    assert!(refusal.to_string().contains("passes none"), "{refusal}");
    let nowhere = KnifeProjection { direction: DVec3::ZERO, ..projection(true) };
    assert!(through.knife_project(&all, &square, &nowhere).is_err(), "no direction");
}

#[test]
fn the_outline_of_a_closed_mesh_is_where_it_turns_away() {
    let mut mesh = edit(primitives::plane(4.0, 4.0));
    let faces: Vec<FaceId> = mesh.faces().collect();
    let cut = mesh.knife_project(&faces, &cube(), &projection(false)).expect("it is above");
    // Only two of the twelve edges' layers are seen from above: those of the upper or the lower side, once.
    assert!((length(&mesh, &cut.edges) - 8.0).abs() < 1e-5, "a square of 2 m");
    assert_eq!(cut.faces.len(), 2, "and the ring around it");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Turned cubes: each side's cut is as long as the seam of their union, and both surfaces stay what they are.
    #[test]
    fn cubes_are_cut_along_the_seam_of_their_union(
        axis in prop::array::uniform3(-1.0f64..1.0), angle in 0.1f64..3.0, offset in prop::array::uniform3(-1.5f64..1.5)
    ) {
        let axis = DVec3::from(axis);
        prop_assume!(axis.length() > 0.1);
        let turn = DQuat::from_axis_angle(axis.normalize(), angle);
        let transform = DAffine3::from_rotation_translation(turn, DVec3::from(offset));
        let mut mesh = joined(&[(cube(), DAffine3::IDENTITY), (cube(), transform)]);
        let mut united = cube();
        let other = joined(&[(cube(), transform)]);
        let tool = BooleanTool { mesh: &other, transform: DAffine3::IDENTITY };
        let seams = united.boolean(&[tool], BooleanOperation::Union).expect("closed").edges;
        let (whole, before, faces) = (area(&mesh), mesh.clone(), first_faces(&mesh, 6));
        match mesh.transaction(|mesh| mesh.intersect_faces(&faces, IntersectWith::Others)) {
            Ok((cut, mut difference)) => {
                prop_assert_eq!((euler(&mesh), cut.uncut), (4, 0));
                prop_assert!((area(&mesh) - whole).abs() < 1e-4, "{} was {}", area(&mesh), whole);
                let [cut, seam] = [length(&mesh, &cut.edges), 2.0 * length(&united, &seams)];
                prop_assert!((cut - seam).abs() < 1e-4, "{} and {}", cut, seam);
                difference.apply(&mut mesh);
            }
            Err(_) => prop_assert!(seams.is_empty(), "{} edges", seams.len()),
        }
        prop_assert!(mesh == before, "undone, or refused");
    }
}
