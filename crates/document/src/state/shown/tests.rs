//! The scene after any commands is the scene made anew, and so is a copy that was only told of
//! changes.

use proptest::prelude::*;
use serde_json::{Value, json};
use trigon_mesh::math::{Vec2, Vec4};
use trigon_mesh::{Attributes, primitives};
use trigon_scene::{Material, Scene};

use super::super::visible::Sight;
use super::*;
use crate::Document;
use crate::tests::commands::{command, run};

/// A smooth torus with texture coordinates and colours, and a plain grid.
fn document() -> Document {
    let mut torus = primitives::torus(2.0, 0.5, 6, 5);
    let corners = torus.corner_count();
    let attributes = Attributes {
        uv_sets: vec![vec![Vec2::X; corners], vec![Vec2::Y; corners]],
        corner_colors: Some(vec![Vec4::ONE; corners]),
        ..torus.attributes().clone()
    };
    torus.set_attributes(attributes).expect("one for each corner");
    torus.smooth_by_angle(3.0);
    let mut scene = Scene::new();
    scene.add_object("torus", torus, Material::default());
    scene.add_object("grid", primitives::grid(2.0, 3.0, 4, 3), Material::default());
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "edit_objects", "objects": [0, 1] }));
    document
}

/// Commands that change values, marks or elements; null undoes, and true does again.
fn step() -> impl Strategy<Value = Value> {
    let kind = prop_oneof![Just("vertex"), Just("edge"), Just("face")];
    let plain = prop_oneof![
        Just("select_all"),
        Just("select_more"),
        Just("mark_sharp"),
        Just("mark_seam"),
        Just("crease"),
        Just("shade"),
        Just("hide"),
        Just("reveal"),
        Just("flip_normals"),
        Just("project_uvs"),
        Just("reset_vertices"),
        Just("delete"),
        Just("extrude"),
    ];
    prop_oneof![
        3 => Just(Value::Null),
        2 => Just(json!(true)),
        5 => prop::array::uniform3(-1.0f64..1.0).prop_map(|v| json!({ "op": "translate", "offset": v })),
        2 => (-90.0f64..90.0).prop_map(|angle| json!({ "op": "rotate", "angle": angle })),
        3 => plain.prop_map(|op| json!({ "op": op })),
        1 => kind.prop_map(|kind| json!({ "op": "set_element_kind", "kind": kind })),
        1 => (0u32..3).prop_map(|levels| json!({ "op": "set_subdivision", "levels": levels })),
        2 => modifier_step(),
        1 => Just(json!({ "op": "leave_edit_mode" })),
        1 => Just(json!({ "op": "edit_objects", "objects": [0, 1] })),
        1 => Just(json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } })),
        4 => (0u32..2, prop::collection::vec(0u32..20, 1..6)).prop_map(|(object, elements)| {
            json!({ "op": "select", "objects": [object], "elements": elements })
        }),
    ]
}

/// Commands that change stacks of modifiers.
fn modifier_step() -> impl Strategy<Value = Value> {
    let modifier = prop_oneof![
        Just(json!({ "kind": "mirror", "merge_distance": 0.5 })),
        Just(json!({ "kind": "weld", "distance": 0.6 })),
        Just(json!({ "kind": "bevel" })),
        Just(json!({ "kind": "array" })),
        Just(json!({ "kind": "triangulate" })),
    ];
    prop_oneof![
        4 => (0u32..2, modifier).prop_map(|(object, modifier)| {
            json!({ "op": "add_modifier", "object": object, "modifier": modifier })
        }),
        1 => (0u32..2, any::<bool>()).prop_map(|(object, on)| {
            json!({ "op": "show_modifier", "object": object, "index": 0, "on": on })
        }),
        1 => (0u32..2, 0u32..3).prop_map(|(object, to)| {
            json!({ "op": "move_modifier", "object": object, "index": 0, "to": to })
        }),
        2 => (0u32..2, 0u32..2).prop_map(|(object, index)| {
            json!({ "op": "remove_modifier", "object": object, "index": index })
        }),
        1 => (0u32..2).prop_map(|object| json!({ "op": "apply_modifier", "object": object })),
    ]
}

/// The document's scene and a copy of it show what making the meshes anew would.
fn check(document: &mut Document, copy: &Scene) -> Result<(), TestCaseError> {
    document.scene();
    for (id, asset) in document.nodes().meshes().iter() {
        let shown = copy.meshes().get(id).expect("the copy has all meshes").mesh();
        let Some(edited) = document.mesh(id) else {
            prop_assert!(shown == asset.mesh(), "the copy follows");
            continue;
        };
        prop_assert!(*asset.mesh() == edited.to_mesh().0, "the scene has all that is hidden");
        let is_edited = document.selection().of(id).is_some();
        let has_hidden = is_edited && document.marked(id).is_some_and(|marked| marked.has_hidden);
        let mut evaluation = Evaluation::default();
        evaluation.update(edited, &SceneObjects::new(document.nodes(), &BTreeMap::new(), None, id));
        let sight = Sight::of(&evaluation, is_edited, has_hidden);
        let (anew, map) = sight.mesh(edited, &evaluation);
        prop_assert_eq!(shown.positions(), anew.positions());
        prop_assert_eq!(shown.attributes(), anew.attributes());
        prop_assert_eq!(shown.shading_normals(), anew.shading_normals());
        prop_assert!(shown == &anew, "the same mesh");
        prop_assert_eq!(document.shown_elements(id), Some(&map));
        let numbers = document.shown_numbers(id).expect("it is up to date");
        prop_assert_eq!(numbers, &ElementNumbers::new(edited, &anew, &map));
    }
    let names = |scene: &Scene| scene.nodes().iter().map(|(_, node)| node.clone()).collect::<Vec<_>>();
    prop_assert_eq!(names(copy), names(document.nodes()));
    Ok(())
}

