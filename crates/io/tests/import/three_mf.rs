//! 3MF: what is read, in which units and places, and what is refused.

use std::io::{Cursor, Write};

use proptest::prelude::*;
use trigon_io::{ExportOptions, Format, Limits, LoadOptions, Loaded, export, load_from_slice};
use trigon_math::color::srgba8_to_linear;
use trigon_math::{DQuat, DVec3, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, primitives};
use trigon_scene::{AlphaMode, Material, Node, Scene, Transform};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::{loaded, meshes, refused, warnings, warns_once};

const RELATIONSHIPS: &str = r#"<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/Metadata/thumbnail.png" Id="rel1" Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/>
<Relationship Target="/other/shapes.xml" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>"#;

/// A tetrahedron with its right angles at the origin, 10 units long.
const MESH: &str = r#"<mesh><vertices>
<vertex x="0" y="0" z="0"/><vertex x="10" y="0" z="0"/><vertex x="0" y="10" z="0"/><vertex x="0" y="0" z="10"/>
</vertices><triangles>
<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/>
</triangles></mesh>"#;

/// An archive of parts.
fn packed(parts: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        archive.start_file(*name, SimpleFileOptions::default()).expect("a new name");
        archive.write_all(text.as_bytes()).expect("memory");
    }
    archive.finish().expect("memory").into_inner()
}

/// A file with a model whose elements these are.
fn file(attributes: &str, resources: &str, build: &str) -> Vec<u8> {
    let model = format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02" {attributes}>
<resources>{resources}</resources><build>{build}</build></model>"#
    );
    packed(&[("_rels/.rels", RELATIONSHIPS), ("other/shapes.xml", &model)])
}

/// An object with the tetrahedron.
fn object(attributes: &str) -> String {
    format!("<object {attributes}>{MESH}</object>")
}

fn read(attributes: &str, resources: &str, build: &str) -> Loaded {
    loaded("a.3mf", &file(attributes, resources, build))
}

/// The positions of each node's vertices in the world.
fn places(scene: &Scene) -> Vec<Vec<DVec3>> {
    let placed = scene.nodes().iter().filter_map(|(id, node)| {
        let mesh = scene.meshes().get(node.mesh?)?.mesh();
        let map = scene.world_transform(id);
        Some(mesh.positions().iter().map(|position| map.transform_point3(position.as_dvec3())).collect())
    });
    placed.collect()
}

#[test]
fn units_become_metres() {
    let lengths = [
        ("micron", 1e-5),
        ("millimeter", 0.01),
        ("centimeter", 0.1),
        ("inch", 0.254),
        ("foot", 3.048),
        ("meter", 10.0),
    ];
    for (unit, length) in lengths {
        let item = r#"<item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 20"/>"#;
        let loaded = read(&format!("unit=\"{unit}\""), &object("id=\"1\""), item);
        assert_eq!(warnings(&loaded), [""; 0], "{unit}");
        assert_eq!(meshes(&loaded)[0].positions()[1], Vec3::X * length as f32, "{unit}: rounded once");
        let place = places(&loaded.scene)[0][0];
        assert!(place.abs_diff_eq(DVec3::Z * (2.0 * length), 1e-15), "{unit}: {place}");
    }
    let loaded = read("", &object("id=\"1\""), "<item objectid=\"1\"/>");
    assert_eq!(meshes(&loaded)[0].positions()[1], Vec3::X * 0.01, "millimetres unless something is said");
}

