//! Meshes as a renderer gets them: welded corners.

use proptest::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, MorphTarget, RenderMesh, WeldedMesh, primitives};

fn with(mut mesh: Mesh, attributes: Attributes) -> RenderMesh {
    mesh.set_attributes(attributes).expect("one value each");
    RenderMesh::from_mesh(&mesh)
}

#[test]
fn a_flat_cube_has_24_vertices_and_a_smooth_one_8() {
    let cube = || primitives::cube(1.0);
    assert_eq!(with(cube(), Attributes::default()).positions.len(), 24, "three normals at each vertex");
    let smooth = Attributes { face_smooth: Some(vec![true; 6]), ..Attributes::default() };
    let render = with(cube(), smooth.clone());
    assert_eq!((render.positions.len(), render.triangles.len()), (8, 12), "one normal at each vertex");
    let mut colors = vec![Vec4::ONE; 24];
    colors[7] = Vec4::X;
    let colored = with(cube(), Attributes { corner_colors: Some(colors), ..smooth.clone() });
    assert_eq!(colored.positions.len(), 9, "one corner has a colour of its own");
    let uv_sets = vec![vec![Vec2::ZERO; 24], (0..24).map(|i| Vec2::splat(i as f32)).collect()];
    let mapped = with(cube(), Attributes { uv_sets, ..smooth });
    assert_eq!((mapped.positions.len(), mapped.uv_sets.len()), (24, 2), "the second set differs everywhere");
}

#[test]
fn a_cube_with_normals_of_polygons_has_8_vertices() {
    let flat = |attributes: Attributes| {
        let mut cube = primitives::cube(1.0);
        cube.set_attributes(attributes).expect("one value each");
        WeldedMesh::of_flat(&cube)
    };
    let (shared, normals) = flat(Attributes::default()).expect("all is flat");
    assert_eq!((shared.corners.len(), shared.normals.len(), normals.len()), (8, 0, 6), "no normals there");
    let split = with(primitives::cube(1.0), Attributes::default());
    let cube = primitives::cube(1.0);
    let position_of = |corner: u32| cube.positions()[cube.corner_vertices()[corner as usize] as usize];
    for (triangle, (one, other)) in shared.triangles.iter().zip(&split.triangles).enumerate() {
        let one = one.map(|vertex| position_of(shared.corners[vertex as usize]));
        let other = other.map(|vertex| split.positions[vertex as usize]);
        assert_eq!(one, other, "triangle {triangle} is at the same place");
        let of_vertex = split.normals[split.triangles[triangle][0] as usize];
        assert_eq!(normals[shared.triangle_faces[triangle] as usize], of_vertex, "triangle {triangle}");
    }
    let mut colors = vec![Vec4::ONE; 24];
    colors[7] = Vec4::X;
    let colored = flat(Attributes { corner_colors: Some(colors), ..Attributes::default() });
    assert_eq!(colored.expect("it is flat").0.corners.len(), 9, "other values still divide vertices");
    let smooth = Attributes { face_smooth: Some(vec![true; 6]), ..Attributes::default() };
    let given = Attributes { corner_normals: Some(vec![Vec3::Y; 24]), ..Attributes::default() };
    let moving = Attributes { morph_targets: vec![MorphTarget::default()], ..Attributes::default() };
    assert!([smooth, given, moving].map(flat).iter().all(Option::is_none), "those need normals of vertices");
}

#[test]
fn materials_and_faces_follow_the_triangles() {
    let slots = vec![5, 4, 3, 2, 1, 0];
    let render =
        with(primitives::cube(1.0), Attributes { face_materials: Some(slots), ..Attributes::default() });
    assert_eq!(render.triangle_faces, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5], "faces");
    let slots = vec![5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0];
    assert_eq!(render.triangle_materials, Some(slots), "slots");
    let plain = with(primitives::cube(1.0), Attributes::default());
    assert_eq!(plain.triangle_materials, None, "a mesh without slots");
}

