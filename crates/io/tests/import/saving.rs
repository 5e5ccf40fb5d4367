//! Scenes out and in again: GLB for other programs, and trigon's own file, which gives back
//! every bit.

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_io::{
    ExportOptions, LoadOptions, Loaded, NativeDocument, UpAxis, Warning, encode_glb, load_from_slice,
};
use trigon_math::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::edit::{EdgeId, EditMesh, FaceId, VertexId};
use trigon_mesh::{Attributes, Deltas, Mesh, MorphTarget, RenderMesh, SkinWeights, primitives};
use trigon_scene::{
    Animation, Channel, Curve, Interpolation, Light, LightKind, Material, MeshId, Node, NodeId, Property,
    RenderSettings, Scene, Shading, Skin, Texture, TextureFormat, Transform, render, showcase,
};

use crate::gltf::{Doc, push};
use crate::movement::{animated, skinned};
use crate::{loaded, warnings};

fn glb(scene: &Scene) -> Vec<u8> {
    encode_glb(scene, &ExportOptions::default()).expect("it is small")
}

/// The JSON of a GLB.
pub(crate) fn json_of(glb: &[u8]) -> Value {
    let glb = ::gltf::Glb::from_slice(glb).expect("a GLB");
    serde_json::from_slice(&glb.json).expect("JSON")
}

