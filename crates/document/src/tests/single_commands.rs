//! What single commands do, by counts and places that follow from the shapes.

use trigon_mesh::math::{DVec3, Vec3};
use trigon_mesh::{Attributes, Deltas, Mesh, MorphTarget, SkinWeights};
use trigon_modelling::{EdgeId, VertexId};
use trigon_scene::Transform;

use super::*;

/// A document with one object, which is edited, all of a kind being selected.
fn edited(mesh: Mesh, kind: &str) -> Document {
    let mut document = shown(mesh);
    run_all(
        &mut document,
        &[
            json!({ "op": "edit_objects", "objects": ["object"] }),
            json!({ "op": "set_element_kind", "kind": kind }),
            json!({ "op": "select_all" }),
        ],
    );
    document
}

/// A document with one object, which is selected.
fn shown(mesh: Mesh) -> Document {
    let mut scene = Scene::new();
    scene.add_object("object", mesh, Material::default());
    let mut document = Document::new(scene);
    run_all(&mut document, &[json!({ "op": "select", "objects": ["object"] })]);
    document
}

fn mesh(document: &Document) -> &EditMesh {
    let (id, _) = document.selection().meshes().next().expect("one is edited");
    document.mesh(id).expect("it is edited")
}

fn selected(document: &Document) -> Vec<u32> {
    let (_, selection) = document.selection().meshes().next().expect("one is edited");
    selection.indices().collect()
}

/// The number of the vertex at this place.
fn vertex_at(mesh: &EditMesh, position: Vec3) -> VertexId {
    mesh.vertices().find(|&vertex| mesh.position(vertex) == position).expect("a vertex")
}

fn message(document: &mut Document, json: serde_json::Value) -> String {
    document.run(command(json.clone())).unwrap_or_else(|error| panic!("{json}: {error}")).message
}

/// A grid of four by three squares without what is at one corner, less what is around that.
#[test]
fn less_is_without_the_neighbors_of_what_is_not_selected() {
    let corner = Vec3::new(-2.0, 0.0, -1.5);
    // The corner's square has four vertices. The corner's edge shares vertices with three others. Four squares
    // meet at the vertex opposite to the corner's.
    for (kind, all, left) in [("vertex", 20, 16), ("edge", 31, 27), ("face", 12, 8)] {
        let mut document = edited(primitives::grid(4.0, 3.0, 4, 3), kind);
        assert_eq!(selected(&document).len(), all, "{kind}");
        run_all(&mut document, &[json!({ "op": "select_less" })]);
        assert_eq!(selected(&document).len(), all, "{kind}: the border of the mesh is none of the selection");
        let mesh = mesh(&document);
        let vertex = vertex_at(mesh, corner);
        let element = match kind {
            "vertex" => vertex.index(),
            "edge" => mesh.vertex_edges(vertex).next().expect("two").index(),
            _ => mesh.vertex_faces(vertex).next().expect("one").index(),
        };
        run_all(
            &mut document,
            &[
                json!({ "op": "select", "elements": [element], "action": "remove" }),
                json!({ "op": "select_less" }),
            ],
        );
        assert_eq!(selected(&document).len(), left, "{kind}");
    }
}

#[test]
fn linked_is_the_part_of_the_mesh_that_a_face_belongs_to() {
    let mut document = edited(primitives::grid(4.0, 3.0, 4, 3), "face");
    run_all(&mut document, &[json!({ "op": "duplicate" })]);
    assert_eq!(mesh(&document).face_count(), 24, "two grids");
    let copies = selected(&document);
    run_all(
        &mut document,
        &[json!({ "op": "select", "elements": [copies[0]] }), json!({ "op": "select_linked" })],
    );
    assert_eq!(selected(&document), copies, "the copy and nothing of the original");
}

#[test]
fn a_subdivided_cube_has_four_faces_for_each_of_six() {
    let mut document = shown(primitives::cube(1.0));
    assert_eq!(message(&mut document, json!({ "op": "catmull_clark" })), "made 24 faces");
    assert_eq!(message(&mut document, json!({ "op": "set_subdivision", "levels": 1 })), "1 level, 96 faces");
    assert_eq!(message(&mut document, json!({ "op": "set_subdivision", "levels": 0 })), "off");
}

#[test]
fn transforms_are_not_applied_to_what_would_not_follow() {
    let apply = || command(json!({ "op": "apply_transform", "location": true }));
    let cube = primitives::cube(1.0);
    let vertices = cube.vertex_count();
    let skin = SkinWeights::new(1, vec![0; vertices], vec![1.0; vertices]);
    let positions = Deltas::from_dense(vec![Vec3::X; vertices]);
    let morph_targets = vec![MorphTarget { positions, ..MorphTarget::default() }];
    let skinned = Attributes { skin, ..Attributes::default() };
    let morphed = Attributes { morph_targets, ..Attributes::default() };
    for (attributes, follows) in [(Attributes::default(), true), (skinned, false), (morphed, false)] {
        let mut mesh = cube.clone();
        mesh.set_attributes(attributes).expect("one value for each vertex");
        let mut document = shown(mesh);
        assert_eq!(document.run(apply()).is_ok(), follows, "{:?}", document.run(apply()));
    }
}