#[test]
fn items_and_components_are_placed_one_within_the_other() {
    // A quarter turn about z, then a step along x: x goes to y.
    let turn = r#"transform="0 1 0 -1 0 0 0 0 1 5 0 0""#;
    let step = r#"transform="1 0 0 0 1 0 0 0 1 0 0 100""#;
    let resources = format!(
        "{}<object id=\"7\" name=\"pair\"><components><component objectid=\"1\"/>\
         <component objectid=\"1\" {turn}/></components></object>",
        object("id=\"1\" name=\"corner\"")
    );
    let loaded = read("", &resources, &format!("<item objectid=\"7\" {step}/><item objectid=\"1\"/>"));
    assert_eq!(warnings(&loaded), [""; 0], "nothing");
    let names: Vec<&str> = loaded.scene.nodes().iter().map(|(_, node)| node.name.as_str()).collect();
    assert_eq!(names, ["pair", "corner", "corner", "corner"], "items and their components");
    assert_eq!(loaded.scene.roots().count(), 2, "one for each item");
    assert_eq!(loaded.scene.meshes().len(), 1, "one mesh for all");
    let ends: Vec<DVec3> = places(&loaded.scene).iter().map(|places| places[1] * 1000.0).collect();
    let expected = [DVec3::new(10.0, 0.0, 100.0), DVec3::new(5.0, 10.0, 100.0), DVec3::X * 10.0];
    for (end, expected) in ends.iter().zip(expected) {
        // Metres of f32 in millimetres.
        assert!(end.abs_diff_eq(expected, 1e-5), "{end} instead of {expected}");
    }
}

#[test]
fn names_are_those_of_objects_or_numbers_of_parts() {
    let resources = [
        object("id=\"1\" name=\"a &amp; b &#x263A;\""),
        object("id=\"2\" partnumber=\"P2\""),
        object("id=\"3\""),
    ];
    let build = r#"<item objectid="1" partnumber="x"/><item objectid="2"/><item objectid="3" partnumber="P3"/><item objectid="3"/>"#;
    let loaded = read("", &resources.concat(), build);
    let names: Vec<&str> = loaded.scene.nodes().iter().map(|(_, node)| node.name.as_str()).collect();
    assert_eq!(names, ["a & b ☺", "P2", "P3", "object 3"]);
}

#[test]
fn triangles_have_materials_and_corners_have_colours() {
    let triangles = [
        r#"<triangle v1="0" v2="2" v3="1"/>"#,
        r#"<triangle v1="0" v2="1" v3="3" pid="4" p1="1"/>"#,
        r#"<triangle v1="1" v2="2" v3="3" pid="5" p1="0" p2="1" p3="1"/>"#,
        r#"<triangle v1="2" v2="0" v3="3" pid="5" p1="1"/>"#,
    ];
    let start = MESH.find("<triangle ").expect("triangles");
    let mesh = format!("{}{}</triangles></mesh>", &MESH[..start], triangles.concat());
    let resources = format!(
        "<basematerials id=\"4\"><base name=\"red\" displaycolor=\"#FF0000\"/><base name=\"glass\" \
         displaycolor=\"#0000FF80\"/></basematerials><m:colorgroup id=\"5\"><m:color color=\"#00FF00\"/>\
         <m:color color=\"#808080FF\"/></m:colorgroup><object id=\"1\" pid=\"4\" pindex=\"0\">{mesh}</object>"
    );
    let loaded = read("", &resources, "<item objectid=\"1\"/>");
    assert_eq!(warnings(&loaded), [""; 0], "nothing");
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    let materials: Vec<&Material> =
        node.materials.iter().map(|&id| loaded.scene.materials.get(id).expect("it is there")).collect();
    let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["red", "glass", "default"], "as faces show them");
    assert_eq!(materials[0].base_color, Vec4::new(1.0, 0.0, 0.0, 1.0), "sRGB as light");
    assert_eq!((materials[1].alpha_mode, materials[1].base_color.w), (AlphaMode::Blend, 128.0 / 255.0));
    assert_eq!(materials[2].base_color, Vec4::ONE, "colours are seen as they are");
    let attributes = meshes(&loaded)[0].attributes();
    assert_eq!(attributes.face_materials.as_deref(), Some(&[0, 1, 2, 2][..]), "slots");
    let colors = attributes.corner_colors.as_ref().expect("colours");
    let (green, grey) = (srgba8_to_linear([0, 255, 0, 255]), srgba8_to_linear([128, 128, 128, 255]));
    assert_eq!(colors[..6], [Vec4::ONE; 6], "faces with a material are white");
    assert_eq!(colors[6..], [green, grey, grey, grey, grey, grey], "of the corners");
}

