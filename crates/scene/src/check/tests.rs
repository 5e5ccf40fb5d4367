//! A broken scene for each fault, and sound ones.

use trigon_math::{DQuat, DVec3, Vec3, Vec4};
use trigon_mesh::{Mesh, MeshBuilder, primitives};

use super::*;
use crate::{
    AlphaMode, Light, Material, MetallicRoughness, Node, Shading, Texture, TextureBinding, TextureFormat,
    Transform,
};

fn scene_of(mesh: Mesh, material: Material) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("thing", mesh, material);
    scene
}

fn with_mesh(mesh: Mesh) -> Scene {
    scene_of(mesh, Material::default())
}

fn cube() -> Mesh {
    primitives::cube(1.0)
}

/// Vertices and faces.
fn mesh(positions: &[Vec3], faces: &[&[u32]]) -> Mesh {
    let mut builder = MeshBuilder::new();
    for &position in positions {
        builder.push_vertex(position);
    }
    for face in faces {
        builder.push_face(face).expect("a face");
    }
    builder.build()
}

fn placed(transform: Transform) -> Scene {
    let mut scene = with_mesh(cube());
    scene.nodes_mut().for_each(|(_, node)| node.transform = transform);
    scene
}

fn scaled(scale: f64) -> Scene {
    placed(Transform::from_scale_rotation_translation(DVec3::splat(scale), DQuat::IDENTITY, DVec3::ZERO))
}

fn flipped() -> Mesh {
    let mut mesh = cube();
    mesh.flip_faces();
    mesh
}

/// Two triangles of a square, one of them turned over.
fn mixed() -> Mesh {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    mesh(&corners, &[&[0, 1, 2], &[0, 3, 2]])
}

/// Three triangles at one edge.
fn fan() -> Mesh {
    mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_Y], &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]])
}

fn with_normals(normal: Vec3) -> Mesh {
    let mut mesh = mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[&[0, 1, 2]]);
    let mut attributes = mesh.attributes().clone();
    attributes.corner_normals = Some(vec![normal; 3]);
    mesh.set_attributes(attributes).expect("one each");
    mesh
}

fn textured(base_color: Vec4, mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    let texels = vec![[255; 4]];
    let texture =
        scene.add_texture("white", Texture::new(1, 1, texels, TextureFormat::Srgb).expect("a texel"));
    let binding = Some(TextureBinding::new(texture));
    scene.add_object(
        "thing",
        mesh,
        Material { base_color, base_color_texture: binding, ..Material::default() },
    );
    scene
}

fn without_coordinates() -> Mesh {
    mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[&[0, 1, 2]])
}

fn black_vertices() -> Mesh {
    let mut mesh = cube();
    let mut attributes = mesh.attributes().clone();
    attributes.corner_colors = Some(vec![Vec4::W; mesh.corner_count()]);
    mesh.set_attributes(attributes).expect("one each");
    mesh
}

fn polished() -> Material {
    let surface = MetallicRoughness { metallic: 1.0, roughness: 0.0, ..MetallicRoughness::default() };
    Material::default().with_shading(Shading::MetallicRoughness(surface))
}

fn clear() -> Material {
    Material {
        base_color: Vec4::new(1.0, 1.0, 1.0, 0.0),
        alpha_mode: AlphaMode::Blend,
        ..Material::default()
    }
}

fn unlit_by_lights() -> Scene {
    let mut scene = with_mesh(cube());
    scene.add(Node::from_light(Light::ambient(0.0)));
    scene
}

fn hidden() -> Scene {
    let mut scene = with_mesh(cube());
    scene.nodes_mut().for_each(|(_, node)| node.visible = false);
    scene
}

fn flat_faces() -> Mesh {
    mesh(&[Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::Y], &[&[0, 1, 2], &[1, 0, 3]])
}

