//! Scenes written for other programs: read again, and held against little readers of the tests' own.

use proptest::prelude::*;
use trigon_io::{
    Encoding, Export, ExportOptions, FaceExport, Format, Loaded, UpAxis, WriteError, export, load,
    load_from_slice,
};
use trigon_math::color::srgba8_to_linear;
use trigon_math::{DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, primitives};
use trigon_raster::{Texture, TextureFormat};
use trigon_scene::{
    Light, Material, MetallicRoughness, Node, NormalMap, Scene, Shading, TextureBinding, Transform,
};

use crate::{loaded, warnings};

const FORMATS: [(Format, &str); 4] =
    [(Format::Obj, "a.obj"), (Format::Ply, "a.ply"), (Format::Stl, "a.stl"), (Format::Off, "a.off")];
const ENCODINGS: [Encoding; 3] = [Encoding::Binary, Encoding::BinaryBigEndian, Encoding::Text];

fn written(scene: &Scene, (format, name): (Format, &str), options: &ExportOptions<'_>) -> Export {
    export(scene, name, format, options).unwrap_or_else(|error| panic!("{error}"))
}

/// The model's own file.
fn bytes(export: &Export) -> &[u8] {
    &export.files.last().expect("there is always one").bytes
}

fn again(scene: &Scene, format: (Format, &str), options: &ExportOptions<'_>) -> Loaded {
    loaded(format.1, bytes(&written(scene, format, options)))
}

/// The faces of all nodes as positions in a world with +Y up, rounded as files have them.
fn faces(scene: &Scene) -> Vec<Vec<[u32; 3]>> {
    let (mut scene, mut faces) = (scene.clone(), Vec::new());
    scene.turn_to(UpAxis::Y);
    for (id, node) in scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let (mesh, world) = (asset.mesh(), scene.world_transform(id));
        let place = |&vertex: &u32| {
            let place = world.transform_point3(mesh.positions()[vertex as usize].as_dvec3());
            // Adding zero makes −0 and +0 the same: STL unites them.
            place.as_vec3().to_array().map(|value| (value + 0.0).to_bits())
        };
        faces.extend((0..mesh.face_count()).map(|face| mesh.face_vertices(face).iter().map(place).collect()));
    }
    faces
}

fn scene_of(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("an object", mesh, Material::default());
    scene
}

