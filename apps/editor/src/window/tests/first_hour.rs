//! Traps that people met in their first hour.

use std::path::Path;

use serde_json::json;
use trigon_document::scene::AlphaMode;
use trigon_document::scene::math::DVec3;

use super::*;
use crate::request::{DisplayMode, FileAction, FileRequest, SolidColor};
use crate::window::actions;

impl Worked {
    fn run(&mut self, command: serde_json::Value) {
        self.editor.run(serde_json::from_value(command).expect("a command"));
    }

    fn menu(&mut self, name: &str) {
        let action = actions::named(name).expect("there is such an action");
        self.editor.choose(&mut self.stage, action);
    }

    fn chord(&mut self, chord: &str) {
        let chord: trigon_window::Chord = chord.parse().expect("a chord");
        self.key(chord.key, chord.modifiers);
    }

    /// Vertices, edges or faces.
    fn selected_elements(&self) -> usize {
        self.editor.document.selection().meshes().map(|(_, elements)| elements.len()).sum()
    }
}

/// An empty scene pushed the properties out of the window, a little more in each pass.
#[test]
fn deleting_everything_leaves_the_panels_where_they_are() {
    let mut harness = harness();
    harness.run();
    let tabs = |harness: &Harness<'_, Worked>| harness.get_by_label("Properties").rect();
    let before = tabs(&harness);
    harness.state_mut().character('a');
    harness.state_mut().character('x');
    for _ in 0..20 {
        harness.run();
    }
    harness.get_by_label("The scene is empty.");
    assert_eq!(tabs(&harness), before, "no panel has moved");
}

/// A wide value made the panel wider, for good.
#[test]
fn the_side_panel_is_as_wide_as_its_user_made_it() {
    let mut harness = harness();
    harness.run();
    let left = |harness: &Harness<'_, Worked>| harness.get_by_label("Properties").rect().left();
    let before = left(&harness);
    harness.state_mut().run(json!({ "op": "translate", "offset": [-123_456.789_012, 1e-7, 3e300] }));
    harness.state_mut().run(json!({ "op": "rename_object", "object": "Cube", "name": "long ".repeat(60) }));
    for _ in 0..5 {
        harness.run();
    }
    assert_eq!(left(&harness), before, "the panel is where it was");
}

#[test]
fn the_tab_of_developers_is_shown_on_request() {
    let mut harness = harness();
    harness.run();
    assert!(harness.query_by_label("Development").is_none(), "usually it is not");
    harness.state_mut().menu("view.development");
    harness.run();
    harness.get_by_label("Development").click();
    harness.run();
    harness.state_mut().menu("view.development");
    harness.run();
    assert!(harness.query_by_label("Transform").is_some(), "the properties are there again");
}

/// With the keyboard in its field, the dialog stayed open and took the next keys.
#[test]
fn escape_closes_every_window_and_gives_the_keyboard_back() {
    for opens in ["Ctrl+O", "Ctrl+Shift+S", "F3", "F1", "F2", "Shift+A", "X"] {
        let mut harness = harness();
        if opens == "X" {
            harness.state_mut().chord("Tab");
            harness.state_mut().chord("A");
        }
        harness.state_mut().chord(opens);
        harness.run();
        harness.key_press(Key::Escape);
        harness.run();
        harness.run();
        let editor = &harness.state().editor;
        let is_open = editor.dialog.is_open() || editor.layout.help;
        let menus = editor.popup.is_some() || editor.search.is_some() || editor.rename.is_some();
        assert!(!is_open && !menus, "{opens} is closed");
        assert!(harness.ctx.memory(|memory| memory.focused().is_none()), "{opens} has no keyboard any more");
        assert_eq!(harness.state().objects(), 2, "{opens} changed nothing");
    }
}

#[test]
fn a_letter_chooses_from_a_menu_at_the_pointer() {
    let mut worked = Worked::new();
    for chord in ["Tab", "3", "A", "X", "F"] {
        worked.chord(chord);
    }
    assert_eq!(worked.faces(), 0, "X F deletes faces, also before the menu was shown");
    assert!(worked.editor.popup.is_none(), "and the menu is gone");
    worked.chord("Z");
    worked.chord("R");
    assert_eq!(worked.editor.view.display, DisplayMode::Rendered, "Z R");
    let mut harness = harness();
    harness.state_mut().chord("Shift+A");
    harness.run();
    for letter in ["t", "o", "r"] {
        harness.input_mut().events.push(trigon_window::egui::Event::Text(letter.into()));
        harness.run();
    }
    harness.key_press(Key::Enter);
    harness.run();
    let names: Vec<_> =
        harness.state().stage.scene.nodes().iter().map(|(_, node)| node.name.clone()).collect();
    assert_eq!(names, ["Cube", "Light", "Torus"], "typing searches a long menu");
}

