//! The properties by name.

use egui_kittest::kittest::Queryable;
use serde_json::json;
use trigon_document::mesh::math::DVec3;
use trigon_document::mesh::primitives;
use trigon_document::scene::{Light, Material, Node, NodeId, Scene};
use trigon_document::{Command, Crease, Document, SetMaterial, SurfaceAlpha, TextureSlot, Translate};

use super::super::testing::Case;
use super::*;

fn case(width: f32, height: f32) -> (Case<PropertiesState>, [NodeId; 2]) {
    let mut scene = Scene::new();
    let cube = scene.add_object("Cube", primitives::cube(2.0), Material::default().with_name("Plastic"));
    let lamp = scene.add(Node::from_light(Light::spot(3.0)).with_name("Lamp"));
    let case = Case::new([width, height], Document::new(scene), PropertiesState::default(), properties);
    (case, [cube, lamp])
}

fn select(case: &mut Case<PropertiesState>, name: &str) {
    case.command(json!({ "op": "select", "objects": [name] }));
    case.take_requests();
}

#[test]
fn an_exact_transform_is_typed() {
    let (mut case, [cube, _]) = case(260.0, 900.0);
    select(&mut case, "Cube");
    case.type_number("Location X", "1.25");
    case.type_number("Rotation Z", "90");
    case.type_number("Scale Y", "-2");
    let transform = case.document().nodes().node(cube).expect("it is there").transform.to_affine();
    assert_eq!(transform.translation, DVec3::new(1.25, 0.0, 0.0), "placed");
    // The sine of a right angle, rounded.
    let turned = transform.transform_vector3(DVec3::X);
    assert!(turned.abs_diff_eq(DVec3::Y, 1e-15), "turned: {turned}");
    assert!(transform.transform_vector3(DVec3::Y).abs_diff_eq(DVec3::X * 2.0, 1e-15), "mirrored and scaled");
    assert_eq!(case.take_requests().len(), 3, "a command for each");
    case.choose("Rotation as", "Quaternion");
    let field = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Rotation W");
    assert_eq!(field.value().as_deref(), Some("W 0.707107"), "half of a right angle");
    case.image("properties");
}

#[test]
fn typed_angles_stay_beyond_half_a_turn() {
    let (mut case, _) = case(260.0, 900.0);
    select(&mut case, "Cube");
    case.type_number("Rotation Y", "120");
    let field = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Rotation Y");
    assert_eq!(field.value().as_deref(), Some("Y 120°"), "not 60° and two half turns");
}

#[test]
fn a_place_in_the_world_is_shown_and_typed() {
    let (mut case, [cube, lamp]) = case(260.0, 900.0);
    case.command(
        json!({ "op": "set_transform", "object": "Cube", "location": [5, 0, 0], "scale": [2, 2, 2] }),
    );
    case.command(json!({ "op": "set_parent", "objects": ["Lamp"], "parent": "Cube" }));
    select(&mut case, "Lamp");
    case.choose("Space", "World");
    let field = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Location X");
    assert_eq!(field.value().as_deref(), Some("X 5 m"), "where its parent is");
    case.type_number("Location X", "6");
    let local = case.document().nodes().node(lamp).expect("it is there").transform.translation();
    assert_eq!(local, DVec3::new(0.5, 0.0, 0.0), "half as far, under a parent of twice the size");
    assert_eq!(case.document().nodes().node(cube).expect("there").transform.translation().x, 5.0, "it stays");
}

#[test]
fn a_light_has_its_parameters() {
    let (mut case, [_, lamp]) = case(260.0, 900.0);
    select(&mut case, "Lamp");
    case.type_number("Intensity", "7.5");
    case.type_number("Outer angle", "30");
    case.click("Limited range");
    case.type_number("Range", "4");
    case.type_number("Radius", "0.25");
    let light =
        case.document().nodes().node(lamp).and_then(|node| node.light.clone()).expect("it is a light");
    assert_eq!((light.intensity, light.range, light.radius), (7.5, 4.0, 0.25), "as typed");
    let trigon_document::scene::LightKind::Spot { outer, .. } = light.kind else { panic!("it is a spot") };
    assert_eq!(outer, 30f32.to_radians(), "shown in degrees");
    case.image("properties_light");
    case.choose("Kind", "Point");
    assert!(case.harness.query_by_label("Outer angle").is_none(), "a point has no cone");
}

