//! What keys and menus do to the document and the view, one chord after the other.

use trigon_document::scene::{Display, NodeId, Style};
use trigon_window::Chord;
use trigon_window::scene::Lighting;
use trigon_window::scene::math::DVec3;

use super::*;
use crate::request::DisplayMode;
use crate::window::actions;

impl Worked {
    /// Presses chords with spaces between them.
    fn chords(&mut self, chords: &str) {
        for text in chords.split_whitespace() {
            let chord: Chord = text.parse().expect("a chord");
            assert_eq!(self.key(chord.key, chord.modifiers), Taken::Yes, "{text} does something");
            if let Message::Refusal(why) = &self.editor.message {
                panic!("{text}: {why}");
            }
        }
    }

    /// Chooses the entry of a menu.
    fn choose(&mut self, name: &str) {
        let action = actions::named(name).expect("there is such an action");
        self.editor.choose(&mut self.stage, action);
        if let Message::Refusal(why) = &self.editor.message {
            panic!("{name}: {why}");
        }
        self.editor.popup = None;
    }

    /// In edit mode, with everything selected as one kind.
    fn editing(kind: &str) -> Self {
        let mut worked = Self::new();
        worked.chords(&format!("Tab {kind} A"));
        worked
    }

    fn object(&self, name: &str) -> NodeId {
        let nodes = self.editor.document.nodes().nodes();
        nodes.iter().find(|(_, node)| node.name == name).map(|(id, _)| id).expect("an object of this name")
    }

    fn place_of(&self, name: &str) -> DVec3 {
        self.editor.document.nodes().world_transform(self.object(name)).translation
    }

    fn is_shown(&self, name: &str) -> bool {
        self.stage.scene.nodes().get(self.object(name)).is_some_and(|node| node.visible)
    }

    fn count(&self) -> usize {
        self.editor.document.selection().meshes().map(|(_, elements)| elements.len()).sum()
    }

    /// Vertices, edges and faces of the cube.
    fn cube(&self) -> [usize; 3] {
        let node = self.editor.document.nodes().nodes().get(self.object("Cube")).expect("it is there");
        let mesh = self.editor.document.mesh(node.mesh.expect("a mesh")).expect("it is edited");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }
}

/// On a busy machine the first letters of a search came before its field had the focus: X deleted what was selected.
#[test]
fn what_is_typed_before_a_field_has_the_focus_runs_nothing() {
    for opens in ["F3", "Ctrl+Shift+S"] {
        let mut worked = Worked::new();
        worked.chords("A");
        worked.chords(opens);
        for typed in ['x', 'a', 'g'] {
            assert_eq!(
                worked.key(WindowKey::Character(typed), Modifiers::NONE),
                Taken::No,
                "{opens}, {typed}"
            );
        }
        assert_eq!(worked.objects(), 2, "nothing was deleted");
        assert!(worked.editor.tool.is_none(), "nothing moves");
        assert_eq!(worked.key(WindowKey::Escape, Modifiers::NONE), Taken::Yes, "closes it");
        worked.chords("X");
        assert_eq!(worked.objects(), 0, "now it is a key again");
    }
}

#[test]
fn ctrl_and_a_digit_show_a_smooth_surface_below_its_cage() {
    let mut worked = Worked::new();
    let shown = |worked: &Worked| {
        let mesh = worked.stage.scene.nodes().get(worked.object("Cube")).and_then(|node| node.mesh);
        worked.stage.scene.meshes().get(mesh.expect("it has one")).expect("it is there").mesh().face_count()
    };
    worked.chords("Ctrl+2");
    assert_eq!(shown(&worked), 96, "in object mode");
    worked.chords("Tab 3 A");
    assert_eq!((worked.count(), worked.cube()), (6, [8, 12, 6]), "the cage is edited");
    worked.chords("Ctrl+3");
    assert_eq!(shown(&worked), 384, "in edit mode");
    worked.chords("Ctrl+Z");
    assert_eq!(shown(&worked), 96, "undone");
    worked.chords("Ctrl+0");
    assert_eq!(shown(&worked), 6, "off");
    worked.chords("Ctrl+1");
    worked.choose("subdivision.apply");
    assert_eq!((shown(&worked), worked.cube()[2]), (24, 24), "the surface is the mesh now");
}

