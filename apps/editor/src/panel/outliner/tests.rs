//! The outliner by name and pointer.

use egui_kittest::kittest::Queryable;
use trigon_document::mesh::primitives;
use trigon_document::scene::{Light, Material, Node, Scene};
use trigon_document::{RenameObject, ShowObjects};

use super::super::ShownDocument;
use super::super::testing::Case;
use super::*;

/// A table with a lamp on it, and a chair.
fn document() -> (Document, [NodeId; 3]) {
    let mut scene = Scene::new();
    let table = scene.add_object("Table", primitives::cube(1.0), Material::default());
    let lamp = Node::from_light(Light::point(1.0)).with_name("Lamp");
    let lamp = scene.add_child(table, lamp).expect("the table is there");
    let chair = scene.add_object("Chair", primitives::cube(1.0), Material::default());
    (Document::new(scene), [table, lamp, chair])
}

fn case(width: f32) -> (Case<OutlinerState>, [NodeId; 3]) {
    let (document, ids) = document();
    (Case::new([width, 320.0], document, OutlinerState::default(), panel), ids)
}

fn panel(ui: &mut Ui, shown: ShownDocument<'_>, state: &mut OutlinerState, requests: &mut Vec<Request>) {
    outliner(ui, shown.document, state, requests);
}

fn selected(case: &mut Case<OutlinerState>) -> Vec<NodeId> {
    case.document().selection().objects.iter().copied().collect()
}

#[test]
fn a_click_selects_and_modifiers_add() {
    let (mut case, [table, lamp, chair]) = case(200.0);
    case.click("Lamp");
    assert_eq!(selected(&mut case), [lamp], "one");
    case.take_requests();
    case.click("Lamp");
    assert_eq!(case.take_requests(), [], "it is selected already");
    case.harness.get_by_label("Chair").click_modifiers(Modifiers::COMMAND);
    case.run();
    assert_eq!(selected(&mut case), [lamp, chair], "one more");
    assert_eq!(case.document().selection().active, Some(chair), "the last is active");
    case.harness.get_by_label("Table").click_modifiers(Modifiers::SHIFT);
    case.run();
    assert_eq!(selected(&mut case), [table, lamp, chair], "the range");
    assert_eq!(case.document().selection().active, Some(table), "its end is active");
    case.image("outliner");
    case.command(serde_json::json!({ "op": "edit_objects" }));
    case.click("Lamp");
    assert!(!case.document().selection().is_editing(), "whole objects are selected in object mode");
    assert_eq!(selected(&mut case), [lamp], "one");
}

#[test]
fn the_eye_hides_and_shows() {
    let (mut case, [table, ..]) = case(200.0);
    case.click("Hide Table");
    let hide = ShowObjects { objects: vec![ObjectName::of(table)], visible: false };
    assert_eq!(case.take_requests(), [Request::Run(hide.into())], "hidden");
    case.click("Show Table");
    assert!(case.document().nodes().node(table).expect("it is there").visible, "shown");
}

#[test]
fn names_are_typed_in_place() {
    let (mut case, [_, lamp, chair]) = case(200.0);
    case.click("Lamp");
    case.harness.get_by_label("Lamp").hover();
    case.harness.key_press(Key::F2);
    case.run();
    case.take_requests();
    case.harness.event(egui::Event::Text("Lamp 2".to_owned()));
    case.run();
    case.harness.key_press(Key::Enter);
    case.run();
    let rename = RenameObject { object: ObjectName::of(lamp), name: "Lamp 2".to_owned() };
    assert_eq!(
        case.take_requests(),
        [Request::Run(rename.into())],
        "F2: what is typed replaces the name, and Enter takes it"
    );
    let place = case.harness.get_by_label("Chair");
    place.click();
    place.click();
    case.run();
    case.take_requests();
    case.harness.event(egui::Event::Text("s".to_owned()));
    case.run();
    case.harness.key_press(Key::Escape);
    case.run();
    assert_eq!(case.take_requests(), [], "Escape leaves the name");
    assert_eq!(case.document().nodes().node(chair).expect("it is there").name, "Chair", "as it was");
}

