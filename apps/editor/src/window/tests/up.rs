//! +Z up on the screen: keys, menus, panels and overlays, with a document that has +Y up.

use egui_kittest::kittest::NodeT as _;
use serde_json::json;
use trigon_document::scene::math::{DQuat, DVec3};
use trigon_window::scene::camera::AxisView;

use super::*;
use crate::overlay::axis_view_at;
use crate::request::UiRequest;
use crate::up::Up;
use crate::window::open_file::{Answer, Question};

impl Worked {
    fn show_up(&mut self, up: Up) {
        self.editor.perform(&mut self.stage, Request::Ui(UiRequest::Up(up)));
    }

    fn with_z_up() -> Self {
        let mut worked = Self::new();
        worked.show_up(Up::Z);
        worked
    }
}

#[test]
fn g_z_moves_up_and_g_y_to_the_back_as_in_blender() {
    for (keys, expected) in [
        ("gz2!", DVec3::Y * 2.0),
        ("gy2!", DVec3::NEG_Z * 2.0),
        ("gx2!", DVec3::X * 2.0),
        // The object's own axes, which are the world's.
        ("gzz2!", DVec3::Y * 2.0),
    ] {
        let mut worked = Worked::with_z_up();
        worked.keys(keys);
        assert_eq!(worked.place(), expected, "{keys}");
    }
    let mut worked = Worked::with_z_up();
    worked.keys("gz");
    let status = worked.editor.tool.as_ref().expect("it runs").status();
    assert!(status.contains("along global Z"), "{status}");
}

#[test]
fn s_z_and_r_z_work_about_what_is_up() {
    let mut worked = Worked::with_z_up();
    worked.keys("sz3!");
    let cube = worked.editor.document.selection().active.expect("the cube");
    let world = worked.stage.scene.world_transform(cube).to_scale_rotation_translation();
    assert!(world.0.distance(DVec3::new(1.0, 3.0, 1.0)) < 1e-12, "higher: {}", world.0);
    let mut worked = Worked::with_z_up();
    worked.keys("rz90!");
    let world = worked.stage.scene.world_transform(cube).to_scale_rotation_translation();
    let expected = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    // Rounding of the angle.
    assert!(world.1.dot(expected).abs() > 1.0 - 1e-12, "turned on the floor: {}", world.1);
}

#[test]
fn a_mirror_of_the_menu_is_across_the_axis_that_it_names() {
    let names = [
        ("mesh.mirror_x", [-1.0, 1.0, 1.0]),
        ("mesh.mirror_y", [1.0, 1.0, -1.0]),
        ("mesh.mirror_z", [1.0, -1.0, 1.0]),
    ];
    for (name, sign) in names {
        let mut worked = Worked::with_z_up();
        worked.keys(">");
        let mesh = |worked: &Worked| {
            let (id, _) = worked.editor.document.selection().meshes().next().expect("edited");
            worked.editor.document.mesh(id).expect("edited").clone()
        };
        let command = json!({ "op": "select_within", "min": [0.0, 0.0, 0.0] });
        worked.editor.run(serde_json::from_value(command).expect("a command"));
        let before = mesh(&worked);
        let action = crate::window::actions::named(name).expect("in the table");
        worked.editor.choose(&mut worked.stage, action);
        let after = mesh(&worked);
        let corner = before.vertices().find(|&vertex| before.position(vertex).min_element() > 0.0);
        let corner = corner.expect("one corner has three positive coordinates");
        let expected = before.position(corner).to_array();
        let expected: Vec<f32> = expected.iter().zip(sign).map(|(at, sign)| at * sign).collect();
        assert_eq!(after.position(corner).to_array()[..], expected[..], "{name}");
    }
}

