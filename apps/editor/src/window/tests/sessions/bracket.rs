//! A bracket: a fillet by a bevel, and two holes by booleans.

use super::*;

const BRACKET: &str = "
    hover 0 1 0
    keys Tab A S Y . 1 5 Enter                      # a plate of 0.3 m
    keys 2
    hover 0.98 0.15 0
    keys Ctrl+R
    click
    right click
    keys G Z - . 7 Enter
    keys 3 Numpad7
    click 0 0.15 -0.85
    see 1 of 10 faces selected
    keys E 2 Enter                                  # the wall
    keys Numpad1 Numpad9 Numpad9
    keys Numpad4 Numpad4 Numpad8 Numpad8 2
    click 0 0.15 -0.7                               # the edge between plate and wall
    keys Ctrl+B
    wheel 5
    keys . 4 Enter
    keys Tab Shift+A
    type cylinder
    keys Enter
    enter Radius 0.3
    keys G Z . 3 Enter
    click 0.9 0.15 0.9 with Shift                   # the bracket is active
    see 2 of 3 objects selected
    keys Ctrl+Numpad-
    see combined with 1 object
    keys Shift+A
    type cylinder
    keys Enter
    enter Radius 0.3
    keys R X 9 0 Enter G Y 1 . 3 Enter G Z - . 8 5 Enter
    click 0.9 1.9 -0.7 with Shift
    keys Ctrl+Numpad-
    see combined with 1 object
    keys F2
    type bracket
    keys Enter Numpad.
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_bracket_gets_a_fillet_and_two_holes() {
    saved_and_reopened(BRACKET, |document, _| {
        let bracket = mesh(document, "bracket");
        assert!(bracket.is_watertight());
        assert_eq!(euler(bracket), 2 - 2 * 2, "a solid with two holes through it");
        // The plate, the wall, a fillet of six sides around a quarter of a circle, and holes of 32 sides.
        let polygon = |sides: f64, radius: f64| {
            0.5 * sides
                * radius
                * radius
                * trigon_window::scene::math::elementary::sin(std::f64::consts::TAU / sides)
        };
        let fillet = 2.0 * (0.4 * 0.4 - polygon(24.0, 0.4) / 4.0);
        let drawn = 2.0 * 0.3 * 2.0 + 2.0 * 2.0 * 0.3 + fillet - 2.0 * 0.3 * polygon(32.0, 0.3);
        let volume = volume(bracket);
        // Vertices are single numbers of about 1 m: their rounding times the surface of 20 m².
        assert!((volume - drawn).abs() < 1e-5, "{volume} for {drawn} m³");
    });
}
