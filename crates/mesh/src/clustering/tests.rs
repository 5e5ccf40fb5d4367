//! Against the definition: what each triangle was, how far it has moved, and what has disappeared.

use proptest::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};

use crate::{Attributes, ClusteredMesh, Mesh, MeshBuilder, primitives};

/// The mesh with values by which its corners and faces are recognized.
fn numbered(mesh: Mesh) -> Mesh {
    let (corners, faces) = (0..mesh.corner_count(), 0..mesh.face_count() as u32);
    let attributes = Attributes {
        uv_sets: vec![corners.clone().map(|corner| Vec2::new(corner as f32, 7.0)).collect()],
        corner_colors: Some(corners.map(|corner| Vec4::splat(corner as f32)).collect()),
        face_materials: Some(faces.clone().map(|face| 3 * face).collect()),
        face_smooth: Some(faces.map(|face| face % 2 == 0).collect()),
        ..mesh.attributes().clone()
    };
    let mut mesh = mesh;
    mesh.set_attributes(attributes).expect("as many as there are");
    mesh
}

/// Whether every vertex of a face is near one of the result, and every triangle of it was one of the mesh, which has
/// [`numbered`] values.
fn check(mesh: &Mesh, coarse: &ClusteredMesh) -> Result<(), TestCaseError> {
    let ClusteredMesh { mesh: coarse, error } = coarse;
    let error = error * (1.0 + 1e-6);
    let near = |a: Vec3, b: Vec3| a.as_dvec3().distance(b.as_dvec3()) <= error;
    for &vertex in mesh.corner_vertices() {
        let at = mesh.positions()[vertex as usize];
        let is_near = |&of: &u32| near(at, coarse.positions()[of as usize]);
        prop_assert!(coarse.corner_vertices().iter().any(is_near), "nothing is left at {at}");
    }
    let all = mesh.triangulation();
    let (attributes, of_mesh) = (coarse.attributes(), mesh.attributes());
    let slots = attributes.face_materials.as_ref().expect("they have slots");
    let smooth = attributes.face_smooth.as_ref().expect("they are smooth or not");
    let colors = attributes.corner_colors.as_ref().expect("they have colours");
    for (face, corners) in coarse.faces().enumerate() {
        let was = [0, 1, 2].map(|i| attributes.uv_sets[0][corners.start + i].x as u32);
        let number = all.triangles.iter().position(|&triangle| triangle == was);
        prop_assert!(number.is_some(), "corners {was:?} are none of a triangle");
        let face_of = all.triangle_faces[number.unwrap_or_default()];
        prop_assert_eq!((slots[face], smooth[face]), (3 * face_of, face_of.is_multiple_of(2)));
        for (corner, own) in corners.zip(was) {
            let now = coarse.positions()[coarse.corner_vertices()[corner] as usize];
            let before = mesh.positions()[mesh.corner_vertices()[own as usize] as usize];
            prop_assert!(near(now, before), "corner {own} went from {before} to {now}");
            prop_assert!(mesh.positions().contains(&now), "{now} is no vertex of the mesh");
            prop_assert_eq!(colors[corner], of_mesh.corner_colors.as_ref().expect("numbered")[own as usize]);
        }
    }
    Ok(())
}

