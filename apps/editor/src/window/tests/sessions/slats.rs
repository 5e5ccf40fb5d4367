//! A chair whose legs are one leg in a mirror, and whose back is one slat in a row.

use trigon_io::{LoadOptions, load};

use super::*;

const CHAIR: &str = "
    hover 0 1 0
    keys Tab A S Y . 1 Enter Tab F2
    type seat
    keys Enter Shift+A
    type cube
    keys Enter
    hover 0 1 0
    keys Tab A S . 1 Enter S Y 9 Enter G X . 8 5 Enter G Z . 8 5 Enter G Y - 1 Enter Tab
    press Edit
    press Add Modifier
    press Mirror
    scroll Axes Z
    press Axes Z
    keys F2
    type legs
    keys Enter Shift+A
    type cube
    keys Enter
    hover 0 1 0
    keys Tab A S . 0 5 Enter S Y 1 4 Enter G Z - . 9 Enter G Y . 8 Enter G X - . 9 Enter Tab
    press Edit
    press Add Modifier
    press Array
    scroll Relative offset X
    enter Count 7
    enter Relative offset X 3
    keys F2
    type slats
    keys Enter Shift+A
    type cube
    keys Enter
    hover 0 1 0
    keys Tab A S Y . 1 Enter S Z . 1 Enter G Y 1 . 6 Enter G Z - . 9 Enter Tab F2
    type rail
    keys Enter Home
    mesh legs 8 12 6                                # what is edited
    mesh slats 8 12 6
    press File
    press Export…
    keys Ctrl+A
    type $FOLDER/chair.obj
    keys Enter
    see not in chair.obj
    press Close
    press File
    press Export…
    keys Ctrl+A
    type $FOLDER/parts.obj
    press Apply modifiers                           # as they are edited
    keys Enter
    see not in parts.obj
    press Close
    keys Ctrl+S
    type $FOLDER/saved
    keys Enter
    title saved.glb - trigon
";

#[test]
fn a_chair_is_made_by_a_mirror_and_an_array() {
    saved_and_reopened(CHAIR, |document, folder| {
        assert_eq!(volume(mesh(document, "seat")) as f32, 0.8, "2 m by 0.2 m by 2 m");
        for (file, legs, slats) in [("chair.obj", 4, 7), ("parts.obj", 1, 1)] {
            let exported = load(folder.join(file), &LoadOptions::default()).expect("as written");
            let meshes = exported.scene.meshes().iter().map(|(_, asset)| EditMesh::from_mesh(asset.mesh()).0);
            let meshes: Vec<EditMesh> = meshes.collect();
            assert!(meshes.iter().all(|mesh| open_edges(mesh) == 0), "{file}: closed");
            let faces: usize = meshes.iter().map(EditMesh::face_count).sum();
            assert_eq!(faces, 6 * (1 + legs + slats + 1), "{file}: seat, legs, slats and rail");
        }
    });
}
