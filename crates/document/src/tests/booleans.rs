//! Booleans of objects: which are changed, where they are, and what becomes of the tools.

use trigon_mesh::math::{DQuat, DVec3};
use trigon_scene::{NodeId, Transform};

use super::*;
use commands::{run, try_run};

/// Two cubes with an edge of 2 m: `body` turned and scaled about the origin, `tool` so that it cuts off half of it.
fn cubes() -> (Document, [NodeId; 2]) {
    let mut scene = Scene::new();
    let nodes =
        ["body", "tool"].map(|name| scene.add_object(name, primitives::cube(2.0), Material::default()));
    let turn = DQuat::from_rotation_z(0.5);
    let placed = |offset: DVec3, scale: f64| {
        Transform::from_scale_rotation_translation(DVec3::splat(scale), turn, turn * offset)
    };
    scene.node_mut(nodes[0]).expect("there").transform = placed(DVec3::ZERO, 0.5);
    scene.node_mut(nodes[1]).expect("there").transform = placed(DVec3::new(1.0, 0.0, 0.0), 1.0);
    (Document::new(scene), nodes)
}

/// The volume of an object's mesh in its own space.
fn volume(document: &Document, object: NodeId) -> f64 {
    let mesh = document.nodes().node(object).and_then(|node| node.mesh).expect("it has a mesh");
    let mesh = document.mesh(mesh).expect("it is edited");
    assert!(mesh.is_watertight() || mesh.face_count() == 0, "closed");
    mesh.volume()
}

#[test]
fn the_active_object_is_combined_with_the_selected_ones() {
    // In the space of the body, in which the tool has an edge of 4 m.
    for (operation, expected) in [("union", 4.0 + 64.0), ("difference", 4.0), ("intersection", 4.0)] {
        let (mut document, [body, tool]) = cubes();
        let before = state(&document);
        run(&mut document, json!({ "op": "select", "objects": ["tool", "body"] }));
        let selected = state(&document);
        let outcome = try_run(&mut document, json!({ "op": "boolean", "operation": operation }))
            .expect("both are closed");
        assert_eq!(outcome.message, "combined with 1 object");
        assert!(
            (volume(&document, body) - expected).abs() < 1e-5,
            "{operation}: {}",
            volume(&document, body)
        );
        assert!(document.nodes().node(tool).is_none(), "the tool is gone");
        assert_eq!(
            document.selection().objects.iter().copied().collect::<Vec<_>>(),
            [body],
            "the body is left"
        );
        document.undo().expect("it was done");
        assert!(state(&document) == selected, "undone");
        document.undo().expect("selecting, too");
        assert!(state(&document) == before, "all undone");
    }
}

#[test]
fn named_objects_are_combined_and_tools_may_stay() {
    let (mut document, [body, tool]) = cubes();
    let boolean = json!({ "op": "boolean", "object": "body", "objects": ["tool"], "keep_tools": true });
    run(&mut document, json!({ "op": "edit_objects", "objects": ["body"] }));
    run(&mut document, json!({ "op": "leave_edit_mode" }));
    let bytes = |document: &Document| document.to_native().encode().expect("it can be").to_bytes();
    let before = bytes(&document);
    run(&mut document, boolean.clone());
    document.undo().expect("one");
    assert!(bytes(&document) == before, "what was only read is as it was");
    run(&mut document, boolean.clone());
    assert!((volume(&document, body) - 4.0).abs() < 1e-5, "half is left");
    assert!(document.nodes().node(tool).is_some(), "the tool stays");
    let with_itself = json!({ "op": "boolean", "object": "body", "objects": ["body"] });
    let error = try_run(&mut document, with_itself).expect_err("there is no other object");
    assert!(error.to_string().contains("two objects"), "{error}");
    run(&mut document, json!({ "op": "edit_objects", "objects": ["body"] }));
    assert!(try_run(&mut document, boolean).is_err(), "names are for object mode");
}

#[test]
fn materials_of_tools_come_along() {
    let (mut document, [body, tool]) = cubes();
    let material = |id| document.nodes().node(id).expect("there").materials[0];
    let materials = [material(body), material(tool)];
    run(&mut document, json!({ "op": "boolean", "object": "body", "objects": ["tool"] }));
    let node = document.nodes().node(body).expect("it stays").clone();
    assert_eq!(node.materials, materials, "both have slots");
    let mesh = document.mesh(node.mesh.expect("it has one")).expect("edited");
    let cut: Vec<u32> = mesh.faces().map(|face| mesh.material(face)).filter(|&slot| slot == 1).collect();
    assert_eq!((mesh.face_count(), cut.len()), (6, 1), "the cut has the tool's");
}

#[test]
fn an_open_object_is_refused_by_name_and_position() {
    let (mut document, [body, _]) = cubes();
    edit_faces(&mut document, &["tool"]);
    run_all(
        &mut document,
        &[
            json!({ "op": "select", "elements": [0] }),
            json!({ "op": "delete", "what": "only_faces" }),
            json!({ "op": "leave_edit_mode" }),
        ],
    );
    let before = state(&document);
    let error = try_run(&mut document, json!({ "op": "boolean", "object": "body", "objects": ["tool"] }))
        .expect_err("the tool is open");
    let message = error.to_string();
    assert!(
        message.contains("\"tool\"") && message.contains("hole") && message.contains("near ("),
        "{message}"
    );
    assert!(state(&document) == before && document.nodes().node(body).is_some(), "nothing changed");
}

#[test]
fn in_edit_mode_the_selected_part_is_the_tool() {
    let (mut document, [body, _]) = cubes();
    run_all(
        &mut document,
        &[json!({ "op": "select", "objects": ["tool", "body"] }), json!({ "op": "join_objects" })],
    );
    edit_faces(&mut document, &["body"]);
    run(&mut document, json!({ "op": "select", "elements": [6, 7, 8, 9, 10, 11] }));
    run(&mut document, json!({ "op": "boolean" }));
    assert!((volume(&document, body) - 4.0).abs() < 1e-5, "half is left");
    let mesh = document.nodes().node(body).and_then(|node| document.mesh(node.mesh?)).expect("it is edited");
    let face = mesh.faces().next().expect("half a cube has some").index();
    run(&mut document, json!({ "op": "select", "elements": [face] }));
    let error = try_run(&mut document, json!({ "op": "boolean" })).expect_err("one face is open");
    assert!(error.to_string().contains("hole"), "{error}");
}

/// Objects vanished without a word.
#[test]
fn a_boolean_that_leaves_nothing_says_so() {
    for (operation, objects, warnings) in [
        ("difference", ["body", "cover"], 1),
        ("intersection", ["body", "far"], 1),
        ("union", ["body", "far"], 0),
    ] {
        let mut scene = Scene::new();
        for (name, edge, x) in [("body", 1.0, 0.0), ("cover", 2.0, 0.0), ("far", 1.0, 5.0)] {
            let node = scene.add_object(name, primitives::cube(edge), Material::default());
            scene.node_mut(node).expect("there").transform =
                Transform::from_translation(DVec3::new(x, 0.0, 0.0));
        }
        let mut document = Document::new(scene);
        let [object, tool] = objects;
        let boolean = json!({ "op": "boolean", "operation": operation, "object": object, "objects": [tool] });
        let outcome = try_run(&mut document, boolean).expect("all are closed");
        let count = outcome.warnings.iter().filter(|warning| warning.contains("nothing is left")).count();
        assert_eq!(count, warnings, "{operation}: {:?}", outcome.warnings);
    }
}