#[test]
fn ctrl_a_applies_the_placement_of_an_object() {
    let mut worked = Worked::new();
    let command = serde_json::json!({ "op": "scale", "factors": [2.0, 1.0, 1.0] });
    worked.editor.run(serde_json::from_value(command).expect("a command"));
    worked.chords("Ctrl+A");
    assert!(worked.editor.popup.is_some(), "a menu opens");
    worked.choose("apply.all");
    let (id, document) = (worked.object("Cube"), &worked.editor.document);
    let node = document.nodes().nodes().get(id).expect("it is there");
    assert_eq!(node.transform, trigon_document::scene::Transform::IDENTITY, "nothing is left of it");
    let mesh = document.mesh(node.mesh.expect("it has one")).expect("it was edited");
    let width = mesh.vertices().map(|vertex| mesh.position(vertex).x).fold(0.0, f32::max);
    assert_eq!(width, 2.0, "the mesh is as wide as it was shown");
}

#[test]
fn objects_are_hung_on_the_active_one_and_taken_off() {
    let mut worked = Worked::new();
    worked.choose("add.empty");
    let command = serde_json::json!({ "op": "translate", "offset": [1.0, 2.0, 3.0] });
    worked.editor.run(serde_json::from_value(command).expect("a command"));
    let command = serde_json::json!({ "op": "select", "objects": ["Cube"], "action": "add" });
    worked.editor.run(serde_json::from_value(command).expect("a command"));
    worked.chords("Ctrl+P");
    assert!(worked.editor.popup.is_some(), "a menu opens");
    worked.choose("parent.keep");
    let parent = |worked: &Worked| {
        worked.editor.document.nodes().nodes().get(worked.object("Empty")).expect("it is there").parent()
    };
    assert_eq!(parent(&worked), Some(worked.object("Cube")), "on the active one");
    assert_eq!(worked.place_of("Empty"), DVec3::new(1.0, 2.0, 3.0), "where it was");
    worked.chords("Alt+P");
    worked.choose("edit.parent_clear");
    assert_eq!(parent(&worked), None, "taken off");
    assert_eq!(worked.place_of("Empty"), DVec3::new(1.0, 2.0, 3.0), "and it stays");
}

#[test]
fn what_is_not_selected_is_hidden_and_shown_again() {
    let mut worked = Worked::new();
    worked.chords("Shift+H");
    assert_eq!((worked.is_shown("Cube"), worked.is_shown("Light")), (true, false), "the cube is selected");
    worked.chords("Alt+H");
    assert!(worked.is_shown("Light"), "again");
    worked.chords("A H");
    assert!(!worked.is_shown("Cube"), "hidden");
    worked.chords("Ctrl+Z A Tab 3 Alt+A");
    let command = serde_json::json!({ "op": "select", "elements": [0] });
    worked.editor.run(serde_json::from_value(command).expect("a command"));
    worked.chords("Shift+H A");
    assert_eq!(worked.count(), 1, "the other faces are hidden");
    worked.chords("Alt+H A");
    assert_eq!(worked.count(), 6, "all");
    worked.chords("H");
    worked.chords("A");
    assert_eq!(worked.count(), 0, "none is left");
}

#[test]
fn local_view_shows_what_is_selected_alone() {
    let mut worked = Worked::new();
    worked.choose("add.torus");
    worked.chords("/");
    assert_eq!((worked.is_shown("Cube"), worked.is_shown("Torus")), (false, true), "only the torus");
    worked.chords("Numpad/");
    assert!(worked.is_shown("Cube"), "all again");
}

#[test]
fn placements_are_cleared_by_keys() {
    let mut worked = Worked::new();
    for (key, json) in [
        ("Alt+G", serde_json::json!({ "op": "translate", "offset": [1.0, 0.0, 0.0] })),
        ("Alt+R", serde_json::json!({ "op": "rotate", "angle": 30.0, "axis": [0.0, 0.0, 1.0] })),
        ("Alt+S", serde_json::json!({ "op": "scale", "factors": [2.0, 2.0, 2.0] })),
    ] {
        let cube = worked.object("Cube");
        let before = worked.editor.document.nodes().world_transform(cube);
        worked.editor.run(serde_json::from_value(json).expect("a command"));
        assert_ne!(worked.editor.document.nodes().world_transform(cube), before, "{key}");
        worked.chords(key);
        assert_eq!(worked.editor.document.nodes().world_transform(cube), before, "{key}");
    }
}