fn document(name: &str, bytes: &[u8]) -> (NativeDocument, Vec<Warning>) {
    NativeDocument::load_from_slice(name, bytes, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// The bytes of a document that loses nothing.
fn saved(document: &NativeDocument) -> Vec<u8> {
    let file = document.encode().expect("it is small");
    assert_eq!(file.what_would_be_lost(), [], "nothing is lost");
    file.to_bytes()
}

/// The only mesh of a document, as it is edited.
fn edited(document: &NativeDocument) -> &EditMesh {
    document.edited.values().next().expect("a mesh is being edited")
}

fn only_mesh(scene: &Scene) -> (MeshId, &Mesh) {
    let (id, asset) = scene.meshes().iter().next().expect("a mesh");
    (id, asset.mesh())
}

fn node_named(scene: &Scene, name: &str) -> NodeId {
    scene.nodes().iter().find(|(_, node)| node.name == name).expect("a node of that name").0
}

/// A mesh with a value of every kind.
fn with_everything(mut mesh: Mesh) -> Mesh {
    let (corners, vertices) = (mesh.corner_count(), mesh.vertex_count());
    let at = |corner: usize| mesh.positions()[mesh.corner_vertices()[corner] as usize];
    let number = |index: usize| index as f32 * 0.001;
    let uv =
        |scale: f32| (0..corners).map(|corner| Vec2::new(at(corner).x * scale, number(corner))).collect();
    let weights: Vec<f32> = (0..vertices).flat_map(|v| [v as f32 + 1.0, 2.0, 0.5]).collect();
    let target = |name: &str| MorphTarget {
        name: name.to_owned(),
        positions: Deltas::new(vec![(0, Vec3::X), (vertices as u32 - 1, Vec3::new(0.1, -0.2, 1e-20))]),
        normals: Deltas::new(vec![(1, Vec3::Y)]),
        tangents: Deltas::default(),
    };
    let attributes = Attributes {
        corner_normals: Some((0..corners).map(|corner| at(corner).normalize_or_zero()).collect()),
        corner_tangents: Some(vec![Vec4::new(1.0, 0.0, 0.0, -1.0); corners]),
        uv_sets: vec![uv(0.3), uv(-1.7)],
        corner_colors: Some((0..corners).map(|corner| Vec4::new(number(corner), 0.5, 1.0, 0.25)).collect()),
        face_materials: Some((0..mesh.face_count() as u32).map(|face| face % 3).collect()),
        face_smooth: Some((0..mesh.face_count()).map(|face| face % 2 == 0).collect()),
        skin: SkinWeights::new(3, (0..vertices * 3).map(|index| (index % 5) as u16).collect(), weights),
        morph_targets: vec![target("smile"), target("frown")],
    };
    mesh.set_attributes(attributes).expect("one value for each");
    mesh
}

/// A mesh that was edited: with holes in its numbering, marks, and vertices that were moved.
fn changed(mesh: &Mesh) -> EditMesh {
    let (mut mesh, _) = EditMesh::from_mesh(mesh);
    mesh.remove_face(FaceId::new(1)).expect("it is there");
    let split = mesh.split_edge(EdgeId::new(0), 0.25).expect("it is there");
    mesh.set_position(split.vertex, Vec3::new(0.1, 1e-30, -7.0));
    mesh.set_sharp(EdgeId::new(2), true);
    mesh.set_seam(EdgeId::new(3), true);
    mesh.set_crease(EdgeId::new(3), 0.7);
    mesh.set_edge_hidden(EdgeId::new(4), true);
    mesh.set_vertex_hidden(VertexId::new(5), true);
    mesh.set_face_hidden(FaceId::new(2), true);
    mesh
}

/// A document with one mesh that is being edited, drawn in as many materials as it has slots.
fn edited_document(mesh: Mesh) -> NativeDocument {
    let mut scene = Scene::new();
    let editable = changed(&mesh);
    let id = scene.add_mesh("shape", mesh);
    let colors = [Vec3::X, Vec3::Y, Vec3::Z];
    let materials = colors.map(|color| scene.add_material(Material::from_color(color))).to_vec();
    let mut node = Node::default().with_name("shape");
    (node.mesh, node.materials) = (Some(id), materials);
    scene.add(node);
    let mut document = NativeDocument::new(scene);
    document.edited.insert(id, editable);
    document
}

fn assert_same_edits(first: &EditMesh, second: &EditMesh) {
    let ((mesh, map), (again, map_again)) = (first.to_mesh(), second.to_mesh());
    assert!(unnamed(again) == unnamed(mesh), "the same mesh, to the bit");
    assert_eq!(second.marks(&map_again), first.marks(&map), "marks and first positions");
    second.check_structure().expect("it keeps every rule");
}

/// Editing meshes do not hold the names of morph targets.
fn unnamed(mut mesh: Mesh) -> Mesh {
    let mut attributes = mesh.attributes().clone();
    attributes.morph_targets.iter_mut().for_each(|target| target.name.clear());
    mesh.set_attributes(attributes).expect("only names are others");
    mesh
}

#[test]
fn a_picture_of_the_exported_showcase_is_that_of_the_scene() {
    let scene = showcase();
    let again = loaded("showcase.glb", &glb(&scene));
    assert_eq!(warnings(&again), [""; 0], "nothing to warn of");
    let settings = RenderSettings::new(100, 60);
    let (_, camera) = scene.cameras()[0];
    let (before, after) = (render(&scene, &camera, &settings), render(&again.scene, &camera, &settings));
    let (before, after) = (before.expect("a picture"), after.expect("a picture"));
    let differ = before.color.iter().zip(&after.color).filter(|(a, b)| a.abs_diff(**b) > 1).count();
    // Flat normals were computed from polygons, and are now those of the file.
    assert!(differ * 1000 < before.color.len(), "{differ} of {} values", before.color.len());
}

#[test]
fn an_edited_mesh_comes_back_to_the_bit() {
    for mesh in [primitives::cube(2.0), primitives::torus(2.0, 0.5, 7, 6), primitives::icosphere(1.0, 1)] {
        let first = edited_document(with_everything(mesh));
        let (second, warned) = document("a.glb", &saved(&first));
        assert_eq!(warned, [], "nothing to warn of");
        assert_same_edits(edited(&first), edited(&second));
        let (_, mesh) = only_mesh(&second.scene);
        let names: Vec<&str> =
            mesh.attributes().morph_targets.iter().map(|target| target.name.as_str()).collect();
        assert_eq!(names, ["smile", "frown"], "names of morph targets");
        let node = second.scene.node(node_named(&second.scene, "shape")).expect("just found");
        let color = |id| second.scene.materials.get(id).expect("it is there").base_color.truncate();
        let colors: Vec<Vec3> = node.materials.iter().map(|&id| color(id)).collect();
        assert_eq!(colors, [Vec3::X, Vec3::Y, Vec3::Z], "also of slots without faces");
        assert_eq!(saved(&second), saved(&first), "and the second file is the first");
    }
}

#[test]
fn a_mesh_that_is_not_edited_keeps_its_polygons() {
    let mut scene = Scene::new();
    let mesh = with_everything(primitives::cylinder(1.0, 2.0, 7));
    scene.add_object("can", mesh.clone(), Material::default());
    let (document, _) = document("a.glb", &saved(&NativeDocument::new(scene)));
    assert!(*only_mesh(&document.scene).1 == mesh, "to the bit");
    assert!(document.edited.is_empty(), "nothing is being edited");
}

#[test]
fn a_viewer_shows_the_polygons_of_a_native_file() {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(2.0), Material::default());
    let bytes = saved(&NativeDocument::new(scene.clone()));
    let again = loaded("a.glb", &bytes);
    assert_eq!(only_mesh(&again.scene).1.edge_count(), 12, "without diagonals");
    let others = loaded("a.glb", &glb(&scene));
    assert_eq!(only_mesh(&others.scene).1.edge_count(), 18, "other programs see triangles");
}

#[test]
fn transforms_lights_and_shading_come_back_to_the_bit() {
    let mut scene = Scene::new();
    let turn = DQuat::from_xyzw(0.1, 0.2, 0.3, 0.4).normalize();
    let far = DVec3::new(12_345_678.901_234_567, -1e-300, 0.1);
    let placed = Transform::from_scale_rotation_translation(DVec3::new(-1.0, 0.3, 1e10), turn, far);
    let sheared = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::ONE * 0.1, DVec3::Z * 3.0));
    let blinn_phong = Shading::blinn_phong(Vec3::new(0.1, 0.7, 1.5), 33.3);
    let lambert = Material { shading: Shading::Lambert, ..Material::default() };
    let glowing = Material { emissive: Vec3::new(0.1, 7.7, 3.0), ..lambert.clone() };
    let plastic = Material { shading: blinn_phong, ior: 1.33, transmission: 0.1, ..Material::default() };
    for (index, material) in [lambert, glowing, plastic].into_iter().enumerate() {
        let id = scene.add_object(format!("{index}"), primitives::cube(1.0), material.with_name("m"));
        let node = scene.node_mut(id).expect("just added");
        node.transform = if index == 0 { placed } else { Transform::Affine(sheared) };
        node.visible = index != 2;
    }
    let spot = Light { kind: LightKind::Spot { inner: 0.1, outer: 0.7 }, ..Light::spot(0.1) };
    for light in [spot.with_range(3.3), Light::point(7.77), Light::directional(1.0), Light::ambient(0.3)] {
        scene.add(Node::from_light(light.with_color(Vec3::new(0.1, 1.0, 0.9))));
    }
    let (second, warned) = document("a.glb", &saved(&NativeDocument::new(scene.clone())));
    assert_eq!(warned, [], "nothing to warn of");
    for ((_, was), (_, now)) in scene.nodes().iter().zip(second.scene.nodes().iter()) {
        assert_eq!(
            (now.transform, now.light, now.visible),
            (was.transform, was.light, was.visible),
            "{}",
            was.name
        );
    }
    let materials =
        |scene: &Scene| scene.materials.iter().map(|(_, material)| material.clone()).collect::<Vec<_>>();
    assert_eq!(materials(&second.scene), materials(&scene), "materials");
}