#[test]
fn a_model_in_several_parts_is_put_together() {
    let core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
    let inner =
        format!("<model xmlns=\"{core}\"><resources>{}</resources><build/></model>", object("id=\"1\""));
    let outer = format!(
        "<model xmlns=\"{core}\" xmlns:q=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" \
         requiredextensions=\"q\"><resources><object id=\"1\"><components><component q:path=\"/3D/Objects/a%20b.model\" \
         objectid=\"1\"/></components></object></resources><build><item objectid=\"1\" q:UUID=\"x\"/></build></model>"
    );
    let parts =
        [("_rels/.rels", RELATIONSHIPS), ("other/shapes.xml", &outer), ("3D/Objects/a b.model", &inner)];
    let loaded = loaded("a.3mf", &packed(&parts));
    assert_eq!(
        (loaded.scene.nodes().len(), loaded.scene.meshes().len()),
        (2, 1),
        "an item and its component"
    );
    assert_eq!(warnings(&loaded), [""; 0], "nothing");
    let message = refused("a.3mf", &packed(&parts[..2]));
    assert!(message.contains("no part \"3D/Objects/a b.model\""), "{message}");
}

#[test]
fn what_is_not_drawn_is_a_warning_and_what_is_needed_is_refused() {
    let lattice = r#"<object id="1">MESH<b:beamlattice><b:beams><b:beam v1="0" v2="1"/></b:beams></b:beamlattice></object>"#;
    let lattice = lattice.replace("MESH", &MESH.replace("</mesh>", "</mesh><b:x/>"));
    let item = "<item objectid=\"1\"/>";
    warns_once(
        &read("", &lattice, item),
        "the extension \"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\"",
    );
    let message = refused("a.3mf", &file("requiredextensions=\"m b\"", &lattice, item));
    assert!(
        message.contains("requires the extension \"http") && message.contains("beamlattice"),
        "{message}"
    );
    assert!(message.contains("other/shapes.xml, line 2"), "{message}");
    let textures =
        format!("<m:texture2dgroup id=\"2\" texid=\"3\"/>{}", object("id=\"1\" pid=\"2\" pindex=\"0\""));
    warns_once(&read("", &textures, item), "\"texture2dgroup\" are not drawn");
    warns_once(&read("", &object("id=\"1\" pid=\"9\" pindex=\"0\""), item), "properties that do not exist");
    let open = object("id=\"1\"").replace("<triangle v1=\"0\" v2=\"2\" v3=\"1\"/>", "");
    warns_once(&read("", &open, item), "object 1 is no closed body: 3 edges");
    let flat =
        object("id=\"1\"").replace("</triangles>", "<triangle v1=\"0\" v2=\"0\" v3=\"1\"/></triangles>");
    warns_once(&read("", &flat, item), "fewer than 3 different vertices");
}

