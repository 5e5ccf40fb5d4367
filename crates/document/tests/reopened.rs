//! Whatever random commands make of a document, it is saved without a loss, opened again and the same.

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_document::mesh::{EditData, Mesh};
use trigon_document::modelling::EditMesh;
use trigon_document::scene::camera::Projection;
use trigon_document::scene::{Material, Node};
use trigon_document::{Command, Document};
use trigon_io::LoadOptions;

/// Names that objects have after [`commands`], and one that none has.
const NAMES: [&str; 6] = ["Cube", "Plane", "Empty", "Light", "Cube.001", "nobody"];

fn name() -> impl Strategy<Value = &'static str> {
    prop::sample::select(&NAMES[..])
}

/// A command that may fail where the document is.
fn command() -> impl Strategy<Value = Value> {
    let place = || prop::array::uniform3(-3.0..3.0_f64);
    let plain = prop::sample::select(vec![
        json!({"op": "select_all"}),
        json!({"op": "select_none"}),
        json!({"op": "select_inverse"}),
        json!({"op": "select_linked"}),
        json!({"op": "edit_objects"}),
        json!({"op": "leave_edit_mode"}),
        json!({"op": "delete_objects"}),
        json!({"op": "delete", "what": "vertices"}),
        json!({"op": "delete", "what": "faces"}),
        json!({"op": "delete", "what": "only_faces"}),
        json!({"op": "dissolve"}),
        json!({"op": "hide"}),
        json!({"op": "reveal"}),
        json!({"op": "reveal_objects"}),
        json!({"op": "duplicate_objects"}),
        json!({"op": "duplicate_objects", "linked": true}),
        json!({"op": "join_objects"}),
        json!({"op": "boolean", "operation": "union"}),
        json!({"op": "separate"}),
        json!({"op": "separate", "by": "loose_parts"}),
        json!({"op": "separate", "by": "material"}),
        json!({"op": "set_origin"}),
        json!({"op": "set_origin", "to": "geometry_to_origin"}),
        json!({"op": "set_origin", "to": "point", "point": [1, 2, 3]}),
        json!({"op": "apply_transform"}),
        json!({"op": "add_object", "object": {"shape": "cube", "edge": 2}}),
        json!({"op": "add_object", "object": {"shape": "plane", "width": 2, "depth": 1}}),
        json!({"op": "add_empty"}),
        json!({"op": "add_light"}),
        json!({"op": "add_camera"}),
        json!({"op": "add_material"}),
        json!({"op": "mark_seam"}),
        json!({"op": "smart_project"}),
        json!({"op": "pin_uvs"}),
        json!({"op": "add_vertex_group"}),
        json!({"op": "add_vertex_group", "name": "ends", "empty": true}),
        json!({"op": "assign_to_vertex_group", "weight": 0.1, "falloff": {"radius": 3.0, "shape": "root"}}),
        json!({"op": "remove_from_vertex_group", "group": "Group"}),
        json!({"op": "remove_vertex_group"}),
        json!({"op": "rename_vertex_group", "name": "\"ends\" \u{2028}"}),
        json!({"op": "mark_sharp"}),
        json!({"op": "shade", "smooth": true}),
        json!({"op": "subdivide"}),
        json!({"op": "merge", "at": "center"}),
        json!({"op": "set_subdivision", "levels": 2}),
        json!({"op": "add_modifier", "modifier": {"kind": "mirror", "merge_distance": null, "axes": [true, false, true]}}),
        json!({"op": "add_modifier", "modifier": {"kind": "array", "offset": [0.1, 1e-300, -3.0]}, "index": 0}),
        json!({"op": "add_modifier", "modifier": {"kind": "bevel", "edges": "creased", "width": 0.30000000000000004}}),
        json!({"op": "add_modifier", "modifier": {"kind": "weld"}}),
        json!({"op": "add_modifier", "modifier": {"kind": "solidify", "rim_material": 1, "group": "Group"}}),
        json!({"op": "add_modifier", "modifier": {"kind": "triangulate"}}),
        json!({"op": "show_modifier", "index": 0, "on": false}),
        json!({"op": "move_modifier", "index": 1, "to": 0}),
        json!({"op": "remove_modifier", "index": 1}),
        json!({"op": "apply_modifier"}),
    ]);
    prop_oneof![
        6 => plain,
        1 => name().prop_map(|name| json!({"op": "select", "objects": [name]})),
        1 => name().prop_map(|name| json!({"op": "edit_objects", "objects": [name]})),
        1 => place().prop_map(|by| json!({"op": "translate", "offset": by})),
        1 => prop::collection::vec(0_u32..9, 0..4).prop_map(|elements| json!({"op": "select", "elements": elements})),
        1 => (name(), any::<bool>()).prop_map(|(name, visible)| json!({"op": "show_objects", "objects": [name], "visible": visible})),
        1 => (name(), name()).prop_map(|(child, parent)| json!({"op": "set_parent", "objects": [child], "parent": parent})),
        1 => (name(), place()).prop_map(|(name, location)| json!({"op": "set_transform", "object": name, "location": location})),
        1 => prop::sample::select(vec!["vertex", "edge", "face"]).prop_map(|kind| json!({"op": "set_element_kind", "kind": kind})),
    ]
}

