//! A textured table that is exported for printing.

use trigon_io::{LoadOptions, load};

use super::*;

/// Places are the document's: y is up.
const TABLE: &str = "
    press View
    press Up Axis
    press Z Is Up
    hover 0 1 0
    keys Tab A S Z . 1 Enter                        # 2 m wide and 0.2 m thick
    keys 2
    hover 0 0.1 0.98
    keys Ctrl+R
    wheel 1
    click
    right click
    keys S X 2 . 1 Enter
    hover 0.98 0.1 0
    keys Ctrl+R
    wheel 1
    click
    right click
    keys S Y 2 . 1 Enter
    mesh Cube 32 60 30
    keys 3 Ctrl+Numpad7
    click -0.85 -0.1 -0.85
    click 0.85 -0.1 -0.85 with Shift
    click 0.85 -0.1 0.85 with Shift
    click -0.85 -0.1 0.85 with Shift
    see 4 of 30 faces selected
    keys E 1 . 4 Enter
    mesh Cube 48 92 46
    keys A                                          # texture coordinates
    press UV
    press Unwrap
    press Cube Projection
    see Cube Projection
    keys Tab
    scroll Open Base color image
    press Open Base color image
    type $FOLDER/wood.png
    keys Enter
    see Base color image: wood
    press Information
    press Properties
    press View
    press Save Screenshot…
    keys Ctrl+A
    type $FOLDER/view.png
    keys Enter
    wait
    see Saved
    keys Z S
    keys Ctrl+C Ctrl+V G Z 2 Enter                  # another table over it
    see Cube.001
    keys Ctrl+Z Ctrl+Z
    press File
    press Export…
    keys Ctrl+A
    type $FOLDER/table.stl
    see for printing
    press unit of the file
    press millimetres
    keys Enter
    see not in table.stl
    press Close
    keys F12
    enter width of the image 96
    enter height of the image 64
    press quality of the image
    press Draft
    press The View
    press Render
    wait
    press Save Image…
    keys Ctrl+A
    type $FOLDER/table.jpg
    keys Enter
    wait
    see Saved
    keys Escape
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_textured_table_is_exported_for_printing_with_z_up_in_millimetres() {
    from_the_cube_and_from_nothing(TABLE, |document, folder| {
        let table = mesh(document, "Cube");
        assert_eq!((euler(table), open_edges(table)), (2, 0), "one closed surface");
        let drawn = 2.0 * 0.2 * 2.0 + 4.0 * 0.3 * 0.3 * 1.4;
        assert!((volume(table) - drawn).abs() < 1e-5, "{} of {drawn} m³", volume(table));
        assert_eq!(document.nodes().textures.len(), 1, "the image of the wood");
        let printed = load(folder.join("table.stl"), &LoadOptions::default()).expect("it can be read");
        let points: Vec<_> = printed.scene.visible_points().collect();
        let size = |axis: usize| {
            let along = points.iter().map(|point| point[axis]);
            along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
        };
        assert_eq!(
            [0, 1, 2].map(|axis| size(axis).round()),
            [2000.0, 2000.0, 1600.0],
            "z is up, in millimetres"
        );
    });
}