#[test]
fn skins_and_animations_move_as_before() {
    let mut scene = Scene::new();
    let root = scene.add(Node::default().with_name("root").at(DVec3::new(1.0, 2.0, 3.0)));
    let joint = scene.add_child(root, Node::default().with_name("joint").at(DVec3::Y)).expect("a root");
    let bind = DAffine3::from_translation(DVec3::new(0.5, -1.0, 0.25));
    let joints = vec![root, joint, root, joint, root];
    let skin = Skin { name: "skin".into(), joints, inverse_bind_matrices: vec![bind; 4] };
    let skin = scene.skins.insert(skin);
    let mesh = scene.add_mesh("body", with_everything(primitives::cube(2.0)));
    let mut body = Node::default().with_name("body");
    (body.mesh, body.skin, body.morph_weights) = (Some(mesh), Some(skin), vec![0.25, 0.5]);
    let body = scene.add(body);
    let turns = Curve::new(Interpolation::Linear, 4, vec![0.0, 1.5], vec![0., 0., 0., 1., 0., 1., 0., 0.]);
    let smiles = Curve::new(Interpolation::Step, 2, vec![0.5], vec![0.75, 0.1]);
    let moves = Curve::new(Interpolation::CubicSpline, 3, vec![0.0], vec![0.1; 9]);
    let channel =
        |node, property, curve: Option<Curve>| Channel { node, property, curve: curve.expect("a curve") };
    let channels = vec![
        channel(root, Property::Translation, moves),
        channel(joint, Property::Rotation, turns),
        channel(body, Property::MorphWeights, smiles),
    ];
    scene.animations.push(Animation { name: "wave".into(), channels });
    for bytes in [glb(&scene), saved(&NativeDocument::new(scene.clone()))] {
        let again = loaded("a.glb", &bytes);
        assert_eq!(warnings(&again), [""; 0], "nothing to warn of");
        assert_eq!(again.scene.animations, scene.animations, "animations");
        let pose = |scene: &Scene| scene.skin_pose(node_named(scene, "body")).expect("a skin");
        assert_eq!(pose(&again.scene), pose(&scene), "the pose");
        let weights =
            |scene: &Scene| scene.node(node_named(scene, "body")).expect("a node").morph_weights.clone();
        assert_eq!(weights(&again.scene), weights(&scene), "weights of morph targets");
    }
}