/// Any mesh of some polygons, with positions of any size.
fn any_mesh() -> impl Strategy<Value = Mesh> {
    let coordinate = prop_oneof![
        4 => -100.0f32..100.0,
        1 => prop::num::f32::NORMAL.prop_filter("within the range of f32 with room", |value| value.abs() < 1e30),
        1 => Just(-0.0f32),
    ];
    let position = [coordinate.clone(), coordinate.clone(), coordinate];
    let positions = prop::collection::vec(position, 3..12);
    let faces = prop::collection::vec(prop::collection::vec(any::<prop::sample::Index>(), 3..7), 1..8);
    (positions, faces).prop_map(|(positions, faces)| {
        let mut builder = MeshBuilder::new();
        for &position in &positions {
            builder.push_vertex(position.into());
        }
        builder.push_face(&[0, 1, 2]).expect("three vertices");
        for face in faces {
            let vertices: Vec<u32> = face.iter().map(|index| index.index(positions.len()) as u32).collect();
            // Those with too few different vertices are none.
            drop(builder.push_face(&vertices));
        }
        builder.build()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Polygons and the bits of their positions, in every format and encoding.
    #[test]
    fn what_is_written_is_read_again(mesh in any_mesh()) {
        let scene = scene_of(mesh);
        for format in FORMATS.into_iter().filter(|&(format, _)| format != Format::Stl) {
            for encoding in ENCODINGS {
                let options = ExportOptions { encoding, ..ExportOptions::default() };
                let read = again(&scene, format, &options);
                prop_assert_eq!(faces(&read.scene), faces(&scene), "{:?} {:?}", format, encoding);
            }
        }
    }

    /// STL has triangles: those of the other formats, if they are asked for them.
    #[test]
    fn triangles_are_the_same_in_all_formats(mesh in any_mesh()) {
        let scene = scene_of(mesh);
        let options = ExportOptions { faces: FaceExport::Triangles, ..ExportOptions::default() };
        let ply = faces(&again(&scene, FORMATS[1], &options).scene);
        // A triangle that a polygon is cut into may have a corner twice at one place.
        let sound = |face: &Vec<[u32; 3]>| face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
        let expected: Vec<_> = ply.into_iter().filter(sound).collect();
        for encoding in [Encoding::Binary, Encoding::Text] {
            let file = written(&scene, FORMATS[2], &ExportOptions { encoding, ..ExportOptions::default() });
            let found = match load_from_slice("a.stl", bytes(&file), &trigon_io::LoadOptions::default()) {
                Ok(loaded) => faces(&loaded.scene),
                Err(_) => Vec::new(),
            };
            prop_assert_eq!(&found, &expected, "{:?}", encoding);
        }
    }

    /// A reader that knows nothing but what trigon writes finds the same numbers.
    #[test]
    fn text_is_what_it_seems(mesh in any_mesh()) {
        let scene = scene_of(mesh);
        let text = |format, encoding| {
            let options = ExportOptions { encoding, ..ExportOptions::default() };
            String::from_utf8(bytes(&written(&scene, format, &options)).to_vec()).expect("text")
        };
        let numbers = |line: &str| -> Vec<f32> { line.split(' ').filter_map(|word| word.parse().ok()).collect() };
        let (_, asset) = scene.meshes().iter().next().expect("one");
        let expected: Vec<f32> = asset.mesh().positions().iter().flat_map(|place| place.to_array()).collect();
        let ply = text(FORMATS[1], Encoding::Text);
        let body = ply.split("end_header\n").nth(1).expect("a body");
        let off = text(FORMATS[3], Encoding::Binary);
        let obj = text(FORMATS[0], Encoding::Binary);
        let count = asset.mesh().vertex_count();
        let found = [
            body.lines().take(count).flat_map(numbers).collect::<Vec<f32>>(),
            off.lines().skip(2).take(count).flat_map(numbers).collect(),
            obj.lines().filter_map(|line| line.strip_prefix("v ")).flat_map(numbers).collect(),
        ];
        for found in found {
            let bits = |list: &[f32]| list.iter().map(|value| value.to_bits()).collect::<Vec<u32>>();
            prop_assert_eq!(bits(&found), bits(&expected));
        }
    }
}

/// Two quads with a seam between them: corners of shared vertices differ.
fn seamed() -> Mesh {
    let mut builder = MeshBuilder::new();
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (0.0, 1.0)] {
        builder.push_vertex(Vec3::new(x, y, 0.0));
    }
    for face in [[0, 1, 4, 5], [1, 2, 3, 4]] {
        builder.push_face(&face).expect("four vertices");
    }
    let mut mesh = builder.build();
    let corners = mesh.corner_count();
    let half = |corner: usize| corner >= corners / 2;
    let attributes = Attributes {
        corner_normals: Some((0..corners).map(|c| if half(c) { Vec3::Z } else { Vec3::Y }).collect()),
        uv_sets: vec![
            (0..corners).map(|c| Vec2::new(c as f32 / 16.0, if half(c) { 0.3 } else { 1e-3 })).collect(),
        ],
        corner_colors: Some(
            (0..corners).map(|c| if half(c) { Vec4::ONE } else { Vec4::new(1., 0., 0., 1.) }).collect(),
        ),
        ..Attributes::default()
    };
    mesh.set_attributes(attributes).expect("one each");
    mesh
}

#[test]
fn values_of_corners_come_back() {
    let scene = scene_of(seamed());
    let (_, asset) = scene.meshes().iter().next().expect("one");
    let expected = asset.mesh().attributes();
    for (format, encoding) in
        [(FORMATS[0], Encoding::Text), (FORMATS[1], Encoding::Binary), (FORMATS[1], Encoding::Text)]
    {
        let read = again(&scene, format, &ExportOptions { encoding, ..ExportOptions::default() });
        let (_, asset) = read.scene.meshes().iter().next().expect("one");
        let found = asset.mesh().attributes();
        assert_eq!(found.corner_normals, expected.corner_normals, "{format:?} {encoding:?}");
        assert_eq!(found.uv_sets, expected.uv_sets, "{format:?} {encoding:?}, to the bit");
        if format.0 == Format::Ply {
            assert_eq!(found.corner_colors, expected.corner_colors, "{encoding:?}");
        }
    }
    let losses = written(&scene, FORMATS[1], &ExportOptions::default());
    let text: Vec<String> = losses.what_would_be_lost().iter().map(ToString::to_string).collect();
    assert!(text.iter().any(|loss| loss.contains("seams and sharp edges are one")), "{text:?}");
}

/// Three vertices with colours that are exact in 8 bits.
fn colored_wires(elements: &[&[u32]]) -> Mesh {
    let mut builder = MeshBuilder::new();
    for place in [Vec3::ZERO, Vec3::X, Vec3::Y] {
        builder.push_vertex(place);
    }
    for element in elements {
        let added = match **element {
            [point] => builder.push_loose_point(point),
            [from, to] => builder.push_loose_edge(from, to),
            _ => builder.push_face(element).map(|_| ()),
        };
        added.expect("vertices that exist");
    }
    let mut mesh = builder.build();
    let colors = [[255, 0, 0, 255], [0, 128, 3, 255], [9, 99, 199, 255]].map(srgba8_to_linear);
    let attributes = Attributes {
        vertex_colors: Some(colors.to_vec()),
        corner_colors: (mesh.face_count() > 0).then(|| vec![Vec4::ONE; mesh.corner_count()]),
        ..Attributes::default()
    };
    mesh.set_attributes(attributes).expect("one each");
    mesh
}

#[test]
fn colours_of_points_and_lines_come_back() {
    let clouds: [&[&[u32]]; 2] = [&[&[0], &[1], &[2]], &[&[0, 1], &[1, 2]]];
    for mesh in clouds.map(colored_wires) {
        let scene = scene_of(mesh.clone());
        let expected = mesh.attributes().vertex_colors.clone().expect("they were set");
        let check = |read: &Loaded, what: &str| {
            let (_, asset) = read.scene.meshes().iter().next().expect("one");
            let found = asset.mesh().attributes().vertex_colors.clone().expect(what);
            let are_near = |(a, b): (&Vec4, &Vec4)| a.abs_diff_eq(*b, 1e-6);
            assert!(found.len() == 3 && found.iter().zip(&expected).all(are_near), "{what}: {found:?}");
            assert!(asset.mesh().loose_edges() == mesh.loose_edges(), "{what}: the lines");
            assert!(asset.mesh().loose_points() == mesh.loose_points(), "{what}: the points");
        };
        for encoding in ENCODINGS {
            let options = ExportOptions { encoding, ..ExportOptions::default() };
            check(&again(&scene, FORMATS[1], &options), &format!("PLY, {encoding:?}"));
        }
        check(&again(&scene, FORMATS[0], &ExportOptions::default()), "OBJ");
        let glb = trigon_io::encode_glb(&scene, &ExportOptions::default()).expect("it is small");
        check(&loaded("a.glb", &glb), "GLB");
    }
}

/// A vertex has one colour in a PLY: where a face and a line show different ones it is written twice.
#[test]
fn a_face_and_a_line_at_one_vertex_keep_their_colours_in_a_ply() {
    let mut builder = MeshBuilder::new();
    for place in [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z] {
        builder.push_vertex(place);
    }
    builder.push_face(&[0, 1, 2]).expect("a face");
    builder.push_loose_edge(0, 3).expect("an edge");
    let mut mesh = builder.build();
    let (red, green) = (Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.0, 1.0, 0.0, 1.0));
    let attributes = Attributes {
        corner_colors: Some(vec![red; 3]),
        vertex_colors: Some(vec![green; 4]),
        ..Attributes::default()
    };
    mesh.set_attributes(attributes).expect("one each");
    let read = again(&scene_of(mesh), FORMATS[1], &ExportOptions::default());
    let (_, asset) = read.scene.meshes().iter().next().expect("one");
    let (mesh, attributes) = (asset.mesh(), asset.mesh().attributes());
    assert_eq!(attributes.corner_colors.as_deref(), Some(&[red; 3][..]), "the face");
    let of_vertices = attributes.vertex_colors.as_ref().expect("the line has colours");
    let ends = mesh.loose_edges().as_flattened();
    assert!(ends.len() == 2 && ends.iter().all(|&end| of_vertices[end as usize] == green), "the line");
}