#[test]
fn a_camera_is_added_looked_through_and_moved_to_the_view() {
    let mut worked = Worked::new();
    worked.chords("Numpad1 Ctrl+Numpad1");
    worked.choose("add.camera");
    let outside = worked.stage.camera().position;
    worked.chords("Numpad0");
    assert_eq!(worked.stage.camera().position, worked.place_of("Camera"), "through the camera");
    worked.chords("Numpad0");
    assert_eq!(worked.stage.camera().position, outside, "and back");
    worked.chords("Ctrl+Alt+Numpad0");
    assert_eq!(worked.place_of("Camera"), outside, "the camera is here");
    let (_, camera) = worked.editor.document.nodes().cameras().into_iter().next().expect("one");
    let sight = |turn: trigon_window::scene::math::DQuat| turn * DVec3::NEG_Z;
    let apart = sight(camera.orientation).distance(sight(worked.stage.camera().orientation));
    // A few roundings of a unit vector.
    assert!(apart < 1e-12, "and looks the same way: {apart}");
}

#[test]
fn new_objects_stand_at_the_cursor() {
    let mut worked = Worked::new();
    worked.editor.tools.cursor = DVec3::new(5.0, 0.0, -1.0);
    worked.choose("add.torus");
    assert_eq!(worked.place_of("Torus"), DVec3::new(5.0, 0.0, -1.0), "there");
    worked.choose("add.point_light");
    assert_eq!(worked.place_of("Point"), DVec3::new(9.0, 5.0, 2.0), "beside it, as beside the origin");
}

#[test]
fn selections_grow_shrink_and_follow_by_keys() {
    let mut worked = Worked::editing("3");
    worked.chords("Ctrl+I");
    assert_eq!(worked.count(), 0, "the rest of all");
    let command = serde_json::json!({ "op": "select", "elements": [0] });
    worked.editor.run(serde_json::from_value(command).expect("a command"));
    worked.chords("Ctrl+Numpad+");
    assert_eq!(worked.count(), 5, "its neighbours, too");
    worked.chords("Ctrl+Numpad-");
    assert_eq!(worked.count(), 1, "and without them");
    worked.chords("Ctrl+L");
    assert_eq!(worked.count(), 6, "all that hangs together");
    worked.editor.run(
        serde_json::from_value(serde_json::json!({ "op": "select", "elements": [0] })).expect("a command"),
    );
    worked.chords("Shift+G");
    assert!(worked.editor.popup.is_some(), "a menu opens");
    worked.choose("similar.area");
    assert_eq!(worked.count(), 6, "all are as large");
    worked.chords("Alt+A");
    assert_eq!(worked.count(), 0, "none");
    worked.choose("select.non_manifold");
    assert_eq!(worked.count(), 0, "a cube is closed");
}

#[test]
fn faces_are_made_cut_and_joined_by_keys() {
    let mut worked = Worked::editing("3");
    worked.chords("Ctrl+T");
    assert_eq!(worked.cube(), [8, 18, 12], "triangles");
    worked.chords("Alt+J");
    assert_eq!(worked.cube(), [8, 12, 6], "quads");
    let command = serde_json::json!({ "op": "select", "elements": [0] });
    worked.editor.run(serde_json::from_value(command).expect("a command"));
    worked.chords("X");
    worked.choose("delete.only_faces");
    assert_eq!(worked.cube(), [8, 12, 5], "a hole");
    worked.chords("2");
    worked.choose("select.border");
    worked.chords("F");
    assert_eq!(worked.cube(), [8, 12, 6], "filled");
    worked.chords("1 A");
    worked.choose("merge.center");
    assert_eq!(worked.cube()[0], 1, "merged in the middle");
}

#[test]
fn meshes_come_apart_and_together_by_keys() {
    let mut worked = Worked::editing("3");
    let command = serde_json::json!({ "op": "select", "elements": [0] });
    worked.editor.run(serde_json::from_value(command.clone()).expect("a command"));
    worked.chords("Y");
    assert_eq!(worked.cube(), [12, 16, 6], "split off");
    worked.chords("Ctrl+Z P S");
    assert_eq!(worked.objects(), 3, "an object of its own");
    worked.chords("Tab A Ctrl+J");
    assert_eq!(worked.objects(), 2, "joined");
    worked.chords("Tab 1 A");
    worked.choose("merge.distance");
    assert_eq!(worked.cube(), [8, 12, 6], "one cube again");
}

#[test]
fn faces_turn_over_and_become_smooth() {
    let mut worked = Worked::editing("3");
    let normals = |worked: &Worked| {
        let node = worked.editor.document.nodes().nodes().get(worked.object("Cube")).expect("it is there");
        worked.editor.document.mesh(node.mesh.expect("a mesh")).expect("it is edited").volume()
    };
    worked.chords("Ctrl+Shift+N");
    assert!(normals(&worked) < 0.0, "inwards");
    worked.chords("Shift+N");
    assert!(normals(&worked) > 0.0, "outwards");
    worked.choose("normals.flip");
    assert!(normals(&worked) < 0.0, "turned over");
    for name in ["face.smooth", "face.flat"] {
        worked.choose(name);
    }
}

