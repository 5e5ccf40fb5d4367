//! A wine bottle by extrusion and subdivision.

use super::*;

/// Places are the document's: y is up.
const BOTTLE: &str = "
    press View
    press Up Axis
    press Z Is Up
    hover 0 1 0
    keys Tab A S . 4 Enter
    keys 3 Alt+A Numpad7
    click 0 0.4 0
    see 1 of 6 faces selected
    keys E 1 Enter                                  # the belly
    keys E . 5 Enter S . 4 Enter                    # the shoulder
    keys E . 6 Enter                                # the neck
    mesh Cube 20 36 18
    keys I . 0 3 Enter E - . 5 Enter                # and its mouth
    mesh Cube 28 52 26
    keys Shift+S
    see Cursor to Selected
    keys Escape
    keys Tab Ctrl+2
    press Edit
    press Subdivision Surface
    press Apply
    mesh Cube 418 832 416
    keys F2
    type bottle
    keys Enter
    scroll Base color hex
    enter Base color hex 103018
    press Information
    see Dimensions
    press Properties
    keys F1
    see Keys and Mouse
    keys Escape
    hover 0 0.5 0
    keys Tab
    see 416 faces selected
    keys Alt+A L
    see 416 of 416 faces selected
    keys Ctrl+F
    type s                                          # Shade Smooth
    keys Tab
    press File
    press Export…
    keys Ctrl+A
    type $FOLDER/bottle.ply
    press Triangulate
    keys Enter
    see bottle.ply
    keys Escape
    keys Z R                                        # rendered, with the shadows of its light
    keys F12
    enter width of the image 64
    enter height of the image 96
    press quality of the image
    press Draft
    press The View
    press Render
    wait
    see 64 × 96 pixels
    press Save Image…
    keys Ctrl+A
    type $FOLDER/bottle.exr
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
fn a_wine_bottle_is_extruded_subdivided_and_rendered() {
    from_the_cube_and_from_nothing(BOTTLE, |document, folder| {
        let bottle = mesh(document, "bottle");
        assert_eq!((euler(bottle), open_edges(bottle)), (2, 0), "one closed surface");
        let heights = bottle.vertices().map(|vertex| bottle.position(vertex).y);
        let (low, high) = heights.fold((f32::MAX, f32::MIN), |(low, high), y| (low.min(y), high.max(y)));
        assert!(
            low > -0.4 && high < 2.5 && high - low > 2.4,
            "from {low} to {high}: subdivision stays within the cage"
        );
        let volume = volume(bottle);
        // That of the cage without its neck, which the surface does not fill.
        assert!((0.3..0.8 * 0.8 * 1.4 + 0.3).contains(&volume), "{volume} m³");
        assert!(bottle.faces().all(|face| bottle.is_smooth(face)), "shaded smooth");
        assert!(
            folder.join("bottle.exr").exists() && folder.join("bottle.ply").exists(),
            "both were written"
        );
    });
}