/// Smooth meshes without normals of their own were written with normals of no length, and came back flat.
#[test]
fn smooth_faces_have_their_normals_in_a_ply() {
    let mut mesh = primitives::cube(1.0);
    let attributes = Attributes {
        face_smooth: Some(vec![true; mesh.face_count()]),
        corner_normals: Some(vec![Vec3::ZERO; mesh.corner_count()]),
        ..Attributes::default()
    };
    mesh.set_attributes(attributes).expect("one for each face and corner");
    let normals = mesh.shading_normals();
    let scene = again(&scene_of(mesh), FORMATS[1], &ExportOptions::default()).scene;
    let (_, asset) = scene.meshes().iter().next().expect("a mesh");
    assert_eq!(asset.mesh().vertex_count(), 8, "no vertex is written twice");
    let read = asset.mesh().shading_normals();
    assert!(read.iter().zip(&normals).all(|(read, normal)| read.abs_diff_eq(*normal, 1e-6)), "{read:?}");
}

#[test]
fn objects_are_in_their_places() {
    let mut scene = scene_of(primitives::cube(2.0));
    let (id, _) = scene.nodes().iter().next().expect("one");
    let (sine, cosine) = trigon_math::elementary::sin_cos(1.0);
    let transform = Transform::from_scale_rotation_translation(
        DVec3::new(-1.0, 2.0, 0.5),
        DQuat::from_rotation_z(1.0),
        DVec3::new(3.0, 4.0, 5.0),
    );
    scene.node_mut(id).expect("it exists").transform = transform;
    for format in FORMATS.into_iter().filter(|&(format, _)| format != Format::Stl) {
        let read = again(&scene, format, &ExportOptions::default());
        let (_, asset) = read.scene.meshes().iter().next().expect("one");
        let found = asset.mesh().positions();
        let corners: [DVec3; 8] = std::array::from_fn(|bits| {
            let corner = [0, 1, 2].map(|axis| if bits >> axis & 1 == 0 { -1.0 } else { 1.0 });
            let [x, y, z] = [-corner[0], 2.0 * corner[1], 0.5 * corner[2]];
            DVec3::new(3.0 + x * cosine - y * sine, 4.0 + x * sine + y * cosine, 5.0 + z)
        });
        // Numbers below 8 in f32. A PLY has a vertex for each normal of a corner.
        let is_near = |vertex: &Vec3, corner: &DVec3| vertex.as_dvec3().abs_diff_eq(*corner, 1e-6);
        for corner in &corners {
            assert!(found.iter().any(|vertex| is_near(vertex, corner)), "{format:?}: {corner}, {found:?}");
        }
        for vertex in found {
            assert!(corners.iter().any(|corner| is_near(vertex, corner)), "{format:?}: {vertex}");
        }
        let outward = (0..6).all(|face| {
            let place =
                |corner: usize| asset.mesh().positions()[asset.mesh().face_vertices(face)[corner] as usize];
            let normal = (place(1) - place(0)).cross(place(2) - place(0));
            normal.dot(place(0) - Vec3::new(3.0, 4.0, 5.0)) > 0.0
        });
        assert!(outward, "{format:?}: the mirror turned no face inside");
    }
}