/// In an unevenly scaled parent, a turned child is sheared. In the world it turns by the angle all the same.
#[test]
fn an_object_turns_in_the_world_within_an_unevenly_scaled_parent() {
    let mut scene = Scene::new();
    let parent = scene.add_object("parent", primitives::cube(1.0), Material::default());
    let child = scene.add_object("child", primitives::cube(1.0), Material::default());
    scene.set_parent(child, Some(parent)).expect("no circle");
    scene.node_mut(parent).expect("just added").transform.scale_by(DVec3::new(2.0, 1.0, 3.0));
    let transform = Transform::from_translation(DVec3::new(0.5, 1.0, 0.0));
    scene.node_mut(child).expect("just added").transform = transform;
    let before = scene.world_transform(child);
    let mut document = Document::new(scene);
    run_all(
        &mut document,
        &[
            json!({ "op": "select", "objects": ["child"] }),
            json!({ "op": "rotate", "angle": 60, "axis": [0, 0, 2], "space": "world" }),
        ],
    );
    let after = document.nodes().world_transform(child);
    // By 60° from x towards y, about the child's origin.
    let (sine, cosine) = (0.75_f64.sqrt(), 0.5);
    for corner in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.5, -0.25, 1.0)] {
        let arm = before.transform_vector3(corner);
        let turned = DVec3::new(cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y, arm.z);
        let found = after.transform_point3(corner);
        assert!(found.distance(before.translation + turned) < 1e-12, "{corner}: {found}");
    }
}

/// A mesh's own placement leads from the world to it, not that of another mesh.
#[test]
fn elements_move_in_the_world_as_their_own_object_is_placed() {
    let mut document = placed_document();
    run_all(
        &mut document,
        &[json!({ "op": "edit_objects", "objects": ["cube"] }), json!({ "op": "select_all" })],
    );
    let positions = |document: &Document| -> Vec<DVec3> {
        let scene = document.nodes();
        let (node, _) = scene.nodes().iter().next().expect("the only one");
        let world = scene.world_transform(node);
        let mesh = mesh(document);
        mesh.vertices().map(|vertex| world.transform_point3(mesh.position(vertex).as_dvec3())).collect()
    };
    let before = positions(&document);
    run_all(&mut document, &[json!({ "op": "translate", "offset": [1, 2, 3], "space": "world" })]);
    for (old, new) in before.iter().zip(positions(&document)) {
        assert!((new - *old).distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-6, "{old} went to {new}");
    }
}

#[test]
fn similar_faces_of_a_cube_are_all_by_corners_and_five_within_a_right_angle() {
    let counts = [
        (json!({ "op": "select_similar", "by": "corners" }), 6),
        (json!({ "op": "select_similar", "by": "area" }), 6),
        (json!({ "op": "select_similar", "by": "normal", "angle": 89.0 }), 1),
        (json!({ "op": "select_similar", "by": "normal", "angle": 91.0 }), 5),
    ];
    for (similar, count) in counts {
        let mut document = edited(primitives::cube(1.0), "face");
        run_all(&mut document, &[json!({ "op": "select", "elements": [0] }), similar.clone()]);
        assert_eq!(selected(&document).len(), count, "{similar}");
    }
}

#[test]
fn one_edge_is_no_outline_of_a_face() {
    let mut document = edited(primitives::grid(1.0, 1.0, 1, 1), "edge");
    run_all(&mut document, &[json!({ "op": "select", "elements": [0] })]);
    let (id, _) = document.selection().meshes().next().expect("one is edited");
    let edge = EdgeId::new(0);
    let mut alone = document.mesh(id).expect("it is edited").clone();
    let refusal = alone.fill_edges(&[edge]).expect_err("one edge").to_string();
    let error = document.run(command(json!({ "op": "fill" }))).expect_err("one edge").to_string();
    assert!(error.contains(&refusal), "{error}, not {refusal}");
}

#[test]
fn vertices_are_merged_at_the_one_that_was_selected_first_or_last() {
    for (at, vertex) in [("first", 7), ("last", 2)] {
        let mut document = edited(primitives::cube(2.0), "vertex");
        let expected = mesh(&document).position(VertexId::new(vertex));
        run_all(
            &mut document,
            &[
                json!({ "op": "select", "elements": [7] }),
                json!({ "op": "select", "elements": [4], "action": "add" }),
                json!({ "op": "select", "elements": [2], "action": "add" }),
                json!({ "op": "merge", "at": at }),
            ],
        );
        let left: Vec<Vec3> =
            selected(&document).iter().map(|&v| mesh(&document).position(VertexId::new(v))).collect();
        assert_eq!(left, [expected], "{at}");
    }
}

