//! A chair by somebody who knows no key: menus, buttons, the gizmo, and numbers that are typed into fields.

use super::*;

/// Only Shift is held, for more than one face at a time.
const CHAIR: &str = "
    see Middle drag or Alt+left drag orbits
    press Scale                             # the tool on the left waits for a drag in the view
    drag 0 1 0 by 0 40
    see Last Operation
    enter Factors X 1
    enter Factors Y 0.1
    enter Factors Z 1
    press Edit
    press Apply
    press All Transforms                    # lengths are metres again
    press Edit Mode
    press Loop Cut
    hover 0 0.1 0.98
    wheel 1
    click
    right click
    mesh Cube 16 28 14
    press Scale
    drag 0.5 0.1 0 by 40 0
    enter Factors X 2.1
    enter Factors Y 1
    enter Factors Z 1
    press Loop Cut
    hover 0.98 0.1 0
    wheel 1
    click
    right click
    mesh Cube 32 60 30
    press Scale
    drag 0.5 0.1 0 by 40 0
    enter Factors X 1
    enter Factors Y 1
    enter Factors Z 2.1
    press Face
    press View
    press Viewpoint
    press Bottom
    click -0.85 -0.1 -0.85
    click 0.85 -0.1 -0.85 with Shift
    click 0.85 -0.1 0.85 with Shift
    click -0.85 -0.1 0.85 with Shift
    see 4 of 30 faces selected
    press Extrude
    drag 0.3 -0.1 0 by 0 -30
    enter Distance 1.8
    mesh Cube 48 92 46
    press View
    press Viewpoint
    press Top
    click 0 0.1 -0.85
    click -0.85 0.1 -0.85 with Shift
    click 0.85 0.1 -0.85 with Shift
    see 3 of 46 faces selected
    press Extrude
    drag 0.3 0.1 0 by 0 -30
    enter Distance 2
    mesh Cube 56 108 54
    press Object Mode
    press Edit
    press Rename…
    type chair
    keys Enter
    see chair
    press File
    press Save
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_newcomer_makes_the_chair_with_the_mouse() {
    saved_and_reopened(CHAIR, |document, _| {
        let chair = mesh(document, "chair");
        assert_eq!((euler(chair), open_edges(chair)), (2, 0), "one closed surface");
        let drawn = 2.0 * 0.2 * 2.0 + 4.0 * 0.3 * 0.3 * 1.8 + 2.0 * 0.3 * 2.0;
        assert!((volume(chair) - drawn).abs() < 1e-4, "{} of {drawn} m³", volume(chair));
    });
}