#[test]
fn faults_are_named_with_their_part_and_line() {
    let item = "<item objectid=\"1\"/>";
    let changed = |from: &str, to: &str| file("", &object("id=\"1\"").replace(from, to), item);
    let cases = [
        (changed("v3=\"1\"", "v3=\"4\""), "line 6: a triangle names vertex 4, and the mesh has 4"),
        (changed("v3=\"1\"", ""), "a triangle has fewer than 3 vertices"),
        (changed("v3=\"1\"", "v3=\"-1\""), "v3 is \"-1\""),
        (changed("x=\"10\"", "x=\"ten\""), "\"ten\" is not a number"),
        (changed("x=\"10\"", "x=\"1e60\""), "too large"),
        (changed("x=\"10\"", ""), "lacks a coordinate"),
        (changed("</mesh>", ""), "line 7"),
        (file("unit=\"mile\"", "", ""), "the unit \"mile\""),
        (file("", "", ""), "the build has no items"),
        (file("", "", item), "there is no object 1"),
        (
            file("", &object("id=\"1\""), "<item objectid=\"1\" transform=\"1 0 0\"/>"),
            "3 numbers instead of 12",
        ),
        (
            file("", &[object("id=\"1\""), object("id=\"1\"")].concat(), item),
            "a second object has the number 1",
        ),
        (packed(&[("a.txt", "hello")]), "without the relationships of a 3MF"),
        (packed(&[("_rels/.rels", "<Relationships/>")]), "no relationship of the package leads to a model"),
        (packed(&[("_rels/.rels", RELATIONSHIPS)]), "no part \"other/shapes.xml\""),
        (
            packed(&[("_rels/.rels", RELATIONSHIPS), ("other/shapes.xml", "<html/>")]),
            "not the <model> of a 3MF",
        ),
        (b"PK\x03\x04".to_vec(), "cannot be unpacked"),
        (Vec::new(), "cannot be unpacked"),
    ];
    for (bytes, expected) in cases {
        let message = refused("a.3mf", &bytes);
        assert!(message.contains(expected), "{message:?} instead of {expected:?}");
    }
}

/// A few hundred bytes that would fill the memory.
#[test]
fn small_files_do_not_grow_without_bounds() {
    let limits = Limits { file_bytes: 1 << 20, nodes: 1000, ..Limits::default() };
    let options = LoadOptions { limits, ..LoadOptions::default() };
    let refused =
        |bytes: &[u8]| load_from_slice("a.3mf", bytes, &options).map(drop).expect_err("too much").to_string();
    let bomb = file("", &" ".repeat(4 << 20), "");
    assert!(bomb.len() < 10_000, "{} bytes", bomb.len());
    assert!(refused(&bomb).contains("unpacks to more than 1048576 bytes"), "an archive");
    let entity = packed(&[
        ("_rels/.rels", RELATIONSHIPS),
        ("other/shapes.xml", "<!DOCTYPE m [<!ENTITY a \"ha\">]><model unit=\"&a;\"/>"),
    ]);
    assert!(refused(&entity).contains("document type"), "entities");
    let doubled = |id: u32| {
        let below = id - 1;
        let component = format!("<component objectid=\"{below}\"/>");
        format!("<object id=\"{id}\"><components>{component}{component}</components></object>")
    };
    let tree: String = (2..40).map(doubled).collect();
    let tree = file("", &format!("{}{tree}", object("id=\"1\"")), "<item objectid=\"39\"/>");
    assert!(refused(&tree).contains("more than 1000 nodes"), "components");
    let circle = "<object id=\"1\"><components><component objectid=\"1\"/></components></object>";
    assert!(refused(&file("", circle, "<item objectid=\"1\"/>")).contains("contains itself"), "a circle");
}

/// Two materials, colours at corners, an instance, a turned and a mirrored one, and a name that XML has to escape.
fn parts() -> Scene {
    let mut scene = Scene::new();
    let red = scene.add_material(Material::from_color(Vec3::X).with_name("red"));
    let blue = scene.add_material(
        Material {
            base_color: srgba8_to_linear([0, 0, 255, 51]),
            alpha_mode: AlphaMode::Blend,
            ..Material::default()
        }
        .with_name("<blue>"),
    );
    let mut cube = primitives::cube(0.1);
    let slots = Attributes { face_materials: Some(vec![0, 1, 0, 1, 1, 1]), ..cube.attributes().clone() };
    cube.set_attributes(slots).expect("one for each face");
    let cube = scene.add_mesh("cube", cube);
    let turn =
        Transform::from_scale_rotation_translation(DVec3::splat(0.7), DQuat::from_rotation_x(0.3), DVec3::X);
    let mirror =
        Transform::from_scale_rotation_translation(DVec3::new(-1.0, 1.0, 1.0), DQuat::IDENTITY, -DVec3::X);
    for transform in [Transform::IDENTITY, turn, mirror] {
        let mut node = Node::from_mesh(cube, red).with_name("a \"cube\" & <more>").with_transform(transform);
        node.materials.push(blue);
        scene.add(node);
    }
    let mut ball = primitives::icosphere(0.05, 1);
    let colors =
        (0..ball.corner_count()).map(|corner| srgba8_to_linear([corner as u8, 100, 255, 255])).collect();
    let colors = Attributes { corner_colors: Some(colors), ..ball.attributes().clone() };
    ball.set_attributes(colors).expect("one for each corner");
    scene.add_object("ball", ball, Material { base_color: Vec4::ONE, ..Material::default() });
    scene
}