#[test]
fn up_and_scale_are_those_of_the_file() {
    let mut builder = MeshBuilder::new();
    let corners = [Vec3::new(1.0, 2.0, 3.0), Vec3::X, Vec3::Y].map(|place| builder.push_vertex(place));
    builder.push_face(&corners).expect("a triangle");
    let scene = scene_of(builder.build());
    let options = ExportOptions { up: Some(UpAxis::Z), scale: 1000.0, ..ExportOptions::default() };
    for format in FORMATS {
        let read = again(&scene, format, &options);
        let (_, asset) = read.scene.meshes().iter().next().expect("one");
        assert_eq!(asset.mesh().positions()[0].to_array(), [1000.0, -3000.0, 2000.0], "{format:?}");
    }
}

#[test]
fn chosen_nodes_are_written_and_hidden_ones_named() {
    let mut scene = scene_of(primitives::cube(2.0));
    let second = scene.add_object("second", primitives::cube(1.0), Material::default());
    let hidden = scene.add_object("hidden", primitives::cube(1.0), Material::default());
    scene.node_mut(hidden).expect("it exists").visible = false;
    for format in FORMATS {
        let read =
            again(&scene, format, &ExportOptions { nodes: Some(vec![second]), ..ExportOptions::default() });
        assert_eq!(
            faces(&read.scene).len(),
            if format.0 == Format::Stl { 12 } else { 6 },
            "{format:?}: one cube"
        );
        let all = written(&scene, format, &ExportOptions::default());
        let text: Vec<String> = all.what_would_be_lost().iter().map(ToString::to_string).collect();
        assert!(
            text.contains(&"node \"hidden\": it is hidden and not written".to_owned()),
            "{format:?}: {text:?}"
        );
    }
}