#[test]
fn each_fault_is_named() {
    let nan = mesh(&[Vec3::NAN, Vec3::X, Vec3::Y, Vec3::Z], &[&[0, 1, 2], &[2, 1, 3]]);
    let away = Transform::from_translation(DVec3::X * 1e7);
    let to_a_line =
        Transform::from_scale_rotation_translation(DVec3::new(1.0, 0.0, 0.0), DQuat::IDENTITY, DVec3::ZERO);
    for (scene, fault, severity) in [
        (Scene::new(), "nothing-to-draw", Severity::Error),
        (hidden(), "nothing-to-draw", Severity::Error),
        (with_mesh(nan), "not-a-number", Severity::Error),
        (placed(to_a_line), "flattened", Severity::Error),
        (scaled(1e-5), "scale", Severity::Warning),
        (scaled(1e6), "scale", Severity::Warning),
        (placed(away), "far-from-origin", Severity::Warning),
        (with_mesh(flipped()), "inside-out", Severity::Error),
        (with_mesh(mixed()), "mixed-winding", Severity::Warning),
        (with_mesh(without_coordinates()), "open-edges", Severity::Note),
        (with_mesh(flat_faces()), "no-area", Severity::Warning),
        (with_mesh(with_normals(Vec3::ZERO)), "broken-normals", Severity::Error),
        (with_mesh(with_normals(Vec3::NEG_Z)), "inverted-normals", Severity::Error),
        (scene_of(cube(), clear()), "invisible", Severity::Error),
        (textured(Vec4::W, cube()), "black", Severity::Error),
        (with_mesh(black_vertices()), "black", Severity::Error),
        (textured(Vec4::ONE, without_coordinates()), "no-texture-coordinates", Severity::Error),
        (scene_of(cube(), polished()), "metal-without-environment", Severity::Note),
        (unlit_by_lights(), "no-light", Severity::Error),
    ] {
        let mut findings = scene.check();
        // Flat examples have open edges besides.
        findings.retain(|finding| finding.fault == fault || finding.fault != "open-edges");
        let faults: Vec<&str> = findings.iter().map(|finding| finding.fault).collect();
        assert_eq!(faults, [fault], "only this: {findings:?}");
        assert_eq!(findings[0].severity, severity, "{fault}");
        assert!(!findings[0].to_string().contains('\n'), "one line");
    }
}

#[test]
fn sound_scenes_have_no_faults() {
    for (name, scene) in [
        ("a cube", with_mesh(cube())),
        ("a wire", with_mesh(primitives::ring(1.0, 8))),
        ("a texture", textured(Vec4::ONE, cube())),
    ] {
        assert_eq!(scene.check(), [], "{name}");
        assert_eq!(scene.check_for_printing(), [], "{name} can be printed");
    }
    for (name, scene) in [
        ("a teapot", with_mesh(primitives::teapot(4))),
        ("a plane", with_mesh(primitives::plane(1.0, 1.0))),
        ("the showcase", crate::showcase()),
    ] {
        let findings = scene.check();
        assert!(findings.iter().all(|finding| finding.fault == "open-edges"), "{name}: {findings:?}");
        assert!(findings.iter().all(|finding| finding.severity == Severity::Note), "{name}: {findings:?}");
    }
}

/// A box that lacks two triangles, as files for printing often do, and three faces at an edge.
#[test]
fn what_encloses_no_volume_is_a_fault_for_printing_alone() {
    let triangles: Vec<[u32; 3]> = {
        let mesh = cube();
        let quads = (0..6).map(|face| mesh.face_vertices(face).to_vec());
        quads.flat_map(|quad| [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]).collect()
    };
    let faces: Vec<&[u32]> = triangles[2..].iter().map(|face| &face[..]).collect();
    let open = mesh(cube().positions(), &faces);
    for (mesh, fault, count) in [(open, "open-edges", "4 open edges"), (fan(), "non-manifold", "1 edge")] {
        let scene = with_mesh(mesh);
        for (findings, severity) in
            [(scene.check(), Severity::Note), (scene.check_for_printing(), Severity::Error)]
        {
            let finding = findings.iter().find(|finding| finding.fault == fault).expect("it is found");
            assert_eq!(finding.severity, severity, "{fault}");
            assert!(finding.what.contains(count), "{finding}");
        }
    }
}

/// The inner wall of a hollow ball points inwards, and that is right.
#[test]
fn a_hollow_ball_is_sound() {
    let (outer, inner) = (primitives::icosphere(2.0, 1), primitives::icosphere(1.0, 1));
    let positions: Vec<Vec3> = outer.positions().iter().chain(inner.positions()).copied().collect();
    let first = outer.vertex_count() as u32;
    let mut faces: Vec<Vec<u32>> =
        (0..outer.face_count()).map(|face| outer.face_vertices(face).to_vec()).collect();
    let turned = |face| inner.face_vertices(face).iter().rev().map(|vertex| first + vertex).collect();
    faces.extend((0..inner.face_count()).map(turned));
    let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
    assert_eq!(with_mesh(mesh(&positions, &faces)).check(), [], "the largest part decides");
}

#[test]
fn a_thousand_of_a_kind_are_five() {
    let mut scene = Scene::new();
    for _ in 0..1000 {
        scene.add_object("thing", flipped(), Material::default());
    }
    assert_eq!(scene.check().len(), MOST_OF_A_KIND, "listed");
}