fn written(scene: &Scene) -> Vec<u8> {
    let export = export(scene, "a.3mf", Format::ThreeMf, &ExportOptions::default());
    export.expect("it is small").files.pop().expect("the model").bytes
}

/// The corners of all triangles in a world with +Y up, with the colour that each shows as sRGB bytes.
fn shown(scene: &Scene) -> Vec<(Vec3, [u8; 4])> {
    let (mut scene, mut shown) = (scene.clone(), Vec::new());
    scene.turn_to(trigon_io::UpAxis::Y);
    for (id, node) in scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let (mesh, map) = (asset.mesh(), scene.world_transform(id));
        let (cut, attributes) = (mesh.triangulation(), mesh.attributes());
        for (triangle, &face) in cut.triangles.iter().zip(&cut.triangle_faces) {
            let slot = attributes.face_materials.as_ref().map_or(0, |slots| slots[face as usize]);
            let material = scene.materials.get(node.materials[slot as usize]).expect("it is there");
            // A mirrored triangle is written the other way round, from the same corner.
            let mut corners = triangle.map(|corner| corner as usize);
            if map.matrix3.determinant() < 0.0 {
                corners[1..].reverse();
            }
            for corner in corners {
                let position = mesh.positions()[mesh.corner_vertices()[corner] as usize].as_dvec3();
                let color = attributes.corner_colors.as_ref().map_or(Vec4::ONE, |colors| colors[corner]);
                let bytes = trigon_math::color::linear_to_srgba8(color * material.base_color);
                shown.push((map.transform_point3(position).as_vec3(), bytes));
            }
        }
    }
    shown
}

#[test]
fn what_is_written_is_read_again() {
    let scene = parts();
    let bytes = written(&scene);
    assert!(bytes == written(&scene), "the same bytes every time");
    let again = loaded("a.3mf", &bytes);
    assert_eq!(warnings(&again), [""; 0], "closed bodies, and nothing unknown");
    assert_eq!(again.scene.meshes().len(), 3, "the cube once, its mirror image, and the ball");
    let names: Vec<&str> = again.scene.nodes().iter().map(|(_, node)| node.name.as_str()).collect();
    assert_eq!(names.iter().filter(|&&name| name == "a \"cube\" & <more>").count(), 3, "{names:?}");
    let materials: Vec<&str> =
        again.scene.materials.iter().map(|(_, material)| material.name.as_str()).collect();
    assert_eq!(materials, ["red", "<blue>", "default"], "by name");
    let (before, after) = (shown(&scene), shown(&again.scene));
    assert_eq!(before.len(), after.len(), "triangles");
    for (before, after) in before.iter().zip(&after) {
        assert!(before.0.abs_diff_eq(after.0, 1e-7) && before.1 == after.1, "{before:?} and {after:?}");
    }
}

#[test]
fn losses_name_what_slicers_miss() {
    let mut scene = Scene::new();
    let mut grid = Node::from_mesh(
        scene.add_mesh("grid", primitives::grid(1.0, 1.0, 2, 2)),
        scene.add_material(Material::default()),
    );
    grid.name = "first".to_owned();
    scene.add(grid.clone().at(DVec3::X));
    scene.add(grid.with_name("second"));
    let export = export(&scene, "a.3mf", Format::ThreeMf, &ExportOptions::default()).expect("it is small");
    let losses: Vec<String> = export.what_would_be_lost().iter().map(ToString::to_string).collect();
    let has = |what: &str| losses.iter().any(|loss| loss.contains(what));
    assert!(has("node \"first\": a closed body: 8 edges"), "{losses:?}");
    assert!(has("node \"first\": 1 name of its copies"), "{losses:?}");
    assert!(has("polygons: they are cut"), "{losses:?}");
}