/// A texture as a file brings it, and one that was made.
#[test]
fn pictures_keep_their_bytes() {
    let source = crate::texture::textured_square();
    let options = LoadOptions { keep_source: true, ..LoadOptions::default() };
    let mut first = load_from_slice("a.glb", &source.glb(), &options).expect("it loads");
    let texels = vec![[10, 20, 30, 255], [40, 50, 60, 70]];
    let texture = Texture::new(2, 1, texels.clone(), TextureFormat::Srgb).expect("two texels");
    let made = first.scene.add_texture("made", texture);
    first.scene.add_object("made", primitives::cube(1.0), Material::from_texture(made));
    let pictures = first.source.as_ref();
    let bytes =
        encode_glb(&first.scene, &ExportOptions { pictures, ..ExportOptions::default() }).expect("small");
    let again = load_from_slice("b.glb", &bytes, &options).expect("it loads");
    let kept = again.source.expect("it was asked for");
    assert_eq!(kept.image(0), pictures.and_then(|source| source.image(0)), "as it was encoded");
    let of = |scene: &Scene| -> Vec<Vec<[u8; 4]>> {
        scene.textures.iter().map(|(_, asset)| asset.texture.texels().collect()).collect()
    };
    assert_eq!(of(&again.scene), of(&first.scene), "every texel");
}

#[test]
fn a_selection_stands_where_it_stood_and_brings_its_joints() {
    let mut scene = Scene::new();
    let above = scene.add_object("above", primitives::cube(1.0), Material::default());
    scene.node_mut(above).expect("just added").transform.set_translation(DVec3::X * 5.0);
    let mesh = scene.add_mesh("m", primitives::cube(1.0));
    let mut child = Node::default().with_name("child").at(DVec3::Y);
    child.mesh = Some(mesh);
    let child = scene.add_child(above, child).expect("a root");
    scene.add_object("other", primitives::cube(1.0), Material::default());
    let options =
        ExportOptions { nodes: Some(vec![child]), scale: 100.0, up: UpAxis::Z, ..ExportOptions::default() };
    let again = loaded("a.glb", &encode_glb(&scene, &options).expect("small"));
    let shown: Vec<&str> = again
        .scene
        .nodes()
        .iter()
        .filter(|(_, node)| node.mesh.is_some())
        .map(|(_, node)| node.name.as_str())
        .collect();
    assert_eq!(shown, ["child"], "nothing else");
    let place = again.scene.world_transform(node_named(&again.scene, "child")).translation;
    assert_eq!(place, DVec3::new(500.0, 0.0, 100.0), "in centimetres, z up");
}

/// What another program does to the triangles counts; what it does elsewhere harms nothing.
#[test]
fn if_another_program_moved_a_vertex_the_triangles_win() {
    let first = edited_document(primitives::cube(2.0));
    let bytes = saved(&first);
    let mut doc = doc_of(&bytes);
    let position =
        doc.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().expect("an index");
    let view = doc.json["accessors"][position as usize]["bufferView"].as_u64().expect("an index") as usize;
    let offset = doc.json["bufferViews"][view]["byteOffset"].as_u64().expect("an offset") as usize;
    doc.bytes[offset + 3] ^= 0x80;
    let (second, warned) = document("a.glb", &doc.glb());
    assert_eq!(warned.len(), 1, "{warned:?}");
    assert_eq!(
        warned[0].to_string(),
        "a.glb, mesh 0: another program changed its triangles; they are read without polygons, marks and \
         first positions; open the file that trigon saved if you need these"
    );
    assert!(second.edited.is_empty(), "what is edited is gone");
    let (_, mesh) = only_mesh(&second.scene);
    assert!(mesh.faces().all(|corners| corners.len() == 3), "triangles");

    let mut doc = doc_of(&bytes);
    doc.json["nodes"][0]["translation"] = json!([1, 2, 3]);
    doc.json["materials"][0]["name"] = json!("renamed");
    let (second, warned) = document("a.glb", &doc.glb());
    assert_eq!(warned, [], "nothing to warn of");
    assert_same_edits(edited(&first), edited(&second));
}

/// The document and the bytes of a GLB, to be changed.
fn doc_of(bytes: &[u8]) -> Doc {
    let glb = ::gltf::Glb::from_slice(bytes).expect("a GLB");
    let bytes = glb.bin.expect("it has bytes").into_owned();
    Doc { json: serde_json::from_slice(&glb.json).expect("JSON"), bytes }
}

