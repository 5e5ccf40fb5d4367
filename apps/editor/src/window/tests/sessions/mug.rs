//! A mug with a handle: a surface of genus 1.

use trigon_window::scene::math::elementary;

use super::*;

/// Places are those of the prism of 16 sides: a side's middle lies at (0.96194, y, 0.19134), and what is pulled out
/// of it goes on along (0.98079, 0, 0.19509).
const MUG: &str = "
    keys X                                          # the cube
    keys Shift+A
    press Cylinder
    see Last Operation
    enter Segments 16
    objects 2
    see 1 of 2 objects selected
    hover 0 0 0
    keys Tab 3
    mesh Cylinder 32 48 18
    keys Alt+A
    click 0 1 0                                     # the top
    see 1 of 18 faces selected
    keys I . 1 Enter
    mesh Cylinder 48 80 34
    keys E - 1 . 8 Enter                            # hollow
    mesh Cylinder 64 112 50
    hover 0.992 0 0.038
    keys Ctrl+R                                     # rows of the outer side
    wheel 1
    wheel 1
    wheel 1
    see Loop Cut: 4
    click
    right click
    mesh Cylinder 128 240 114
    keys 3 Alt+A
    click 0.96194 0.4 0.19134
    click 0.96194 -0.4 0.19134 with Shift
    see 2 of 114 faces selected
    keys E . 3 Enter E . 2 Enter                    # the two ends of the handle
    mesh Cylinder 144 272 130
    keys Alt+A Numpad3 Numpad2
    click 1.35349 0.2 0.26922                       # the lower side of the upper end
    keys Numpad8 Numpad8
    click 1.35349 -0.2 0.26922 with Shift           # the upper side of the lower one
    see 2 of 130 faces selected
    keys F3
    type bridge
    keys Enter
    see Bridge
    mesh Cylinder 144 276 132
    title *untitled - trigon
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_mug_with_a_handle_is_closed_and_as_large_as_drawn() {
    saved_and_reopened(MUG, |document, _| {
        let mug = mesh(document, "Cylinder");
        assert_eq!((euler(mug), open_edges(mug)), (0, 0), "a closed surface with one handle");
        let (sin, cos) = elementary::sin_cos(std::f64::consts::PI / 16.0);
        let area = |radius: f64| 16.0 * sin * cos * radius * radius;
        let inner = (cos - 0.1) / cos;
        let width = 2.0 * sin;
        let handle = width * (2.0 * 0.4 * 0.5 + 0.4 * 0.2);
        let drawn = 2.0 * area(1.0) - 1.8 * area(inner) + handle;
        assert!((volume(mug) / drawn - 1.0).abs() < 0.01, "{} of {drawn} m³", volume(mug));
    });
}
