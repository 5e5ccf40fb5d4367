//! A chair from a cube.

use super::*;

/// As a user of Blender makes it.
const CHAIR: &str = "
    title untitled - trigon
    see 1 of 2 objects selected
    hover 0 1 0
    keys Tab A S Y . 1 Enter                # the seat, 2 m wide and 0.2 m thick
    see Scale
    title *untitled - trigon
    keys 2
    hover 0 0.1 0.98
    keys Ctrl+R                             # across the front edge: cuts from front to back
    wheel 1
    click
    right click                             # do not slide
    mesh Cube 16 28 14
    see 8 of 28 edges selected
    keys S X 2 . 1 Enter
    hover 0.98 0.1 0
    keys Ctrl+R
    wheel 1
    click
    right click
    keys S Z 2 . 1 Enter
    mesh Cube 32 60 30
    keys 3 Ctrl+Numpad7                     # faces, from below
    click -0.85 -0.1 -0.85
    click 0.85 -0.1 -0.85 with Shift
    click 0.85 -0.1 0.85 with Shift
    click -0.85 -0.1 0.85 with Shift
    see 4 of 30 faces selected
    keys E 1 . 8 Enter                      # legs
    mesh Cube 48 92 46
    see Extrude
    keys Numpad7
    click 0 0.1 -0.85
    click -0.85 0.1 -0.85 with Shift
    click 0.85 0.1 -0.85 with Shift
    see 3 of 46 faces selected
    keys E 2 Enter                          # the back
    mesh Cube 56 108 54
    keys Tab F2
    type chair
    keys Enter
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_chair_is_made_from_a_cube_and_saved() {
    saved_and_reopened(CHAIR, |document, _| {
        let chair = mesh(document, "chair");
        assert_eq!((euler(chair), open_edges(chair)), (2, 0), "one closed surface");
        let drawn = 2.0 * 0.2 * 2.0 + 4.0 * 0.3 * 0.3 * 1.8 + 2.0 * 0.3 * 2.0;
        // Vertices are single numbers of about 1 m: their rounding times the surface of 15 m².
        assert!((volume(chair) - drawn).abs() < 1e-5, "{} of {drawn} m³", volume(chair));
    });
}
