//! Tools and selection by mouse and keys, from the window's inputs to the document.

use trigon_document::scene::Region;
use trigon_document::{Command, SelectAction};
use trigon_window::scene::camera::{AxisView, Projector};
use trigon_window::scene::math::{DVec2, DVec3};
use trigon_window::{InputOwner, PointerButton};

use super::*;
use crate::window::pointing::Pointing;

impl Worked {
    /// Where a place in the world is seen.
    fn seen(&self, place: DVec3) -> DVec2 {
        let projector = Projector::new(&self.stage.camera(), self.stage.viewport());
        projector.to_screen(place).expect("before the eye")
    }

    fn input(&mut self, input: Input, at: DVec2, modifiers: Modifiers) -> Taken {
        self.editor.input(&mut self.stage, &input, Hands { pointer: Some(at), modifiers })
    }

    fn move_to(&mut self, at: DVec2) {
        self.input(Input::PointerMoved, at, Modifiers::NONE);
    }

    fn click(&mut self, at: DVec2, modifiers: Modifiers) {
        self.move_to(at);
        self.input(Input::Pressed(PointerButton::Left), at, modifiers);
        self.input(Input::Released(PointerButton::Left), at, modifiers);
    }

    fn drag(&mut self, from: DVec2, to: DVec2, modifiers: Modifiers) {
        self.input(Input::Pressed(PointerButton::Left), from, modifiers);
        for share in [0.3, 0.6, 1.0] {
            self.input(Input::PointerMoved, from.lerp(to, share), modifiers);
        }
        self.input(Input::Released(PointerButton::Left), to, modifiers);
    }

    pub(super) fn keys(&mut self, keys: &str) {
        for key in keys.chars() {
            let key = match key {
                '!' => WindowKey::Enter,
                '?' => WindowKey::Escape,
                '>' => WindowKey::Tab,
                key => WindowKey::Character(key),
            };
            assert_eq!(self.key(key, Modifiers::NONE), Taken::Yes, "{key:?} does something");
        }
    }

    /// In edit mode, with faces to be selected and none selected.
    pub(super) fn on_faces() -> Self {
        let mut worked = Self::new();
        worked.keys(">3");
        worked.key(WindowKey::Character('a'), Modifiers::ALT);
        worked
    }

    /// How many elements are selected.
    fn selected(&self) -> usize {
        self.editor.document.selection().meshes().map(|(_, elements)| elements.len()).sum()
    }

    pub(super) fn place(&self) -> DVec3 {
        let scene = self.editor.document.nodes();
        let cube = self.editor.document.selection().active.expect("the cube");
        assert_eq!(self.stage.scene.world_transform(cube), scene.world_transform(cube), "on the stage");
        scene.world_transform(cube).translation
    }

    pub(super) fn bytes(&self) -> Vec<u8> {
        self.editor.document.to_native().encode().expect("it is small").to_bytes().to_vec()
    }
}

#[test]
fn g_and_a_number_move_what_is_selected_and_undo_takes_it_back() {
    let mut worked = Worked::new();
    worked.move_to(DVec2::new(700.0, 400.0));
    worked.keys("g");
    assert_eq!(worked.stage.input_owner, InputOwner::Application, "wherever the pointer goes");
    worked.keys("2!");
    assert_eq!(worked.place(), DVec3::new(2.0, 0.0, 0.0), "the first number is X");
    assert_eq!(worked.stage.input_owner, InputOwner::Interface, "the tool is over");
    assert_eq!(worked.stage.title(), "*untitled - trigon", "something was done");
    worked.key(WindowKey::Character('z'), Modifiers::CTRL);
    assert_eq!(worked.place(), DVec3::ZERO, "one entry");
    assert_eq!(worked.stage.title(), "untitled - trigon", "as it was");
}

