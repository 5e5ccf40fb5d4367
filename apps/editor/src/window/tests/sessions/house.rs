//! A house with a gable roof and two windows, with +Z up on the screen.

use super::*;

/// Places are the document's: y is up. The walls are 4 m wide, 2 m high and deep, and the ridge is 1 m higher.
const HOUSE: &str = "
    press View
    press Up Axis
    press Z Is Up
    press Information                               # the tabs leave each other where they are
    see Dimensions
    press Properties
    keys Ctrl+O
    see Open
    keys Escape                                     # and the keyboard is the view's again
    hidden Open
    hover 0 1 0
    keys Tab A S X 2 Enter
    keys 2
    hover 1.98 1 0
    keys Ctrl+R                                     # along the house
    click
    right click
    mesh Cube 12 20 10
    keys Alt+A
    click 0 1 0
    see 1 of 20 edges selected
    keys G Z 1 Enter                                # the ridge goes up
    see Move
    hover 0 0.98 1
    keys Ctrl+R                                     # four cuts across the front
    wheel 1
    wheel 1
    wheel 1
    see Loop Cut: 4
    click
    right click
    mesh Cube 36 68 34
    keys 3 Alt+A Numpad1
    see Orthographic
    click -0.8 0 1
    click 0.8 0 1 with Shift
    see 2 of 34 faces selected
    keys I . 2 Enter
    mesh Cube 44 84 42
    keys E - . 1 Enter
    mesh Cube 52 100 50
    scroll New
    press New                                       # glass for the faces that are selected
    scroll Assign
    press Assign
    scroll Base color hex
    enter Base color hex 3060a0
    keys Alt+A
    hover 0 0 1
    keys L
    see 50 of 50 faces selected
    keys Alt+E
    see Extrude Along Normals
    keys Escape
    keys X F                                        # a letter of the menu
    mesh Cube 0 0 0
    keys Ctrl+Z
    mesh Cube 52 100 50
    keys Tab Ctrl+C Ctrl+V
    see Cube.001
    keys X
    hidden Cube.001
    press File
    press Export…
    see Loses the tree of objects
    keys Ctrl+A
    type $FOLDER/house.obj
    keys Enter
    see house.obj
    keys Escape
    keys F12
    see The scene has no camera
    enter width of the image 96
    enter height of the image 64
    press quality of the image
    press Draft
    press Render the View
    wait
    see 96 × 64 pixels
    press Save Image…
    keys Ctrl+A
    type $FOLDER/house.webp
    keys Enter
    wait
    see Saved
    keys Escape
    title *untitled - trigon
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_house_with_windows_is_built_rendered_and_exported() {
    from_the_cube_and_from_nothing(HOUSE, |document, folder| {
        let house = mesh(document, "Cube");
        assert_eq!((euler(house), open_edges(house)), (2, 0), "one closed surface");
        // Of each window a border of 0.2 m stays, and 0.1 m goes inwards.
        let drawn = 4.0 * 2.0 * 2.0 + 4.0 * 2.0 * 1.0 / 2.0 - 2.0 * 0.4 * 1.6 * 0.1;
        assert!((volume(house) - drawn).abs() < 1e-5, "{} of {drawn} m³", volume(house));
        let glass = house.faces().filter(|face| house.material(*face) == 1).count();
        assert_eq!(glass, 2, "the panes are of glass");
        assert!(folder.join("house.webp").exists() && folder.join("house.mtl").exists(), "both were written");
    });
}
