//! What hands guess: each of these was a wrong guess once, of somebody who knows Blender or who knows nothing.

use super::*;

fn play(script: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| user.play(script));
}

#[test]
fn e_s_extrudes_in_place_and_scales() {
    play(
        "
        hover 0 1 0
        keys Tab 3
        click 0 1 0
        keys E S . 5 Enter          # a step, half as wide
        mesh Cube 12 20 10
        see Scale
        keys Ctrl+Z                 # the scaling
        mesh Cube 12 20 10
        keys Ctrl+Z                 # the extrusion
        mesh Cube 8 12 6
    ",
    );
}

#[test]
fn a_new_name_replaces_the_old_one() {
    play(
        "
        hover 0 0 0
        keys F2
        type Box
        keys Enter
        see Box
        hidden Cube
        hidden BoxCube
    ",
    );
}

#[test]
fn the_right_button_offers_what_can_be_done() {
    play(
        "
        hover 0 1 0
        right click
        press Duplicate Objects
        keys X 3 Enter
        objects 3
        hover 0 1 0
        right click
        press Edit Mode             # the button of the bar above is the same action
        keys A
        hover 0 1 0
        right click
        press Subdivide
        see Subdivide
        right click
        press Delete Menu
        press Only Faces
        see Delete
        right click
        keys Escape
        hidden Delete Menu
        keys Ctrl+Z
    ",
    );
}

#[test]
fn the_status_line_says_how_a_tool_ends() {
    play(
        "
        hover 0 1 0
        keys G
        see Move, X/Y/Z: lock
        see click: done, right click: cancel
        keys Z
        move 0 -80
        see Move (0.0000, 0.0000, -
        see along global Z
        keys Ctrl+Z Ctrl+Z          # no undo in the middle of a tool
        see along global Z
        right click
        title untitled - trigon
        hidden Duplicate Objects    # a cancelled tool opens no menu
        pull X by 30
        title *untitled - trigon
    ",
    );
}

#[test]
fn a_tool_of_a_button_waits_for_a_press_in_the_view() {
    play(
        "
        hover 0 1 0
        keys Tab 3
        click 0 1 0
        press Extrude
        hover 0 1 0
        see Press in the view and drag
        see Extrude 0.0000 m
        drag 0 1 0 by 0 -40         # the whole tool
        mesh Cube 12 20 10
        see Last Operation
        keys Ctrl+Z
        press Extrude
        click 0 1 0                 # or it follows the pointer from here
        see Extrude 0.0000 m
        move 0 -20
        hidden Last Operation
        click
        mesh Cube 12 20 10
        keys Ctrl+Z
        press Extrude
        keys . 5 Enter              # or numbers
        mesh Cube 12 20 10
        keys Ctrl+Z
        press Extrude
        press Inset Faces           # thought better of
        mesh Cube 8 12 6
    ",
    );
}

#[test]
fn escape_closes_a_menu_of_the_bar() {
    play(
        "
        press Edit
        see Undo
        keys Escape
        hidden Undo
        keys G                      # and keys mean what they meant before
        see Move
        keys Escape
    ",
    );
}

#[test]
fn joined_objects_are_edited() {
    play(
        "
        hover 0 1 0
        keys Shift+D X 3 Enter
        keys Shift+D Z 2 Enter
        click 0 1 0 with Shift
        see 2 of 4 objects selected
        keys Ctrl+J
        objects 3
        keys Tab
        see vertices selected
        keys 1 A
        see 16 of 16 vertices selected
    ",
    );
}

#[test]
fn alt_h_shows_hidden_objects_again() {
    play(
        "
        hover 0 1 0
        keys H
        see 0 of 2 objects selected
        keys Alt+H
        see 1 of 2 objects selected
        keys G X 1 Enter
        see Last Operation
    ",
    );
}

#[test]
fn a_key_starts_a_tool_wherever_the_pointer_is() {
    play(
        "
        press X-Ray                 # the pointer stays on the bar
        keys G
        move 0 200
        see Move (
        right click
        title untitled - trigon
    ",
    );
}

#[test]
fn keys_mean_what_they_mean_after_a_file_was_saved() {
    play(
        "
        hover 0 1 0
        keys Ctrl+S
        type $FOLDER/saved
        keys Enter
        title saved.glb - trigon
        keys F1
        see Keys and Mouse
        keys Escape
        hidden Keys and Mouse
        keys Ctrl+S                 # it has its file now
        title saved.glb - trigon
        see Saved
    ",
    );
}

#[test]
fn four_views_have_a_button_for_those_who_know_no_key() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        for expected in [true, false] {
            user.play("press Four Views");
            assert_eq!(user.window.stage().four_views, expected, "a press of the button");
        }
    });
}
