//! Texture coordinates by keys and menus.

use trigon_window::scene::camera::Viewport;
use trigon_window::scene::math::{DVec2, Vec2, Vec3};
use trigon_window::{Chord, PointerButton};

use super::sessions::{User, at_the_editor};
use super::*;
use crate::window::actions;
use crate::window::panes::points;

/// Presses chords with spaces between them; what they do may be refused.
fn press(worked: &mut Worked, chords: &str) {
    for text in chords.split_whitespace() {
        let chord: Chord = text.parse().expect("a chord");
        assert_eq!(worked.key(chord.key, chord.modifiers), Taken::Yes, "{text} does something");
    }
}

fn choose(worked: &mut Worked, name: &str) {
    let action = actions::named(name).expect("there is such an action");
    worked.editor.choose(&mut worked.stage, action);
    worked.editor.popup = None;
}

/// The position and texture coordinates of each corner of the cube.
fn corners(worked: &Worked) -> Vec<(Vec3, Vec2)> {
    let (id, _) = worked.editor.document.selection().meshes().next().expect("the cube is edited");
    let mesh = worked.editor.document.mesh(id).expect("it is");
    let corner =
        |corner| (mesh.position(mesh.corner_vertex(corner)), mesh.uv(0, corner).expect("a cube has a set"));
    mesh.corners().map(corner).collect()
}

#[test]
fn u_unwraps_along_seams_and_says_what_is_missing() {
    let mut worked = Worked::new();
    press(&mut worked, "Tab 3 A");
    let before = corners(&worked);
    press(&mut worked, "U U");
    assert!(worked.refusal().contains("mark seams"), "a closed cube has none: {}", worked.refusal());
    assert!(worked.editor.popup.is_none(), "the menu is gone");
    choose(&mut worked, "edge.mark_seam");
    press(&mut worked, "U U");
    let Message::Info(message) = &worked.editor.message else { panic!("it is done") };
    assert_eq!(message, "Unwrap: made 6 islands");
    for (_, uv) in corners(&worked) {
        // The margin is a hundredth.
        assert!(uv.cmpge(Vec2::splat(0.0099)).all() && uv.cmple(Vec2::splat(0.9901)).all(), "{uv}");
    }
    press(&mut worked, "Ctrl+Z");
    assert_eq!(corners(&worked), before, "undone");
    for (letter, message) in [
        ("M", "Unwrap: made 6 islands"),
        ("S", "Smart Projection: made 6 islands"),
        ("I", "Pack Islands: packed 6 islands"),
    ] {
        press(&mut worked, "U");
        press(&mut worked, letter);
        let Message::Info(said) = &worked.editor.message else { panic!("{letter} is refused") };
        assert_eq!(said, message, "{letter}");
    }
}

#[test]
fn texture_coordinates_are_those_of_the_view() {
    let mut worked = Worked::new();
    press(&mut worked, "Tab 3 A");
    for (view, seen) in [
        ("Numpad1", (|at| Vec2::new(at.x, at.y)) as fn(Vec3) -> Vec2),
        ("Numpad3", |at| Vec2::new(-at.z, at.y)),
        ("Numpad7", |at| Vec2::new(at.x, -at.z)),
    ] {
        press(&mut worked, view);
        choose(&mut worked, "uv.view");
        for (position, uv) in corners(&worked) {
            // The cube has edges of 2 m, and its image the upper left corner as origin.
            let expected = Vec2::new(0.5, 0.5) + seen(position) * Vec2::new(0.5, -0.5);
            assert!(uv.abs_diff_eq(expected, 1e-6), "{view}: {uv} for {expected}");
        }
    }
}

/// The middle of the texture coordinates of each face of the cube.
fn middles(user: &User<'_>) -> Vec<Vec2> {
    let editor = user.editor.borrow();
    let (id, _) = editor.document.selection().meshes().next().expect("the cube is edited");
    let mesh = editor.document.mesh(id).expect("it is");
    let middle = |face| {
        let uvs = mesh.face_corners(face).map(|corner| mesh.uv(0, corner).expect("a set"));
        uvs.sum::<Vec2>() / mesh.face_size(face) as f32
    };
    mesh.faces().map(middle).collect()
}

/// Where coordinates are seen in the window, in physical pixels.
fn seen(user: &User<'_>, uv: Vec2) -> DVec2 {
    let canvas = user.editor.borrow().uv.canvas.expect("the view is open");
    let at = canvas.point(uv.as_dvec2());
    DVec2::new(at.x.into(), at.y.into()) * points(user.window.stage())
}

