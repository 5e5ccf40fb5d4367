//! A light that is found in the view, moved by a key and by the gizmo, and made brighter.

use super::*;
use trigon_document::scene::math::DVec3;

const LIGHT: &str = "
    click 4 6 3                              # on its circles
    see 1 of 2 objects selected
    see Intensity
    keys G X 1 Enter
    title *untitled - trigon
    keys Ctrl+Z
    title untitled - trigon
    keys Ctrl+Shift+Z
    title *untitled - trigon
    pull Y by -40
    see Move
    keys G                                   # thought better of
    move 30 30
    see Move (
    keys Escape
    enter Intensity 250
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_light_is_moved_by_key_and_gizmo_and_made_brighter() {
    saved_and_reopened(LIGHT, |document, _| {
        let scene = document.nodes();
        let (id, node) = scene.nodes().iter().find(|(_, node)| node.name == "Light").expect("a light");
        assert_eq!(node.light.as_ref().expect("it shines").intensity, 250.0, "as typed");
        let DVec3 { x, y, z } = scene.world_transform(id).translation;
        assert_eq!([x, z], [5.0, 3.0], "moved by 1 m, and not at all");
        assert!((3.0..5.9).contains(&y), "and down by the gizmo: {y}");
    });
}