fn tell(document: &mut Document, copy: &mut Scene) -> Vec<SceneChange> {
    let changes = document.take_scene_changes();
    changes.iter().for_each(|change| change.clone().apply(document.nodes(), copy));
    changes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn the_scene_and_its_copy_follow_all_commands(
        steps in prop::collection::vec((step(), any::<bool>()), 1..40)
    ) {
        let (mut document, mut copy) = (document(), Scene::new());
        for (step, is_looked_at) in steps {
            // Many are refused: the scene stays as it is then.
            match step {
                Value::Null => drop(document.undo()),
                Value::Bool(_) => drop(document.redo()),
                json => drop(document.run(command(json))),
            }
            if is_looked_at {
                tell(&mut document, &mut copy);
                check(&mut document, &copy)?;
            }
        }
        tell(&mut document, &mut copy);
        check(&mut document, &copy)?;
    }
}

/// How many vertices and corners the copy is told of; `None` if of more than values.
fn told_values(changes: &[SceneChange]) -> Option<[usize; 2]> {
    let mut told = [0; 2];
    for change in changes {
        let SceneChange::Values(_, change) = change else { return None };
        told[0] += change.positions.len();
        told[1] += change.corner_normals.len();
    }
    Some(told)
}

#[test]
fn moving_undoing_and_doing_again_change_values_alone() {
    let (mut document, mut copy) = (document(), Scene::new());
    run(&mut document, json!({ "op": "select", "objects": [1], "elements": [3, 7] }));
    tell(&mut document, &mut copy);
    run(&mut document, json!({ "op": "translate", "offset": [0, 1, 0] }));
    assert_eq!(told_values(&tell(&mut document, &mut copy)), Some([2, 0]));
    document.undo().expect("the move");
    assert_eq!(told_values(&tell(&mut document, &mut copy)), Some([2, 0]));
    document.redo().expect("the move");
    assert_eq!(told_values(&tell(&mut document, &mut copy)), Some([2, 0]));
    assert!(tell(&mut document, &mut copy).is_empty(), "nothing new");
    check(&mut document, &copy).expect("the same scene");
}

#[test]
fn normals_at_sharp_edges_follow_a_vertex_beside_them() {
    let (mut document, mut copy) = (document(), Scene::new());
    run(&mut document, json!({ "op": "set_element_kind", "kind": "edge" }));
    run(&mut document, json!({ "op": "select", "objects": [0], "elements": [0, 1, 2, 3] }));
    run(&mut document, json!({ "op": "mark_sharp" }));
    tell(&mut document, &mut copy);
    for offset in [[0.0, 0.3, 0.0], [0.1, 0.0, 0.2]] {
        run(&mut document, json!({ "op": "translate", "offset": offset }));
        let told = told_values(&tell(&mut document, &mut copy));
        assert!(told.is_some_and(|[_, normals]| normals > 0), "{told:?}");
        check(&mut document, &copy).expect("the same scene");
    }
}

#[test]
fn seams_and_creases_change_nothing_that_is_shown() {
    let (mut document, mut copy) = (document(), Scene::new());
    run(&mut document, json!({ "op": "set_element_kind", "kind": "edge" }));
    run(&mut document, json!({ "op": "select", "objects": [0], "elements": [0, 5] }));
    tell(&mut document, &mut copy);
    for op in ["mark_seam", "crease"] {
        run(&mut document, json!({ "op": op }));
        let told = told_values(&tell(&mut document, &mut copy));
        assert_eq!(told, Some([0, 0]), "{op}");
    }
}

#[test]
fn objects_that_are_moved_keep_their_meshes() {
    let (mut document, mut copy) = (document(), Scene::new());
    run(&mut document, json!({ "op": "leave_edit_mode" }));
    run(&mut document, json!({ "op": "select", "objects": [1] }));
    tell(&mut document, &mut copy);
    run(&mut document, json!({ "op": "translate", "offset": [0, 1, 0] }));
    assert_eq!(tell(&mut document, &mut copy), [SceneChange::Parts], "nodes alone");
    run(&mut document, json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } }));
    let changes = tell(&mut document, &mut copy);
    assert!(matches!(changes[..], [SceneChange::Mesh(_), SceneChange::Parts]), "{changes:?}");
    check(&mut document, &copy).expect("the same scene");
}

#[test]
fn hidden_elements_are_shown_again_in_object_mode_and_moved_around() {
    let (mut document, mut copy) = (document(), Scene::new());
    run(&mut document, json!({ "op": "set_element_kind", "kind": "face" }));
    run(&mut document, json!({ "op": "select", "objects": [1], "elements": [0, 1, 7] }));
    run(&mut document, json!({ "op": "hide" }));
    run(&mut document, json!({ "op": "select", "objects": [1], "elements": [4] }));
    let faces = |copy: &Scene| copy.meshes().iter().nth(1).expect("the grid").1.mesh().face_count();
    tell(&mut document, &mut copy);
    assert_eq!(faces(&copy), 12 - 3);
    run(&mut document, json!({ "op": "translate", "offset": [0, 1, 0] }));
    assert_eq!(told_values(&tell(&mut document, &mut copy)), Some([4, 0]), "the rest follows");
    check(&mut document, &copy).expect("the visible part");
    run(&mut document, json!({ "op": "leave_edit_mode" }));
    tell(&mut document, &mut copy);
    assert_eq!(faces(&copy), 12, "object mode shows all");
    check(&mut document, &copy).expect("all of it");
    document.undo().expect("edit mode again");
    tell(&mut document, &mut copy);
    assert_eq!(faces(&copy), 12 - 3);
}
