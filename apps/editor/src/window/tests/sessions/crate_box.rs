//! A crate: unwrapped along seams, painted elsewhere, and saved with its image.

use trigon_io::{Limits, LoadOptions, load, load_image};

use super::*;

const CRATE: &str = "
    hover 0 1 0
    keys Tab 2 A Ctrl+E
    press Mark Seam
    keys 3 A
    hover 0 1 0
    keys I I . 2 Tab - . 1 Enter                    # each face by itself, 0.1 m deep
    mesh Cube 32 60 30
    keys A U
    press Unwrap
    keys Shift+F10
    see 30 of 30 faces selected
    image crate
    press UV
    press Save UV Layout…
    keys Ctrl+A
    type $FOLDER/layout.png
    keys Enter
    wait
    see Saved
    keys Tab
    scroll Open Base color image
    press Open Base color image
    type $FOLDER/wood.png
    keys Enter
    see Base color image: wood
    keys Shift+F10 F2
    type crate
    keys Enter
    press File
    press Export…
    keys Ctrl+A
    type $FOLDER/crate.glb
    keys Enter
    see not in crate.glb
    press Close
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_crate_is_unwrapped_and_painted() {
    saved_and_reopened(CRATE, |document, folder| {
        let crate_mesh = mesh(document, "crate");
        assert_eq!((euler(crate_mesh), open_edges(crate_mesh)), (2, 0), "one closed surface");
        assert_eq!(crate_mesh.uv_overlaps(0), [], "nothing lies on anything else in the image");
        let layout = load_image(folder.join("layout.png"), &Limits::default()).expect("an image");
        assert_eq!((layout.width, layout.height), (2048, 2048));
        let exported = load(folder.join("crate.glb"), &LoadOptions::default()).expect("as written");
        let (_, material) = exported.scene.materials.iter().next().expect("one");
        assert!(material.base_color_texture.is_some(), "with its image");
    });
}