#[test]
fn a_material_has_its_values_and_images() {
    let (mut case, [cube, _]) = case(260.0, 1100.0);
    select(&mut case, "Cube");
    case.choose("Surface", "Physical");
    case.type_number("Metallic", "1");
    case.choose("Alpha mode", "Mask");
    case.take_requests();
    case.type_number("Alpha cutoff", "0.25");
    let expected =
        SetMaterial { material: Some(trigon_document::MaterialName::Number(0)), ..SetMaterial::default() };
    let cutoff = SetMaterial { alpha_cutoff: Some(0.25), ..expected.clone() };
    assert_eq!(case.take_requests(), [Request::Run(cutoff.into())], "one value");
    case.click("Open Normal map");
    let choose = Request::ChooseTexture {
        material: trigon_document::MaterialName::Number(0),
        slot: TextureSlot::Normal,
    };
    assert_eq!(case.take_requests(), [choose], "the editor asks for a file");
    case.choose("Alpha mode", "Blend");
    let blend = SetMaterial { alpha: Some(SurfaceAlpha::Blend), ..expected };
    assert_eq!(case.take_requests(), [Request::Run(blend.into())], "chosen");
    case.click("New");
    let slots = |case: &mut Case<PropertiesState>| {
        case.document().nodes().node(cube).expect("it is there").materials.clone()
    };
    let new = slots(&mut case);
    assert_eq!(new.len(), 1, "in object mode the new material takes the chosen slot");
    case.choose("Material", "Plastic");
    assert_ne!(slots(&mut case), new, "the first material again");
    case.command(json!({ "op": "edit_objects", "objects": ["Cube"] }));
    case.click("New");
    assert_eq!(slots(&mut case).len(), 2, "in edit mode it gets a slot for faces that are chosen later");
    case.image("properties_material");
}

#[test]
fn selected_vertices_are_moved_by_their_median() {
    let (mut case, _) = case(260.0, 900.0);
    case.command(json!({ "op": "edit_objects", "objects": ["Cube"] }));
    case.command(json!({ "op": "select", "elements": [0] }));
    case.take_requests();
    case.type_number("Vertex X", "3");
    let requests = case.take_requests();
    let [Request::Run(Command::Translate(Translate { offset, .. }))] = &requests[..] else {
        panic!("a move: {requests:?}")
    };
    assert_eq!(offset.map(f64::abs)[1..], [0.0, 0.0], "along x only");
    let field = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Vertex X");
    assert_eq!(field.value().as_deref(), Some("X 3 m"), "there it is");
    case.click("Reset to original positions");
    let field = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Vertex X");
    assert_ne!(field.value().as_deref(), Some("X 3 m"), "where it was made");
    case.command(json!({ "op": "set_element_kind", "kind": "edge" }));
    case.command(json!({ "op": "select", "elements": [0, 1] }));
    case.type_number("Mean crease", "0.5");
    assert!(case.take_requests().contains(&Request::Run(Crease { crease: 0.5 }.into())), "both edges");
    case.image("properties_elements");
}

