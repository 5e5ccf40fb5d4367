//! The view through the scene's camera.

use trigon_window::scene::camera::Viewport;

use super::sessions::{User, at_the_editor};

/// Turning the camera left the view where it was, with a skewed frame, and moving it by the pointer did nothing.
#[test]
fn the_view_through_the_camera_follows_it() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], Viewport { width: 1000, height: 700 }, |user| {
        user.play("keys Shift+A\npress Camera\nkeys Ctrl+Alt+Numpad0");
        let camera = |user: &User<'_>| {
            let editor = user.editor.borrow();
            let (_, camera) = crate::window::navigation::camera(&editor.document).expect("it was added");
            (camera.position, camera.orientation)
        };
        let shown = |user: &User<'_>| {
            let camera = user.window.stage().camera();
            (camera.position, camera.orientation)
        };
        let is_same = |user: &User<'_>| {
            let ((at, turn), (eye, view)) = (camera(user), shown(user));
            at.distance(eye) < 1e-6 && turn.angle_between(view) < 1e-6
        };
        assert!(is_same(user), "{:?} and {:?}", camera(user), shown(user));
        let before = camera(user);
        user.play("keys R 2 0 Enter");
        assert!(
            is_same(user) && camera(user).1.angle_between(before.1) > 0.3,
            "it is turned, and the view with it"
        );
        user.play("hover 0 0 0\nkeys G\nmove 60 20\nclick");
        assert!(is_same(user) && camera(user).0.distance(before.0) > 0.01, "it is moved");
        assert!(user.editor.borrow().view.camera.is_some(), "it is still looked through");
        user.play("keys Numpad4");
        assert!(user.editor.borrow().view.camera.is_none(), "who turns the view has left the camera");
    });
}
