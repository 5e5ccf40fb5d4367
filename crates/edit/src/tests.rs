//! Random commands on documents: what is undone is undone to the same bytes.

use proptest::prelude::*;
use serde_json::json;
use trigon_mesh::edit::EditMesh;
use trigon_mesh::primitives;
use trigon_scene::{Material, Scene};

use crate::*;

fn document() -> Document {
    let mut scene = Scene::new();
    scene.add_object("torus", primitives::torus(2.0, 0.5, 6, 5), Material::default());
    scene.add_object("grid", primitives::grid(2.0, 3.0, 4, 3), Material::default());
    Document::new(scene)
}

fn command(json: serde_json::Value) -> Command {
    serde_json::from_value(json).expect("a command")
}

fn run_all(document: &mut Document, commands: &[serde_json::Value]) {
    for json in commands {
        document.run(command(json.clone())).unwrap_or_else(|error| panic!("{json}: {error}"));
    }
}

/// All that a user could tell apart.
fn state(document: &Document) -> (Vec<EditMesh>, Selection, String) {
    let scene = document.nodes();
    // Meshes that no object shows stay in the scene, so that an undone object finds its own again.
    let shown = scene.nodes().iter().filter_map(|(_, node)| node.mesh);
    let meshes = shown.filter_map(|id| document.mesh(id).cloned()).collect();
    let nodes: Vec<_> = scene.nodes().iter().map(|(id, node)| format!("{id:?} {node:?}")).collect();
    let roots: Vec<_> = scene.roots().collect();
    let materials: Vec<_> = scene.materials.iter().collect();
    (meshes, document.selection().clone(), format!("{}\n{roots:?}\n{materials:?}", nodes.join("\n")))
}