/// The middle and the crease are kept while what they depend on is unchanged.
#[test]
fn values_of_elements_follow_moves_creases_and_selections() {
    let (mut case, _) = case(260.0, 900.0);
    let shown = |case: &Case<PropertiesState>, label: &str| {
        let field = case.harness.query_by_role_and_label(egui::Role::SpinButton, label);
        field.and_then(|field| field.value())
    };
    case.command(json!({ "op": "edit_objects", "objects": ["Cube"] }));
    case.command(json!({ "op": "set_element_kind", "kind": "edge" }));
    case.command(json!({ "op": "select", "elements": [0] }));
    case.command(json!({ "op": "crease", "crease": 0.5 }));
    assert_eq!(shown(&case, "Crease").as_deref(), Some("0.5"), "of one edge");
    let (before, crease) = (shown(&case, "Median X"), shown(&case, "Crease"));
    let moved: Command =
        serde_json::from_value(json!({ "op": "translate", "offset": [7, 0, 0] })).expect("valid");
    for _ in 0..2 {
        case.document().preview(moved.clone()).expect("it can be done");
        case.run();
    }
    assert_ne!(shown(&case, "Median X"), before, "moved");
    assert_eq!(shown(&case, "Crease"), crease, "the same edge");
    assert!(case.document().cancel(), "it was a preview");
    case.run();
    assert_eq!(shown(&case, "Median X"), before, "where it was");
    case.command(json!({ "op": "crease", "crease": 0.75 }));
    assert_eq!(shown(&case, "Crease").as_deref(), Some("0.75"), "another value");
    case.command(json!({ "op": "select", "elements": [1] }));
    assert_eq!(shown(&case, "Crease").as_deref(), Some("0"), "another edge");
    case.command(json!({ "op": "select", "elements": [0, 1] }));
    assert_eq!(shown(&case, "Mean crease").as_deref(), Some("0.375"), "both");
    case.command(json!({ "op": "set_element_kind", "kind": "vertex" }));
    case.command(json!({ "op": "select", "elements": [0] }));
    assert_eq!(shown(&case, "Mean crease").or(shown(&case, "Crease")), None, "no edge is between one vertex");
    *case.document() = Document::new(Scene::new());
    case.run();
    assert_eq!(shown(&case, "Vertex X"), None, "another document");
}

#[test]
fn a_drag_of_a_value_is_undone_as_one() {
    let (mut case, [cube, _]) = case(260.0, 900.0);
    select(&mut case, "Cube");
    let entries = case.document().history().done().len();
    for round in 1..=2 {
        let field = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Location X").rect().center();
        case.harness.drag_at(field);
        case.run();
        for step in 1..6 {
            case.harness.hover_at(field + egui::vec2(20.0 * step as f32, 0.0));
            case.run();
        }
        case.harness.drop_at(field + egui::vec2(100.0, 0.0));
        case.run();
        assert_eq!(case.document().history().done().len(), entries + round, "one entry for each drag");
    }
    let moved = case.document().nodes().node(cube).expect("it is there").transform.translation().x;
    assert!(moved > 1.0, "{moved}");
}

#[test]
fn leaving_a_field_rounds_nothing() {
    let (mut case, [cube, _]) = case(260.0, 900.0);
    let exact = 1.0 / 3.0;
    case.command(json!({ "op": "set_transform", "object": "Cube", "location": [exact, 0, 0] }));
    select(&mut case, "Cube");
    case.harness.get_by_role_and_label(egui::Role::SpinButton, "Location X").click();
    case.run();
    case.harness.key_press(egui::Key::Enter);
    case.run();
    assert_eq!(case.take_requests(), [], "nothing was typed");
    assert_eq!(
        case.document().nodes().node(cube).expect("there").transform.translation().x,
        exact,
        "all digits"
    );
}

#[test]
fn a_narrow_panel_clips_no_label() {
    let (mut case, _) = case(160.0, 1500.0);
    for object in ["Cube", "Lamp"] {
        select(&mut case, object);
        case.assert_nothing_is_clipped();
        case.image(&format!("properties_narrow_{object}"));
    }
    case.command(json!({ "op": "edit_objects", "objects": ["Cube"] }));
    case.command(json!({ "op": "select_all" }));
    case.assert_nothing_is_clipped();
}

/// Nothing was seen of an alpha below 1.
#[test]
fn who_lowers_alpha_sees_through() {
    let (mut case, _) = case(260.0, 900.0);
    select(&mut case, "Cube");
    case.type_number("Alpha", "0.5");
    let requests = case.take_requests();
    let [Request::Run(Command::SetMaterial(SetMaterial { alpha, base_color, .. }))] = &requests[..] else {
        panic!("one command: {requests:?}")
    };
    assert_eq!((*alpha, base_color.map(|color| color[3])), (Some(SurfaceAlpha::Blend), Some(0.5)), "both");
    case.choose("Alpha mode", "Mask");
    case.take_requests();
    case.type_number("Alpha", "0.25");
    let requests = case.take_requests();
    let [Request::Run(Command::SetMaterial(SetMaterial { alpha: None, .. }))] = &requests[..] else {
        panic!("what was chosen stays: {requests:?}")
    };
}