#[test]
fn islands_are_picked_and_moved_in_the_uv_view_by_the_keys_of_the_3d_view() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], Viewport { width: 1200, height: 700 }, |user| {
        user.play("keys Tab 3 A U S Shift+F10\nsee 6 of 6 faces selected");
        let before = middles(user);
        let at = seen(user, before[2]);
        user.window.move_to(at);
        user.window.press(PointerButton::Left);
        user.window.release(PointerButton::Left);
        user.play("see 1 of 6 faces selected\nkeys G . 2 5 Tab . 5 Enter");
        let moved = middles(user);
        // v grows downwards, and what is typed upwards.
        assert!(
            (moved[2] - before[2]).abs_diff_eq(Vec2::new(0.25, -0.5), 1e-6),
            "{} to {}",
            before[2],
            moved[2]
        );
        for other in [0, 1, 3, 4, 5] {
            assert_eq!(moved[other], before[other], "it is another island");
        }
        user.play("keys Alt+A");
        let at = seen(user, moved[4]);
        user.window.move_to(at);
        user.play("keys L\nsee 1 of 6 faces selected\nkeys R 9 0 Enter");
        assert!(middles(user)[4].abs_diff_eq(moved[4], 1e-6), "it turns around its middle");
        user.play("keys S X 0 Enter Ctrl+Z Ctrl+Z Ctrl+Z");
        user.play("keys 1 Alt+A");
        let (before, at) = (middles(user), seen(user, middles(user)[1]));
        user.window.move_to(at);
        user.play("keys L\nsee 4 of 8 vertices selected\nkeys G . 5 Tab 0 Enter");
        let moved = middles(user);
        for face in 0..6 {
            let by = if face == 1 { Vec2::new(0.5, 0.0) } else { Vec2::ZERO };
            assert!(
                (moved[face] - before[face]).abs_diff_eq(by, 1e-6),
                "face {face}: the other islands stay"
            );
        }
        user.play("keys Ctrl+Z E");
        let message = user.editor.borrow().message.clone();
        assert!(matches!(&message, Message::Refusal(text) if text.contains("3D view")), "{message:?}");
        user.play("keys 3");
        // A box around everything.
        let (from, to) = (seen(user, Vec2::splat(-0.05)), seen(user, Vec2::splat(1.05)));
        user.window.move_to(from);
        user.window.press(PointerButton::Left);
        user.window.move_to((from + to) / 2.0);
        user.window.move_to(to);
        user.window.release(PointerButton::Left);
        assert!(user.editor.borrow().document.selection().meshes().all(|(_, faces)| faces.len() >= 5));
    });
}

/// With all edges as seams each side of a cube is an island of its own, and none covers the image.
#[test]
fn seams_unwrap_again_when_that_is_live() {
    for is_live in [false, true] {
        let mut worked = Worked::new();
        press(&mut worked, "Tab 2 A");
        let before = corners(&worked);
        worked.editor.uv.live_unwrap = is_live;
        choose(&mut worked, "edge.mark_seam");
        let after = corners(&worked);
        assert_eq!(before != after, is_live, "live: {is_live}");
        if is_live {
            assert!(after.iter().all(|(_, uv)| uv.cmpge(Vec2::splat(0.0099)).all()), "with the margin");
        }
        press(&mut worked, "Ctrl+Z");
        assert_eq!(corners(&worked), before, "one step");
    }
}

/// `P` separates parts over the 3D view, and pins coordinates over the UV view.
#[test]
fn keys_over_the_uv_view_pin_and_stitch() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], Viewport { width: 1200, height: 700 }, |user| {
        user.play("keys Tab 3 A U S Shift+F10");
        let before = middles(user);
        let at = seen(user, before[2]);
        user.window.move_to(at);
        user.window.press(PointerButton::Left);
        user.window.release(PointerButton::Left);
        let pinned = |user: &User<'_>| {
            let editor = user.editor.borrow();
            let (id, _) = editor.document.selection().meshes().next().expect("the cube is edited");
            let mesh = editor.document.mesh(id).expect("it is");
            mesh.corners().filter(|&corner| mesh.is_uv_pinned(0, corner)).count()
        };
        user.play("keys P\nsee changed 4 corners");
        assert_eq!(pinned(user), 4, "those of the face");
        user.play("keys Alt+P");
        assert_eq!(pinned(user), 0, "free again");
        user.play("keys V\nmesh Cube 8 12 6\nsee Stitch");
    });
}

#[test]
fn the_uv_view_leaves_the_scene_its_own_part_of_the_window() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], Viewport { width: 1200, height: 700 }, |user| {
        let before = user.window.stage().visible_area();
        user.play("keys Shift+F10");
        let after = user.window.stage().visible_area();
        assert!(after.size.width < before.size.width * 3 / 4 && after.min == before.min, "{after:?}");
        user.play("keys Shift+F10");
        assert_eq!(user.window.stage().visible_area(), before, "and back");
    });
}
