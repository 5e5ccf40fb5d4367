//! Several kinds of elements at once, rips, and the keys of a bevel.

use super::*;

fn play(script: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| user.play(script));
}

#[test]
fn shift_and_a_digit_let_clicks_select_several_kinds() {
    play(
        "
        hover 0 1 0
        keys Tab 1 Shift+3
        see 0 of 8 vertices, 0 of 6 faces selected
        click 0 1 0                 # a face, by its vertices
        see 4 of 8 vertices, 1 of 6 faces selected
        click 1 1 1                 # a vertex
        see 1 of 8 vertices, 0 of 6 faces selected
        click 0 1 0 with Shift      # one of its vertices was selected, now all are
        see 4 of 8 vertices, 1 of 6 faces selected
        click 0 1 0 with Shift
        see 0 of 8 vertices, 0 of 6 faces selected
        keys Shift+2
        click 0 1 1                 # an edge
        see 2 of 8 vertices, 1 of 12 edges, 0 of 6 faces selected
        click 0 1 0 with Shift
        keys Shift+1                # without vertices, the first kind is edges
        see 4 of 12 edges, 1 of 6 faces selected
        keys Ctrl+Z
        see 4 of 8 vertices, 4 of 12 edges, 1 of 6 faces selected
        keys 3 Shift+3              # the last kind stays
        see 1 of 6 faces selected
    ",
    );
}

#[test]
fn v_rips_on_the_pointers_side_and_moves_it() {
    play(
        "
        hover 0 1 0
        keys Tab 2
        click 0 1 1
        hover 0 1 0
        keys V Y 1 Enter            # the upper face comes loose at the edge
        mesh Cube 10 15 6
        see Move
        keys Ctrl+Z Ctrl+Z
        mesh Cube 8 12 6
        keys Alt+V Escape           # ends the move, and the filled rip stays
        mesh Cube 10 17 9
        keys Ctrl+Z 1
        click 1 1 1
        hover 0 1 0
        keys V Enter
        mesh Cube 9 14 6
        keys Ctrl+Z 3
        click 0 1 0
        keys V
        see switch to one of these
        mesh Cube 8 12 6
    ",
    );
}

#[test]
fn a_bevel_obeys_its_keys_and_its_panel_keeps_them() {
    play(
        "
        hover 0 1 0
        keys Tab 3
        click 0 1 0
        hover 0 1 0
        keys Ctrl+B M M M
        see M: percent
        keys 2 5 I K Enter
        mesh Cube 16 28 14
        see Width type
        see Inner miter
    ",
    );
}

/// The default cube: an edge of 2 m, and the right angle at its end.
#[test]
fn clicks_measure_lengths_and_angles_and_change_nothing() {
    play(
        "
        press Measure
        click 1 1 1
        see Measure: 
        hover -1 1 1
        see 2.0000 m
        click -1 1 1
        hover -1 -1 1
        see 2.0000 m, 90.00°, 4.0000 m in all
        keys Backspace
        see 2.8284 m. Click         # across the face: the square root of 8
        keys Escape
        title untitled - trigon
        keys Tab
        press Measure
        click 1 1 1
        hover 1 1 -1
        see 2.0000 m
        keys Escape
    ",
    );
}