#[test]
fn what_a_format_cannot_hold_is_told() {
    let mut scene = scene_of(seamed());
    scene.add(Node::from_light(Light::point(1.0)).with_name("lamp"));
    scene.add_object("wire", primitives::polyline(&[Vec3::ZERO, Vec3::X]), Material::default());
    let lost = |format| {
        let export = written(&scene, format, &ExportOptions::default());
        export.what_would_be_lost().iter().map(ToString::to_string).collect::<Vec<String>>()
    };
    let stl = lost(FORMATS[2]);
    for what in [
        "node \"lamp\": its light",
        "normals",
        "texture coordinates",
        "vertex colours",
        "edges without faces",
    ] {
        assert!(stl.contains(&what.to_owned()), "{what}: {stl:?}");
    }
    assert!(stl.iter().any(|loss| loss.starts_with("polygons")), "{stl:?}");
    let expected = ["node \"lamp\": its light", "vertex colours that differ between the faces of a vertex"];
    assert_eq!(lost(FORMATS[0]), expected, "OBJ holds the rest");
    let refused = export(&scene, "a.gltf", Format::Gltf, &ExportOptions::default()).map(drop);
    assert!(matches!(refused, Err(WriteError::Unwritten { .. })), "{refused:?}");
}

#[test]
fn a_glb_tells_that_it_cuts_polygons() {
    let lost = |mesh: Mesh, faces| {
        let options = ExportOptions { faces, ..ExportOptions::default() };
        let export = written(&scene_of(mesh), (Format::Glb, "a.glb"), &options);
        export.what_would_be_lost().iter().map(ToString::to_string).collect::<Vec<String>>()
    };
    let told = lost(primitives::cube(1.0), FaceExport::Polygons);
    assert_eq!(told, ["polygons: they are cut into triangles"], "squares");
    assert!(lost(primitives::cube(1.0), FaceExport::Triangles).is_empty(), "as it was asked for");
    assert!(lost(primitives::icosphere(1.0, 1), FaceExport::Polygons).is_empty(), "triangles stay");
}

/// Files beside the model, found again by its reader.
#[test]
fn materials_and_images_lie_beside_an_obj() {
    let mut scene = scene_of(seamed());
    let texels = vec![[255, 0, 0, 255], [0, 255, 0, 255]];
    let texture = scene
        .add_texture("folder\\wood #1.png", Texture::new(2, 1, texels, TextureFormat::Srgb).expect("two"));
    let (_, material) = scene.materials.iter_mut().next().expect("one");
    material.name = "dark wood".to_owned();
    material.base_color = Vec4::new(1.0, 0.5, 0.25, 0.5);
    material.base_color_texture = Some(TextureBinding::new(texture));
    let export = written(&scene, (Format::Obj, "my chair.obj"), &ExportOptions::default());
    let names: Vec<&str> = export.files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["my_chair_wood__1.png", "my_chair.mtl", "my chair.obj"], "the model last");
    let folder = tempfile::tempdir().expect("a folder");
    export.write(folder.path()).expect("written");
    let read =
        load(folder.path().join("my chair.obj"), &trigon_io::LoadOptions::default()).expect("it loads");
    assert_eq!(warnings(&read), [""; 0], "nothing is missing");
    let (_, found) = read.scene.materials.iter().next().expect("one");
    let close = (found.base_color - Vec4::new(1.0, 0.5, 0.25, 0.5)).abs().max_element();
    assert!(found.name == "dark_wood" && close < 1e-6, "a rounding of sRGB: {found:?}");
    let binding = found.base_color_texture.expect("the image");
    assert_eq!(binding.transform, TextureBinding::new(binding.texture).transform, "in its place");
    let texture = &read.scene.textures.get(binding.texture).expect("it exists").texture;
    assert_eq!(texture.texels().next(), Some([255, 0, 0, 255]), "its texels");
}

