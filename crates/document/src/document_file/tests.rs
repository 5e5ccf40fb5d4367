//! Documents saved and opened again: meshes that are being edited come back to the bit.

use trigon_io::{LoadOptions, encode_glb, load_from_slice};
use trigon_mesh::math::Vec3;
use trigon_mesh::{SkinWeights, primitives};
use trigon_modelling::{
    EdgeId, FaceId, GroupAssignment, Modifier, NoObjects, StackedModifier, SubdivisionModifier, VertexId,
};
use trigon_scene::{Material, Scene};

use super::*;

/// A document of one object.
fn document(mesh: Mesh) -> (DocumentFile, MeshId) {
    let mut scene = Scene::new();
    scene.add_object("shape", mesh, Material::default());
    let id = scene.meshes().iter().next().expect("just added").0;
    (DocumentFile { native: NativeDocument::new(scene), ..DocumentFile::default() }, id)
}

/// The bytes of a file that loses nothing.
fn saved(native: &NativeDocument) -> Vec<u8> {
    let file = native.encode().expect("it is small");
    assert_eq!(file.what_would_be_lost(), [], "nothing is lost");
    file.to_bytes()
}

fn opened(bytes: &[u8]) -> (DocumentFile, Vec<Warning>) {
    let loaded = NativeDocument::load_from_slice("a.glb", bytes, &LoadOptions::default());
    let (native, mut warnings) = loaded.expect("as it was saved");
    (DocumentFile::open(native, Path::new("a.glb"), &mut warnings), warnings)
}

/// The only mesh that is being edited.
fn edited(file: &DocumentFile) -> &EditMesh {
    file.edited.values().next().expect("a mesh is being edited")
}

#[test]
fn an_edited_mesh_comes_back_with_everything_that_was_marked() {
    let (mut first, id) = document(primitives::torus(2.0, 0.5, 7, 6));
    let asset = first.native.scene.meshes().get(id).expect("just added");
    let (mut mesh, _) = EditMesh::from_mesh(asset.mesh());
    mesh.set_position(VertexId::new(3), Vec3::new(0.1, 1e-30, -7.0));
    mesh.set_sharp(EdgeId::new(2), true);
    mesh.set_crease(EdgeId::new(3), 0.7);
    mesh.set_edge_hidden(EdgeId::new(4), true);
    mesh.set_vertex_hidden(VertexId::new(5), true);
    mesh.set_face_hidden(FaceId::new(2), true);
    mesh.add_vertex_group("none").expect("room");
    mesh.add_vertex_group("some").expect("room");
    let assignment = GroupAssignment { weight: 0.1, ..GroupAssignment::default() };
    mesh.assign_to_vertex_group("some", &[VertexId::new(1), VertexId::new(7)], &assignment)
        .expect("they exist");
    first.edited.insert(id, mesh.clone());
    let bytes = saved(&first.to_native());
    let (second, warnings) = opened(&bytes);
    assert_eq!(warnings, [], "nothing to warn of");
    assert!(*edited(&second) == mesh, "also where the vertex was before");
    assert!(saved(&second.to_native()) == bytes, "and the second file is the first");
}

