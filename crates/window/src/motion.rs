//! Turns input movements into movements of camera and objects. The effect of a drag does not depend
//! on the size of the window or its resolution.

use std::f64::consts::PI;

use trigon_camera::Viewport;
use trigon_math::{DVec2, DVec3, elementary};

use crate::Stage;
use crate::keymap::{CameraMotion, DragAction, Motion, ObjectMotion};

/// A drag over the height of the window rotates the camera by half a turn.
const TURN_PER_HEIGHT: f64 = PI;

/// A drag over the height of the window magnifies by e to this power.
const ZOOM_PER_HEIGHT: f64 = 3.0;

/// A line of the wheel magnifies by e to this power: to 1.1 times the size, as in F3D.
const ZOOM_PER_LINE: f64 = 0.095_310_179_804_324_87;

/// The pointer moved from one position to another with a button down. `anchor` is the world point
/// that zooming to the pointer keeps in place.
pub(crate) fn drag(stage: &mut Stage, action: DragAction, from: DVec2, to: DVec2, anchor: Option<DVec3>) {
    let pane = stage.pane_at(from);
    let Viewport { width, height } = pane.area.size;
    let size = DVec2::new(width.max(1).into(), height.max(1).into());
    let way = (to - from) / size.y;
    match action {
        // The scene follows the pointer, so the eye moves the opposite way; y is down.
        DragAction::Orbit => stage.orbit.orbit(-way.x * TURN_PER_HEIGHT, way.y * TURN_PER_HEIGHT),
        DragAction::Pan => {
            let (mut orbit, height) = (pane.orbit, stage.orbit.height_at_target());
            orbit.pan(-way.x * height, way.y * height);
            stage.orbit.set_target(orbit.target());
        }
        DragAction::Roll => {
            let angle = |at: DVec2| elementary::atan2(at.y - size.y * 0.5, at.x - size.x * 0.5);
            stage.orbit.roll(angle(to) - angle(from));
        }
        DragAction::Zoom => stage.orbit.zoom(elementary::exp(-way.y * ZOOM_PER_HEIGHT)),
        DragAction::ZoomToPointer => zoom(stage, -way.y * ZOOM_PER_HEIGHT, anchor),
    }
}

/// The wheel was turned by this many lines.
pub(crate) fn wheel(stage: &mut Stage, lines: f64, anchor: Option<DVec3>) {
    zoom(stage, lines * ZOOM_PER_LINE, anchor);
}

/// Magnifies by e to this power, about the anchor if there is one.
pub(crate) fn zoom(stage: &mut Stage, power: f64, anchor: Option<DVec3>) {
    let factor = elementary::exp(power);
    match anchor {
        Some(anchor) => stage.orbit.zoom_about(anchor, factor),
        None => stage.orbit.zoom(factor),
    }
}

/// A key was held for this many seconds.
pub(crate) fn hold(stage: &mut Stage, motion: Motion, seconds: f64) {
    match motion {
        Motion::Camera(CameraMotion::Orbit(right, up)) => stage.orbit.orbit(right * seconds, up * seconds),
        Motion::Camera(CameraMotion::Pan(right, up)) => {
            let height = stage.orbit.height_at_target() * seconds;
            stage.orbit.pan(right * height, up * height);
        }
        Motion::Camera(CameraMotion::Zoom(power)) => zoom(stage, power * seconds, None),
        Motion::Camera(CameraMotion::Roll(angle)) => stage.orbit.roll(angle * seconds),
        Motion::Object(ObjectMotion::Move(by)) => {
            let height = stage.orbit.height_at_target();
            move_selection(stage, by * height * seconds);
        }
        Motion::Object(ObjectMotion::Turn(by)) => turn_selection(stage, by * seconds),
    }
}

/// Moves the selected object along the axes of the image.
fn move_selection(stage: &mut Stage, by: DVec3) {
    let Some(by) = in_parent(stage, by) else { return };
    let node = stage.selection.and_then(|id| stage.scene.node_mut(id));
    if let Some(node) = node {
        node.transform.translate(by);
    }
}

/// Rotates the selected object about its origin, around an axis of the image, by the axis' length
/// in radians.
fn turn_selection(stage: &mut Stage, by: DVec3) {
    let angle = by.length();
    let Some(axis) = in_parent(stage, by) else { return };
    let node = stage.selection.and_then(|id| stage.scene.node_mut(id));
    if let Some(node) = node {
        node.transform.rotate(axis, angle);
    }
}

