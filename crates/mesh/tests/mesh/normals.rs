//! Normals of faces, vertices and corners.

use std::f64::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Attributes, Mesh, RenderMesh, primitives};

use crate::outlines::mesh;

#[test]
fn a_bent_quad_has_the_normal_of_its_area() {
    let bent = [Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 1.0)];
    let quad = mesh(&bent, &[&[0, 1, 2, 3]]);
    assert_eq!(quad.face_area_vector(0), DVec3::Z, "half the product of the diagonals");
}

#[test]
fn vertex_normals_do_not_depend_on_how_faces_are_cut() {
    let corner =
        [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y, Vec3::Y + Vec3::Z, Vec3::Z, Vec3::X + Vec3::Z];
    let whole = mesh(&corner, &[&[0, 3, 2, 1], &[0, 1, 6, 5], &[0, 5, 4, 3]]);
    let cut = mesh(&corner, &[&[0, 3, 2], &[0, 2, 1], &[0, 1, 6, 5], &[0, 5, 4, 3]]);
    let expected = Vec3::NEG_ONE.normalize();
    for mesh in [whole, cut] {
        let found = mesh.vertex_normals()[0];
        assert!(found.distance(expected) < 1e-6, "the corner of a cube looks to {found}");
    }
}

#[test]
fn flat_is_the_default_and_smooth_is_chosen_per_face() {
    let mut cube = primitives::cube(1.0);
    assert!(cube.shading_normals().iter().all(|n| n.abs().element_sum() == 1.0), "flat normals are axes");
    let mut smooth = vec![true; 6];
    smooth[3] = false;
    let attributes = Attributes { face_smooth: Some(smooth), ..Attributes::default() };
    cube.set_attributes(attributes).expect("six faces");
    let normals = cube.shading_normals();
    assert!(cube.face_corners(3).all(|c| normals[c] == Vec3::NEG_Y), "the bottom is flat");
    let top = normals[cube.face_corners(2).start];
    assert!((top.y - 1.0 / 3.0_f32.sqrt()).abs() < 1e-6, "the top is smooth: {top}");
    let lower = cube.face_corners(0).map(|c| normals[c]).find(|n| n.y == 0.0);
    assert!(lower.is_some(), "flat faces do not count for smooth ones");
}

#[test]
fn normals_that_say_nothing_are_replaced() {
    let mut cube = primitives::cube(1.0);
    let mut given = vec![Vec3::new(0.0, 3.0, 0.0); 24];
    given[0] = Vec3::ZERO;
    given[1] = Vec3::NAN;
    given[2] = Vec3::new(0.0, f32::INFINITY, 0.0);
    given[3] = Vec3::new(0.6, 0.8, 0.0);
    let attributes = Attributes { corner_normals: Some(given), ..Attributes::default() };
    cube.set_attributes(attributes).expect("24 corners");
    let normals = cube.shading_normals();
    assert_eq!(normals[..3], [Vec3::X; 3], "the face's normal instead");
    assert_eq!(normals[3], Vec3::new(0.6, 0.8, 0.0), "a unit normal keeps its bits");
    assert_eq!(normals[4], Vec3::Y, "a long one is shortened");
}

#[test]
fn faces_without_area_never_give_nan() {
    let points = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::NAN];
    let mut mesh = mesh(&points, &[&[0, 1, 2], &[0, 1, 3], &[0, 1, 2], &[2, 1, 0]]);
    for smooth in [None, Some(vec![true; 4])] {
        mesh.set_attributes(Attributes { face_smooth: smooth, ..Attributes::default() }).expect("four faces");
        let render = RenderMesh::from_mesh(&mesh);
        assert!(render.normals.iter().all(|n| n.length() == 1.0), "unit normals: {:?}", render.normals);
    }
    mesh.smooth_by_angle(1.0);
    assert!(mesh.shading_normals().iter().all(|n| n.length() == 1.0), "unit normals");
}

#[test]
fn a_cube_is_sharp_until_the_angle_reaches_its_own() {
    let drawn = |angle: f64| {
        let mut cube = primitives::cube(1.0);
        let shape = Attributes::default();
        cube.set_attributes(shape).expect("nothing fits");
        cube.smooth_by_angle(angle);
        RenderMesh::from_mesh(&cube).positions.len()
    };
    assert_eq!([drawn(0.0), drawn(1.5), drawn(FRAC_PI_2), drawn(PI)], [24, 24, 8, 8], "drawn vertices");
}

#[test]
fn smoothing_a_cylinder_keeps_its_rims() {
    let exact = primitives::cylinder(1.0, 2.0, 32);
    let mut smoothed = exact.clone();
    smoothed.smooth_by_angle(0.5);
    for (a, b) in exact.shading_normals().iter().zip(smoothed.shading_normals()) {
        assert!(a.distance(b) < 1e-5, "{a} became {b}");
    }
}

#[test]
fn smoothing_everything_gives_the_vertex_normals() {
    let mut pot = primitives::uv_sphere(1.0, 9, 7);
    pot.smooth_by_angle(PI);
    let normals = pot.vertex_normals();
    for (&vertex, found) in pot.corner_vertices().iter().zip(pot.shading_normals()) {
        assert!(normals[vertex as usize].distance(found) < 1e-6, "vertex {vertex}: {found}");
    }
}

fn soup(points: &[(i8, i8, i8)]) -> Mesh {
    let positions: Vec<Vec3> =
        points.iter().map(|&(x, y, z)| Vec3::new(f32::from(x), f32::from(y), f32::from(z))).collect();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    let faces: Vec<&[u32]> = indices.windows(3).collect();
    mesh(&positions, &faces)
}

proptest! {
    #[test]
    fn all_normals_are_unit_vectors(points in prop::collection::vec((-3i8..3, -3i8..3, -3i8..3), 3..30), angle in 0.0..PI) {
        let mut mesh = soup(&points);
        let faces = mesh.face_count();
        mesh.set_attributes(Attributes { face_smooth: Some(vec![true; faces]), ..Attributes::default() }).unwrap();
        for _ in 0..2 {
            for normal in mesh.shading_normals() {
                prop_assert!((normal.length() - 1.0).abs() < 1e-6, "{}", normal);
            }
            mesh.smooth_by_angle(angle);
        }
    }
}