#[test]
fn zeros_are_one_value_and_nan_is_like_itself() {
    let quad = || primitives::plane(1.0, 1.0);
    let twice = |uv: [Vec2; 4]| {
        let mut builder = MeshBuilder::new();
        for &position in quad().positions() {
            builder.push_vertex(position);
        }
        for _ in 0..2 {
            builder.push_face(&[0, 1, 2, 3]).expect("a quad");
        }
        let mut set = vec![Vec2::ZERO; 4];
        set.extend(uv);
        with(builder.build(), Attributes { uv_sets: vec![set], ..Attributes::default() }).positions.len()
    };
    assert_eq!(twice([Vec2::new(-0.0, 0.0); 4]), 4, "-0 is 0");
    assert_eq!(twice([Vec2::NAN; 4]), 8, "NaN is not 0");
    assert_eq!(twice([Vec2::new(f32::MIN_POSITIVE / 2.0, 0.0); 4]), 8, "nothing is rounded");
}

#[test]
fn a_fan_with_100_000_seams_at_one_vertex() {
    let count = 100_000u32;
    let mut builder = MeshBuilder::new();
    let tip = builder.push_vertex(Vec3::Y);
    for i in 0..=count {
        builder.push_vertex(Vec3::new(i as f32, 0.0, 0.0));
    }
    for i in 1..=count {
        builder.push_face(&[tip, i, i + 1]).expect("a triangle");
    }
    let set = (0..3 * count).map(|corner| Vec2::splat((corner / 3 % 50_000) as f32)).collect();
    let smooth = Some(vec![true; count as usize]);
    let attributes = Attributes { uv_sets: vec![set], face_smooth: smooth, ..Attributes::default() };
    let render = with(builder.build(), attributes);
    let at_tip = render.positions.iter().filter(|&&p| p == Vec3::Y).count();
    assert_eq!(at_tip, 50_000, "each value twice at the tip");
}

/// What welding means, without any cleverness.
fn naive(mesh: &Mesh) -> (Vec<Vec3>, Vec<u32>) {
    let normals = mesh.shading_normals();
    let mut seen: Vec<(u32, Vec3, Vec2)> = Vec::new();
    let set = &mesh.attributes().uv_sets[0];
    let numbers = mesh.corner_vertices().iter().enumerate().map(|(corner, &vertex)| {
        let value = (vertex, normals[corner], set[corner]);
        let known = seen.iter().position(|other| *other == value);
        known.unwrap_or_else(|| {
            seen.push(value);
            seen.len() - 1
        }) as u32
    });
    let numbers: Vec<u32> = numbers.collect();
    (seen.iter().map(|&(vertex, ..)| mesh.positions()[vertex as usize]).collect(), numbers)
}

proptest! {
    #[test]
    fn welding_agrees_with_comparing_everything(
        faces in prop::collection::vec(prop::collection::vec(0u32..5, 3..6), 1..40),
        values in prop::collection::vec(0u8..3, 240),
    ) {
        let mut builder = MeshBuilder::new();
        for i in 0..5u8 {
            builder.push_vertex(Vec3::new(f32::from(i), f32::from(i * i % 3), f32::from(i % 2)));
        }
        for face in &faces {
            let _ = builder.push_face(face);
        }
        let mut mesh = builder.build();
        let set = values[..mesh.corner_count()].iter().map(|&v| Vec2::splat(f32::from(v))).collect();
        mesh.set_attributes(Attributes { uv_sets: vec![set], ..Attributes::default() }).unwrap();
        let render = RenderMesh::from_mesh(&mesh);
        let (positions, numbers) = naive(&mesh);
        prop_assert_eq!(&render.positions, &positions);
        for (drawn, corners) in render.triangles.iter().zip(mesh.triangulation().triangles) {
            prop_assert_eq!(*drawn, corners.map(|corner| numbers[corner as usize]));
        }
    }
}
