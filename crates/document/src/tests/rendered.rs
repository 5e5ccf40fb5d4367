//! The scene that images are rendered of.

use serde_json::json;
use trigon_mesh::primitives;
use trigon_scene::{Material, Scene};

use crate::Document;

fn run(document: &mut Document, command: serde_json::Value) {
    let text = command.to_string();
    let command = serde_json::from_value(command).expect("a command");
    document.run(command).unwrap_or_else(|error| panic!("{text}: {error}"));
}

/// Faces, and edges that belong to no face, of the only mesh.
fn rendered(document: &mut Document) -> [usize; 2] {
    let scene = document.scene_to_render();
    let (_, asset) = scene.meshes().iter().next().expect("one mesh");
    let mesh = asset.mesh();
    [mesh.face_count(), mesh.edge_count() - mesh.face_edge_count()]
}

#[test]
fn images_have_surfaces_without_their_cages_and_what_edit_mode_hides() {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(2.0), Material::default());
    let mut document = Document::new(scene);
    assert_eq!(rendered(&mut document), [6, 0], "never edited");
    for command in [
        json!({ "op": "select_all" }),
        json!({ "op": "edit_objects" }),
        json!({ "op": "set_element_kind", "kind": "face" }),
        json!({ "op": "select", "elements": [0] }),
    ] {
        run(&mut document, command);
    }
    run(&mut document, json!({ "op": "hide" }));
    assert_eq!(rendered(&mut document), [6, 0], "a hidden face is part of the object");
    run(&mut document, json!({ "op": "reveal" }));
    run(&mut document, json!({ "op": "set_subdivision", "levels": 2 }));
    // Each square becomes 4, and each of these 4.
    assert_eq!(rendered(&mut document), [96, 0], "the surface alone, also while its cage is edited");
    run(&mut document, json!({ "op": "leave_edit_mode" }));
    assert_eq!(rendered(&mut document), [96, 0], "and afterwards");
    let (_, asset) = document.scene().meshes().iter().next().expect("one mesh");
    assert_eq!(asset.mesh().face_count(), 6, "the document has its cage");
}
