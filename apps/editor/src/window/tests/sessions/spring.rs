//! A spring by a screw that stays a modifier, for printing.

use trigon_io::{LoadOptions, load};

use super::*;

/// A disc beside the axis, swept up six turns.
const SPRING: &str = "
    keys A X Shift+A
    type disc
    keys Enter
    enter Radius 0.2
    enter Segments 12
    keys Tab A
    keys R X 9 0 Enter G X 1 Enter
    keys Tab
    press Edit
    press Add Modifier
    press Screw
    scroll Height
    enter Height 0.6
    enter Turns 6
    enter Steps 24
    keys Home
    mesh Disc 12 12 1                               # the disc itself
    keys F2
    type spring
    keys Enter
    press File
    press Export…
    keys Ctrl+A
    type $FOLDER/spring.stl
    press unit of the file
    press millimetres
    see Size in the file: 2400
    keys Enter
    see not in spring.stl
    press Close
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_spring_is_swept_along_a_screw_and_exported_for_printing() {
    saved_and_reopened(SPRING, |document, folder| {
        assert_eq!(mesh(document, "spring").modifiers().len(), 1, "the screw stays a modifier");
        let printed = load(folder.join("spring.stl"), &LoadOptions::default()).expect("as written");
        let (_, asset) = printed.scene.meshes().iter().next().expect("one mesh");
        let (solid, _) = EditMesh::from_mesh(asset.mesh());
        assert!(solid.is_watertight(), "both ends are closed");
        assert_eq!(solid.face_count(), 2 * 6 * 24 * 12 + 2 * (12 - 2), "quads and two discs as triangles");
        // A polygon of 12 corners, and 24 sines of 15 degrees as the way around: where its quads are bent, a little less.
        let disc = 6.0 * 0.2 * 0.2 * 0.5;
        let expected = 6.0 * 24.0 * 0.258_819 * disc * 1e9;
        let volume = volume(&solid);
        assert!((volume / expected - 1.0).abs() < 0.01, "{volume} for {expected} mm³");
    });
}
