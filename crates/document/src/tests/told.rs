//! What commands tell, and how many elements there are afterwards: by counting on a cube.

use super::*;

/// Two cubes, 2 on a side and flat, which are edited together; everything of a kind is selected.
fn cubes(kind: &str) -> Document {
    let mut scene = Scene::new();
    for name in ["first", "second"] {
        scene.add_object(name, primitives::cube(2.0), Material::default());
    }
    let mut document = Document::new(scene);
    run_all(
        &mut document,
        &[
            json!({ "op": "edit_objects", "objects": ["first", "second"] }),
            json!({ "op": "set_element_kind", "kind": kind }),
            json!({ "op": "select_all" }),
        ],
    );
    document
}

fn first_of_each() -> serde_json::Value {
    let part = |name| json!({ "object": name, "ranges": [[0, 0]] });
    json!({ "op": "select_elements", "parts": [part("first"), part("second")] })
}

/// Vertices, edges and faces of each mesh that is edited.
fn counts(document: &Document) -> Vec<[usize; 3]> {
    let count = |id| {
        let mesh = document.mesh(id).expect("it is edited");
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    };
    document.selection().meshes().map(|(id, _)| count(id)).collect()
}

#[test]
fn what_takes_more_memory_than_the_setting_is_refused_with_figures() {
    let mut document = cubes("face");
    document.set_memory(1 << 20);
    for last in [
        json!({ "op": "catmull_clark", "levels": 7 }),
        json!({ "op": "subdivide", "cuts": 900 }),
        json!({ "op": "set_subdivision", "levels": 5 }),
        json!({ "op": "bevel", "segments": 100 }),
    ] {
        let (history, before) = (document.history().done().len(), counts(&document));
        let refusal =
            document.run(command(last.clone())).map(drop).expect_err("a megabyte is little").to_string();
        assert!(refusal.contains("1.0 MiB are allowed") && refusal.contains("`memory`"), "{last}: {refusal}");
        assert_eq!((document.history().done().len(), counts(&document)), (history, before), "{last}");
    }
    document.set_memory(1 << 30);
    document.run(command(json!({ "op": "catmull_clark", "levels": 7 }))).expect("a gigabyte is enough");
}

/// What is selected of each mesh that is edited, as the commands before left it.
fn selected(document: &Document) -> Vec<usize> {
    document.selection().meshes().map(|(_, selection)| selection.indices().count()).collect()
}

/// Runs commands, whose last one tells this, after which both meshes have so many elements.
fn assert_told<const COUNT: usize>(
    kind: &str,
    commands: [serde_json::Value; COUNT],
    message: &str,
    expected: [usize; 3],
) {
    let mut document = cubes(kind);
    let (last, first) = commands.split_last().expect("at least one");
    run_all(&mut document, first);
    let what = format!("{kind}: {commands:?}");
    let told = document.run(command(last.clone())).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert_eq!(told.message, message, "{what}");
    assert_eq!(counts(&document), [expected; 2], "{what}");
}

const CUBE: [usize; 3] = [8, 12, 6];

#[test]
fn marks_are_counted_once() {
    let mark = |op: &str,
                value: &str,
                set: serde_json::Value,
                unset: serde_json::Value,
                kind,
                message: [&str; 2]| {
        let set = json!({ "op": op, value: set });
        let unset = json!({ "op": op, value: unset });
        assert_told(kind, [set.clone()], message[0], CUBE);
        assert_told(kind, [set.clone(), set.clone()], message[1], CUBE);
        assert_told(kind, [set, unset], message[0], CUBE);
    };
    let edges = ["changed 24 edges", "changed 0 edges"];
    mark("mark_sharp", "sharp", json!(true), json!(false), "edge", edges);
    mark("mark_seam", "seam", json!(true), json!(false), "edge", edges);
    mark("crease", "crease", json!(0.5), json!(0.25), "edge", edges);
    let faces = ["changed 12 faces", "changed 0 faces"];
    mark("shade", "smooth", json!(true), json!(false), "face", faces);
    mark("assign_material", "material", json!(1), json!(0), "face", faces);
    let by_angle = |angle| json!({ "op": "mark_sharp", "angle": angle });
    assert_told("edge", [by_angle(89)], "changed 24 edges", CUBE);
    assert_told("edge", [by_angle(91)], "changed 0 edges", CUBE);
    let seams = |angle| json!({ "op": "mark_seam", "angle": angle });
    assert_told("edge", [seams(89)], "changed 24 edges", CUBE);
    assert_told("edge", [seams(89), seams(91)], "changed 24 edges", CUBE);
}

#[test]
fn faces_and_vertices_that_are_made_or_removed_are_counted() {
    // Each square becomes four around its middle.
    assert_told("edge", [json!({ "op": "subdivide" })], "cut into 48 faces", [26, 48, 24]);
    let triangles = json!({ "op": "triangulate" });
    assert_told("face", [triangles.clone()], "", [8, 18, 12]);
    assert_told("face", [triangles, json!({ "op": "tris_to_quads" })], "made 12 quads", CUBE);
    assert_told(
        "vertex",
        [json!({ "op": "merge" })],
        "removed 14 vertices, 24 edges and 12 faces",
        [1, 0, 0],
    );
    assert_told(
        "vertex",
        [json!({ "op": "merge", "at": "distance", "distance": 1.9 })],
        "removed 0 vertices",
        CUBE,
    );
    let cut = json!({ "op": "subdivide" });
    let flat = json!({ "op": "dissolve_flat" });
    let as_faces = json!({ "op": "set_element_kind", "kind": "face" });
    let all = json!({ "op": "select_all" });
    assert_told("edge", [cut, as_faces, all, flat], "removed 36 vertices", CUBE);
}