#[test]
fn modifiers_are_added_switched_moved_and_removed_in_the_panel() {
    let (mut case, [cube, _]) = case(320.0, 1400.0);
    select(&mut case, "Cube");
    let names = |case: &mut Case<PropertiesState>| -> Vec<(&'static str, bool)> {
        let document = case.document();
        let mesh = document.nodes().node(cube).and_then(|node| node.mesh).expect("the cube's");
        let stack = document.mesh(mesh).expect("it has modifiers").modifiers();
        stack.iter().map(|stacked| (stacked.modifier.name(), stacked.is_on)).collect()
    };
    for name in ["Mirror", "Array"] {
        case.click("Add Modifier");
        case.harness.get_all_by_label(name).last().expect("the menu is open").click();
        case.run();
    }
    assert_eq!(names(&mut case), [("Mirror", true), ("Array", true)]);
    case.image("modifiers");
    case.click("Axes Y");
    case.type_number("Count", "5");
    let mesh = case.document().nodes().node(cube).and_then(|node| node.mesh).expect("the cube's");
    let mirror = &case.document().mesh(mesh).expect("it has modifiers").modifiers()[0].modifier;
    let trigon_document::Modifier::Mirror(mirror) = mirror else { panic!("{mirror:?}") };
    assert_eq!(mirror.axes, [true, true, false], "and y");
    case.click("Mirror");
    case.click("Move down Mirror");
    assert_eq!(names(&mut case), [("Array", true), ("Mirror", false)]);
    let array = &case.document().mesh(mesh).expect("it has modifiers").modifiers()[0].modifier;
    let trigon_document::Modifier::Array(array) = array else { panic!("{array:?}") };
    assert_eq!(array.count, 5, "what was typed");
    case.click("Apply Array");
    assert_eq!(names(&mut case), [("Mirror", false)]);
    assert_eq!(case.document().mesh(mesh).expect("it is edited").face_count(), 30, "five cubes");
    case.click("Remove Mirror");
    assert_eq!(names(&mut case), []);
}

#[test]
fn vertex_groups_are_assigned_selected_and_removed_in_the_panel() {
    let (mut case, [cube, _]) = case(320.0, 1400.0);
    select(&mut case, "Cube");
    assert!(case.harness.query_by_label("Vertex Groups").is_none(), "there is none");
    case.command(json!({ "op": "edit_objects" }));
    case.command(json!({ "op": "select", "elements": [0, 1] }));
    case.command(json!({ "op": "add_vertex_group", "name": "top" }));
    let mesh = case.document().nodes().node(cube).and_then(|node| node.mesh).expect("the cube's");
    let count = |case: &mut Case<PropertiesState>, name: &str| {
        let group = case.document().mesh(mesh).expect("it is edited").vertex_group(name);
        group.map(|group| group.vertices().count())
    };
    assert_eq!(count(&mut case, "top"), Some(2), "the selected ones");
    case.command(json!({ "op": "select_all" }));
    case.click("Deselect top");
    let selected =
        |case: &mut Case<PropertiesState>| case.document().selection().of(mesh).map(|all| all.len());
    assert_eq!(selected(&mut case), Some(6), "the others");
    case.click("Assign top");
    assert_eq!(count(&mut case, "top"), Some(8), "all");
    case.click("Unassign top");
    case.click("Select top");
    assert_eq!((count(&mut case, "top"), selected(&mut case)), (Some(2), Some(8)));
    case.click("Add Vertex Group");
    assert_eq!(count(&mut case, "Group"), Some(8), "with the selected ones");
    case.assert_nothing_is_clipped();
    case.click("Remove top");
    assert_eq!((count(&mut case, "top"), count(&mut case, "Group")), (None, Some(8)));
}

#[test]
fn a_modifier_says_which_object_it_lacks() {
    let (mut case, _) = case(320.0, 1400.0);
    select(&mut case, "Cube");
    let add =
        |object: &str| json!({ "op": "add_modifier", "modifier": { "kind": "boolean", "object": object } });
    case.command(add(""));
    assert!(case.harness.query_by_label_contains("Choose the other object").is_some());
    case.command(add("Ball"));
    assert!(case.harness.query_by_label_contains("There is no object Ball").is_some(), "it was deleted");
}
