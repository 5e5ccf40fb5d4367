//! Transforms baked into vertices (source A2, hard case 33).

use trigon_math::{DAffine3, DMat3, DQuat, DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};

/// Normals stay of unit length, square to the surface, on its outside.
fn check_normals(mesh: &Mesh) {
    let faces = mesh.face_normals();
    let normals = mesh.shading_normals();
    for (face, corners) in mesh.faces().enumerate() {
        for corner in corners {
            assert!((normals[corner].length() - 1.0).abs() < 1e-6, "|{}|", normals[corner]);
            let side = normals[corner].dot(faces[face]);
            assert!(side > 0.9, "corner {corner} looks away from face {face}: {side}");
        }
    }
}

#[test]
fn every_regular_transform_keeps_outside_outside() {
    let sheared = DMat3::from_cols(DVec3::X, DVec3::new(0.7, 1.0, 0.0), DVec3::Z);
    for matrix in [
        DMat3::from_quat(DQuat::from_axis_angle(DVec3::ONE.normalize(), 1.0)),
        DMat3::from_diagonal(DVec3::new(3.0, 1.0, 0.5)),
        DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0)),
        DMat3::from_diagonal(DVec3::splat(-2.0)),
        sheared,
    ] {
        let transform = DAffine3::from_mat3_translation(matrix, DVec3::new(5.0, 6.0, 7.0));
        let sphere = primitives::uv_sphere(1.0, 48, 32);
        let moved = sphere.transformed(&transform);
        check_normals(&moved);
        assert!(moved.is_closed(), "still closed");
        let volume = sphere.volume() * matrix.determinant().abs();
        assert!((moved.volume() / volume - 1.0).abs() < 1e-4, "volume {} for {volume}", moved.volume());
        assert_eq!(moved.edges(), sphere.edges(), "edges keep their numbers");
    }
}

#[test]
fn mirroring_twice_is_nothing() {
    let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let cone = primitives::cone(1.0, 2.0, 5);
    let mirrored = cone.transformed(&mirror);
    assert_ne!(mirrored.corner_vertices(), cone.corner_vertices(), "faces are turned over");
    for corner in 0..mirrored.corner_count() {
        let edge = mirrored.edges()[mirrored.corner_edge(corner).expect("vertices are distinct") as usize];
        assert!(edge.contains(&mirrored.corner_vertices()[corner]), "corner {corner} is not on its edge");
    }
    assert_eq!(mirrored.transformed(&mirror), cone, "all bits are back");
}

#[test]
fn flattening_gives_no_nan() {
    for scale in [DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 0.0, 1.0), DVec3::ZERO] {
        let flat = primitives::uv_sphere(1.0, 8, 6).transformed(&DAffine3::from_scale(scale));
        assert!(flat.shading_normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-6), "scaled by {scale}");
    }
}

#[test]
fn transforms_are_computed_in_f64() {
    // In f32, 1e8 + 1 - 1e8 is 0.
    let there = DAffine3::from_translation(DVec3::splat(1e8));
    let back = DAffine3::from_translation(DVec3::splat(-1e8));
    let mut cube = primitives::cube(2.0);
    cube.transform(&(back * there));
    assert_eq!(cube.positions()[7], Vec3::ONE, "nothing is lost");
}
