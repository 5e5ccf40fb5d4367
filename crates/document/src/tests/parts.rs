//! Selections that stay true, and objects that are joined and separated.

use trigon_mesh::math::DVec3;

use super::*;

/// A document with cubes of these names at different places, and their nodes.
fn cubes<const COUNT: usize>(names: [&str; COUNT]) -> (Scene, [trigon_scene::NodeId; COUNT]) {
    let mut scene = Scene::new();
    let mut x = 0.0;
    let nodes = names.map(|name| {
        let node = scene.add_object(name, primitives::cube(1.0), Material::default());
        x += 3.0;
        let transform = &mut scene.node_mut(node).expect("just added").transform;
        transform.set_translation(DVec3::new(x, 0.0, 0.0));
        node
    });
    (scene, nodes)
}

#[test]
fn numbers_of_removed_elements_are_not_selected_when_they_are_given_again() {
    let mut document = document();
    edit_faces(&mut document, &["grid"]);
    run_all(
        &mut document,
        &[
            json!({ "op": "select", "elements": [2, 3] }),
            json!({ "op": "delete", "what": "faces" }),
            json!({ "op": "select_less" }),
            json!({ "op": "select_all" }),
            json!({ "op": "subdivide" }),
        ],
    );
    let (id, selection) = document.selection().meshes().next().expect("one is edited");
    let mesh = document.mesh(id).expect("it is edited");
    assert!(selection.indices().all(|index| ElementKind::Face.is_selectable(mesh, index)));
    assert!(
        document.run(command(json!({ "op": "select_path" }))).is_err(),
        "nothing was selected one by one"
    );
}

#[test]
fn what_is_hidden_is_never_selected() {
    let mut document = document();
    edit_faces(&mut document, &["grid"]);
    run_all(
        &mut document,
        &[
            json!({ "op": "select", "elements": [0, 1] }),
            json!({ "op": "hide" }),
            json!({ "op": "select_within" }),
        ],
    );
    let (_, selection) = document.selection().meshes().next().expect("one is edited");
    assert_eq!(selection.len(), 10, "all faces of the grid but two");
    assert!(!selection.contains(0) && !selection.contains(1));
    let hidden = document.run(command(json!({ "op": "select", "elements": [1] })));
    assert!(hidden.expect_err("it is hidden").to_string().contains("reveal"), "the remedy is told");
}

#[test]
fn parts_are_separated_from_the_objects_that_they_come_from() {
    let (mut scene, _) = cubes(["left", "middle"]);
    let (parent, _) = scene.nodes().iter().next().expect("two");
    scene.add_child(parent, trigon_scene::Node::default());
    let mut document = Document::new(scene);
    edit_faces(&mut document, &["left", "middle"]);
    run_all(
        &mut document,
        &[json!({ "op": "select", "objects": ["middle"], "elements": [0] }), json!({ "op": "separate" })],
    );
    let scene = document.scene();
    let (part, node) = scene.nodes().iter().last().expect("a new one");
    assert_eq!(node.name, "middle.001", "the part comes from the second object");
    assert_eq!(scene.world_transform(part).translation.x, 6.0, "and is where it was");
}

#[test]
fn objects_that_hang_on_joined_ones_stay_where_they_are() {
    let (mut scene, [base, active, hanging]) = cubes(["base", "active", "hanging"]);
    scene.node_mut(base).expect("there").transform.rotate(DVec3::Z, 0.5);
    scene.set_parent(active, Some(base)).expect("no circle");
    scene.set_parent(hanging, Some(base)).expect("no circle");
    let before = scene.world_transform(hanging);
    let mut document = Document::new(scene);
    run_all(
        &mut document,
        &[json!({ "op": "select", "objects": ["base", "active"] }), json!({ "op": "join_objects" })],
    );
    let scene = document.scene();
    assert!(scene.node(base).is_none() && scene.node(active).is_some(), "the active one stays");
    let moved = scene.world_transform(hanging).translation - before.translation;
    assert!(moved.length() < 1e-12, "a few roundings of places of about ten metres");
    let mesh = scene.node(active).and_then(|node| node.mesh).expect("it has one");
    assert_eq!(document.mesh(mesh).expect("joined").face_count(), 12);
}