/// Corners of a cube that are not shared, as faces with sharp edges have them in many files.
#[test]
fn vertices_at_one_position_become_one_where_that_closes_the_surface() {
    let cube = primitives::cube(1.0);
    let mut builder = MeshBuilder::new();
    for face in 0..cube.face_count() {
        let corners: Vec<u32> = cube
            .face_vertices(face)
            .iter()
            .map(|&vertex| builder.push_vertex(cube.positions()[vertex as usize]))
            .collect();
        builder.push_face(&corners).expect("a square");
    }
    let mut scene = Scene::new();
    scene.add_object("cube", builder.build(), Material::default());
    let again = loaded("a.3mf", &written(&scene));
    assert_eq!((meshes(&again)[0].vertex_count(), warnings(&again)), (8, vec![]), "closed");
}

fn any_triangles() -> impl Strategy<Value = Mesh> {
    let coordinate =
        prop_oneof![-1000.0f32..1000.0, any::<f32>().prop_filter("finite", |value| value.abs() < 1e30)];
    let position = prop::array::uniform3(coordinate).prop_map(Vec3::from);
    prop::collection::vec(prop::array::uniform3(position), 1..6).prop_map(|triangles| {
        let mut builder = MeshBuilder::new();
        for triangle in triangles {
            let face = triangle.map(|position| builder.push_vertex(position));
            builder.push_face(&face).expect("3 vertices");
        }
        builder.build()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Millimetres in the file, metres of f32 on both sides of it.
    #[test]
    fn positions_come_back_with_the_same_bits(mesh in any_triangles()) {
        let mut scene = Scene::new();
        scene.up = trigon_io::UpAxis::Z;
        scene.add_object("a", mesh.clone(), Material::default());
        let again = loaded("a.3mf", &written(&scene));
        let offset = again.scene.nodes().iter().next().expect("a node").1.transform.translation();
        prop_assume!(offset == DVec3::ZERO);
        let corners = |mesh: &Mesh| {
            let position = |&vertex: &u32| mesh.positions()[vertex as usize].to_array().map(|at| (at + 0.0).to_bits());
            mesh.corner_vertices().iter().map(position).collect::<Vec<_>>()
        };
        prop_assert_eq!(corners(meshes(&again)[0]), corners(&mesh));
    }

    /// Whatever the bytes, there is a scene or an error of one line.
    #[test]
    fn no_byte_makes_the_loader_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        in_text: bool,
    ) {
        let model = format!(
            "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><basematerials id=\"2\">\
             <base name=\"a\" displaycolor=\"#FF0000\"/></basematerials>{}</resources><build><item objectid=\"1\" \
             transform=\"1 0 0 0 1 0 0 0 1 1 2 3\"/></build></model>", object("id=\"1\" pid=\"2\" pindex=\"0\"")
        );
        let change = |bytes: &mut Vec<u8>| {
            for (at, value) in &changes {
                let at = at.index(bytes.len());
                bytes[at] = *value;
            }
        };
        let mut text = model.into_bytes();
        if in_text {
            change(&mut text);
        }
        let text = String::from_utf8_lossy(&text).into_owned();
        let mut bytes = packed(&[("_rels/.rels", RELATIONSHIPS), ("other/shapes.xml", &text)]);
        if !in_text {
            change(&mut bytes);
        }
        if let Err(error) = load_from_slice("a.3mf", &bytes, &LoadOptions::default()) {
            prop_assert!(!error.to_string().contains('\n'), "one line: {}", error);
        }
    }
}
