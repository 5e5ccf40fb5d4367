//! What is selected and marked has its colour, under the numbers of the scene's mesh.

use serde_json::json;
use trigon_mesh::primitives;
use trigon_scene::{Material, Scene};

use super::*;
use crate::tests::commands::run;

/// A grid that is edited with a hole in the numbering of its faces, and a cube that is not edited.
fn document() -> Document {
    let mut scene = Scene::new();
    scene.add_object("grid", primitives::grid(2.0, 2.0, 4, 4), Material::default());
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "edit_objects", "objects": ["grid"] }));
    run(&mut document, json!({ "op": "set_element_kind", "kind": "face" }));
    run(&mut document, json!({ "op": "select", "elements": [0, 5] }));
    run(&mut document, json!({ "op": "delete" }));
    document
}

fn settings(document: &mut Document) -> RenderSettings {
    let mut marks = DisplayMarks::default();
    assert!(marks.update(document), "made for the first time");
    let mut settings = RenderSettings::new(64, 64);
    marks.apply(&mut settings, Reach::Visible);
    settings
}

/// The numbers of elements in a colour, of the first object.
fn of_color(marks: &[Mark], srgb: [u8; 3]) -> Vec<u32> {
    let colored = marks.iter().filter(|mark| mark.color == linear(srgb) && mark.opacity > 0.0);
    colored
        .flat_map(|mark| mark.elements.iter())
        .filter(|(node, _)| node.index() == 0)
        .map(|(_, e)| e)
        .collect()
}

#[test]
fn selected_faces_are_marked_under_their_numbers_in_the_scene() {
    let mut document = document();
    run(&mut document, json!({ "op": "select", "elements": [1, 6, 15] }));
    let settings = settings(&mut document);
    // Two faces before the last ones are gone, one before the first.
    assert_eq!(of_color(&settings.marks.faces, SELECTED_FACE), [0, 4, 13]);
    assert_eq!(of_color(&settings.marks.faces, ACTIVE_FACE), [13], "the last one");
    assert_eq!(settings.vertices, None, "not in face mode");
    assert_eq!(settings.style, Style::SurfaceWithEdges);
    assert_eq!(settings.effects.outline, None);
}

#[test]
fn edges_of_the_selection_and_with_marks_are_those_of_the_scene() {
    let mut document = document();
    run(&mut document, json!({ "op": "set_element_kind", "kind": "edge" }));
    let (id, _) = document.selection().meshes().next().expect("the grid");
    let edges: Vec<EdgeId> = document.mesh(id).expect("it is edited").edges().collect();
    for (op, edge) in [("mark_sharp", 7), ("mark_seam", 11), ("crease", 20)] {
        run(&mut document, json!({ "op": "select", "elements": [edges[edge].index()] }));
        let parameters =
            if op == "crease" { json!({ "op": op, "crease": 0.5 }) } else { json!({ "op": op }) };
        run(&mut document, parameters);
    }
    run(&mut document, json!({ "op": "select", "elements": [edges[3].index(), edges[30].index()] }));
    let settings = settings(&mut document);
    let ends = |number: u32| {
        let mesh = document.nodes().meshes().get(id).expect("it stays").mesh();
        let mut ends =
            mesh.edges()[number as usize].map(|vertex| mesh.positions()[vertex as usize].to_array());
        ends.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        ends
    };
    let expected = |edge: usize| {
        let mesh = document.mesh(id).expect("it is edited");
        let mut ends = mesh.edge_vertices(edges[edge]).map(|vertex| mesh.position(vertex).to_array());
        ends.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        ends
    };
    for (color, edge) in [(SHARP, 7), (SEAM, 11), (CREASE, 20), (ACTIVE, 30)] {
        let found = of_color(&settings.marks.edges, color);
        assert_eq!(found.iter().map(|&number| ends(number)).collect::<Vec<_>>(), [expected(edge)]);
    }
    assert_eq!(of_color(&settings.marks.edges, SELECTED_EDGE).len(), 2);
    let unseen = &settings.marks.edges[0];
    assert_eq!(unseen.opacity, 0.0, "it comes first");
    let of_cube = unseen.elements.iter().filter(|(node, _)| node.index() == 1).count();
    assert_eq!(of_cube, 12, "the cube is not edited");
}

#[test]
fn vertices_are_points_in_vertex_mode() {
    let mut document = document();
    run(&mut document, json!({ "op": "set_element_kind", "kind": "vertex" }));
    run(&mut document, json!({ "op": "select", "elements": [20, 24] }));
    let settings = settings(&mut document);
    assert!(settings.vertices.is_some());
    assert_eq!(of_color(&settings.marks.vertices, ACTIVE).len(), 1);
    assert_eq!(of_color(&settings.marks.vertices, SELECTED_VERTEX).len(), 2);
    let unseen = &settings.marks.vertices[0];
    assert_eq!(unseen.opacity, 0.0, "it comes first");
    let of_cube = unseen.elements.iter().filter(|(node, _)| node.index() == 1).count();
    assert_eq!(of_cube, 8, "the cube is not edited");
}

#[test]
fn selected_objects_have_an_outline_in_object_mode() {
    let mut document = document();
    run(&mut document, json!({ "op": "leave_edit_mode" }));
    run(&mut document, json!({ "op": "select", "objects": ["cube"] }));
    let settings = settings(&mut document);
    let outline = settings.effects.outline.expect("an object is selected");
    assert_eq!(outline.nodes.iter().map(|node| node.index()).collect::<Vec<_>>(), [1]);
    assert_eq!(settings.style, Style::Surface);
    assert_eq!(settings.marks, Marks::default());
}

#[test]
fn marks_are_made_when_something_changed_and_not_before() {
    let mut document = document();
    run(&mut document, json!({ "op": "select", "elements": [1] }));
    let mut marks = DisplayMarks::default();
    assert!(marks.update(&mut document));
    assert!(!marks.update(&mut document), "nothing changed");
    run(&mut document, json!({ "op": "translate", "offset": [0, 1, 0] }));
    assert!(!marks.update(&mut document), "vertices were moved");
    for json in [
        json!({ "op": "select", "elements": [2] }),
        json!({ "op": "mark_seam" }),
        json!({ "op": "subdivide" }),
    ] {
        run(&mut document, json.clone());
        assert!(marks.update(&mut document), "{json}");
    }
    document.undo().expect("the last one");
    assert!(marks.update(&mut document), "undone");
}

#[test]
fn a_face_of_a_cage_is_marked_by_all_its_parts_and_its_surface_has_no_edges() {
    let mut document = document();
    document.take_scene_changes();
    run(&mut document, json!({ "op": "set_subdivision", "levels": 2 }));
    run(&mut document, json!({ "op": "select", "elements": [1, 15] }));
    let settings = settings(&mut document);
    // 14 faces of 4 corners became 16 faces each; face 0 is gone.
    let parts: Vec<u32> = (0..16).chain(13 * 16..14 * 16).collect();
    assert_eq!(of_color(&settings.marks.faces, SELECTED_FACE), parts);
    let plain = &settings.marks.edges[0];
    let hidden = plain.elements.iter().filter(|(node, _)| node.index() == 0).count();
    assert_eq!(plain.opacity, 0.0, "not seen");
    let id = document.selection().meshes().next().expect("the grid").0;
    let surface = document.shown_surface(id).expect("it has one");
    assert_eq!(hidden, surface.face_edge_count(), "all edges of the surface");
    let cage = document.mesh(id).expect("it is edited").edge_count();
    assert_eq!(surface.edge_count() - hidden, cage, "those of the cage are seen");
}