#[test]
fn vertex_groups_are_not_exported_and_reported() {
    let (mut first, id) = document(primitives::cube(2.0));
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let losses = |file: &DocumentFile| {
        let written = file.export("cube.glb", Format::Glb, &ExportOptions::default()).expect("it is small");
        written.what_would_be_lost().iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    first.edited.insert(id, cube.clone());
    let before = losses(&first);
    cube.add_vertex_group("some").expect("room");
    first.edited.insert(id, cube);
    let new: Vec<String> = losses(&first).into_iter().filter(|loss| !before.contains(loss)).collect();
    assert_eq!(new, ["mesh \"shape\": vertex groups"]);
    let nothing = ExportOptions { nodes: Some(Vec::new()), ..ExportOptions::default() };
    let written = first.export("cube.glb", Format::Glb, &nothing).expect("it is small");
    assert!(!written.what_would_be_lost().iter().any(|loss| loss.what == "vertex groups"), "not exported");
}

fn surface(levels: u32) -> StackedModifier {
    StackedModifier::new(SubdivisionModifier { levels })
}

#[test]
fn a_stack_with_every_modifier_comes_back_and_is_baked_on_export_if_wanted() {
    let (mut first, id) = document(primitives::cube(2.0));
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let mut stack: Vec<StackedModifier> =
        Modifier::of_each_kind().into_iter().map(StackedModifier::new).collect();
    stack[0].is_on = false;
    cube.set_modifiers(stack).expect("the defaults are in range");
    first.edited.insert(id, cube.clone());
    let bytes = saved(&first.to_native());
    let (second, warnings) = opened(&bytes);
    assert_eq!(warnings, [], "nothing to warn of");
    assert!(*edited(&second) == cube, "with its stack");
    assert!(saved(&second.to_native()) == bytes, "and the second file is the first");
    let faces = |modifiers| {
        let options = ExportOptions { modifiers, ..ExportOptions::default() };
        let written = first.export("cube.ply", Format::Ply, &options).expect("it is small");
        let file = written.files.last().expect("the model");
        let exported =
            load_from_slice("cube.ply", &file.bytes, &LoadOptions::default()).expect("it is whole");
        exported.scene.meshes().iter().map(|(_, asset)| asset.mesh().face_count()).sum::<usize>()
    };
    let baked = cube.evaluated(&NoObjects).expect("it is small").expect("some are on").face_count();
    assert_eq!((faces(false), faces(true)), (6, baked), "the cube, and what the stack makes of it");
    assert!(baked > 24, "at least mirrored, copied and beveled: {baked}");
}

/// Before there were other modifiers, the header of a mesh had a number of levels alone.
#[test]
fn a_file_of_an_older_version_has_its_subdivision_surface() {
    let (mut first, id) = document(primitives::cube(2.0));
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    cube.set_modifiers(vec![surface(2)]).expect("two are few");
    first.edited.insert(id, cube.clone());
    let bytes = saved(&first.to_native());
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let json = std::str::from_utf8(&bytes[20..20 + length]).expect("it is text");
    let now = r#""modifiers":[{"modifier":{"kind":"subdivision","levels":2},"is_on":true}]"#;
    assert!(json.contains(now), "{json}");
    // Spaces leave the length as it is.
    let before = format!("{:width$}", r#""subdivision":2"#, width = now.len());
    let old = [&bytes[..20], json.replace(now, &before).as_bytes(), &bytes[20 + length..]].concat();
    let (opened, warnings) = opened(&old);
    assert_eq!(warnings, [], "nothing to warn of");
    assert!(*edited(&opened) == cube, "cage and levels");
}

#[test]
fn a_subdivision_surface_is_saved_as_its_cage_and_exported_as_a_surface() {
    let (mut first, id) = document(primitives::cube(2.0));
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    cube.set_modifiers(vec![surface(2)]).expect("two are few");
    first.edited.insert(id, cube.clone());
    assert!(*edited(&opened(&saved(&first.to_native())).0) == cube, "cage and levels");
    let written = first.export("cube.obj", Format::Obj, &ExportOptions::default()).expect("it is small");
    let file = written.files.iter().find(|file| file.name == "cube.obj").expect("the model's own file");
    let exported = load_from_slice("cube.obj", &file.bytes, &LoadOptions::default()).expect("it is whole");
    let (_, asset) = exported.scene.meshes().iter().next().expect("one object");
    assert_eq!(asset.mesh().face_count(), 96, "6 faces become 24 and then 96");
}

#[test]
fn a_surface_that_is_too_large_is_not_exported_and_names_its_mesh() {
    // 20,000 quads: 80,000 corners, each of which becomes 256 quads.
    let torus = primitives::torus(2.0, 0.5, 200, 100);
    let (mut first, id) = document(torus.clone());
    let (mut mesh, _) = EditMesh::from_mesh(&torus);
    let levels = |mesh: &mut EditMesh| mesh.set_modifiers(vec![surface(SubdivisionModifier::MOST)]);
    mesh.transaction_within(u64::MAX, levels).map(drop).expect("levels alone are no surface yet");
    first.edited.insert(id, mesh);
    let error = first.export("torus.obj", Format::Obj, &ExportOptions::default()).expect_err("20 million");
    assert!(error.to_string().starts_with("mesh \"shape\": "), "{error}");
}

/// An editable mesh keeps eight joints of a vertex: converting it there and back changes the mesh.
#[test]
fn a_mesh_that_was_only_looked_at_stays_as_it_was_read() {
    let mut mesh = primitives::cube(2.0);
    let count = mesh.vertex_count();
    let joints = (0..count * 12).map(|index| (index % 12) as u16).collect();
    let weights = (0..count * 12).map(|index| 1.0 + (index % 12) as f32).collect();
    let skin = SkinWeights::new(12, joints, weights);
    mesh.set_attributes(trigon_mesh::Attributes { skin, ..mesh.attributes().clone() })
        .expect("for each vertex");
    let (first, _) = document(mesh);
    let glb = encode_glb(&first.native.scene, &ExportOptions::default()).expect("it is small");
    let (mut loaded, _) = opened(&glb);
    let (id, asset) = loaded.native.scene.meshes().iter().next().expect("one object");
    let (mut mesh, left_out) = EditMesh::from_mesh(asset.mesh());
    assert!(left_out.skinned_vertices > 0, "some joints are left out");
    let before = saved(&loaded.to_native());
    loaded.edited.insert(id, mesh.clone());
    assert!(saved(&loaded.to_native()) == before, "as if nobody had looked");
    mesh.set_position(VertexId::new(0), Vec3::ONE * 3.0);
    loaded.edited.insert(id, mesh);
    let native = loaded.to_native();
    let file = native.encode().expect("it is small");
    let lost: Vec<String> = file.what_would_be_lost().iter().map(ToString::to_string).collect();
    let attributes =
        ["JOINTS_2", "WEIGHTS_2"].map(|name| format!("mesh 0, primitive 0: its attribute {name}"));
    assert_eq!(lost, attributes, "a changed mesh is written anew, with eight joints");
}

#[test]
fn data_of_another_mesh_are_left_out_with_a_warning() {
    let (first, id) = document(primitives::cube(2.0));
    let mut native = first.to_native();
    native.edit_data.insert(id, EditData { hidden_vertices: vec![1, 8], ..EditData::default() });
    let (second, warnings) = opened(&saved(&native));
    assert!(second.edited.is_empty(), "the mesh is there and not being edited");
    assert_eq!(
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        [
            "a.glb, mesh \"shape\": marks and original positions are left out: vertex 8 is hidden and does not exist; \
          open an older copy of the file if you need them"
        ]
    );
}