#[test]
fn a_program_that_numbers_views_anew_is_found_out() {
    let mut doc = doc_of(&saved(&edited_document(primitives::cube(2.0))));
    let columns = &mut doc.json["meshes"][0]["extras"]["trigon"]["columns"];
    let (a, b) = (columns["faceSizes"].clone(), columns["cornerVertices"].clone());
    (columns["faceSizes"], columns["cornerVertices"]) = (b, a);
    let (second, warned) = document("a.glb", &doc.glb());
    assert_eq!(warned.len(), 1, "{warned:?}");
    assert!(second.edited.is_empty(), "the triangles are read");
    doc.json["meshes"][0]["extras"]["trigon"]["version"] = json!(99);
    let (_, warned) = document("a.glb", &doc.glb());
    assert!(warned[0].what.contains("newer version"), "{warned:?}");
}

/// A file in which everything that may has `extras` and an unknown extension.
fn odd_file() -> Vec<u8> {
    let mut doc = animated();
    doc.json["scenes"] = json!([{"nodes": [0], "extras": {"unused": 1}}, {"nodes": [0]}]);
    doc.json["scene"] = json!(1);
    let view = doc.view(b"known to nobody");
    doc.json["extensions"] = json!({"VENDOR_data": {"bufferView": view}});
    doc.json["extensionsUsed"] = json!(["VENDOR_data"]);
    let holders: Vec<String> = ["nodes", "meshes", "animations", "accessors", "bufferViews", "scenes"]
        .iter()
        .flat_map(|list| {
            let count = doc.json[list].as_array().map_or(0, Vec::len);
            (0..count).map(move |index| format!("/{list}/{index}"))
        })
        .collect();
    for holder in holders {
        let object = doc.json.pointer_mut(&holder).expect("it is there");
        object["extras"]["odd"] = json!({"z": [1, "é"], "a": holder});
        object["extensions"]["VENDOR_data"] = json!({"inside": holder});
    }
    doc.glb()
}

/// Every part of a value that another one has, with its path.
fn assert_contains(now: &Value, was: &Value, path: &str) {
    match (now, was) {
        (Value::Object(now), Value::Object(was)) => {
            for (name, value) in was {
                let found = now.get(name).unwrap_or_else(|| panic!("{path}/{name} is gone"));
                assert_contains(found, value, &format!("{path}/{name}"));
            }
        }
        (Value::Array(now), Value::Array(was)) => {
            assert!(now.len() >= was.len(), "{path} is shorter");
            for (index, value) in was.iter().enumerate() {
                assert_contains(&now[index], value, &format!("{path}/{index}"));
            }
        }
        _ => assert_eq!(now, was, "{path}"),
    }
}

#[test]
fn what_nobody_touched_is_written_back_as_it_was() {
    let bytes = odd_file();
    let (first, _) = document("a.glb", &bytes);
    let again = saved(&first);
    let (was, now) = (doc_of(&bytes), doc_of(&again));
    let mut expected = was.json.clone();
    expected["buffers"][0]["byteLength"] = now.json["buffers"][0]["byteLength"].clone();
    assert_eq!(now.json, expected, "the whole document");
    assert_eq!(now.bytes[..was.bytes.len()], was.bytes, "every byte");
    assert_eq!(saved(&document("a.glb", &again).0), again, "and again");
}

#[test]
fn a_node_that_is_moved_and_a_new_one_leave_all_else_alone() {
    let bytes = odd_file();
    let (mut first, _) = document("a.glb", &bytes);
    let (id, _) = first.scene.nodes().iter().next().expect("a node");
    first.scene.node_mut(id).expect("just found").transform.translate(DVec3::new(0.1, 0.0, 0.0));
    first.scene.add_object("new", primitives::cube(1.0), Material::default());
    let (was, mut now) = (json_of(&bytes), json_of(&saved(&first)));
    assert_eq!(now["nodes"].as_array().map(Vec::len), was["nodes"].as_array().map(|list| list.len() + 1));
    assert_eq!(now["scenes"][1]["nodes"].as_array().map(Vec::len), Some(2), "in the scene that was loaded");
    assert_eq!(now["scenes"][0], was["scenes"][0], "not in the other");
    now["nodes"][0] = was["nodes"][0].clone();
    now["buffers"] = was["buffers"].clone();
    assert_contains(&now, &was, "");
}