/// A direction of the image in the space of the selected object's parent; `None` without a
/// selection, or if that space is flat.
fn in_parent(stage: &Stage, direction: DVec3) -> Option<DVec3> {
    let node = stage.scene.node(stage.selection?)?;
    let world = stage.orbit.orientation() * direction;
    let Some(parent) = node.parent() else { return Some(world) };
    let local = stage.scene.world_transform(parent).matrix3.inverse() * world;
    local.is_finite().then_some(local)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_camera::{AxisView, Projector};
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, Transform};

    fn stage() -> Stage {
        let mut stage = Stage::new("test");
        let cube = stage.scene.add_object("cube", primitives::cube(2.0), Material::default());
        stage.resize(Viewport { width: 400, height: 300 });
        stage.orbit.set_view(AxisView::Front);
        stage.fit_view();
        stage.selection = Some(cube);
        stage
    }

    #[test]
    fn panning_keeps_the_scene_under_the_hand() {
        let mut stage = stage();
        let point = stage.orbit.target();
        let screen = |stage: &Stage| {
            Projector::new(&stage.camera(), stage.viewport()).to_screen(point).expect("before the eye")
        };
        let before = screen(&stage);
        drag(&mut stage, DragAction::Pan, DVec2::new(10.0, 20.0), DVec2::new(45.0, 5.0), None);
        let moved = screen(&stage) - before;
        assert!(moved.distance(DVec2::new(35.0, -15.0)) < 1e-9, "moved by {moved}");
    }

    #[test]
    fn rolling_turns_the_image_with_the_hand() {
        let mut stage = stage();
        let point = DVec3::new(0.5, 0.0, 0.0);
        let screen = |stage: &Stage| {
            Projector::new(&stage.camera(), stage.viewport()).to_screen(point).expect("before the eye")
        };
        let middle = DVec2::new(200.0, 150.0);
        assert!((screen(&stage) - middle).y.abs() < 1e-9, "the point is to the right of the middle");
        // A quarter of a turn clockwise on the screen.
        drag(&mut stage, DragAction::Roll, DVec2::new(300.0, 150.0), DVec2::new(200.0, 250.0), None);
        let at = screen(&stage) - middle;
        assert!(at.x.abs() < 1e-9 && at.y > 0.0, "it is below now: {at}");
        hold(&mut stage, Motion::Camera(CameraMotion::Roll(1.0)), 0.1);
        assert!((screen(&stage) - middle).x < at.x, "the eye turns counter-clockwise, the image clockwise");
    }

    #[test]
    fn orbiting_moves_the_front_with_the_hand() {
        let mut stage = stage();
        drag(&mut stage, DragAction::Orbit, DVec2::ZERO, DVec2::new(30.0, 0.0), None);
        assert!(stage.camera().position.x < 0.0, "to the right: the eye goes left");
        drag(&mut stage, DragAction::Orbit, DVec2::ZERO, DVec2::new(0.0, 30.0), None);
        assert!(stage.camera().position.y > 0.0, "down: the eye goes up");
        let distance = stage.orbit.distance();
        drag(&mut stage, DragAction::Zoom, DVec2::ZERO, DVec2::new(0.0, -30.0), None);
        assert!(stage.orbit.distance() < distance, "up is closer");
        wheel(&mut stage, -2.0, None);
        wheel(&mut stage, 2.0, None);
        let expected = distance * elementary::exp(-0.3);
        assert!((stage.orbit.distance() - expected).abs() < 1e-9, "the wheel back undoes the wheel");
    }

    #[test]
    fn objects_move_in_the_image_whatever_they_hang_on() {
        let mut stage = stage();
        let turned = Transform::from_scale_rotation_translation(
            DVec3::splat(4.0),
            trigon_math::DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0),
            DVec3::new(3.0, 0.0, 0.0),
        );
        let parent = stage.scene.add(Node::default().with_transform(turned));
        let child = stage.selection.expect("the cube is selected");
        stage.scene.set_parent(child, Some(parent)).expect("no cycle");
        let before = stage.scene.world_transform(child).translation;
        hold(&mut stage, Motion::Object(ObjectMotion::Move(DVec3::X)), 0.5);
        let moved = stage.scene.world_transform(child).translation - before;
        let expected = DVec3::X * 0.5 * stage.orbit.height_at_target();
        assert!(moved.distance(expected) < 1e-9, "half a height to the right: {moved}");

        hold(&mut stage, Motion::Object(ObjectMotion::Turn(DVec3::Y)), 0.5);
        let front = stage.scene.world_transform(child).transform_vector3(DVec3::X).normalize();
        // Half a turn about z by the parent, then half a radian about y.
        let (sin, cos) = elementary::sin_cos(0.5);
        assert!(front.distance(DVec3::new(-cos, 0.0, sin)) < 1e-9, "turned about the upward axis: {front}");
    }

    #[test]
    fn the_selected_object_is_looked_at() {
        let mut stage = stage();
        let child = stage.selection.expect("the cube is selected");
        let away = DVec3::new(3.0, -2.0, 5.0);
        stage.scene.node_mut(child).expect("it is there").transform.translate(away);
        crate::commands::act(&mut stage, crate::keymap::Action::LookAtSelected);
        assert_eq!(stage.orbit.target(), away, "its middle");
        stage.selection = None;
        crate::commands::act(&mut stage, crate::keymap::Action::LookAtSelected);
        assert_eq!(stage.orbit.target(), away, "and nothing without one");
    }

    #[test]
    fn without_a_selection_object_keys_do_nothing() {
        let mut stage = stage();
        let bounds = stage.scene.bounds();
        stage.selection = None;
        hold(&mut stage, Motion::Object(ObjectMotion::Move(DVec3::X)), 1.0);
        hold(&mut stage, Motion::Object(ObjectMotion::Turn(DVec3::X)), 1.0);
        assert_eq!(stage.scene.bounds(), bounds, "nothing moved");
    }

    #[test]
    fn held_keys_go_on_by_the_second() {
        let mut stage = stage();
        let held = |stage: &mut Stage, motion| hold(stage, Motion::Camera(motion), 2.0);
        let distance = stage.orbit.distance();
        held(&mut stage, CameraMotion::Zoom(0.25));
        let expected = distance * elementary::exp(-0.5);
        assert!((stage.orbit.distance() - expected).abs() < 1e-9, "closer by e to half");
        let (before, height) = (stage.orbit.target(), stage.orbit.height_at_target());
        held(&mut stage, CameraMotion::Pan(0.25, -0.5));
        let moved = stage.orbit.target() - before;
        assert!(moved.distance(DVec3::new(0.5, -1.0, 0.0) * height) < 1e-9, "{moved} of {height}");
        held(&mut stage, CameraMotion::Orbit(0.2, 0.0));
        let eye = stage.orbit.orientation() * DVec3::Z;
        let (sin, cos) = elementary::sin_cos(0.4);
        assert!(eye.distance(DVec3::new(sin, 0.0, cos)) < 1e-9, "{eye}: to the right");
        held(&mut stage, CameraMotion::Orbit(0.0, 0.1));
        assert!(((stage.orbit.orientation() * DVec3::Z).y - elementary::sin_cos(0.2).0).abs() < 1e-9, "up");
    }

    #[test]
    fn zooming_to_the_pointer_keeps_what_is_there() {
        let mut stage = stage();
        let anchor = DVec3::new(0.7, -0.4, 1.0);
        let screen = |stage: &Stage| {
            Projector::new(&stage.camera(), stage.viewport()).to_screen(anchor).expect("before the eye")
        };
        let (before, distance) = (screen(&stage), stage.orbit.distance());
        drag(&mut stage, DragAction::ZoomToPointer, DVec2::ZERO, DVec2::new(9.0, -30.0), Some(anchor));
        assert!(screen(&stage).distance(before) < 1e-6, "it stays in place");
        // A tenth of the window's height.
        let factor = elementary::exp(-0.1 * ZOOM_PER_HEIGHT);
        assert!((stage.orbit.distance() / distance - factor).abs() < 1e-9, "and comes closer");
        wheel(&mut stage, 1.0, Some(anchor));
        assert!(screen(&stage).distance(before) < 1e-6, "with the wheel, too");
        assert!((stage.orbit.distance() * 1.1 / distance - factor).abs() < 1e-9, "to 1.1 times the size");
    }

    /// The way of a drag is told in heights of the view, whatever its width.
    #[test]
    fn a_drag_over_the_height_turns_by_half() {
        let mut stage = stage();
        drag(&mut stage, DragAction::Orbit, DVec2::ZERO, DVec2::new(-75.0, 0.0), None);
        let eye = stage.orbit.orientation() * DVec3::Z;
        let (sin, cos) = elementary::sin_cos(PI / 4.0);
        assert!(eye.distance(DVec3::new(sin, 0.0, cos)) < 1e-9, "{eye}: a quarter of it, to the right");
        drag(&mut stage, DragAction::Orbit, DVec2::ZERO, DVec2::new(0.0, 50.0), None);
        let up = (stage.orbit.orientation() * DVec3::Z).y;
        assert!((up - elementary::sin_cos(PI / 6.0).0).abs() < 1e-9, "{up}: a sixth, up");
    }
}