#[test]
fn searching_shows_what_is_found_and_where_it_hangs() {
    let (mut case, _) = case(200.0);
    case.click("Fold Table");
    assert!(case.harness.query_by_label("Lamp").is_none(), "folded");
    case.harness.get_by_label("Search objects").click();
    case.run();
    case.harness.event(egui::Event::Text("LAM".to_owned()));
    case.run();
    assert!(case.harness.query_by_label("Lamp").is_some(), "found, though folded");
    assert!(case.harness.query_by_label("Table").is_some(), "and what it hangs on");
    assert!(case.harness.query_by_label("Chair").is_none(), "nothing else");
}

#[test]
fn rows_are_hung_on_one_another_and_reordered_by_the_menu() {
    let (mut case, [table, lamp, chair]) = case(200.0);
    let menu = |case: &mut Case<OutlinerState>, row: &str, item: &str| {
        case.harness.get_by_label(row).click_secondary();
        case.run();
        case.image("outliner_menu");
        case.click(item);
    };
    menu(&mut case, "Chair", "Move up");
    assert_eq!(case.document().nodes().roots().collect::<Vec<_>>(), [chair, table], "reordered");
    case.click("Chair");
    case.harness.get_by_label("Lamp").click_modifiers(Modifiers::COMMAND);
    case.run();
    menu(&mut case, "Table", "Delete");
    assert!(case.document().nodes().node(table).is_none(), "the right button selects what it is over");
    case.document().undo().expect("deleted");
    case.document().undo().expect("selected");
    case.run();
    menu(&mut case, "Lamp", "Parent the other selected here");
    let parent =
        |case: &mut Case<OutlinerState>, id| case.document().nodes().node(id).expect("there").parent();
    assert_eq!(parent(&mut case, chair), Some(lamp), "the other one hangs there");
    menu(&mut case, "Chair", "Clear parent");
    assert_eq!(parent(&mut case, chair), None, "and on nothing again");
}

#[test]
fn rows_are_dragged_onto_and_between_rows() {
    let (mut case, [table, lamp, chair]) = case(200.0);
    let drag = |case: &mut Case<OutlinerState>, from: &str, to: egui::Pos2| {
        let from = case.harness.get_by_label(from).rect().center();
        case.harness.drag_at(from);
        case.run();
        case.harness.hover_at(from + egui::vec2(0.0, 8.0));
        case.run();
        case.harness.hover_at(to);
        case.run();
        case.image("outliner_drag");
        case.harness.drop_at(to);
        case.run();
    };
    let on = case.harness.get_by_label("Table").rect();
    drag(&mut case, "Chair", on.center());
    let children = case.document().nodes().node(table).expect("there").children().to_vec();
    assert_eq!(children, [lamp, chair], "onto it");
    let above = case.harness.get_by_label("Lamp").rect().center_top() + egui::vec2(0.0, 1.0);
    drag(&mut case, "Chair", above);
    let children = case.document().nodes().node(table).expect("there").children().to_vec();
    assert_eq!(children, [chair, lamp], "before it");
    drag(&mut case, "Lamp", egui::pos2(100.0, 300.0));
    assert_eq!(case.document().nodes().roots().collect::<Vec<_>>(), [table, lamp], "below all");
    case.run();
    let above = case.harness.get_by_label("Table").rect().center_top() + egui::vec2(0.0, 1.0);
    drag(&mut case, "Chair", above);
    assert_eq!(case.document().nodes().roots().collect::<Vec<_>>(), [chair, table, lamp], "among the roots");
}

#[test]
fn of_ten_thousand_rows_only_those_in_view_are_laid_out() {
    let mut scene = Scene::new();
    for index in 0..10_000 {
        scene.add(Node::default().with_name(format!("Object {index}")));
    }
    let case = Case::new([200.0, 300.0], Document::new(scene), OutlinerState::default(), panel);
    let texts = case.harness.output().shapes.iter();
    let texts = texts.filter(|clipped| matches!(clipped.shape, egui::Shape::Text(_))).count();
    // A name in each of the rows of some 20 points.
    assert!((10..20).contains(&texts), "{texts} texts");
}

#[test]
fn a_narrow_outliner_keeps_its_eyes_in_view() {
    let (mut case, _) = case(160.0);
    case.assert_nothing_is_clipped();
    let eye = case.harness.get_by_label("Hide Lamp").rect();
    assert!(eye.right() <= 160.0, "{eye}");
    case.image("outliner_narrow");
}