/// What a material is shaded by, in the words of MTL and of its extension for metals.
#[test]
fn shading_and_the_strength_of_normals_are_written_to_mtl() {
    let mtl = |material: Material| {
        let mut scene = scene_of(seamed());
        *scene.materials.iter_mut().next().expect("one").1 = material;
        let export = written(&scene, FORMATS[0], &ExportOptions::default());
        let text = |file: &trigon_io::ExportedFile| String::from_utf8_lossy(&file.bytes).into_owned();
        export.files.iter().find(|file| file.name.ends_with(".mtl")).map(text).expect("a library")
    };
    let metal = MetallicRoughness { metallic: 0.25, roughness: 0.75, ..MetallicRoughness::default() };
    let specular = Vec3::new(1.0, 0.0, 1.0);
    let shadings = [
        (Shading::Unlit, vec!["illum 0"]),
        (Shading::Lambert, vec!["illum 1"]),
        (
            Shading::BlinnPhong { specular, shininess: 32.0, specular_texture: None },
            vec!["illum 2", "Ks 1 0 1", "Ns 32"],
        ),
        (Shading::MetallicRoughness(metal), vec!["illum 2", "Pr 0.75", "Pm 0.25"]),
    ];
    for (shading, expected) in shadings {
        let text = mtl(Material { shading, ..Material::default() });
        for line in expected {
            assert!(text.lines().any(|found| found == line), "{line}: {text}");
        }
    }
}

#[test]
fn the_strength_of_normal_maps_is_written_to_mtl_unless_it_is_one() {
    for (scale, line) in [(1.0, "norm "), (0.5, "norm -bm 0.5 ")] {
        let mut scene = scene_of(seamed());
        let texture = Texture::new(1, 1, vec![[128, 128, 255, 255]], TextureFormat::Linear).expect("one");
        let binding = TextureBinding::new(scene.add_texture("bumps", texture));
        scene.materials.iter_mut().next().expect("one").1.normal_map = Some(NormalMap { binding, scale });
        let export = written(&scene, FORMATS[0], &ExportOptions::default());
        let file = export.files.iter().find(|file| file.name.ends_with(".mtl")).expect("a library");
        let text = String::from_utf8_lossy(&file.bytes);
        let found = text.lines().find(|found| found.starts_with("norm ")).expect("a normal map");
        assert!(found.starts_with(line) && found.contains("-bm") == (scale != 1.0), "{found}");
    }
}

/// Each attribute alone: what is not there is not lost.
#[test]
fn only_what_the_mesh_has_is_lost() {
    let square = primitives::plane(1.0, 1.0);
    let uv_sets = square.attributes().uv_sets.clone();
    for (attributes, expected) in [
        (Attributes::default(), vec![]),
        (Attributes { uv_sets, ..Attributes::default() }, vec!["texture coordinates"]),
        (Attributes { corner_normals: Some(vec![Vec3::Y; 4]), ..Attributes::default() }, vec!["normals"]),
    ] {
        let mut mesh = square.clone();
        mesh.set_attributes(attributes).expect("one value for each corner");
        let export = written(&scene_of(mesh), FORMATS[3], &ExportOptions::default());
        let lost: Vec<String> = export.what_would_be_lost().iter().map(ToString::to_string).collect();
        let told = ["texture coordinates", "normals"].into_iter();
        let lost: Vec<&str> = told.filter(|what| lost.iter().any(|loss| loss == what)).collect();
        assert_eq!(lost, expected, "in OFF");
    }
}