#[test]
fn escape_leaves_every_byte_as_it_was() {
    let mut worked = Worked::new();
    let before = worked.bytes();
    for tool in ["g", "r", "s"] {
        worked.move_to(DVec2::new(700.0, 400.0));
        worked.keys(tool);
        worked.move_to(DVec2::new(790.0, 450.0));
        assert!(worked.bytes() != before, "{tool} shows what it does");
        worked.keys("?");
        assert!(worked.bytes() == before, "{tool} is taken back");
        assert!(!worked.editor.file.is_unsaved(), "nothing was done");
    }
}

#[test]
fn a_click_selects_the_face_under_the_pointer_and_shift_adds_another() {
    let mut worked = Worked::on_faces();
    let [front, right] = [DVec3::Z, DVec3::X].map(|face| worked.seen(face));
    worked.click(front, Modifiers::NONE);
    assert_eq!(worked.selected(), 1, "one");
    worked.click(right, Modifiers::SHIFT);
    assert_eq!(worked.selected(), 2, "another one");
    worked.click(right, Modifiers::SHIFT);
    assert_eq!(worked.selected(), 1, "and not");
    worked.click(right, Modifiers::NONE);
    assert_eq!(worked.selected(), 1, "in place of the first");
    assert!(!worked.stage.settings.marks.faces.is_empty(), "it is marked in the image");
    worked.click(DVec2::new(200.0, 200.0), Modifiers::NONE);
    assert_eq!(worked.selected(), 0, "beside everything");
}

#[test]
fn modelling_tools_follow_the_pointer() {
    let mut worked = Worked::on_faces();
    let top = worked.seen(DVec3::Y);
    worked.click(top, Modifiers::NONE);
    worked.keys("e");
    assert_eq!(worked.faces(), 10, "its sides are there at once");
    worked.move_to(top - DVec2::Y * 80.0);
    worked.click(top - DVec2::Y * 80.0, Modifiers::NONE);
    assert!(worked.stage.scene.bounds().max.y > 1.2, "pulled upwards");
    worked.keys("i.2!");
    assert_eq!(worked.faces(), 14, "and a rim");
    let front = worked.seen(DVec3::Z);
    worked.move_to(front);
    worked.keys("2");
    worked.key(WindowKey::Character('r'), Modifiers::CTRL);
    worked.move_to(front + DVec2::X);
    worked.click(front + DVec2::X, Modifiers::NONE);
    let cut = worked.faces();
    assert!(cut > 14, "a ring is cut: {cut}");
    worked.keys("!");
    assert_eq!((worked.faces(), worked.editor.tool.is_none()), (cut, true), "and stays so");
    worked.key(WindowKey::Character('b'), Modifiers::CTRL);
    worked.keys(".1!");
    assert!(worked.faces() > cut, "bevelled");
    while worked.editor.document.history().done().len() > 1 {
        worked.key(WindowKey::Character('z'), Modifiers::CTRL);
    }
    assert_eq!(worked.faces(), 6, "a cube again");
}

#[test]
fn a_drag_selects_within_a_box_what_is_seen_or_with_x_ray_all() {
    let mut worked = Worked::on_faces();
    let (from, to) = (DVec2::new(150.0, 60.0), DVec2::new(1200.0, 850.0));
    worked.drag(from, to, Modifiers::NONE);
    assert_eq!(worked.selected(), 3, "those that are seen");
    worked.key(WindowKey::Character('z'), Modifiers::ALT);
    worked.drag(from, to, Modifiers::NONE);
    assert_eq!(worked.selected(), 6, "all");
    worked.keys("b");
    worked.drag(worked.seen(DVec3::Z) - 3.0, worked.seen(DVec3::Z) + 3.0, Modifiers::CTRL);
    assert!(worked.selected() < 6, "fewer");
    assert!(worked.editor.tool.is_none(), "a box is drawn once");
}