#[test]
fn arrows_go_around_a_menu_at_the_pointer() {
    let mut harness = harness();
    harness.state_mut().chord("Ctrl+A");
    harness.run();
    harness.key_press(Key::ArrowUp);
    harness.run();
    let popup = harness.state().editor.popup.as_ref().expect("it is open");
    let entries = popup.entries(&harness.state().editor.document);
    assert_eq!(entries[popup.index].action.name, "apply.all", "before the first comes the last");
}

#[test]
fn a_file_is_chosen_from_its_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let inner = folder.path().join("models");
    std::fs::create_dir(&inner).expect("made");
    let path = inner.join("square.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").expect("written");
    std::fs::write(inner.join("notes.txt"), "").expect("written");
    let mut harness = harness();
    let Worked { editor, stage } = harness.state_mut();
    editor.file.path = Some(folder.path().join("none.glb"));
    editor.perform(stage, Request::File(FileRequest::Ask(FileAction::SaveAs)));
    harness.run();
    harness.get_by_label("models/").click();
    harness.run();
    assert!(harness.query_by_label("square.obj").is_none(), "no document of the editor's");
    harness.get_by_label("Cancel").click();
    harness.run();
    harness.state_mut().chord("Ctrl+O");
    harness.run();
    assert!(harness.query_by_label("notes.txt").is_none(), "no model");
    harness.get_by_label("square.obj").click();
    harness.run();
    harness.get_all_by_label("Open").last().expect("the button").click();
    harness.run();
    let Worked { editor, stage } = harness.state_mut();
    finish_load(editor, stage);
    assert_eq!(editor.file.path.as_deref(), Some(path.as_path()), "opened: {:?}", editor.message);
}

#[test]
fn the_local_view_gives_the_camera_back() {
    let mut worked = Worked::new();
    let before = worked.stage.orbit;
    worked.menu("view.local");
    assert_ne!(worked.stage.orbit, before, "the cube fills the view");
    worked.menu("view.local");
    assert_eq!(worked.stage.orbit, before, "as it was");
}

#[test]
fn a_new_document_has_the_cursor_and_the_pivot_where_they_usually_are() {
    let mut worked = Worked::new();
    worked.editor.tools.cursor = DVec3::ONE;
    worked.menu("pivot.cursor");
    let Worked { editor, stage } = &mut worked;
    editor.perform(stage, Request::File(FileRequest::Ask(FileAction::New)));
    assert_eq!(worked.editor.tools, settings::ToolSettings::default(), "as at the start");
}

#[test]
fn tab_edits_all_of_a_file_in_which_nothing_is_selected() {
    let mut worked = Worked::new();
    worked.menu("add.torus");
    worked.chord("Alt+A");
    worked.chord("Tab");
    assert_eq!(worked.editor.document.selection().meshes().count(), 2, "the cube and the torus");
    worked.chord("3");
    worked.chord("A");
    assert_eq!(worked.selected_elements(), 6 + 48 * 12, "all faces");
}

#[test]
fn a_side_is_seen_in_parallel_projection_until_it_is_left() {
    let mut harness = harness();
    harness.run();
    harness.state_mut().menu("view.right");
    harness.run();
    assert!(harness.state().stage.orbit.is_orthographic(), "a side");
    harness.state_mut().menu("view.top");
    harness.run();
    assert!(harness.state().stage.orbit.is_orthographic(), "another one");
    harness.state_mut().menu("view.orbit_left");
    harness.run();
    assert!(!harness.state().stage.orbit.is_orthographic(), "no side");
    harness.state_mut().menu("view.orthographic");
    harness.state_mut().menu("view.front");
    harness.run();
    harness.state_mut().menu("view.orbit_left");
    harness.run();
    assert!(harness.state().stage.orbit.is_orthographic(), "it was parallel before");
}