#[test]
fn names_break_no_line() {
    let mut scene = scene_of(primitives::cube(2.0));
    for (_, node) in scene.nodes_mut() {
        node.name = "a\nv 9 9 9 \\".to_owned();
    }
    scene.add_object("a\nv 9 9 9 \\", primitives::cube(1.0), Material::default());
    for format in [FORMATS[0], FORMATS[2]] {
        let read =
            again(&scene, format, &ExportOptions { encoding: Encoding::Text, ..ExportOptions::default() });
        assert_eq!(
            warnings(&read).iter().filter(|warning| !warning.contains("library")).count(),
            0,
            "{format:?}"
        );
        assert_eq!(read.scene.nodes().len(), 2, "{format:?}: two objects");
    }
}

#[test]
fn a_far_model_keeps_its_digits() {
    let mut scene = scene_of(primitives::cube(0.001));
    for (_, node) in scene.nodes_mut() {
        node.transform = Transform::from_translation(DVec3::new(1e7, 0.0, 0.0));
    }
    for format in FORMATS {
        let read =
            again(&scene, format, &ExportOptions { encoding: Encoding::Text, ..ExportOptions::default() });
        let size = read.scene.bounds().max - read.scene.bounds().min;
        assert!(
            (size - DVec3::splat(0.001)).abs().max_element() < 1e-8,
            "{format:?}: {size}, half a step of f64 at 10⁷ m"
        );
    }
}

#[test]
fn point_clouds_stay_point_clouds() {
    let mut builder = MeshBuilder::new();
    for position in [Vec3::ZERO, Vec3::X, Vec3::Y] {
        let vertex = builder.push_vertex(position);
        builder.push_loose_point(vertex).expect("it exists");
    }
    let scene = scene_of(builder.build());
    for format in [FORMATS[0], FORMATS[1], FORMATS[3]] {
        let read = again(&scene, format, &ExportOptions::default());
        let (_, asset) = read.scene.meshes().iter().next().expect("one");
        assert_eq!(asset.mesh().loose_points(), [0, 1, 2], "{format:?}");
    }
}

/// These were written as 0, or as infinity.
#[test]
fn a_coordinate_beyond_f32_is_refused_and_not_written() {
    let far = |transform: Transform, mesh: Mesh| {
        let mut scene = Scene::new();
        let parent = scene.add(Node::default().with_name("parent").with_transform(transform));
        let mesh = scene.add_mesh("cube", mesh);
        let mut cube = Node::default().with_name("cube");
        cube.mesh = Some(mesh);
        scene.add_child(parent, cube).expect("the parent is there");
        scene
    };
    let scaled = |scale: f64| {
        Transform::from_scale_rotation_translation(DVec3::splat(scale), DQuat::IDENTITY, DVec3::ZERO)
    };
    let cases = [
        far(scaled(1e39), primitives::cube(2.0)),
        far(scaled(1e30), primitives::cube(2e30)),
        far(Transform::from_translation(DVec3::Y * 1e39), primitives::cube(2.0)),
        far(scaled(f64::INFINITY), primitives::cube(2.0)),
    ];
    for (number, scene) in cases.iter().enumerate() {
        for ((format, name), encoding) in
            FORMATS.into_iter().flat_map(|format| ENCODINGS.map(|way| (format, way)))
        {
            let options = ExportOptions { encoding, ..ExportOptions::default() };
            let error = export(scene, name, format, &options).map(drop).expect_err("it does not fit");
            assert!(
                matches!(&error, WriteError::Overflow { node } if node == "cube"),
                "{number}, {name}: {error}"
            );
        }
        let fits = scene.nodes().iter().all(|(_, node)| node.transform.fits_f32());
        let glb = export(scene, "a.glb", Format::Glb, &ExportOptions::default()).map(drop);
        assert_eq!(glb.is_ok(), fits, "{number}: a GLB has the nodes, not their product");
    }
    let near = far(scaled(1e37), primitives::cube(2.0));
    for format in FORMATS {
        written(&near, format, &ExportOptions::default());
    }
}