/// Another thread finds the visible vertices while the box is drawn; what it has found does not outlive a change.
#[test]
fn a_box_selects_the_vertices_that_are_seen_after_every_change() {
    /// What somebody finds who knows nothing yet.
    fn expected(worked: &Worked, [min, max]: [DVec2; 2]) -> usize {
        let Worked { editor, stage } = worked;
        let pane = stage.pane_at(min);
        let region = Region::Rectangle { min, max };
        let found = Pointing::default().ask(&editor.document, stage, &pane, editor.reach(), |picks| {
            picks.region(&region, SelectAction::Replace)
        });
        let Some(Command::SelectElements(select)) = found.flatten() else { panic!("some are seen") };
        let ranges = select.parts.iter().flat_map(|part| &part.ranges);
        ranges.map(|[first, last]| (last - first + 1) as usize).sum()
    }
    let mut worked = Worked::new();
    worked.keys(">1");
    let corners = [DVec2::new(10.0, 60.0), DVec2::new(1200.0, 850.0)];
    let x_ray = |worked: &mut Worked| {
        worked.key(WindowKey::Character('z'), Modifiers::ALT);
    };
    let steps: [&dyn Fn(&mut Worked); 5] =
        [&|_| {}, &x_ray, &x_ray, &|worked| worked.stage.orbit.set_view(AxisView::Front), &|worked| {
            worked.keys("gx3!");
        }];
    let mut counts = Vec::new();
    for (number, step) in steps.iter().enumerate() {
        step(&mut worked);
        for _ in 0..2 {
            worked.drag(corners[0], corners[1], Modifiers::NONE);
            assert_eq!(worked.selected(), expected(&worked, corners), "after step {number}");
        }
        counts.push(worked.selected());
    }
    assert_eq!(counts[..4], [7, 8, 7, 4], "of a cube");
    assert_ne!(counts[4], 4, "the front has moved aside");
}

#[test]
fn the_panel_of_the_last_operation_changes_it() {
    use egui_kittest::kittest::NodeT;
    use trigon_window::egui::Role;

    let mut harness = harness();
    let worked = harness.state_mut();
    worked.move_to(DVec2::new(700.0, 400.0));
    worked.keys("gx2!");
    harness.run();
    let offset = harness.get_by_role_and_label(Role::SpinButton, "Offset X");
    assert_eq!(offset.accesskit_node().value().as_deref(), Some("X 2 m"), "what was done");
    offset.click();
    harness.run();
    harness.event(trigon_window::egui::Event::Text("3".into()));
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(harness.state().place(), DVec3::new(3.0, 0.0, 0.0), "in its place");
    harness.state_mut().key(WindowKey::Function(9), Modifiers::NONE);
    harness.run();
    let hidden = harness.query_by_role_and_label(Role::SpinButton, "Offset X");
    assert!(hidden.is_none(), "F9 hides it");
    harness.state_mut().key(WindowKey::Character('z'), Modifiers::CTRL);
    assert_eq!(harness.state().place(), DVec3::ZERO, "one entry");
}

#[test]
fn a_handle_of_the_gizmo_moves_along_its_axis() {
    let mut worked = Worked::new();
    let gizmo =
        worked.editor.gizmo(&worked.stage, &worked.stage.pane_at(DVec2::ZERO)).expect("the cube is selected");
    let view = worked.editor.overlay_view(&worked.stage, &worked.stage.pane_at(DVec2::ZERO));
    let arm = gizmo.center + DVec3::X * view.pixel_size(gizmo.center) * 60.0;
    let from = worked.seen(arm);
    worked.drag(from, worked.seen(arm + DVec3::X), Modifiers::NONE);
    let place = worked.place();
    // A metre is drawn a little larger at the arm, which is nearer to the eye than the middle.
    assert!((0.9..1.1).contains(&place.x) && place.y == 0.0 && place.z == 0.0, "{place}: about 1 m on X");
    assert!(worked.editor.tool.is_none(), "letting go confirms");
}