#[test]
fn menus_of_elements_offer_their_tools() {
    let mut harness = harness();
    for (key, label) in
        [("Ctrl+Shift+V", "Connect Vertices"), ("Ctrl+E", "Loop Cut"), ("Ctrl+F", "Triangulate")]
    {
        let worked = harness.state_mut();
        if !worked.editor.document.selection().is_editing() {
            worked.chords("Tab A");
        }
        worked.chords(key);
        harness.run();
        assert!(harness.query_all_by_label(label).next().is_some(), "{key} offers {label}");
        harness.key_press(Key::Escape);
        harness.run();
    }
}

#[test]
fn the_view_follows_the_number_pad() {
    let mut worked = Worked::new();
    let direction = |worked: &Worked| worked.stage.camera().orientation * DVec3::Z;
    for (key, from) in [
        ("Numpad1", DVec3::Z),
        ("Ctrl+Numpad1", DVec3::NEG_Z),
        ("Numpad3", DVec3::X),
        ("Ctrl+Numpad3", DVec3::NEG_X),
        ("Numpad7", DVec3::Y),
        ("Ctrl+Numpad7", DVec3::NEG_Y),
    ] {
        worked.chords(key);
        // Sines and cosines of right angles.
        assert!(direction(&worked).abs_diff_eq(from, 1e-9), "{key}: {}", direction(&worked));
    }
    worked.chords("Numpad3 Numpad9");
    assert!(direction(&worked).abs_diff_eq(DVec3::NEG_X, 1e-9), "from the other side");
    worked.chords("Numpad1 Numpad6");
    let turned = direction(&worked).angle_between(DVec3::Z).to_degrees();
    assert!((turned - 15.0).abs() < 1e-9, "{turned} degrees");
    let is_flat = worked.stage.orbit.is_orthographic();
    worked.chords("Numpad5");
    assert_ne!(worked.stage.orbit.is_orthographic(), is_flat, "the other projection");
    worked.chords("Home Numpad.");
}

#[test]
fn display_modes_change_style_lights_and_surfaces() {
    let mut worked = Worked::new();
    let style = |worked: &Worked| (worked.stage.settings.style, worked.stage.settings.lighting);
    assert_eq!(style(&worked), (Style::Surface, Lighting::Studio), "solid at first");
    worked.chords("Shift+Z");
    assert_eq!(style(&worked).0, Style::Wireframe, "wires");
    worked.chords("Shift+Z");
    assert_eq!(style(&worked).0, Style::Surface, "and not");
    worked.chords("Alt+Z");
    assert!(worked.stage.settings.x_ray > 0.0, "X-ray");
    worked.chords("Alt+Z");
    let own = worked.stage.scene.materials.len();
    worked.choose("display.matcap");
    assert_eq!(worked.stage.settings.display, Display::Matcap, "clay for all");
    for key in ["G", "X", "1", "Enter"] {
        worked.chords(key);
    }
    assert_eq!(worked.stage.settings.display, Display::Matcap, "also after something was done");
    worked.choose("display.rendered");
    assert_eq!(worked.stage.settings.display, Display::Shaded, "no clay");
    assert_eq!(style(&worked).1, Lighting::Automatic, "the scene's own lights");
    assert_eq!(worked.stage.scene.materials.len(), own, "and materials");
    assert_eq!(worked.editor.view.display, DisplayMode::Rendered);
    let pane = worked.stage.panes()[0];
    assert!(worked.editor.gizmo(&worked.stage, &pane).is_some(), "overlays are there");
    worked.chords("Alt+Shift+Z");
    assert!(worked.editor.gizmo(&worked.stage, &pane).is_none(), "and not");
}

#[test]
fn the_pivot_orientation_snapping_and_proportional_editing_have_keys() {
    let mut worked = Worked::new();
    for key in [".", ","] {
        worked.chords(key);
        assert!(worked.editor.popup.take().is_some(), "{key} opens a menu");
    }
    worked.choose("pivot.cursor");
    worked.choose("orientation.local");
    worked.chords("Shift+Tab O");
    let tools = worked.editor.tools;
    assert!(tools.snapping && tools.proportional, "switched on");
    assert_eq!(
        (tools.pivot, tools.orientation),
        (crate::request::Pivot::Cursor, crate::request::Orientation::Local)
    );
}
