//! Texture coordinates by keys and menus.

use trigon_window::Chord;
use trigon_window::scene::math::{Vec2, Vec3};

use super::*;
use crate::window::actions;

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