#[test]
fn the_chosen_slot_goes_to_the_selected_faces() {
    let mut harness = harness();
    harness.set_size(trigon_window::egui::vec2(1280.0, 1200.0));
    for chord in ["Tab", "3", "A"] {
        harness.state_mut().chord(chord);
    }
    harness.state_mut().run(json!({ "op": "select", "elements": [2, 4] }));
    harness.run();
    harness.get_by_label("New").click();
    harness.run();
    harness.get_by_label("Assign").click();
    harness.run();
    harness.state_mut().chord("Alt+A");
    harness.run();
    let assign = harness.get_by_label("Assign");
    assert!(assign.accesskit_node().is_disabled(), "no face is selected");
    harness.get_all_by_label("Select").last().expect("the button, after the menu").click();
    harness.run();
    assert_eq!(harness.state().selected_elements(), 2, "the faces of the new slot");
}

#[test]
fn dropped_images_become_textures_and_several_models_are_all_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let image = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/images/showcase.png");
    let mut worked = Worked::new();
    worked.editor.pointer = None;
    let Worked { editor, stage } = &mut worked;
    editor.dropped(stage, vec![image], Modifiers::NONE);
    assert_eq!(worked.objects(), 3, "a picture in the scene: {:?}", worked.editor.message);
    assert_eq!(worked.editor.document.nodes().textures.iter().count(), 1, "with its image");
    let view = &worked.editor.view;
    assert_eq!((view.display, view.solid), (DisplayMode::Solid, SolidColor::Texture), "which is shown");
    let paths: Vec<_> = ["a.obj", "b.obj"].iter().map(|name| folder.path().join(name)).collect();
    for path in &paths {
        std::fs::write(path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").expect("written");
    }
    let Worked { editor, stage } = &mut worked;
    editor.dropped(stage, paths, Modifiers::NONE);
    finish_load(editor, stage);
    finish_load(editor, stage);
    assert_eq!(worked.objects(), 5, "both");
}

#[test]
fn objects_and_elements_are_copied_by_keys() {
    let mut worked = Worked::new();
    worked.chord("Ctrl+V");
    assert!(worked.refusal().contains("Ctrl+C"), "{}", worked.refusal());
    worked.chord("Ctrl+C");
    worked.chord("Ctrl+V");
    assert_eq!(worked.objects(), 3, "a second cube: {:?}", worked.editor.message);
    worked.chord("Ctrl+Z");
    for chord in ["Tab", "3", "A", "Ctrl+C", "Ctrl+V"] {
        worked.chord(chord);
    }
    let mesh = worked.editor.document.selection().meshes().next().expect("it is edited").0;
    let faces = worked.editor.document.mesh(mesh).expect("it is edited").face_count();
    assert_eq!(faces, 12, "its faces, twice: {:?}", worked.editor.message);
    eprintln!(
        "meshes {} stage {:?}",
        worked.editor.document.nodes().meshes().len(),
        worked.stage.scene.meshes().iter().map(|(_, a)| a.mesh().face_count()).collect::<Vec<_>>()
    );
    assert_eq!(worked.selected_elements(), 6, "the new ones are selected");
}

#[test]
fn the_cursor_and_the_selection_go_to_one_another() {
    let mut worked = Worked::new();
    worked.run(json!({ "op": "translate", "offset": [1.25, 2.5, -3.75] }));
    worked.menu("snap.cursor_to_selected");
    assert_eq!(worked.editor.tools.cursor, DVec3::new(1.25, 2.5, -3.75), "where the cube is");
    worked.menu("snap.cursor_to_grid");
    assert_eq!(worked.editor.tools.cursor, DVec3::new(1.0, 3.0, -4.0), "whole metres");
    worked.menu("snap.selection_to_cursor");
    let place = |worked: &Worked| {
        let scene = worked.editor.document.nodes();
        let (id, _) = scene.nodes().iter().next().expect("the cube");
        scene.world_transform(id).translation
    };
    assert_eq!(place(&worked), DVec3::new(1.0, 3.0, -4.0), "the cube follows");
    worked.menu("snap.cursor_to_origin");
    worked.menu("origin.cursor");
    assert_eq!(place(&worked), DVec3::ZERO, "its origin is at the cursor");
    let bounds = worked.stage.scene.visible_points().fold(DVec3::INFINITY, DVec3::min);
    assert_eq!(bounds, DVec3::new(0.0, 2.0, -5.0), "and nothing is seen to move");
}

