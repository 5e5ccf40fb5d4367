//! Tests of remeshing by voxels.

use proptest::prelude::*;
use trigon_math::{DAffine3, DVec3, Vec4};
use trigon_mesh::{Mesh, primitives};

use super::*;
use crate::tests::{affine_color, check_operation, with_affine_values};

fn remeshed(mesh: &Mesh, voxel_size: f64, project: bool) -> EditMesh {
    let (mut mesh, _) = EditMesh::from_mesh(mesh);
    let made = mesh.voxel_remesh(&VoxelRemeshSettings { voxel_size, project }).expect("closed");
    assert_eq!(made.len(), mesh.face_count());
    check_manifold(&mesh).expect("manifold");
    mesh
}

/// Closed, of quads, and around each vertex one cycle of faces.
fn check_manifold(mesh: &EditMesh) -> Result<(), String> {
    mesh.check_structure()?;
    if !mesh.is_watertight() || mesh.faces().any(|face| mesh.face_size(face) != 4) {
        return Err("open, or not of quads".into());
    }
    for vertex in mesh.vertices() {
        let faces: Vec<FaceId> = mesh.vertex_faces(vertex).collect();
        let first = faces[0];
        let (mut face, mut steps) = (first, 0);
        loop {
            let corner = mesh.face_corner_at(face, vertex).ok_or("no corner")?;
            let pair = mesh.edge_pair(mesh.corner_edge(corner)).ok_or("an edge without two faces")?;
            let other = if mesh.corner_face(pair[0]) == face { pair[1] } else { pair[0] };
            face = mesh.corner_face(other);
            steps += 1;
            if face == first || steps > faces.len() {
                break;
            }
        }
        if steps != faces.len() {
            return Err(format!("{vertex} has {} faces, and {steps} around it", faces.len()));
        }
    }
    Ok(())
}

/// Vertices + faces − edges.
fn euler(mesh: &EditMesh) -> i64 {
    mesh.vertex_count() as i64 + mesh.face_count() as i64 - mesh.edge_count() as i64
}

/// The greatest distance of vertices of one mesh from the surface of another.
fn distance(from: &EditMesh, to: &EditMesh) -> f64 {
    let tree = SurfaceTree::new(to, &DAffine3::IDENTITY);
    from.vertices()
        .map(|vertex| {
            let point = from.point(vertex);
            tree.nearest(point).expect("it has faces").position.distance(point)
        })
        .fold(0.0, f64::max)
}

#[test]
fn spheres_and_tori_become_quads_of_the_same_shape() {
    for (mesh, genus, voxel_size) in [
        (primitives::icosphere(1.0, 3), 0, 0.15),
        (primitives::torus(1.0, 0.4, 32, 16), 1, 0.11),
        (primitives::cube(2.0), 0, 0.3),
    ] {
        let (source, _) = EditMesh::from_mesh(&mesh);
        let mut errors = Vec::new();
        for size in [voxel_size, voxel_size / 2.0] {
            for project in [false, true] {
                let result = remeshed(&mesh, size, project);
                assert_eq!(euler(&result), 2 - 2 * genus);
                let far = distance(&result, &source).max(distance(&source, &result));
                assert!(far <= size * 3.0_f64.sqrt(), "{far} for voxels of {size}");
                if project {
                    assert!(distance(&result, &source) < 1e-6, "on the surface");
                } else {
                    errors.push((result.volume() - source.volume()).abs());
                }
            }
        }
        if source.face_count() == 6 {
            // Sides are exact. Of 12 edges of 2 metres at most half a cell is cut off.
            let lost = |size: f64| 24.0 * 0.5 * size * size;
            assert!(errors[0] < lost(voxel_size) && errors[1] < lost(voxel_size / 2.0), "{errors:?}");
        } else {
            // The error of chords shrinks with the square of their length; half of that is asked for.
            assert!(errors[1] < 0.5 * errors[0] && errors[0] < 0.05 * source.volume(), "{errors:?}");
        }
    }
}

#[test]
fn flat_sides_stay_flat_wherever_the_lattice_is() {
    for shift in [0.0, 0.05, 0.123] {
        let (cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let mut moved = EditMesh::new();
        moved.join_mesh(&cube, &DAffine3::from_translation(DVec3::splat(shift))).expect("a copy");
        moved.voxel_remesh(&VoxelRemeshSettings { voxel_size: 0.25, project: false }).expect("closed");
        check_manifold(&moved).expect("manifold");
        let on_top =
            moved.vertices().filter(|&vertex| (moved.point(vertex).y - shift - 1.0).abs() < 1e-6).count();
        // Those whose cells do not reach a side: at least 6 x 6.
        assert!(on_top >= 36, "{on_top} vertices on the top at {shift}");
    }
}

/// Cubes around single points of the lattice, which touch in edges and vertices: every ambiguous case.
#[test]
fn random_voxels_are_manifold() {
    let mut state = 1_u64;
    for _ in 0..40 {
        let mut mesh = EditMesh::new();
        let (cube, _) = EditMesh::from_mesh(&primitives::cube(1.0));
        for at in 0..27_u32 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            if state >> 63 != 0 && at > 0 {
                continue;
            }
            let offset = DVec3::new(f64::from(at % 3), f64::from(at / 3 % 3), f64::from(at / 9));
            // Each contains just one point of the lattice.
            mesh.join_mesh(&cube, &DAffine3::from_translation(offset)).expect("a copy");
        }
        let settings = VoxelRemeshSettings { voxel_size: 1.0, project: false };
        let (after, _) =
            check_operation(&mesh, |mesh| mesh.voxel_remesh(&settings)).expect("whole").expect("closed");
        check_manifold(&after).expect("manifold");
    }
}

