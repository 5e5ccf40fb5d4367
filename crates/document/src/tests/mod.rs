//! Random commands on documents: what is undone is undone to the same bytes.

mod booleans;
pub(crate) mod commands;
mod overflow;
mod parts;
mod rendered;
mod single_commands;
mod told;

use proptest::prelude::*;
use serde_json::json;
use trigon_mesh::primitives;
use trigon_modelling::EditMesh;
use trigon_scene::{Material, Scene};

use crate::*;
use commands::{command, edit_faces, run_all};

fn document() -> Document {
    let mut scene = Scene::new();
    scene.add_object("torus", primitives::torus(2.0, 0.5, 6, 5), Material::default());
    scene.add_object("grid", primitives::grid(2.0, 3.0, 4, 3), Material::default());
    Document::new(scene)
}

/// All that a user could tell apart.
fn state(document: &Document) -> (Vec<EditMesh>, Selection, String) {
    let scene = document.nodes();
    // Meshes that no object shows stay in the scene, so that an undone object finds its own again.
    let shown = scene.nodes().iter().filter_map(|(_, node)| node.mesh);
    // A mesh that was never edited is the same as one whose edits were undone.
    let made = |id| EditMesh::from_mesh(scene.meshes().get(id).expect("nodes name meshes").mesh()).0;
    let meshes = shown.map(|id| document.mesh(id).cloned().unwrap_or_else(|| made(id))).collect();
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
        Just("hide"),
        Just("reveal"),
        Just("catmull_clark"),
        Just("dissolve"),
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
                    let selection = document.selection();
                    let selected = selection.of(id).into_iter().flat_map(MeshSelection::indices);
                    for index in selected {
                        prop_assert!(selection.kind().is_selectable(mesh, index), "{json}: {index} is selected");
                    }
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

/// What is not seen in [`state`]: the history and the events.
fn record(document: &mut Document, events: &mut Vec<Event>) -> (Vec<Command>, usize, Vec<Event>) {
    events.extend(document.take_events());
    (document.script(), document.history().undone().len(), events.clone())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Against a document in which each of them is run and undone.
    #[test]
    fn previews_leave_no_trace_until_they_are_confirmed(
        start in prop::collection::vec(any_command(), 0..8),
        previews in prop::collection::vec(any_command(), 1..12),
        confirms in any::<bool>(),
    ) {
        let (mut document, mut other) = (document(), document());
        let mut events = document.take_events();
        let edit = json!({ "op": "edit_objects", "objects": [0, 1] });
        for json in std::iter::once(edit).chain(start) {
            drop((document.run(command(json.clone())), other.run(command(json))));
        }
        let (first, first_record) = (state(&document), record(&mut document, &mut events));
        let mut last = None;
        for json in previews {
            match (document.preview(command(json.clone())), other.run(command(json.clone()))) {
                (Ok(outcome), Ok(expected)) => {
                    prop_assert_eq!(outcome, expected);
                    last = Some((command(json), state(&other)));
                    other.undo().expect("it was just run");
                }
                (Err(refusal), Err(expected)) => prop_assert_eq!(refusal, expected),
                (tried, expected) => prop_assert!(false, "{json}: {tried:?}, not {expected:?}"),
            }
            let expected = last.as_ref().map_or(&first, |(_, state)| state);
            prop_assert!(state(&document) == *expected, "as if it were the only one");
            prop_assert_eq!(document.previewed(), last.as_ref().map(|(command, _)| command));
            prop_assert_eq!(record(&mut document, &mut events), first_record.clone());
        }
        if confirms && let Some((command, expected)) = last {
            prop_assert!(document.confirm() && !document.confirm(), "once");
            prop_assert!(state(&document) == expected, "it stays");
            prop_assert_eq!(document.script().pop(), Some(command.clone()));
            prop_assert_eq!(document.take_events(), vec![Event::Run(Box::new(command))]);
            document.undo().expect("one entry");
        } else {
            document.cancel();
            prop_assert_eq!(record(&mut document, &mut events), first_record);
            prop_assert!(!document.cancel(), "there is none left");
        }
        prop_assert!(state(&document) == first, "the first bytes");
    }
}

#[test]
fn what_changes_a_document_confirms_its_preview_first() {
    let add = || command(json!({ "op": "add_light", "light": "spot" }));
    let mut document = document();
    let objects = |document: &Document| document.nodes().nodes().len();
    document.preview(add()).expect("a light");
    document.run(add()).expect("another");
    assert_eq!((objects(&document), document.history().done().len()), (4, 2), "both are done");
    document.preview(add()).expect("a third");
    document.undo().expect("the preview");
    assert_eq!((objects(&document), document.history().undone().len()), (4, 1), "it can be done again");
    document.redo().expect("it");
    document.preview(add()).expect("a fourth");
    assert_eq!(document.redo(), Err(EditError::Nothing("do again")), "after something else was done");
    assert_eq!((objects(&document), document.history().done().len()), (6, 4), "but the fourth stays");
    document.preview(add()).expect("a fifth");
    document.repeat_last().expect("a sixth");
    document.preview(add()).expect("a seventh");
    document.adjust_last(add()).expect("the seventh");
    assert_eq!((objects(&document), document.history().done().len()), (9, 7), "seven lights");
}

#[test]
fn the_last_command_is_adjusted_in_place() {
    let mut document = document();
    edit_faces(&mut document, &["grid"]);
    run_all(
        &mut document,
        &[json!({ "op": "select", "elements": [0, 1] }), json!({ "op": "delete", "what": "only_faces" })],
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
    edit_faces(&mut document, &["torus"]);
    document.set_history_budget(2000);
    for face in 0..30 {
        let select = json!({ "op": "select", "elements": [face] });
        run_all(&mut document, &[select, json!({ "op": "delete" })]);
    }
    let history = document.history();
    assert!(history.bytes() <= 2000, "{} bytes", history.bytes());
    assert!(history.dropped() > 0 && !history.done().is_empty(), "the oldest are gone, the newest not");
    let sum: usize = history.done().iter().map(Entry::bytes).sum();
    assert_eq!(history.bytes(), sum, "what is gone counts no more");
    let largest = history.done().iter().map(Entry::bytes).max().unwrap_or(0);
    assert!(history.bytes() + 2 * largest > 2000, "no more are gone than need be: {} bytes", history.bytes());
}

/// Each of ten thousand entries had a copy of what was selected, an eighth of a byte for each vertex of the mesh.
#[test]
fn entries_of_moves_share_what_is_selected() {
    let mut scene = Scene::new();
    scene.add_object("sheet", primitives::grid(1.0, 1.0, 200, 200), Material::default());
    let mut document = Document::new(scene);
    run_all(&mut document, &[json!({ "op": "edit_objects", "objects": ["sheet"] })]);
    // The last vertex, so that there is a bit for each of them.
    run_all(&mut document, &[json!({ "op": "select", "elements": [40_400] })]);
    let up = json!({ "op": "translate", "offset": [0, 0.5, 0] });
    run_all(&mut document, std::slice::from_ref(&up));
    let (first, before) = (document.history().bytes(), state(&document));
    for _ in 0..500 {
        run_all(&mut document, std::slice::from_ref(&up));
    }
    let each = (document.history().bytes() - first) / 500;
    assert!(each < 40_400 / 8, "{each} bytes for each move of one vertex");
    for _ in 0..500 {
        document.undo().expect("none was dropped");
    }
    assert!(state(&document) == before, "as it was before them");
    run_all(&mut document, &[up]);
    let entries = document.history().done().iter().chain(document.history().undone());
    let sum: usize = entries.map(Entry::bytes).sum();
    assert_eq!(document.history().bytes(), sum, "what can no more be done again counts no more");
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

/// An object that is turned by a quarter about y, twice as wide along its own x, and 10 m off.
fn placed_document() -> Document {
    use trigon_mesh::math::{DQuat, DVec3};
    let mut scene = Scene::new();
    let object = scene.add_object("cube", primitives::cube(2.0), Material::default());
    let quarter =
        DQuat::from_xyzw(0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2);
    let (scale, offset) = (DVec3::new(2.0, 1.0, 1.0), DVec3::X * 10.0);
    let placement = trigon_scene::Transform::from_scale_rotation_translation(scale, quarter, offset);
    scene.node_mut(object).expect("it was just added").transform = placement;
    Document::new(scene)
}

/// The vertices of the only mesh in the world.
fn world_points(document: &Document) -> Vec<trigon_mesh::math::DVec3> {
    let (id, _) = document.selection().meshes().next().expect("it is edited");
    let (mesh, to_world) = (document.mesh(id).expect("it is edited"), document.mesh_transform(id));
    mesh.vertices().map(|vertex| to_world.transform_point3(mesh.position(vertex).as_dvec3())).collect()
}

#[test]
fn elements_are_moved_turned_and_scaled_in_the_worlds_axes() {
    use trigon_mesh::math::DVec3;
    let center = DVec3::new(10.0, 0.0, 0.0);
    type Expected = fn(DVec3) -> DVec3;
    let cases: [(serde_json::Value, Expected); 4] = [
        (json!({ "op": "translate", "offset": [1, 2, 3], "space": "world" }), |p| {
            p + DVec3::new(1.0, 2.0, 3.0)
        }),
        (
            json!({ "op": "rotate", "angle": 90, "axis": [0, 0, 1], "center": [10, 0, 0], "space": "world" }),
            |p| DVec3::new(-p.y, p.x, p.z),
        ),
        (json!({ "op": "scale", "factors": [3, 1, 1], "center": [10, 0, 0], "space": "world" }), |p| {
            DVec3::new(3.0 * p.x, p.y, p.z)
        }),
        (
            json!({ "op": "scale", "factors": [3, 1, 1], "orientation": [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
            "center": [10, 0, 0], "space": "world" }),
            |p| DVec3::new(p.x, p.y, 3.0 * p.z),
        ),
    ];
    for (json, expected) in cases {
        let mut document = placed_document();
        run_all(
            &mut document,
            &[json!({ "op": "edit_objects", "objects": [0] }), json!({ "op": "select_all" })],
        );
        let before = world_points(&document);
        run_all(&mut document, std::slice::from_ref(&json));
        for (from, to) in before.into_iter().zip(world_points(&document)) {
            let expected = expected(from - center) + center;
            // Vertices are rounded to f32.
            assert!(to.distance(expected) < 1e-5, "{json}: {from} goes to {to}, not to {expected}");
        }
    }
}

#[test]
fn objects_that_hang_on_each_other_are_moved_once_in_the_world() {
    use trigon_mesh::math::DVec3;
    let mut document = placed_document();
    run_all(
        &mut document,
        &[
            json!({ "op": "add_light", "light": "point" }),
            json!({ "op": "select", "objects": [1] }),
            json!({ "op": "set_parent", "parent": 0 }),
            json!({ "op": "select_all" }),
        ],
    );
    let positions = |document: &Document| {
        let scene = document.nodes();
        scene.nodes().iter().map(|(id, _)| scene.world_transform(id).translation).collect::<Vec<_>>()
    };
    let before = positions(&document);
    run_all(&mut document, &[json!({ "op": "translate", "offset": [0, 0, 4], "space": "world" })]);
    for (from, to) in before.iter().zip(positions(&document)) {
        assert!(to.distance(*from + DVec3::Z * 4.0) < 1e-12, "{from} goes to {to}");
    }
    run_all(
        &mut document,
        &[json!({ "op": "rotate", "angle": 180, "axis": [0, 1, 0], "center": [0, 0, 0], "space": "world" })],
    );
    for (from, to) in before.into_iter().zip(positions(&document)) {
        let expected = DVec3::new(-from.x, from.y, -from.z - 4.0);
        assert!(to.distance(expected) < 1e-12, "{from} goes to {to}");
    }
}

#[test]
fn an_object_is_scaled_along_its_own_axes_by_what_they_get_in_the_world() {
    let mut document = placed_document();
    run_all(
        &mut document,
        &[json!({ "op": "select_all" }), json!({ "op": "scale", "factors": [5, 1, 1], "space": "world" })],
    );
    let (_, node) = document.nodes().nodes().iter().next().expect("the cube");
    let trigon_scene::Transform::Decomposed { scale, .. } = node.transform else { panic!("no shear") };
    // Its z runs along the world's x.
    assert!((scale - trigon_mesh::math::DVec3::new(2.0, 1.0, 5.0)).length() < 1e-12, "{scale}");
}

#[test]
fn parts_turn_about_their_own_middles() {
    let mut document = document();
    edit_faces(&mut document, &["grid"]);
    run_all(&mut document, &[json!({ "op": "select", "elements": [0, 11] })]);
    let middles = |document: &Document| {
        let (id, _) = document.selection().meshes().next().expect("it is edited");
        let mesh = document.mesh(id).expect("it is edited");
        [0, 11].map(|face| mesh.face_center(trigon_modelling::FaceId::new(face)))
    };
    let before = middles(&document);
    run_all(&mut document, &[json!({ "op": "scale", "factors": [0.5, 0.5, 0.5], "individual": true })]);
    for (from, to) in before.into_iter().zip(middles(&document)) {
        assert!(from.distance(to) < 1e-6, "{from} stays: {to}");
    }
    let refusal = document.run(command(json!({ "op": "rotate", "individual": true, "proportional": {} })));
    assert!(refusal.expect_err("near to several").to_string().contains("another pivot"), "with the remedy");
}

#[test]
fn vertices_slide_along_the_edge_in_a_direction() {
    let mut document = document();
    run_all(
        &mut document,
        &[json!({ "op": "edit_objects", "objects": ["grid"] }), json!({ "op": "select", "elements": [6] })],
    );
    let position = |document: &Document| {
        let (id, _) = document.selection().meshes().next().expect("it is edited");
        document.mesh(id).expect("it is edited").position(trigon_modelling::VertexId::new(6))
    };
    let before = position(&document);
    run_all(&mut document, &[json!({ "op": "slide_vertices", "factor": 0.5, "direction": [1, 0, 0.2] })]);
    let way = position(&document) - before;
    assert_eq!((way.x, way.y, way.z), (0.25, 0.0, 0.0), "half of a quad of half a metre");
}

#[test]
fn a_loop_is_cut_at_a_given_edge() {
    let mut document = document();
    run_all(&mut document, &[json!({ "op": "edit_objects", "objects": [0, 1] })]);
    let two = document.run(command(json!({ "op": "loop_cut", "edge": 0 })));
    assert!(matches!(two, Err(EditError::NothingSelected { .. })), "there are two objects");
    let made = document.run(command(json!({ "op": "loop_cut", "edge": 0, "object": "torus", "cuts": 2 })));
    assert_eq!(made.expect("quads").message, "cut 10 edges", "twice around the tube of five");
    assert!(
        document.run(command(json!({ "op": "loop_cut", "edge": 9999, "object": 0 }))).is_err(),
        "no edge"
    );
}