#[test]
fn a_changed_mesh_names_what_it_cannot_hold() {
    let mut doc = skinned();
    let custom = doc.floats("SCALAR", &[1., 2., 3., 4.]);
    doc.primitive()["attributes"]["_HEAT"] = json!(custom);
    doc.primitive()["extensions"] = json!({"VENDOR_fur": {"length": 3}});
    let (mut first, _) = document("a.glb", &doc.glb());
    assert_eq!(first.encode().expect("small").what_would_be_lost(), [], "as long as it stays");
    let (id, mesh) = only_mesh(&first.scene);
    let (mut editable, _) = EditMesh::from_mesh(mesh);
    first.edited.insert(id, editable.clone());
    assert_eq!(first.encode().expect("small").what_would_be_lost(), [], "and is only looked at");
    editable.set_position(VertexId::new(0), Vec3::ONE);
    first.edited.insert(id, editable.clone());
    let file = first.encode().expect("small");
    let lost: Vec<String> = file.what_would_be_lost().iter().map(ToString::to_string).collect();
    assert_eq!(
        lost,
        ["mesh 0, primitive 0: its attribute _HEAT", "mesh 0, primitive 0: its extension VENDOR_fur"],
        "and nothing else"
    );
    let (second, warned) = document("a.glb", &file.to_bytes());
    assert_eq!(warned, [], "nothing to warn of");
    assert_same_edits(&editable, edited(&second));
    assert!(second.scene.skins.len() == 1, "the skin is still there");
}

#[test]
fn removed_nodes_and_animations_are_gone_and_the_rest_moves_as_before() {
    let (mut first, _) = document("a.glb", &animated().glb());
    first.scene.add_object("new", primitives::cube(1.0), Material::default());
    let count = first.scene.nodes().len();
    let victim = first.scene.nodes().iter().find(|(_, node)| node.parent().is_none()).expect("a root").0;
    let removed = first.scene.remove(victim);
    first.scene.animations.clear();
    let (second, _) = document("a.glb", &first.encode().expect("small").to_bytes());
    assert_eq!(second.scene.nodes().len(), count - removed, "as many as are left");
    assert_eq!(second.scene.animations, [], "none");
}

#[test]
fn a_changed_animation_keeps_its_place_and_names_what_it_cannot_hold() {
    let mut doc = animated();
    doc.json["animations"][0]["extras"] = json!("kept");
    let pointer = json!({"sampler": 0, "target": {"path": "pointer"}});
    push(&mut doc.json["animations"][0]["channels"], pointer);
    let (mut first, _) = document("a.glb", &doc.glb());
    assert_eq!(first.encode().expect("small").what_would_be_lost(), [], "as long as it stays");
    let again = first.scene.animations[0].clone();
    first.scene.animations.push(again);
    first.scene.animations[0].name = "renamed".to_owned();
    let file = first.encode().expect("small");
    let lost: Vec<String> = file.what_would_be_lost().iter().map(ToString::to_string).collect();
    let saved = file.to_bytes();
    let (second, _) = document("a.glb", &saved);
    let names = |document: &NativeDocument| -> Vec<String> {
        document.scene.animations.iter().map(|animation| animation.name.clone()).collect()
    };
    let sorted = |mut names: Vec<String>| {
        names.sort();
        names
    };
    assert_eq!(sorted(names(&second)), sorted(names(&first)), "both are there");
    let json = json_of(&saved);
    assert_eq!(json["animations"][0]["extras"], json!("kept"), "in its place");
    // The copy takes the place of the one that it equals, and the other is new.
    assert_eq!(lost, [""; 0], "the channel is still in the copy");
    first.scene.animations.pop();
    let file = first.encode().expect("small");
    let lost = file.what_would_be_lost();
    let what = "animation 0: its channels that move something other than nodes";
    assert_eq!(lost.iter().map(ToString::to_string).collect::<Vec<_>>(), [what], "now it is gone");
}

/// A file must not grow by a mesh each time that it is opened, edited and saved.
#[test]
fn a_mesh_that_is_written_anew_leaves_nothing_behind() {
    let mut doc = doc_of(&saved(&edited_document(primitives::torus(2.0, 0.5, 30, 20))));
    let view = doc.view(b"known to nobody");
    doc.json["extensions"] = json!({"VENDOR_data": {"bufferView": view}});
    let mut bytes = saved(&document("a.glb", &doc.glb()).0);
    let mut lengths = Vec::new();
    for step in 0..4 {
        let (mut next, _) = document("a.glb", &bytes);
        let mesh = next.edited.values_mut().next().expect("a mesh is being edited");
        mesh.set_position(VertexId::new(0), Vec3::splat(step as f32));
        bytes = saved(&next);
        assert_same_edits(edited(&next), edited(&document("b.glb", &bytes).0));
        let again = doc_of(&bytes);
        let view = &again.json["bufferViews"][view];
        let start = view["byteOffset"].as_u64().expect("an offset") as usize;
        assert_eq!(&again.bytes[start..start + 15], b"known to nobody", "views of others keep their bytes");
        lengths.push(bytes.len());
    }
    let grown = lengths[3] - lengths[0];
    assert!(grown < 3 * 4000, "three savings left {grown} bytes of {}", lengths[0]);
}