#[test]
fn values_are_those_of_the_nearest_face() {
    let (mut ball, _) = EditMesh::from_mesh(&with_affine_values(primitives::icosphere(1.0, 2)));
    let upper: Vec<FaceId> = ball.faces().filter(|&face| ball.face_center(face).y > 0.0).collect();
    ball.assign_material(&upper, 2).expect("some");
    ball.shade_flat(&ball.faces().collect::<Vec<FaceId>>()).expect("all");
    ball.shade_smooth(&upper).expect("some");
    ball.voxel_remesh(&VoxelRemeshSettings { voxel_size: 0.2, project: true }).expect("closed");
    for face in ball.faces() {
        let height = ball.face_center(face).y;
        if height.abs() > 0.2 {
            assert_eq!((ball.material(face) == 2, ball.is_smooth(face)), (height > 0.0, height > 0.0));
        }
    }
    for corner in ball.corners() {
        let expected: Vec4 = affine_color(ball.position(ball.corner_vertex(corner)));
        assert!(ball.color(corner).expect("there are colours").abs_diff_eq(expected, 1e-5));
    }
}

#[test]
fn what_has_no_inside_or_is_too_fine_is_refused() {
    let refused = |mesh: &Mesh, voxel_size: f64| {
        let (mut mesh, _) = EditMesh::from_mesh(mesh);
        let before = mesh.clone();
        let refusal = mesh.voxel_remesh(&VoxelRemeshSettings { voxel_size, project: false });
        assert!(mesh == before, "unchanged");
        refusal.expect_err("refused").to_string()
    };
    assert!(refused(&primitives::grid(1.0, 1.0, 2, 2), 0.1).contains("hole"));
    assert!(refused(&primitives::cube(2.0), 1e-4).contains("2147483648 points"));
    assert!(refused(&primitives::cube(2.0), 1e-300).contains("points"));
    assert!(refused(&primitives::cube(2.0), 0.0).contains("above 0"));
    assert!(refused(&primitives::cube(2.0), f64::NAN).contains("above 0"));
    assert!(EditMesh::new().voxel_remesh(&VoxelRemeshSettings::default()).is_err());
    let (small, _) = EditMesh::from_mesh(&primitives::cube(0.25));
    let mut thin = EditMesh::new();
    thin.join_mesh(&small, &DAffine3::from_translation(DVec3::splat(0.5))).expect("a copy");
    let refusal = thin.voxel_remesh(&VoxelRemeshSettings { voxel_size: 1.0, project: false });
    assert!(refusal.expect_err("between points").to_string().contains("thinner"));
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let bytes = cube.bytes() as u64;
    for allowed in [bytes, bytes + 40_000] {
        let settings = VoxelRemeshSettings { voxel_size: 0.05, project: false };
        let refusal = cube.transaction_within(allowed, |cube| cube.voxel_remesh(&settings)).map(drop);
        assert!(matches!(refusal, Err(Refusal::Memory { .. })), "{refusal:?}");
        assert_eq!(cube.bytes() as u64, bytes, "no list has grown");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Spheres that overlap, touch or are apart: all vertices are near the boundary of their union.
    #[test]
    fn unions_of_spheres_are_manifold_and_near(
        spheres in prop::collection::vec((prop::array::uniform3(-1.0_f64..1.0), 0.3_f64..0.8), 1..5),
    ) {
        let mut mesh = EditMesh::new();
        for &(center, radius) in &spheres {
            let (ball, _) = EditMesh::from_mesh(&primitives::icosphere(radius as f32, 2));
            mesh.join_mesh(&ball, &DAffine3::from_translation(DVec3::from(center))).expect("a copy");
        }
        let settings = VoxelRemeshSettings { voxel_size: 0.13, project: false };
        let (after, _) = check_operation(&mesh, |mesh| mesh.voxel_remesh(&settings))
            .map_err(TestCaseError::fail)?
            .expect("closed");
        check_manifold(&after).map_err(TestCaseError::fail)?;
        prop_assert_eq!(euler(&after) % 2, 0);
        // Their triangles leave out at most 5 % of a radius.
        let far = 0.13 * 3.0_f64.sqrt() + 0.04;
        for vertex in after.vertices() {
            let outside = |&(center, radius): &([f64; 3], f64)| {
                after.point(vertex).distance(DVec3::from(center)) - radius
            };
            let nearest = spheres.iter().map(outside).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest.abs() <= far, "{} is {} outside", after.point(vertex), nearest);
        }
    }
}
