//! Moves: typed, dragged, locked, snapped.

use trigon_document::mesh::math::{DVec2, DVec3, Vec3};
use trigon_window::{Input, Key, Modifiers, PointerButton};

use super::super::{Tool, ToolState, TransformKind};
use super::{Session, settings};

#[test]
fn typed_moves_are_exact() {
    for (keys, expected) in [
        ("x2!", DVec3::X * 2.0),
        ("2!", DVec3::X * 2.0),
        ("1>2>3!", DVec3::new(1.0, 2.0, 3.0)),
        ("2-y!", DVec3::Y * -2.0),
        ("z4/!", DVec3::Z * 0.25),
        ("Z1>2!", DVec3::new(1.0, 2.0, 0.0)),
        ("x=1m-20cm!", DVec3::X * (1.0 - 20.0 * 0.01)),
        ("xc2>3!", DVec3::new(2.0, 3.0, 0.0)),
    ] {
        let mut session = Session::object("cube");
        let mut tool = session.transform(TransformKind::Translate, settings());
        let state = session.keys(&mut tool, keys);
        assert_eq!((session.place(), state), (expected, ToolState::Confirmed), "G {keys}");
        let name = session.document.history().done().last().map(|entry| entry.command().name());
        assert_eq!(name, Some("Move"), "one entry");
        session.document.undo().expect("one");
        assert_eq!(session.place(), DVec3::ZERO, "undone");
    }
}

#[test]
fn a_typed_move_of_vertices_is_exact() {
    let mut session = Session::editing("cube", "vertex", &[]);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.keys(&mut tool, "x2!");
    let expected: Vec<Vec3> = before.iter().map(|place| *place + Vec3::X * 2.0).collect();
    assert_eq!(session.positions(), expected, "2 m, to the last bit");
}

#[test]
fn a_drag_follows_the_pointer_and_cancelling_restores_the_first_bytes() {
    for ending in [
        Input::Pressed(PointerButton::Right),
        Input::Key { logical: Some(Key::Escape), physical: None, repeat: false },
    ] {
        for mut session in [Session::object("cube"), Session::editing("cube", "face", &[0, 3])] {
            let (first, entries) = (session.bytes(), session.document.history().done().len());
            let mut tool = session.transform(TransformKind::Translate, settings());
            for step in 0..50 {
                session.drag(&mut tool, 400.0 + 7.3 * f64::from(step), 300.0 - 3.1 * f64::from(step));
            }
            assert_ne!(session.bytes(), first, "it moved");
            assert_eq!(session.input(&mut tool, ending), ToolState::Cancelled);
            assert_eq!(
                (session.bytes(), session.document.history().done().len()),
                (first, entries),
                "as it was"
            );
        }
    }
}

#[test]
fn drags_are_slow_with_shift_and_go_in_steps_with_ctrl() {
    let mut session = Session::object("cube");
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.drag(&mut tool, 560.0, 270.0);
    assert!(
        session.place().abs_diff_eq(DVec3::new(1.6, 0.3, 0.0), 1e-12),
        "1 cm a pixel: {}",
        session.place()
    );
    session.hold(&mut tool, Modifiers::CTRL);
    assert!(session.place().abs_diff_eq(DVec3::X * 2.0, 1e-12), "steps of a metre: {}", session.place());
    session.hold(&mut tool, Modifiers::SHIFT);
    let tab = Input::Key { logical: Some(Key::Tab), physical: None, repeat: false };
    session.input(&mut tool, tab);
    assert!(
        session.place().abs_diff_eq(DVec3::new(1.6, 0.3, 0.0), 1e-12),
        "steps of 10 cm: {}",
        session.place()
    );
    session.input(&mut tool, tab);
    session.drag(&mut tool, 660.0, 270.0);
    assert!(session.place().abs_diff_eq(DVec3::new(1.7, 0.3, 0.0), 1e-12), "a tenth: {}", session.place());
    tool.pointer_jumped(DVec2::new(0.0, 270.0));
    session.hold(&mut tool, Modifiers::NONE);
    session.drag(&mut tool, 30.0, 270.0);
    assert!(
        session.place().abs_diff_eq(DVec3::new(2.0, 0.3, 0.0), 1e-12),
        "a jump is no move: {}",
        session.place()
    );
    assert_eq!(session.input(&mut tool, Input::Pressed(PointerButton::Left)), ToolState::Confirmed);
}

#[test]
fn locks_hold_a_drag_to_axes_and_planes() {
    let mut session = Session::object("cube");
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.drag(&mut tool, 500.0, 250.0);
    for (keys, expected) in
        [("x", DVec3::X), ("y", DVec3::Y * 0.5), ("X", DVec3::Y * 0.5), ("c", DVec3::new(1.0, 0.5, 0.0))]
    {
        session.keys(&mut tool, keys);
        assert!(session.place().abs_diff_eq(expected, 1e-9), "{keys}: {}", session.place());
    }
    session.input(&mut tool, Input::Pressed(PointerButton::Middle));
    assert!(session.place().abs_diff_eq(DVec3::X, 1e-9), "the axis along which it went: {}", session.place());
    session.input(&mut tool, Input::Released(PointerButton::Middle));
    session.drag(&mut tool, 400.0, 200.0);
    assert!(session.place().abs_diff_eq(DVec3::ZERO, 1e-9), "it stays: {}", session.place());
    assert!(tool.status().contains("along global X"), "{}", tool.status());
    assert_eq!(tool.marks().lines.len(), 1, "the axis is drawn");
}
