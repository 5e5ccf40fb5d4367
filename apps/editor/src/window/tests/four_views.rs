//! Four views: each is clicked, dragged in and drawn over as what it shows.

use trigon_window::scene::camera::{AxisView, Projector};
use trigon_window::scene::math::{DVec2, DVec3};
use trigon_window::{Pane, PointerButton};

use super::*;

impl Worked {
    fn in_four_views() -> Self {
        let mut worked = Self::new();
        worked.key(WindowKey::Character('q'), Modifiers::CTRL | Modifiers::ALT);
        assert_eq!(worked.stage.panes().len(), 4, "Ctrl+Alt+Q");
        worked
    }

    fn pane(&self, side: Option<AxisView>) -> Pane {
        *self.stage.panes().iter().find(|pane| pane.side == side).expect("it is shown")
    }

    /// Where a view shows a place in the world.
    fn shown(&self, side: Option<AxisView>, place: DVec3) -> DVec2 {
        let pane = self.pane(side);
        let projector = Projector::new(&self.stage.camera_of(&pane), pane.area.size);
        projector.to_screen(place).expect("before the eye") + pane.area.origin()
    }

    fn pointer(&mut self, input: Input, at: DVec2) {
        self.editor.input(&mut self.stage, &input, Hands { pointer: Some(at), modifiers: Modifiers::NONE });
    }

    fn move_cube(&mut self, side: Option<AxisView>, to: DVec3) -> DVec3 {
        let [from, to] = [DVec3::ZERO, to].map(|place| self.shown(side, place));
        self.pointer(Input::PointerMoved, from);
        self.character('g');
        self.pointer(Input::PointerMoved, to);
        self.pointer(Input::Pressed(PointerButton::Left), to);
        let cube = self.editor.document.selection().active.expect("the cube");
        self.editor.document.nodes().world_transform(cube).translation
    }
}

#[test]
fn ctrl_alt_q_shows_four_views_and_one_again() {
    let mut worked = Worked::in_four_views();
    let sides: Vec<_> = worked.stage.panes().iter().map(|pane| pane.side).collect();
    assert_eq!(sides, [Some(AxisView::Top), None, Some(AxisView::Front), Some(AxisView::Right)]);
    worked.key(WindowKey::Character('q'), Modifiers::CTRL | Modifiers::ALT);
    assert_eq!(worked.stage.panes().len(), 1);
}

#[test]
fn a_click_selects_what_its_view_shows() {
    let mut worked = Worked::in_four_views();
    worked.key(WindowKey::Tab, Modifiers::NONE);
    worked.character('3');
    worked.key(WindowKey::Character('a'), Modifiers::ALT);
    let sides = [
        (Some(AxisView::Top), DVec3::Y),
        (Some(AxisView::Front), DVec3::Z),
        (Some(AxisView::Right), DVec3::X),
    ];
    for (side, normal) in sides {
        let at = worked.shown(side, normal);
        worked.pointer(Input::Pressed(PointerButton::Left), at);
        worked.pointer(Input::Released(PointerButton::Left), at);
        let document = &worked.editor.document;
        let (id, selected) = document.selection().meshes().next().expect("it is edited");
        let mesh = document.mesh(id).expect("it is edited");
        let faces = selected.faces(mesh, document.selection().kind());
        let [face] = faces[..] else { panic!("{side:?}: {faces:?}") };
        let found = mesh.face_area_vector(face).normalize();
        assert!(found.distance(normal) < 1e-6, "{side:?}: {found}");
    }
}

#[test]
fn a_move_stays_in_the_plane_of_its_view() {
    for (side, to) in [
        (Some(AxisView::Top), DVec3::new(0.5, 0.0, -0.25)),
        (Some(AxisView::Front), DVec3::new(0.5, 0.25, 0.0)),
        (Some(AxisView::Right), DVec3::new(0.0, 0.25, -0.5)),
    ] {
        let moved = Worked::in_four_views().move_cube(side, to);
        assert!(moved.distance(to) < 1e-6, "{side:?}: {moved} instead of {to}");
    }
}

#[test]
fn four_views_fill_what_no_panel_covers() {
    let mut harness = harness();
    harness.state_mut().key(WindowKey::Character('q'), Modifiers::CTRL | Modifiers::ALT);
    harness.run();
    let worked = harness.state();
    let free = worked.editor.free.expect("it is laid out");
    let area = worked.stage.view_area.expect("it is known");
    assert_eq!(area.min, [free.min.x, free.min.y].map(|at| at.round() as u32), "beside the tools");
    assert!((f64::from(free.width()) - f64::from(area.size.width)).abs() <= 1.0, "up to the panels");
}

/// The window puts its pointer to the other side of a border.
#[test]
fn a_move_goes_on_when_the_pointer_jumps() {
    let mut worked = Worked::in_four_views();
    let side = Some(AxisView::Top);
    let from = worked.shown(side, DVec3::ZERO);
    worked.pointer(Input::PointerMoved, from);
    assert!(!worked.stage.wraps_pointer, "no tool runs");
    worked.character('g');
    let half = worked.shown(side, DVec3::X * 0.5);
    worked.pointer(Input::PointerMoved, half);
    assert!(worked.stage.wraps_pointer, "as far as it goes");
    let Worked { editor, stage } = &mut worked;
    editor.pointer_jumped(stage, DVec2::new(4.0, half.y));
    worked.pointer(Input::PointerMoved, DVec2::new(4.0, half.y) + (half - from));
    worked.key(WindowKey::Enter, Modifiers::NONE);
    assert!(!worked.stage.wraps_pointer, "it is over");
    let cube = worked.editor.document.selection().active.expect("the cube");
    let place = worked.editor.document.nodes().world_transform(cube).translation;
    assert!(place.distance(DVec3::X) < 1e-6, "twice half a metre: {place}");
}