#[test]
fn exports_list_all_that_they_cannot_hold() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut harness = harness();
    let Worked { editor, stage } = harness.state_mut();
    editor.perform(stage, Request::File(FileRequest::Ask(FileAction::Export)));
    harness.run();
    harness.get_by_label_contains("Loses the tree of objects");
    harness.key_press(Key::Escape);
    harness.run();
    let Worked { editor, stage } = harness.state_mut();
    let path = folder.path().join("cube.stl");
    editor.perform(stage, Request::File(FileRequest::Export(path.clone())));
    harness.run();
    assert!(path.exists(), "written");
    let losses = harness.query_all_by_label_contains("not in cube.stl").count();
    assert!(losses > 1, "each of them: {losses}");
    harness.get_by_label("Close").click();
    harness.run();
    assert!(harness.state().editor.report.is_none(), "read");
}

#[test]
fn a_shape_that_is_added_in_edit_mode_joins_the_mesh() {
    let mut worked = Worked::new();
    worked.run(json!({ "op": "set_transform", "location": [5.0, 0.0, 0.0], "scale": [2.0, 2.0, 2.0] }));
    worked.chord("Tab");
    worked.menu("add.cube");
    assert_eq!(worked.objects(), 2, "no object more: {:?}", worked.editor.message);
    assert_eq!(worked.selected_elements(), 8, "the new vertices are selected");
    let points: Vec<DVec3> = worked.stage.scene.visible_points().collect();
    let has = |at: DVec3| points.iter().any(|point| point.distance(at) < 1e-6);
    assert!(points.len() == 16 && has(DVec3::ONE) && has(DVec3::new(7.0, 2.0, 2.0)), "both: {points:?}");
}

/// What a key did was said in small letters at the border only.
#[test]
fn what_was_done_is_said_over_the_view_for_some_seconds() {
    let mut harness = harness();
    harness.run();
    // In the status line, and over the view.
    let texts = |harness: &Harness<'_, Worked>| {
        let (Message::Hint(said) | Message::Info(said) | Message::Refusal(said)) =
            &harness.state().editor.message;
        let shapes = harness.output().shapes.iter();
        let is_it = |shape: &trigon_window::egui::Shape| match shape {
            trigon_window::egui::Shape::Text(text) => text.galley.text() == said,
            _ => false,
        };
        shapes.filter(|clipped| is_it(&clipped.shape)).count()
    };
    assert_eq!(texts(&harness), 1, "how to begin is a hint");
    for key in ['x', 'x'] {
        // The second finds nothing to delete, which is said, too.
        harness.state_mut().character(key);
        harness.step();
        assert_eq!(texts(&harness), 2, "it is said");
        // A quarter of a second each.
        harness.run_steps(30);
        assert_eq!(texts(&harness), 1, "and not for ever");
    }
    harness.state_mut().chord("Ctrl+Z");
    harness.state_mut().chord("A");
    harness.step();
    assert_eq!(texts(&harness), 1, "a selection is seen anyway");
}

/// A GLB was written under the name of an OBJ, which no program could read.
#[test]
fn a_document_is_saved_under_a_glbs_name_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut worked = Worked::new();
    for name in ["cube.obj", "cube.doc"] {
        let path = folder.path().join(name);
        let request = Request::File(FileRequest::SaveAs(path.clone()));
        worked.editor.perform(&mut worked.stage, request);
        assert!(worked.refusal().contains("Export"), "{}", worked.refusal());
        assert!(!path.exists() && worked.editor.saving.is_none(), "{name} is not written");
    }
    let path = folder.path().join("cube.GLB");
    worked.editor.perform(&mut worked.stage, Request::File(FileRequest::SaveAs(path.clone())));
    finish_save(&mut worked.editor, &mut worked.stage);
    assert!(path.exists(), "{:?}", worked.editor.message);
}

/// The new material was chosen in the panel and seen on no face.
#[test]
fn a_new_material_of_an_object_is_seen_on_it() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label("New").click();
    harness.run();
    let worked = harness.state();
    let cube = worked.editor.document.selection().active.expect("the cube");
    let node = worked.editor.document.nodes().node(cube).expect("it is there");
    assert_eq!(node.materials.len(), 1, "it has no slot more");
    let material = worked.editor.document.nodes().materials.get(node.materials[0]).expect("it is there");
    assert_eq!(material.name, "Material", "the new one");
}