#[test]
fn joined_faces_keep_their_materials_where_the_active_object_has_none() {
    let (mut scene, [plain, red]) = cubes(["plain", "red"]);
    scene.node_mut(plain).expect("there").materials.clear();
    let material = scene.node(red).expect("there").materials[0];
    let mut document = Document::new(scene);
    run_all(
        &mut document,
        &[json!({ "op": "select", "objects": ["red", "plain"] }), json!({ "op": "join_objects" })],
    );
    let node = document.scene().node(plain).expect("the active one stays").clone();
    let mesh = document.mesh(node.mesh.expect("it has one")).expect("joined");
    let of_face = |face| node.materials[mesh.material(face) as usize];
    let in_red = mesh.faces().filter(|&face| of_face(face) == material).count();
    assert_eq!((in_red, mesh.face_count()), (6, 12), "the others are drawn as before, without a material");
}

#[test]
fn corners_that_are_left_out_are_told() {
    let mut builder = trigon_mesh::MeshBuilder::new();
    for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] {
        builder.push_vertex(trigon_mesh::math::Vec3::new(corner[0], corner[1], 0.0));
    }
    builder.push_face(&[0, 1, 1, 2]).expect("a face may repeat a vertex");
    let mut scene = Scene::new();
    scene.add_object("folded", builder.build(), Material::default());
    let mut document = Document::new(scene);
    let outcome = document.run(command(json!({ "op": "edit_objects", "objects": ["folded"] })));
    let warnings = outcome.expect("it can be edited").warnings;
    assert_eq!(warnings, ["folded: corners at the same vertex as the next one are left out: 1"]);
    let again = document.run(command(json!({ "op": "select_all" }))).expect("edited");
    assert!(again.warnings.is_empty(), "told once");
}

/// In vertex mode two joined vertices are an edge, which becomes a face; a vertex apart becomes an edge.
#[test]
fn two_joined_vertices_were_extruded_to_two_edges() {
    for (elements, faces, edges, selected) in
        [(vec![0, 1], 1, 3, 2), (vec![0, 2], 0, 2, 2), (vec![0, 1, 3], 1, 4, 3), (vec![2], 0, 1, 1)]
    {
        let mut scene = Scene::new();
        scene.add_object("grid", primitives::grid(1.0, 1.0, 3, 3), Material::default());
        let mut document = Document::new(scene);
        run_all(
            &mut document,
            &[
                json!({ "op": "edit_objects", "objects": ["grid"] }),
                json!({ "op": "select", "elements": elements }),
            ],
        );
        let counts = |document: &Document| {
            let (id, _) = document.selection().meshes().next().expect("one is edited");
            let mesh = document.mesh(id).expect("it is edited");
            [mesh.face_count(), mesh.edge_count()]
        };
        let before = counts(&document);
        run_all(&mut document, &[json!({ "op": "extrude", "offset": [0.0, 1.0, 0.0] })]);
        let after = counts(&document);
        assert_eq!([after[0] - before[0], after[1] - before[1]], [faces, edges], "{elements:?}");
        let (_, selection) = document.selection().meshes().next().expect("it still is");
        assert_eq!(selection.len(), selected, "{elements:?}: what was extruded is selected");
    }
}

#[test]
fn new_objects_and_copies_get_names_of_their_own_and_renaming_says_so() {
    let mut document = Document::default();
    run_all(
        &mut document,
        &[
            json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } }),
            json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } }),
            json!({ "op": "select_all" }),
            json!({ "op": "duplicate_objects" }),
            json!({ "op": "add_light" }),
            json!({ "op": "add_light" }),
            json!({ "op": "add_empty", "name": "Cube.002" }),
            json!({ "op": "add_camera", "name": "Light" }),
        ],
    );
    let names = |document: &Document| -> Vec<String> {
        document.nodes().nodes().iter().map(|(_, node)| node.name.clone()).collect()
    };
    let expected =
        ["Cube", "Cube.001", "Cube.002", "Cube.003", "Light", "Light.001", "Cube.004", "Light.002"];
    assert_eq!(names(&document), expected);
    let outcome = document.run(command(json!({ "op": "rename_object", "object": "Cube", "name": "Light" })));
    assert!(outcome.expect("it is there").message.contains("Light.003"), "it says so");
    let outcome = document.run(command(json!({ "op": "rename_object", "object": "Light", "name": "Light" })));
    assert_eq!(outcome.expect("it is there").message, "", "its own name is free for it");
    run_all(&mut document, &[json!({ "op": "rename_object", "object": "Light", "name": "Lamp" })]);
    assert_eq!(names(&document)[4], "Lamp", "a free name stays");
}