/// Copies that an extension makes are part of the file until one is changed.
#[test]
fn instances_stay_an_extension_until_one_is_moved() {
    let mut doc = Doc::square();
    let places = doc.floats("VEC3", &[0., 0., 0., 5., 0., 0., 9., 0., 0.]);
    let attributes = json!({"attributes": {"TRANSLATION": places}});
    doc.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": attributes});
    doc.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    let (mut first, _) = document("a.glb", &doc.glb());
    assert_eq!(json_of(&saved(&first))["nodes"], doc.json["nodes"], "as it was");
    let copy = first.scene.nodes().iter().find(|(_, node)| node.mesh.is_some()).expect("a copy").0;
    first.scene.node_mut(copy).expect("just found").transform.translate(DVec3::Y);
    let (second, _) = document("a.glb", &saved(&first));
    let places = |scene: &Scene| -> Vec<DVec3> {
        let shown = scene.nodes().iter().filter(|(_, node)| node.mesh.is_some());
        shown.map(|(id, _)| scene.world_transform(id).translation).collect()
    };
    assert_eq!(places(&second.scene), places(&first.scene), "each where it was");
}

#[test]
fn one_mesh_in_several_materials_shares_its_numbers() {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("m", primitives::cube(1.0));
    for color in [Vec3::X, Vec3::Y, Vec3::X] {
        let material = scene.add_material(Material::from_color(color));
        scene.add(Node::from_mesh(mesh, material));
    }
    let json = json_of(&glb(&scene));
    assert_eq!(json["meshes"].as_array().map(Vec::len), Some(3), "one for each material");
    assert_eq!(json["accessors"].as_array().map(Vec::len), Some(4), "positions, normals, uv, indices");
}

#[test]
fn loose_edges_points_and_empty_meshes_are_written() {
    let mut scene = Scene::new();
    let mut wires = primitives::polyline(&[Vec3::ZERO, Vec3::X, Vec3::ONE]);
    let values =
        Attributes { corner_colors: Some(Vec::new()), uv_sets: vec![Vec::new()], ..Attributes::default() };
    wires.set_attributes(values).expect("there are no corners");
    scene.add_object("wires", wires.clone(), Material::default());
    scene.add_object("nothing", Mesh::default(), Material::default());
    let again = loaded("a.glb", &glb(&scene));
    assert_eq!(only_mesh(&again.scene).1.loose_edges(), wires.loose_edges(), "lines");
    let native = NativeDocument::new(scene);
    let file = native.encode().expect("small");
    assert_eq!(file.what_would_be_lost()[0].to_string(), "node \"nothing\": its mesh, which has no vertices");
    assert!(*only_mesh(&document("a.glb", &file.to_bytes()).0.scene).1 == wires, "to the bit");
}

#[test]
fn places_that_are_not_finite_stay_in_the_native_file_only() {
    let mut mesh = primitives::cube(2.0);
    mesh.positions_mut()[0] = Vec3::new(f32::NAN, f32::INFINITY, -0.0);
    let mut scene = Scene::new();
    scene.add_object("broken", mesh.clone(), Material::default());
    let bytes = saved(&NativeDocument::new(scene));
    let (second, _) = document("a.glb", &bytes);
    let bits =
        |mesh: &Mesh| mesh.positions().iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(only_mesh(&second.scene).1), bits(&mesh), "every bit");
    let json = json_of(&bytes);
    let position = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().expect("an index");
    assert_eq!(json["accessors"][position as usize]["max"], json!([1.0, 1.0, 1.0]), "numbers for others");
}

/// Triangles of a scene, in its world, sorted.
fn triangles(scene: &Scene) -> Vec<[[u32; 3]; 3]> {
    let mut all = Vec::new();
    for (id, node) in scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let (world, render) = (scene.world_transform(id), RenderMesh::from_mesh(asset.mesh()));
        let place = |vertex: u32| {
            let position = world.transform_point3(render.positions[vertex as usize].as_dvec3());
            position.as_vec3().to_array().map(|number| (number + 0.0).to_bits())
        };
        all.extend(render.triangles.iter().map(|triangle| {
            let mut corners = triangle.map(place);
            let first = (0..3).min_by_key(|&corner| corners[corner]).expect("three");
            corners.rotate_left(first);
            corners
        }));
    }
    all.sort_unstable();
    all
}