/// Units and sums were thrown away without a word, as was nonsense.
#[test]
fn fields_for_numbers_take_units_and_sums_and_say_what_they_do_not_take() {
    for (typed, expected) in [("50 cm", 0.5), ("1+2/4", 1.5), ("2 * (1 m + 20 cm)", 2.4), ("abc", 0.0)] {
        let mut harness = harness();
        harness.run();
        harness.get_by_label("Location X").click();
        harness.run();
        harness.event(trigon_window::egui::Event::Text(typed.into()));
        harness.run();
        harness.key_press(Key::Enter);
        harness.run();
        let worked = harness.state();
        let cube = worked.editor.document.selection().active.expect("the cube");
        let at = worked.editor.document.nodes().world_transform(cube).translation;
        assert!((at.x - expected).abs() < 1e-12, "{typed}: {at}");
        if typed == "abc" {
            assert!(worked.refusal().contains("\"abc\""), "{}", worked.refusal());
        }
    }
}

/// K and U did nothing, and nothing was said.
#[test]
fn a_key_without_a_command_says_so() {
    let mut worked = Worked::new();
    let key = |worked: &mut Worked, key| worked.key(WindowKey::Character(key), Modifiers::NONE);
    assert_eq!(key(&mut worked, 'q'), Taken::No, "it is nobody's");
    assert!(worked.refusal().starts_with('Q') && worked.refusal().contains("F3"), "{}", worked.refusal());
}

/// It was offered in edit mode only.
#[test]
fn whole_objects_are_shaded_smooth() {
    let mut worked = Worked::new();
    worked.menu("face.smooth");
    let smooth = |worked: &mut Worked| {
        worked.chord("Tab");
        let (id, _) = worked.editor.document.selection().meshes().next().expect("edited");
        let mesh = worked.editor.document.mesh(id).expect("edited");
        let all = mesh.faces().all(|face| mesh.is_smooth(face));
        worked.chord("Tab");
        all
    };
    assert!(smooth(&mut worked), "{:?}", worked.editor.message);
    worked.menu("face.flat");
    assert!(!smooth(&mut worked), "flat again");
    worked.chord("Alt+A");
    worked.menu("face.smooth");
    assert!(worked.refusal().contains("mesh"), "{}", worked.refusal());
}

#[test]
fn text_grows_and_shrinks_in_steps_and_comes_back() {
    let mut worked = Worked::new();
    for (name, expected) in [
        ("view.larger_text", 1.25),
        ("view.smaller_text", 1.0),
        ("view.smaller_text", 0.8),
        ("view.normal_text", 1.0),
    ] {
        worked.menu(name);
        assert_eq!(worked.stage.text_scale, expected, "{name}");
    }
    (0..20).for_each(|_| worked.menu("view.larger_text"));
    assert_eq!(worked.stage.text_scale, 2.0, "the panels leave room for the view");
}

#[test]
fn what_was_hidden_is_selected_when_it_is_shown_again() {
    let mut worked = Worked::new();
    for chord in ["Tab", "3", "A", "H"] {
        worked.chord(chord);
    }
    worked.chord("Alt+H");
    assert_eq!(worked.selected_elements(), 6, "all faces");
}

/// In a view of a side the image lies in its plane; with alpha, so that what is modelled shows through.
#[test]
fn a_reference_image_faces_the_view_and_is_half_transparent() {
    let image = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/images/showcase.png");
    for (view, towards) in
        [("Numpad1", DVec3::Z), ("Numpad3", DVec3::X), ("Numpad7", DVec3::Y), ("Home", DVec3::Z)]
    {
        let mut worked = Worked::new();
        worked.chord(view);
        let Worked { editor, stage } = &mut worked;
        editor.file_request(stage, FileRequest::Reference(image.clone()));
        let document = &worked.editor.document;
        let object = document.selection().active.expect("it is selected");
        let node = document.nodes().node(object).expect("it exists");
        let turned = node.transform.to_affine().transform_vector3(DVec3::Y);
        assert!(turned.abs_diff_eq(towards, 1e-9), "{view}: {turned}");
        let material = document.nodes().materials.get(node.materials[0]).expect("it has one");
        assert_eq!((material.base_color.w, material.alpha_mode), (0.5, AlphaMode::Blend), "{view}");
        assert!(material.base_color_texture.is_some() && material.double_sided);
    }
}