#[test]
fn panels_show_and_take_positions_with_z_up() {
    let mut harness = harness();
    harness.state_mut().show_up(Up::Z);
    let command = json!({ "op": "set_transform", "object": "Cube", "location": [1.0, 2.0, 3.0], "scale": [1.0, 4.0, 1.0] });
    harness.state_mut().editor.run(serde_json::from_value(command).expect("a command"));
    harness.run();
    let value = |harness: &Harness<'_, Worked>, label: &str| {
        harness
            .get_all_by_label(label)
            .next_back()
            .and_then(|node| node.accesskit_node().value())
            .unwrap_or_default()
    };
    let shown = ["X", "Y", "Z"].map(|axis| value(&harness, &format!("Location {axis}")));
    assert_eq!(shown, ["X 1 m", "Y -3 m", "Z 2 m"], "x, −z, y");
    assert_eq!(value(&harness, "Scale Z"), "Z 4", "the height");
    // The panel at the right comes after that of the last operation.
    harness.get_all_by_label("Location Z").next_back().expect("a field").click();
    harness.run();
    harness.event(trigon_window::egui::Event::Text("7".into()));
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(harness.state().place(), DVec3::new(1.0, 7.0, 3.0), "up is the document's y");
}

#[test]
fn the_ball_of_z_in_the_corner_looks_from_above() {
    let mut worked = Worked::with_z_up();
    for (up, name) in [(Up::Y, 1), (Up::Z, 2)] {
        worked.show_up(up);
        let pane = worked.stage.pane_at(trigon_window::scene::math::DVec2::ZERO);
        let view = worked.editor.overlay_view(&worked.stage, &pane);
        let direction = up.axes().col(name);
        assert_eq!(direction, DVec3::Y, "what is up");
        let in_view = view.camera().orientation.conjugate() * direction * 34.0;
        let center = trigon_window::egui::pos2(300.0, 300.0);
        let ball = center + trigon_window::egui::vec2(in_view.x as f32, -in_view.y as f32);
        assert_eq!(axis_view_at(&view, center, ball), Some(AxisView::Top), "{up:?}");
    }
}

#[test]
fn what_is_saved_does_not_depend_on_what_is_shown_as_up() {
    let mut worked = Worked::with_z_up();
    worked.keys("gz2!");
    let saved = worked.bytes();
    let mut other = Worked::new();
    other.keys("gy2!");
    assert_eq!(saved, other.bytes(), "the same document");
}

#[test]
fn which_axis_is_up_is_asked_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let start = || {
        let mut stage = Stage::new("test");
        settings::prepare(&mut stage);
        let mut editor = Editor::new(Keys::default(), Some(folder.path().into()), Vec::new());
        editor.start(&mut stage);
        Worked { editor, stage }
    };
    let mut first = start();
    assert!(matches!(first.editor.question, Some(Question::Up)), "at the first start");
    first.editor.answer(&mut first.stage, Answer::Up(Up::Z));
    let second = start();
    assert!(second.editor.question.is_none(), "and never again");
    assert_eq!(second.editor.up(), Up::Z, "as it was answered");
    assert!(Worked::new().editor.question.is_none(), "not where the answer would be forgotten");
}

#[test]
fn alt_e_opens_the_menu_of_extrusions_and_faces_go_along_their_normals() {
    let mut worked = Worked::on_faces();
    worked.keys("a");
    worked.key(WindowKey::Character('e'), Modifiers::ALT);
    let popup = worked.editor.popup.as_ref().expect("it is open");
    let names: Vec<_> =
        popup.entries(&worked.editor.document).iter().map(|entry| entry.action.name).collect();
    assert_eq!(names, ["mesh.extrude", "extrude.along_normals", "mesh.extrude_individual"], "its entries");
    let action = crate::window::actions::named("extrude.along_normals").expect("in the table");
    worked.editor.choose(&mut worked.stage, action);
    worked.keys("0.5!");
    let (id, _) = worked.editor.document.selection().meshes().next().expect("edited");
    let mesh = worked.editor.document.mesh(id).expect("edited");
    let farthest = mesh.vertices().map(|vertex| mesh.position(vertex).length()).fold(0.0, f32::max);
    // A corner of the cube of 2 m lies √3 from the middle, and goes half a metre along its diagonal.
    assert!((farthest - (3f32.sqrt() + 0.5)).abs() < 1e-4, "{farthest}");
}
