//! Turns, scales, pivots, orientations, proportional editing.

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_window::{Input, Modifiers, PointerButton};

use super::super::{Orientation, Pivot, Tool, ToolState, TransformKind, TransformSettings};
use super::{Session, settings};

/// Where a point goes.
type Map = fn(DVec3) -> DVec3;

#[test]
fn turns_are_about_the_line_of_sight_or_the_locked_axis() {
    let turned: [(&str, Map); 4] = [
        ("90!", |p| DVec3::new(-p.y, p.x, p.z)),
        ("x90!", |p| DVec3::new(p.x, -p.z, p.y)),
        ("Y90!", |p| DVec3::new(p.z, p.y, -p.x)),
        ("z=pi rad!", |p| DVec3::new(-p.x, -p.y, p.z)),
    ];
    for (keys, expected) in turned {
        let mut session = Session::editing("cube", "vertex", &[]);
        let before = session.positions();
        let mut tool = session.transform(TransformKind::Rotate, settings());
        session.keys(&mut tool, keys);
        session.moved(&before, expected);
    }
}

#[test]
fn a_drag_around_the_pivot_turns_as_far_as_it_goes() {
    let mut session = Session::editing("cube", "vertex", &[]).at(500.0, 300.0);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::Rotate, settings());
    session.drag(&mut tool, 400.0, 200.0);
    session.moved(&before, |p| DVec3::new(-p.y, p.x, p.z));
    session.drag(&mut tool, 300.0, 300.0);
    session.drag(&mut tool, 400.0, 400.0);
    session.drag(&mut tool, 500.0, 300.0);
    assert!(tool.status().starts_with("Rotate 360.00°"), "once round: {}", tool.status());
    session.drag(&mut tool, 500.0, 305.0);
    session.hold(&mut tool, Modifiers::CTRL);
    assert!(tool.status().starts_with("Rotate 355.00°"), "steps of 5°: {}", tool.status());
}

#[test]
fn scales_are_along_all_or_some_axes() {
    let scaled: [(&str, Map); 5] = [
        ("2!", |p| p * 2.0),
        ("2>3>4!", |p| p * DVec3::new(2.0, 3.0, 4.0)),
        ("x2!", |p| p * DVec3::new(2.0, 1.0, 1.0)),
        ("Z.5!", |p| p * DVec3::new(0.5, 0.5, 1.0)),
        ("1-!", |p| -p),
    ];
    for (keys, expected) in scaled {
        let mut session = Session::editing("cube", "vertex", &[]);
        let before = session.positions();
        let mut tool = session.transform(TransformKind::Scale, settings());
        session.keys(&mut tool, keys);
        session.moved(&before, expected);
    }
    let mut session = Session::editing("cube", "vertex", &[]).at(450.0, 300.0);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::Scale, settings());
    session.drag(&mut tool, 525.0, 300.0);
    session.moved(&before, |p| p * 2.5);
    session.drag(&mut tool, 350.0, 300.0);
    session.moved(&before, |p| -p);
}

#[test]
fn a_key_turns_one_tool_into_another() {
    let mut session = Session::editing("cube", "vertex", &[]);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.keys(&mut tool, "x5");
    session.keys(&mut tool, "s2!");
    session.moved(&before, |p| p * DVec3::new(2.0, 1.0, 1.0));
    let mut tool = session.transform(TransformKind::Rotate, settings());
    session.keys(&mut tool, "r");
    assert!(tool.status().starts_with("Trackball"), "R R: {}", tool.status());
    session.keys(&mut tool, "90!");
    session.moved(&before, |p| DVec3::new(p.z, p.y, -2.0 * p.x));
    assert_eq!(session.document.history().done().last().map(|entry| entry.command().name()), Some("Rotate"));
}

#[test]
fn orientations_and_pivots_come_from_the_settings() {
    let mut session = Session::editing("cube", "vertex", &[]);
    let before = session.positions();
    let cursor = TransformSettings { pivot: Pivot::Cursor, cursor: DVec3::X, ..settings() };
    let mut tool = session.transform(TransformKind::Scale, cursor);
    session.keys(&mut tool, "3!");
    session.moved(&before, |p| (p - DVec3::X) * 3.0 + DVec3::X);
    session.document.undo().expect("one");
    let view = TransformSettings { orientation: Orientation::View, ..settings() };
    session.view.camera =
        trigon_document::scene::camera::Camera::look_at(DVec3::X * 10.0, DVec3::ZERO, DVec3::Y)
            .with_projection(session.view.camera.projection);
    let mut tool = session.transform(TransformKind::Translate, view);
    session.keys(&mut tool, "x2!");
    session.moved(&before, |p| p + DVec3::NEG_Z * 2.0);
}

#[test]
fn proportional_editing_is_toggled_and_the_wheel_changes_its_radius() {
    let mut session = Session::editing("grid", "vertex", &[12]);
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.keys(&mut tool, "oy1");
    assert_eq!(
        session.positions().iter().filter(|place| place.y > 0.0).count(),
        1,
        "neighbours are 1 m away"
    );
    for _ in 0..2 {
        session.input(&mut tool, Input::Wheel(1.0));
    }
    assert!(tool.status().contains("proportional 1.210 m"), "{}", tool.status());
    assert_eq!(session.positions().iter().filter(|place| place.y > 0.0).count(), 5, "they follow");
    assert!(tool.marks().circle.is_some(), "the reach is drawn");
}

#[test]
fn a_chosen_point_snaps_to_a_vertex_that_stays() {
    let mut session = Session::editing("cube", "vertex", &[]).at(490.0, 210.0);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.keys(&mut tool, "b");
    assert_eq!(session.input(&mut tool, Input::Pressed(PointerButton::Left)), ToolState::Running, "a choice");
    // The grid's corner at (2, 0) is drawn at (600, 300).
    session.drag(&mut tool, 595.0, 303.0);
    assert!(tool.marks().point.is_some_and(|point| point.truncate() == DVec2::X * 2.0), "{:?}", tool.marks());
    let way = session.positions()[0] - before[0];
    assert_eq!((way.x, way.y), (1.0, -1.0), "the cube's corner at (1, 1) lies on it");
}

#[test]
fn kept_points_are_snapped_to_in_their_middle() {
    let mut session = Session::editing("cube", "vertex", &[]).at(490.0, 210.0);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::Translate, settings());
    session.keys(&mut tool, "b");
    session.input(&mut tool, Input::Pressed(PointerButton::Left));
    // Corners of the grid at (2, 0) and (-2, 0).
    session.drag(&mut tool, 600.0, 300.0);
    session.keys(&mut tool, "a");
    session.drag(&mut tool, 200.0, 300.0);
    assert!(tool.status().contains("the middle of 2 points"), "{}", tool.status());
    let way = session.positions()[0] - before[0];
    assert_eq!((way.x, way.y), (-1.0, -1.0), "the cube's corner at (1, 1) lies between them");
}
