//! What is found from the lists of the shown mesh is what is found from the edited one.

use serde_json::json;
use trigon_mesh::primitives;
use trigon_scene::{Material, Scene};

use super::*;
use crate::tests::commands::run;

/// A grid with holes in the numbering of its elements, of which every so many vertices are not selected.
fn document(left_out: u32) -> Document {
    let mut scene = Scene::new();
    scene.add_object("grid", primitives::grid(2.0, 2.0, 20, 14), Material::default());
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "edit_objects", "objects": ["grid"] }));
    run(&mut document, json!({ "op": "select", "elements": [0, 25, 26, 160] }));
    run(&mut document, json!({ "op": "delete" }));
    let (id, _) = document.selection().meshes().next().expect("the grid");
    let mesh = document.mesh(id).expect("it is edited");
    let elements: Vec<u32> =
        mesh.vertices().map(|vertex| vertex.index()).filter(|index| index % left_out != 3).collect();
    run(&mut document, json!({ "op": "select", "elements": elements }));
    document.scene();
    document
}

#[test]
fn a_whole_mesh_shows_what_follows_from_its_vertices() {
    for left_out in [5, 7, 1000] {
        let document = document(left_out);
        let (id, selected) = document.selection().meshes().next().expect("the grid");
        let shown = EditedMeshView::of(&document, id).expect("it is shown");
        let mesh = shown.whole.expect("all of it is shown");
        let found = shown.of_vertices(mesh, selected);
        assert_eq!(found, shown.of_any(selected, ElementKind::Vertex), "without {left_out}");
        assert_eq!(found, shown.selected(selected, ElementKind::Vertex));
        assert!(found.iter().all(|bits| !bits.is_clear()), "something of each kind");
        assert!(left_out == 1000 || found.iter().all(|bits| bits.count_ones(..) < bits.len()));
    }
}

#[test]
fn few_vertices_show_what_many_would() {
    let mut document = document(5);
    let (id, _) = document.selection().meshes().next().expect("the grid");
    let mesh = document.mesh(id).expect("it is edited");
    let face = mesh.faces().next().expect("a face");
    let corners: Vec<u32> = mesh.face_vertices(face).map(|vertex| vertex.index()).collect();
    run(&mut document, json!({ "op": "select", "elements": corners }));
    let (id, selected) = document.selection().meshes().next().expect("the grid");
    let shown = EditedMeshView::of(&document, id).expect("it is shown");
    assert!(!shown.are_many(selected));
    let found = shown.selected(selected, ElementKind::Vertex);
    assert_eq!(found.each_ref().map(|bits| bits.count_ones(..)), [4, 4, 1]);
    let mesh = shown.whole.expect("all of it is shown");
    assert_eq!(found, shown.of_vertices(mesh, selected));
}

#[test]
fn a_mesh_of_which_something_is_hidden_or_that_has_a_surface_is_not_whole() {
    let mut hidden = document(5);
    run(&mut hidden, json!({ "op": "hide" }));
    let mut smooth = document(5);
    smooth.take_scene_changes();
    run(&mut smooth, json!({ "op": "set_subdivision", "levels": 1 }));
    for mut document in [hidden, smooth] {
        document.scene();
        let (id, _) = document.selection().meshes().next().expect("the grid");
        assert!(document.shown_whole(id).is_none());
    }
}