#[test]
fn what_is_deleted_leaves_the_rest() {
    let delete = |what: &str| json!({ "op": "delete", "what": what });
    assert_told("face", [delete("only_faces")], "", [8, 12, 0]);
    assert_told("face", [delete("faces")], "", [0, 0, 0]);
    assert_told("edge", [delete("edges")], "", [0, 0, 0]);
    assert_told("vertex", [delete("vertices")], "", [0, 0, 0]);
    let repair = json!({ "op": "repair" });
    assert_told("face", [repair.clone()], "repaired 0 elements", CUBE);
    // All edges are loose, and then all vertices.
    assert_told("face", [delete("only_faces"), repair], "repaired 40 elements", [0, 0, 0]);
    let edges = json!({ "op": "repair", "loose_vertices": false });
    assert_told("face", [delete("only_faces"), edges], "repaired 24 elements", [8, 0, 0]);
}

#[test]
fn what_is_turned_or_moved_back_is_counted() {
    let flip = json!({ "op": "flip_normals" });
    let outwards = json!({ "op": "recalculate_normals" });
    let inwards = json!({ "op": "recalculate_normals", "inside": true });
    assert_told("face", [outwards.clone()], "turned over 0 faces", CUBE);
    assert_told("face", [flip.clone(), outwards.clone()], "turned over 12 faces", CUBE);
    assert_told("face", [flip, inwards.clone()], "turned over 12 faces", CUBE);
    assert_told("face", [inwards, outwards], "turned over 12 faces", CUBE);
    let reset = json!({ "op": "reset_vertices" });
    let up = json!({ "op": "translate", "offset": [0, 1, 0] });
    assert_told("vertex", [reset.clone()], "took back 0 vertices", CUBE);
    assert_told("vertex", [up, reset], "took back 16 vertices", CUBE);
}

#[test]
fn copies_and_surfaces_are_counted() {
    assert_told("face", [json!({ "op": "duplicate" })], "", [16, 24, 12]);
    // One face of each has its own vertices and edges.
    assert_told("face", [first_of_each(), json!({ "op": "split_off" })], "", [12, 16, 6]);
    assert_told("face", [json!({ "op": "separate" })], "made 2 objects", [0, 0, 0]);
    let set = |levels| json!({ "op": "set_subdivision", "levels": levels });
    assert_told("face", [set(2)], "2 levels, 192 faces", CUBE);
    assert_told("face", [set(2), set(0)], "off", CUBE);
}

#[test]
fn objects_are_counted() {
    let mut document = cubes("face");
    let leave = json!({ "op": "leave_edit_mode" });
    let select = |names: &[&str]| json!({ "op": "select", "objects": names });
    run_all(&mut document, &[leave, select(&["first"])]);
    let mut told = |json: serde_json::Value| {
        let outcome = document.run(command(json.clone())).unwrap_or_else(|error| panic!("{json}: {error}"));
        outcome.message
    };
    assert_eq!(told(json!({ "op": "hide_others" })), "hid 1 object");
    assert_eq!(told(json!({ "op": "reveal_objects" })), "showed 1 object");
    assert_eq!(told(json!({ "op": "catmull_clark" })), "made 24 faces");
    told(json!({ "op": "set_subdivision", "levels": 1 }));
    assert_eq!(told(json!({ "op": "apply_subdivision" })), "made 96 faces");
    told(select(&["second", "first"]));
    assert_eq!(told(json!({ "op": "join_objects" })), "joined 1 object");
    told(select(&["first"]));
    assert_eq!(told(json!({ "op": "delete_objects" })), "deleted 1 object");
    assert_eq!(document.nodes().nodes().len(), 0, "both are gone");
}

#[test]
fn what_is_hidden_is_neither_selected_nor_lost() {
    let all = json!({ "op": "select_all" });
    for (kind, total) in [("vertex", 8), ("face", 6)] {
        for (others, left) in [(false, total - 1), (true, 1)] {
            let mut document = cubes(kind);
            let hide = json!({ "op": "hide", "unselected": others });
            run_all(&mut document, &[first_of_each(), hide, all.clone()]);
            assert_eq!(selected(&document), [left; 2], "{kind}: all but the first are hidden: {others}");
            assert_eq!(counts(&document), [CUBE; 2], "{kind}: they are hidden, not deleted");
            run_all(&mut document, &[json!({ "op": "reveal" }), all.clone()]);
            assert_eq!(selected(&document), [total; 2], "{kind}: shown again");
        }
    }
    let mut document = cubes("edge");
    run_all(&mut document, &[json!({ "op": "hide" }), all]);
    assert_eq!(selected(&document), [0, 0], "no edge is left");
}
