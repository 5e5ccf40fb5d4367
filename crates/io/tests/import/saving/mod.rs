//! Scenes out and in again: GLB for other programs, and trigon's own file, which gives back
//! every bit.

mod kept;
mod written;

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_io::{
    ExportOptions, LoadErrorKind, LoadOptions, Loaded, NativeDocument, UpAxis, Warning, encode_glb,
    load_from_slice,
};
use trigon_math::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Deltas, EditData, Mesh, MorphTarget, RenderMesh, SkinWeights, primitives};
use trigon_modelling::{EdgeId, EditMesh, FaceId, StackedModifier, SubdivisionModifier, VertexId};
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

pub(crate) fn document(name: &str, bytes: &[u8]) -> (NativeDocument, Vec<Warning>) {
    NativeDocument::load_from_slice(name, bytes, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// The bytes of a document that loses nothing.
pub(crate) fn saved(document: &NativeDocument) -> Vec<u8> {
    let file = document.encode().expect("it is small");
    assert_eq!(file.what_would_be_lost(), [], "nothing is lost");
    file.to_bytes()
}

/// The only mesh of a document, as it is edited.
fn edited(document: &NativeDocument) -> EditMesh {
    let (&id, data) = document.edit_data.iter().next().expect("a mesh is being edited");
    let mesh = document.scene.meshes().get(id).expect("it is there").mesh();
    EditMesh::from_mesh_and_data(mesh, data).expect("they belong together").0
}

/// Puts an edited mesh into a document. Editing meshes do not hold the names of morph targets.
pub(crate) fn put(document: &mut NativeDocument, id: MeshId, edited: &EditMesh) {
    let named = document.scene.meshes().get(id).expect("it is there").mesh().attributes().clone();
    let (mut mesh, map) = edited.to_mesh();
    let mut attributes = mesh.attributes().clone();
    for (target, named) in attributes.morph_targets.iter_mut().zip(named.morph_targets) {
        target.name = named.name;
    }
    mesh.set_attributes(attributes).expect("only names are others");
    document.scene.replace_mesh(id, mesh).expect("it is there");
    document.edit_data.insert(id, edited.edit_data(&map));
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
        vertex_colors: Some((0..vertices).map(|vertex| Vec4::new(0.25, number(vertex), 1.0, 0.5)).collect()),
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
    put(&mut document, id, &editable);
    document
}

fn assert_same_edits(first: &EditMesh, second: &EditMesh) {
    let ((mesh, map), (again, map_again)) = (first.to_mesh(), second.to_mesh());
    assert!(unnamed(again) == unnamed(mesh), "the same mesh, to the bit");
    assert_eq!(second.edit_data(&map_again), first.edit_data(&map), "marks and original positions");
    second.check_structure().expect("it keeps every rule");
}

/// A mesh without the names of its morph targets.
fn unnamed(mut mesh: Mesh) -> Mesh {
    let mut attributes = mesh.attributes().clone();
    attributes.morph_targets.iter_mut().for_each(|target| target.name.clear());
    mesh.set_attributes(attributes).expect("only names are others");
    mesh
}

#[test]
fn an_image_of_the_exported_showcase_is_that_of_the_scene() {
    let scene = showcase();
    let again = loaded("showcase.glb", &glb(&scene));
    assert_eq!(warnings(&again), [""; 0], "nothing to warn of");
    let settings = RenderSettings::new(100, 60);
    let (_, camera) = scene.cameras()[0];
    let (before, after) = (render(&scene, &camera, &settings), render(&again.scene, &camera, &settings));
    let (before, after) = (before.expect("an image"), after.expect("an image"));
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
        assert_same_edits(&edited(&first), &edited(&second));
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
fn a_subdivision_surface_is_saved_as_its_cage() {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(2.0), Material::default());
    let mut first = NativeDocument::new(scene);
    let (id, mesh) = only_mesh(&first.scene);
    let (mut cube, _) = EditMesh::from_mesh(mesh);
    let surface = StackedModifier::new(SubdivisionModifier { levels: 2 });
    cube.set_modifiers(vec![surface]).expect("two are few");
    put(&mut first, id, &cube);
    let (again, warnings) = document("cube.glb", &saved(&first));
    assert_eq!(warnings, []);
    assert!(edited(&again) == cube, "cage and levels");
}

#[test]
fn a_mesh_that_is_not_edited_keeps_its_polygons() {
    let mut scene = Scene::new();
    let mesh = with_everything(primitives::cylinder(1.0, 2.0, 7));
    scene.add_object("can", mesh.clone(), Material::default());
    let (document, _) = document("a.glb", &saved(&NativeDocument::new(scene)));
    assert!(*only_mesh(&document.scene).1 == mesh, "to the bit");
    assert!(document.edit_data.is_empty(), "nothing is being edited");
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
    let sun = Light::directional(1.0).with_radius(0.00465);
    for light in [spot.with_range(3.3).with_radius(0.1), Light::point(7.77), sun, Light::ambient(0.3)] {
        scene.add(Node::from_light(light.with_color(Vec3::new(0.1, 1.0, 0.9))));
    }
    let (second, warned) = document("a.glb", &saved(&NativeDocument::new(scene.clone())));
    assert_eq!(warned, [], "nothing to warn of");
    for ((_, was), (_, now)) in scene.nodes().iter().zip(second.scene.nodes().iter()) {
        assert_eq!(
            (now.transform, &now.light, now.visible),
            (was.transform, &was.light, was.visible),
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
fn images_keep_their_bytes() {
    let source = crate::texture::textured_square();
    let options = LoadOptions { keep_source: true, ..LoadOptions::default() };
    let mut first = load_from_slice("a.glb", &source.glb(), &options).expect("it loads");
    let texels = vec![[10, 20, 30, 255], [40, 50, 60, 70]];
    let texture = Texture::new(2, 1, texels.clone(), TextureFormat::Srgb).expect("two texels");
    let made = first.scene.add_texture("made", texture);
    first.scene.add_object("made", primitives::cube(1.0), Material::from_texture(made));
    let images = first.source.as_ref();
    let bytes =
        encode_glb(&first.scene, &ExportOptions { images, ..ExportOptions::default() }).expect("small");
    let again = load_from_slice("b.glb", &bytes, &options).expect("it loads");
    let kept = again.source.expect("it was asked for");
    assert_eq!(kept.image(0), images.and_then(|source| source.image(0)), "as it was encoded");
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
    let options = ExportOptions {
        nodes: Some(vec![child]),
        scale: 100.0,
        up: Some(UpAxis::Z),
        ..ExportOptions::default()
    };
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
         original positions; open the file that trigon saved if you need these"
    );
    assert!(second.edit_data.is_empty(), "what is edited is gone");
    let (_, mesh) = only_mesh(&second.scene);
    assert!(mesh.faces().all(|corners| corners.len() == 3), "triangles");

    let mut doc = doc_of(&bytes);
    doc.json["nodes"][0]["translation"] = json!([1, 2, 3]);
    doc.json["materials"][0]["name"] = json!("renamed");
    let (second, warned) = document("a.glb", &doc.glb());
    assert_eq!(warned, [], "nothing to warn of");
    assert_same_edits(&edited(&first), &edited(&second));
}

/// The document and the bytes of a GLB, to be changed.
pub(crate) fn doc_of(bytes: &[u8]) -> Doc {
    let glb = ::gltf::Glb::from_slice(bytes).expect("a GLB");
    let bytes = glb.bin.expect("it has bytes").into_owned();
    Doc { json: serde_json::from_slice(&glb.json).expect("JSON"), bytes }
}