fn any_command() -> impl Strategy<Value = serde_json::Value> {
    let kind = prop_oneof![Just("vertex"), Just("edge"), Just("face")];
    let plain = prop_oneof![
        Just("select_all"),
        Just("select_none"),
        Just("select_inverse"),
        Just("select_linked"),
        Just("select_more"),
        Just("select_less"),
        Just("select_loop"),
        Just("select_ring"),
        Just("select_path"),
        Just("select_border"),
        Just("select_non_manifold"),
        Just("select_sharp"),
        Just("select_by_normal"),
        Just("select_by_material"),
        Just("select_similar"),
        Just("delete_objects"),
        Just("leave_edit_mode"),
    ];
    let what = prop_oneof![Just("vertices"), Just("edges"), Just("faces"), Just("only_faces")];
    let action = prop_oneof![Just("replace"), Just("add"), Just("remove"), Just("toggle")];
    prop_oneof![
        6 => plain.prop_map(|op| json!({ "op": op })),
        2 => kind.prop_map(|kind| json!({ "op": "set_element_kind", "kind": kind })),
        1 => what.prop_map(|what| json!({ "op": "delete", "what": what })),
        2 => prop::array::uniform3(-1.0f64..1.0).prop_map(|v| json!({ "op": "translate", "offset": v })),
        1 => (-1.0f64..1.0).prop_map(|turn| json!({ "op": "rotate", "angle": turn * 90.0, "center": [1, 0, 0] })),
        1 => Just(json!({ "op": "subdivide" })),
        1 => (0.0f64..2.0).prop_map(|near| json!({ "op": "merge", "at": "distance", "distance": near })),
        1 => any::<bool>().prop_map(|linked| json!({ "op": "duplicate_objects", "linked": linked })),
        1 => Just(json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } })),
        1 => Just(json!({ "op": "add_light", "light": "spot" })),
        1 => any::<bool>().prop_map(|visible| json!({ "op": "show_objects", "visible": visible })),
        1 => Just(json!({ "op": "rename_object", "object": 1, "name": "another" })),
        1 => (0u32..3, any::<bool>()).prop_map(|(parent, keep)| json!({ "op": "set_parent", "parent": parent,
            "keep_transform": keep })),
        1 => (0u32..3, 0u32..4).prop_map(|(object, to)| json!({ "op": "reorder_object", "object": object, "to": to })),
        1 => prop::array::uniform3(-180.0f64..180.0).prop_map(|angles| json!({ "op": "set_transform", "object": 1,
            "space": "world", "rotation": { "by": "euler", "angles": angles }, "location": [1, 2, 3] })),
        1 => (0.0f64..1.0).prop_map(|metal| json!({ "op": "set_material", "material": 0, "metallic": metal })),
        1 => Just(json!({ "op": "add_material", "object": 0 })),
        1 => Just(json!({ "op": "edit_objects", "objects": ["grid", 0] })),
        4 => (action, 0u32..2, prop::collection::vec(0u32..20, 0..6)).prop_map(|(action, object, elements)| {
            json!({ "op": "select", "objects": [object], "elements": elements, "action": action })
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn undo_and_redo_lead_to_the_same_bytes(commands in prop::collection::vec(any_command(), 1..30)) {
        let mut document = document();
        document.take_events();
        run_all(&mut document, &[json!({ "op": "edit_objects", "objects": [0, 1] })]);
        let mut states = vec![state(&document)];
        for json in commands {
            let before = state(&document);
            match document.run(command(json.clone())) {
                Ok(_) => states.push(state(&document)),
                Err(_) => prop_assert!(state(&document) == before, "{json} was refused"),
            }
            for (id, _) in document.nodes().meshes().iter() {
                if let Some(mesh) = document.mesh(id) {
                    prop_assert_eq!(mesh.check_structure(), Ok(()));
                }
            }
        }
        for known in states[..states.len() - 1].iter().rev() {
            document.undo().expect("each was done");
            prop_assert!(state(&document) == *known, "undone");
        }
        for known in &states[1..] {
            document.redo().expect("each was undone");
            prop_assert!(state(&document) == *known, "done again");
        }
        // What a recovery file was told does the same, with undo and redo.
        let mut recovered = self::document();
        recovered.replay(&document.take_events()).expect("as before");
        prop_assert!(state(&recovered) == state(&document), "recovered");
        prop_assert_eq!(recovered.script(), document.script(), "with its history");
        // The history as a script does the same.
        let script = Script::from_json(&Script::new(document.script()).to_json()).expect("as written");
        let mut again = self::document();
        script.run(&mut again, |_| {}).expect("as before");
        prop_assert!(state(&again) == state(&document), "the script");
    }
}

#[test]
fn the_last_command_is_adjusted_in_place() {
    let mut document = document();
    run_all(
        &mut document,
        &[
            json!({ "op": "edit_objects", "objects": ["grid"] }),
            json!({ "op": "set_element_kind", "kind": "face" }),
            json!({ "op": "select", "elements": [0, 1] }),
            json!({ "op": "delete", "what": "only_faces" }),
        ],
    );
    let entries = document.history().done().len();
    document.adjust_last(command(json!({ "op": "delete", "what": "faces" }))).expect("other parameters");
    assert_eq!(document.history().done().len(), entries, "one entry took the place of another");
    let faces = |document: &mut Document| {
        let meshes = document.scene().meshes().iter();
        meshes.map(|(_, asset)| (asset.mesh().face_count(), asset.mesh().edge_count())).collect::<Vec<_>>()
    };
    assert_eq!(faces(&mut document)[1], (10, 27), "two faces and the edges that only they had are gone");
    let refused = document.adjust_last(command(json!({ "op": "select", "elements": [9999] })));
    assert!(refused.is_err(), "there is no such face");
    assert_eq!(faces(&mut document)[1], (10, 27), "a refusal leaves the last one done");
    document.undo().expect("one");
    assert_eq!(faces(&mut document)[1], (12, 31), "and undoes as one");
}

#[test]
fn the_history_stays_within_its_budget() {
    let mut document = document();
    run_all(
        &mut document,
        &[
            json!({ "op": "edit_objects", "objects": ["torus"] }),
            json!({ "op": "set_element_kind", "kind": "face" }),
        ],
    );
    document.set_history_budget(2000);
    for face in 0..30 {
        let select = json!({ "op": "select", "elements": [face] });
        run_all(&mut document, &[select, json!({ "op": "delete" })]);
    }
    let history = document.history();
    assert!(history.bytes() <= 2000, "{} bytes", history.bytes());
    assert!(history.dropped() > 0 && !history.done().is_empty(), "the oldest are gone, the newest not");
}

#[test]
fn a_parameter_that_does_not_exist_is_refused() {
    let wrong = r#"{ "version": 1, "commands": [
        { "op": "select_sharp", "angel": 3 }
    ] }"#;
    let error = Script::from_json(wrong).expect_err("no such parameter").to_string();
    assert!(error.contains("angel") && error.contains("line"), "{error}");
    let unknown = r#"{ "version": 1, "commands": [ { "op": "explode" } ] }"#;
    assert!(
        Script::from_json(unknown).expect_err("no such command").to_string().contains("explode"),
        "named"
    );
    assert!(Script::from_json(r#"{ "version": 2, "commands": [] }"#).is_err(), "a later version");
}