/// An object, as deep as it hangs.
#[derive(Debug, PartialEq)]
struct Object {
    depth: usize,
    /// The node without the numbers of other things, which may change.
    node: Node,
    camera: Option<[f32; 3]>,
    materials: Vec<Material>,
    mesh: Option<(String, Mesh)>,
    /// Of a mesh that was edited. Its elements have other numbers once those that were deleted are gone.
    edited: Option<(Mesh, EditData)>,
}

fn as_edited(mesh: &EditMesh) -> (Mesh, EditData) {
    let (polygons, map) = mesh.to_mesh();
    let data = mesh.edit_data(&map);
    (polygons, data)
}

/// The numbers of a perspective camera, which files hold as f32.
fn lens(projection: Projection) -> [f32; 3] {
    let Projection::Perspective { vertical_fov, near, far, .. } = projection else {
        panic!("no command makes {projection:?}")
    };
    [vertical_fov, near, far.unwrap_or(0.0)].map(|number| number as f32)
}

/// The objects of a document, each after its parent.
fn objects(document: &mut Document) -> Vec<Object> {
    let scene = document.scene().clone();
    let describe = |(id, depth)| {
        let node: &Node = scene.node(id).expect("it is in the tree");
        let material = |&id| scene.materials.get(id).expect("it is in use").clone();
        let asset = node.mesh.and_then(|mesh| scene.meshes().get(mesh));
        let mut bare = Node::default().with_name(node.name.as_str()).with_transform(node.transform);
        (bare.light, bare.visible) = (node.light.clone(), node.visible);
        Object {
            depth,
            node: bare,
            camera: node.camera.as_deref().copied().map(lens),
            materials: node.materials.iter().map(material).collect(),
            mesh: asset.map(|asset| (asset.name.clone(), asset.mesh().clone())),
            edited: node.mesh.and_then(|mesh| document.mesh(mesh)).map(as_edited),
        }
    };
    scene.tree().into_iter().map(describe).collect()
}

fn saved(document: &Document) -> Result<Vec<u8>, TestCaseError> {
    let native = document.to_native();
    let file = native.encode().map_err(|error| TestCaseError::fail(error.to_string()))?;
    prop_assert_eq!(file.what_would_be_lost(), &[]);
    Ok(file.to_bytes())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn what_random_commands_leave_is_opened_as_it_was_saved(commands in prop::collection::vec(command(), 0..14)) {
        let mut document = Document::default();
        for json in &commands {
            let command: Command = serde_json::from_value(json.clone()).expect("it is in the reference");
            // Many make no sense where the document is.
            let _ = document.run(command);
        }
        let bytes = saved(&document)?;
        let opened = Document::open_bytes("a.glb".as_ref(), &bytes, &LoadOptions::default());
        let (mut again, warnings) = opened.map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(warnings, vec![]);
        prop_assert!(saved(&again)? == bytes, "the second file is the first");
        let (before, after) = (objects(&mut document), objects(&mut again));
        prop_assert_eq!(before.len(), after.len());
        for (before, after) in before.iter().zip(&after) {
            prop_assert!(before == after, "{:?}\n{:?}", before, after);
        }
    }
}
