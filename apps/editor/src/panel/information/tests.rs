//! Counts and measures of known bodies.

use egui_kittest::kittest::Queryable;
use serde_json::json;
use trigon_document::mesh::primitives;
use trigon_document::scene::{Material, Scene};

use super::super::testing::Case;
use super::*;

fn case(width: f32) -> Case<InformationState> {
    let mut scene = Scene::new();
    scene.add_object("Cube", primitives::cube(2.0), Material::default());
    scene.add_object("Grid", primitives::grid(1.0, 1.0, 2, 2), Material::default());
    let controls =
        [("Middle mouse button".to_owned(), "orbit".to_owned()), ("A".to_owned(), "select all".to_owned())];
    Case::new(
        [width, 640.0],
        Document::new(scene),
        InformationState::default(),
        move |ui, shown, state, _| {
            information(ui, shown, state, &controls);
        },
    )
}

/// All text in view.
fn text(case: &Case<InformationState>) -> String {
    let texts = case.harness.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
        egui::Shape::Text(text) => Some(text.galley.text().to_owned()),
        _ => None,
    });
    texts.collect::<Vec<_>>().join("\n")
}

#[test]
fn a_cube_of_two_metres_is_measured() {
    let mut case = case(260.0);
    case.command(json!({ "op": "select", "objects": ["Cube"] }));
    let shown = text(&case);
    for expected in
        ["Selected: Cube", "Vertices\n17\n8", "Edges\n24\n12", "Triangles\n20\n12", "X\n2 m\n-1 m"]
    {
        assert!(shown.contains(expected), "{expected:?} in\n{shown}");
    }
    case.click("Measure selection");
    let shown = text(&case);
    for expected in ["Surface: 24 m²", "Volume: 8 m³", "Watertight: yes"] {
        assert!(shown.contains(expected), "{expected:?} in\n{shown}");
    }
    case.image("information");
    case.command(json!({ "op": "translate", "offset": [1, 0, 0] }));
    assert!(!text(&case).contains("Volume"), "measured before it was changed");
}

/// 8 cm³ of 1.24 and of 1.04 g/cm³; then ten times as wide, high and deep.
#[test]
fn a_closed_body_is_weighed_of_the_chosen_material_as_it_stands_in_the_world() {
    let mut scene = Scene::new();
    scene.add_object("Cube", primitives::cube(0.02), Material::default());
    let (document, state) = (Document::new(scene), InformationState::default());
    let mut case = Case::new([260.0, 640.0], document, state, |ui, shown, state, _| {
        information(ui, shown, state, &[]);
    });
    case.command(json!({ "op": "select", "objects": ["Cube"] }));
    case.click("Measure selection");
    let shown = text(&case);
    assert!(shown.contains("Volume: 8 cm³") && shown.contains("Weight: 9.92 g"), "{shown}");
    case.choose("Material", "ABS");
    assert!(text(&case).contains("Weight: 8.32 g"), "{}", text(&case));
    case.command(json!({ "op": "scale", "factors": [10, 10, 10] }));
    case.click("Measure selection");
    let shown = text(&case);
    let lines = ["Volume: 8 cm³", "Volume in the world: 0.008 m³", "Weight: 8.32 kg"];
    assert!(lines.iter().all(|line| shown.contains(line)), "{shown}");
}

#[test]
fn elements_are_measured() {
    let mut case = case(260.0);
    case.command(json!({ "op": "edit_objects", "objects": ["Cube"] }));
    case.command(json!({ "op": "set_element_kind", "kind": "edge" }));
    case.command(json!({ "op": "select", "elements": [0] }));
    case.click("Measure selection");
    let shown = text(&case);
    for expected in
        ["Selected: 1 edge", "Length of edges: 2 m", "Angle between its faces: 90°", "Distance: 2 m"]
    {
        assert!(shown.contains(expected), "{expected:?} in\n{shown}");
    }
    case.command(json!({ "op": "set_element_kind", "kind": "face" }));
    case.command(json!({ "op": "select", "elements": [0, 1] }));
    case.click("Measure selection");
    assert!(text(&case).contains("Area of faces: 8 m²"), "{}", text(&case));
}

#[test]
fn an_open_grid_is_not_watertight() {
    let mut case = case(260.0);
    case.command(json!({ "op": "select", "objects": ["Grid"] }));
    case.click("Measure selection");
    let shown = text(&case);
    assert!(shown.contains("Watertight: no") && shown.contains("Open borders: 1"), "{shown}");
}

#[test]
fn a_narrow_panel_clips_no_label() {
    let mut case = case(160.0);
    case.command(json!({ "op": "select_all" }));
    case.click("Measure selection");
    case.assert_nothing_is_clipped();
    assert!(case.harness.query_by_label("Middle mouse button").is_some(), "the keys are there");
    case.image("information_narrow");
}