#[test]
fn every_triangle_of_the_showcase_is_in_the_file() {
    let scene = showcase();
    let again: Loaded = loaded("a.glb", &glb(&scene));
    assert_eq!(triangles(&again.scene), triangles(&scene), "the same triangles");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// A native file with some bytes changed: a typed error, or a mesh that keeps every rule.
    #[test]
    fn damaged_native_files_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let mut bytes = saved(&edited_document(with_everything(primitives::cube(2.0))));
        for (place, value) in changes {
            let index = place.index(bytes.len());
            bytes[index] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok((document, _)) = NativeDocument::load_from_slice("a.glb", &bytes, &LoadOptions::default()) {
            for mesh in document.edited.values() {
                prop_assert_eq!(mesh.check_structure(), Ok(()));
            }
            drop(document.encode().map(|file| file.to_bytes()));
        }
    }

    /// Numbers in the header and in the columns, with hashes that are right again.
    #[test]
    fn forged_native_files_never_panic(
        column in any::<prop::sample::Index>(),
        word in any::<prop::sample::Index>(),
        value in prop_oneof![any::<u32>(), 0u32..30],
        member in 0usize..6,
    ) {
        let mut doc = doc_of(&saved(&edited_document(with_everything(primitives::cube(2.0)))));
        let header = doc.json["meshes"][0]["extras"]["trigon"].clone();
        let columns = header["columns"].as_object().expect("columns");
        let names: Vec<&String> = columns.keys().collect();
        let name = names[column.index(names.len())].clone();
        let view = columns[&name].as_u64().expect("an index") as usize;
        let own = &mut doc.json["meshes"][0]["extras"]["trigon"];
        match member {
            0 => own["columns"][&name] = json!(value),
            1 => own["jointsPerVertex"] = json!(value),
            2 => own["targets"] = json!(value),
            3 => own["slots"][0] = json!(value),
            4 => drop(own["columns"].as_object_mut().map(|columns| columns.remove(&name))),
            _ => {
                let (offset, length) = {
                    let view = &doc.json["bufferViews"][view];
                    (view["byteOffset"].as_u64(), view["byteLength"].as_u64())
                };
                let (offset, length) = (offset.expect("an offset") as usize, length.expect("a length") as usize);
                let at = offset + word.index(length) / 4 * 4;
                doc.bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
            }
        }
        if let Ok((document, _)) = NativeDocument::load_from_slice("a.glb", &doc.glb(), &LoadOptions::default()) {
            for mesh in document.edited.values() {
                prop_assert_eq!(mesh.check_structure(), Ok(()));
            }
        }
    }
}

#[test]
fn a_file_with_buffers_and_pictures_beside_it_becomes_one() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut doc = crate::texture::textured_square();
    let picture = crate::texture::png();
    std::fs::write(dir.path().join("p.png"), &picture).expect("a file");
    std::fs::write(dir.path().join("a.bin"), &doc.bytes).expect("a file");
    doc.json["images"] = json!([{"uri": "p.png", "extras": 7}]);
    let unused = json!({"byteLength": 4, "uri": "data:,abcd"});
    doc.json["buffers"] = json!([unused, {"byteLength": doc.bytes.len(), "uri": "a.bin"}]);
    for view in doc.json["bufferViews"].as_array_mut().expect("views") {
        view["buffer"] = json!(1);
    }
    push(&mut doc.json["bufferViews"], json!({"buffer": 0, "byteLength": 4}));
    let path = dir.path().join("a.gltf");
    std::fs::write(&path, serde_json::to_vec(&doc.json).expect("JSON")).expect("a file");
    let (first, _) = NativeDocument::load(&path, &LoadOptions::default()).expect("it loads");
    let out = dir.path().join("b.glb");
    first.encode().expect("small").write(&out).expect("written");
    let bytes = std::fs::read(&out).expect("a file");
    let json = json_of(&bytes);
    assert_eq!(json["buffers"].as_array().map(Vec::len), Some(1), "one buffer");
    assert_eq!(json["images"][0]["extras"], json!(7), "extras stay");
    let (second, warned) = document("b.glb", &bytes);
    assert_eq!(warned, [], "nothing is missing");
    assert_eq!(triangles(&second.scene), triangles(&first.scene), "the same triangles");
    assert_eq!(second.scene.textures.len(), 1, "and the picture");
}