/// Triangles anywhere, most of them small; many share a vertex.
fn triangles() -> impl Strategy<Value = Mesh> {
    let point = prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from_array);
    let one = (point.clone(), prop::array::uniform3(point), 0.001_f32..0.5);
    prop::collection::vec(one, 1..60).prop_map(|all| {
        let mut builder = MeshBuilder::new();
        let mut last = builder.push_vertex(Vec3::ZERO);
        for (middle, [_, b, c], size) in all {
            let [b, c] = [b, c].map(|corner| builder.push_vertex(middle + corner * size));
            builder.push_face(&[last, b, c]).expect("three vertices");
            last = if size > 0.25 { builder.push_vertex(middle) } else { b };
        }
        builder.build()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn triangles_were_triangles_and_nothing_disappears(
        mesh in triangles(), most in 1_usize..200, scale in -20_i32..20, shift in -10.0_f32..10.0,
    ) {
        let mut mesh = numbered(mesh);
        let scale = if scale < 0 { 1.0 / (1 << -scale) as f32 } else { (1 << scale) as f32 };
        mesh.positions_mut().iter_mut().for_each(|at| *at = (*at + Vec3::splat(shift)) * scale);
        let coarse = mesh.clustered(most);
        let count = coarse.mesh.face_count();
        prop_assert!((1..=most).contains(&count), "{} of {}", count, most);
        check(&mesh, &coarse)?;
    }

    #[test]
    fn a_surface_of_polygons_becomes_one_of_triangles(around in 3_u32..24, most in 20_usize..900) {
        let mesh = numbered(primitives::torus(1.0, 0.4, 2 * around, around));
        let coarse = mesh.clustered(most);
        prop_assert!(coarse.mesh.face_count() <= most);
        check(&mesh, &coarse)?;
    }
}

/// The wanted number is used, and the surface has the shape and the light of the fine one.
#[test]
fn a_coarse_ball_is_a_ball() {
    let ball = primitives::uv_sphere(1.0, 120, 60);
    let mut last_error = f64::INFINITY;
    for most in [200, 800, 3_200] {
        let ClusteredMesh { mesh, error } = ball.clustered(most);
        let count = mesh.face_count();
        assert!((most / 4..=most).contains(&count), "{count} of {most}");
        assert!(error < last_error / 1.5, "{error} is hardly less than {last_error}");
        last_error = error;
        let normals = mesh.attributes().corner_normals.as_ref().expect("they had normals");
        let along = |(&vertex, normal): (&u32, &Vec3)| mesh.positions()[vertex as usize].dot(*normal);
        let least = mesh.corner_vertices().iter().zip(normals).map(along).fold(1.0, f32::min);
        assert!(least > 0.9999, "the normals of a ball lead outwards: {least}");
        let area = |of: &Mesh| -> f64 {
            of.triangulation()
                .triangles
                .iter()
                .map(|of_corners| {
                    let [a, b, c] = of_corners
                        .map(|corner| of.positions()[of.corner_vertices()[corner as usize] as usize]);
                    f64::from((b - a).cross(c - a).length()) / 2.0
                })
                .sum()
        };
        let share = area(&mesh) / area(&ball);
        assert!((0.85..1.02).contains(&share), "{share} of the area for {most}");
    }
}

/// Once a normal was that of the other side of an edge.
#[test]
fn sides_of_a_sharp_edge_have_their_own_normals() {
    let mut cube = primitives::cube(1.0);
    cube.smooth_by_angle(0.1);
    let coarse = cube.clustered(1_000).mesh;
    let normals = coarse.attributes().corner_normals.as_ref().expect("they had normals");
    assert_eq!(coarse.face_count(), 12, "nothing collapses");
    for (triangle, normals) in coarse.corner_vertices().chunks(3).zip(normals.chunks(3)) {
        let [a, b, c] = [0, 1, 2].map(|i| coarse.positions()[triangle[i] as usize]);
        let plane = (b - a).cross(c - a).normalize();
        assert!(normals.iter().all(|normal| normal.dot(plane) > 0.999), "{normals:?} on {plane}");
    }
}

/// Leaves are smaller than a cell: all of their triangles collapse.
#[test]
fn leaves_did_not_disappear() {
    let mut builder = MeshBuilder::new();
    for leaf in 0..4_000 {
        let at = Vec3::new((leaf % 16) as f32, (leaf / 16 % 16) as f32, (leaf / 256) as f32);
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| builder.push_vertex(at + corner * 0.01));
        builder.push_face(&corners).expect("three vertices");
    }
    let coarse = numbered(builder.build()).clustered(1_000).mesh;
    let count = coarse.face_count();
    assert!((200..=1_000).contains(&count), "{count} leaves");
    let size = (coarse.bounds().size() - 15.0).abs().max_element();
    assert!(size < 4.0, "they reach as far: {:?}", coarse.bounds());
}

#[test]
fn meshes_without_size_or_with_odd_numbers_are_mastered() {
    assert_eq!(Mesh::default().clustered(0).mesh.face_count(), 0, "nothing");
    for (most, odd) in [0, 1, 2, 3, 100, usize::MAX].into_iter().zip([
        0.0,
        1e30,
        f32::MAX,
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
    ]) {
        let mut builder = MeshBuilder::new();
        let corners = [Vec3::splat(odd), Vec3::splat(odd), Vec3::new(odd, 0.0, -odd), Vec3::ZERO]
            .map(|corner| builder.push_vertex(corner));
        builder.push_face(&corners).expect("four vertices");
        let count = builder.build().clustered(most).mesh.face_count();
        assert!(count <= most.clamp(1, 2), "{odd}: {count} of {most}");
    }
}