#[test]
fn the_last_step_can_be_undone_without_any_budget() {
    let mut document = edited(primitives::cube(1.0), "face");
    document.set_history_budget(0);
    for _ in 0..3 {
        run_all(&mut document, &[json!({ "op": "subdivide" })]);
        assert_eq!(document.history().done().len(), 1, "the last one stays");
    }
    let faces = mesh(&document).face_count();
    document.undo().expect("the last one");
    assert_eq!(mesh(&document).face_count() * 4, faces, "before the last cut of all squares");
}

#[test]
fn selections_of_elements_are_replaced_added_removed_toggled_and_intersected() {
    let steps = [
        ("replace", vec![0, 1, 2], vec![0, 1, 2]),
        ("remove", vec![1, 4], vec![0, 2]),
        ("add", vec![2, 3], vec![0, 2, 3]),
        ("toggle", vec![3, 5], vec![0, 2, 5]),
        ("intersect", vec![1, 2, 5], vec![2, 5]),
    ];
    let mut document = edited(primitives::cube(1.0), "face");
    for (action, elements, left) in steps {
        run_all(&mut document, &[json!({ "op": "select", "elements": elements, "action": action })]);
        assert_eq!(selected(&document), left, "{action}");
    }
    let mut scene = Scene::new();
    for name in ["a", "b", "c"] {
        scene.add_object(name, primitives::cube(1.0), Material::default());
    }
    let mut document = Document::new(scene);
    let names = |document: &Document| -> Vec<String> {
        let node = |id: &trigon_scene::NodeId| document.nodes().node(*id).expect("it is there").name.clone();
        document.selection().objects.iter().map(node).collect()
    };
    let steps = [
        ("replace", vec!["a", "b"], vec!["a", "b"]),
        ("remove", vec!["a"], vec!["b"]),
        ("add", vec!["c"], vec!["b", "c"]),
        ("toggle", vec!["a", "b"], vec!["c", "a"]),
        ("intersect", vec!["a"], vec!["a"]),
    ];
    for (action, objects, left) in steps {
        run_all(&mut document, &[json!({ "op": "select", "objects": objects, "action": action })]);
        let (mut found, mut expected) = (names(&document), left);
        found.sort();
        expected.sort_unstable();
        assert_eq!(found, expected, "{action}");
    }
}

#[test]
fn edits_say_what_they_need_if_nothing_is_selected() {
    let mut document = edited(primitives::grid(4.0, 3.0, 4, 3), "face");
    run_all(&mut document, &[json!({ "op": "select_none" })]);
    let before = mesh(&document).clone();
    for op in ["extrude", "delete", "subdivide", "flip_normals", "dissolve", "hide"] {
        let refused = document.run(command(json!({ "op": op })));
        let Err(EditError::NothingSelected { needed, .. }) = refused else { panic!("{op}: {refused:?}") };
        assert!(!needed.is_empty(), "{op}: the remedy");
        assert_eq!(mesh(&document), &before, "{op}");
    }
}

/// A linked copy has the same mesh, any other one a mesh of its own, edited before or not.
#[test]
fn copies_of_objects_are_edited_alone_unless_they_are_linked() {
    for is_edited_before in [false, true] {
        for linked in [false, true] {
            let mut document = shown(primitives::cube(1.0));
            if is_edited_before {
                run_all(
                    &mut document,
                    &[
                        json!({ "op": "edit_objects", "objects": ["object"] }),
                        json!({ "op": "leave_edit_mode" }),
                        json!({ "op": "select", "objects": ["object"] }),
                    ],
                );
            }
            run_all(&mut document, &[json!({ "op": "duplicate_objects", "linked": linked })]);
            let copy = document.selection().active.expect("the copy");
            let original = document.nodes().nodes().iter().map(|(id, _)| id).find(|id| *id != copy);
            let pair = [original.expect("the first object"), copy];
            let of = |document: &Document, node| document.nodes().node(node)?.mesh;
            let [one, other] = pair.map(|node| of(&document, node).expect("both have a mesh"));
            assert_eq!(one == other, linked);
            run_all(
                &mut document,
                &[
                    json!({ "op": "edit_objects" }),
                    json!({ "op": "set_element_kind", "kind": "face" }),
                    json!({ "op": "select_all" }),
                    json!({ "op": "subdivide" }),
                ],
            );
            let faces = |id| document.mesh(id).map_or(6, EditMesh::face_count);
            assert_eq!(faces(other), 24, "each of six in four");
            assert_eq!(faces(one), if linked { 24 } else { 6 }, "edited before: {is_edited_before}");
        }
    }
}
