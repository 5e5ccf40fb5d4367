//! What nobody touched is written back as it was, and what a change cannot keep is named.

use super::*;

#[test]
fn a_program_that_numbers_views_anew_is_found_out() {
    let mut doc = doc_of(&saved(&edited_document(primitives::cube(2.0))));
    let columns = &mut doc.json["meshes"][0]["extras"]["trigon"]["columns"];
    let (a, b) = (columns["faceSizes"].clone(), columns["cornerVertices"].clone());
    (columns["faceSizes"], columns["cornerVertices"]) = (b, a);
    let (second, warned) = document("a.glb", &doc.glb());
    assert_eq!(warned.len(), 1, "{warned:?}");
    assert!(second.edit_data.is_empty(), "the triangles are read");
    doc.json["meshes"][0]["extras"]["trigon"]["version"] = json!(99);
    let (_, warned) = document("a.glb", &doc.glb());
    assert!(warned[0].what.contains("newer version"), "{warned:?}");
}

/// A file in which everything that may has `extras` and an unknown extension.
fn odd_file() -> Vec<u8> {
    let mut doc = animated();
    doc.json["scenes"] = json!([{"nodes": [0], "extras": {"unused": 1}}, {"nodes": [0]}]);
    doc.json["scene"] = json!(1);
    let view = doc.view(b"known to nobody");
    doc.json["extensions"] = json!({"VENDOR_data": {"bufferView": view}});
    doc.json["extensionsUsed"] = json!(["VENDOR_data"]);
    let holders: Vec<String> = ["nodes", "meshes", "animations", "accessors", "bufferViews", "scenes"]
        .iter()
        .flat_map(|list| {
            let count = doc.json[list].as_array().map_or(0, Vec::len);
            (0..count).map(move |index| format!("/{list}/{index}"))
        })
        .collect();
    for holder in holders {
        let object = doc.json.pointer_mut(&holder).expect("it is there");
        object["extras"]["odd"] = json!({"z": [1, "é"], "a": holder});
        object["extensions"]["VENDOR_data"] = json!({"inside": holder});
    }
    doc.glb()
}

/// Every part of a value that another one has, with its path.
fn assert_contains(now: &Value, was: &Value, path: &str) {
    match (now, was) {
        (Value::Object(now), Value::Object(was)) => {
            for (name, value) in was {
                let found = now.get(name).unwrap_or_else(|| panic!("{path}/{name} is gone"));
                assert_contains(found, value, &format!("{path}/{name}"));
            }
        }
        (Value::Array(now), Value::Array(was)) => {
            assert!(now.len() >= was.len(), "{path} is shorter");
            for (index, value) in was.iter().enumerate() {
                assert_contains(&now[index], value, &format!("{path}/{index}"));
            }
        }
        _ => assert_eq!(now, was, "{path}"),
    }
}

#[test]
fn what_nobody_touched_is_written_back_as_it_was() {
    let bytes = odd_file();
    let (first, _) = document("a.glb", &bytes);
    let again = saved(&first);
    let (was, now) = (doc_of(&bytes), doc_of(&again));
    let mut expected = was.json.clone();
    expected["buffers"][0]["byteLength"] = now.json["buffers"][0]["byteLength"].clone();
    assert_eq!(now.json, expected, "the whole document");
    assert_eq!(now.bytes[..was.bytes.len()], was.bytes, "every byte");
    assert_eq!(saved(&document("a.glb", &again).0), again, "and again");
}

#[test]
fn a_node_that_is_moved_and_a_new_one_leave_all_else_alone() {
    let bytes = odd_file();
    let (mut first, _) = document("a.glb", &bytes);
    let (id, _) = first.scene.nodes().iter().next().expect("a node");
    first.scene.node_mut(id).expect("just found").transform.translate(DVec3::new(0.1, 0.0, 0.0));
    first.scene.add_object("new", primitives::cube(1.0), Material::default());
    let (was, mut now) = (json_of(&bytes), json_of(&saved(&first)));
    assert_eq!(now["nodes"].as_array().map(Vec::len), was["nodes"].as_array().map(|list| list.len() + 1));
    assert_eq!(now["scenes"][1]["nodes"].as_array().map(Vec::len), Some(2), "in the scene that was loaded");
    assert_eq!(now["scenes"][0], was["scenes"][0], "not in the other");
    now["nodes"][0] = was["nodes"][0].clone();
    now["buffers"] = was["buffers"].clone();
    assert_contains(&now, &was, "");
}

#[test]
fn a_changed_mesh_names_what_it_cannot_hold() {
    let mut doc = skinned();
    let custom = doc.floats("SCALAR", &[1., 2., 3., 4.]);
    doc.primitive()["attributes"]["_HEAT"] = json!(custom);
    doc.primitive()["extensions"] = json!({"VENDOR_fur": {"length": 3}});
    let (mut first, _) = document("a.glb", &doc.glb());
    assert_eq!(first.encode().expect("small").what_would_be_lost(), [], "as long as it stays");
    let (id, mesh) = only_mesh(&first.scene);
    let (mut editable, _) = EditMesh::from_mesh(mesh);
    first.edit_data.insert(id, EditData::default());
    assert_eq!(first.encode().expect("small").what_would_be_lost(), [], "and is only looked at");
    editable.set_position(VertexId::new(0), Vec3::ONE);
    put(&mut first, id, &editable);
    let file = first.encode().expect("small");
    let lost: Vec<String> = file.what_would_be_lost().iter().map(ToString::to_string).collect();
    assert_eq!(
        lost,
        ["mesh 0, primitive 0: its attribute _HEAT", "mesh 0, primitive 0: its extension VENDOR_fur"],
        "and nothing else"
    );
    let (second, warned) = document("a.glb", &file.to_bytes());
    assert_eq!(warned, [], "nothing to warn of");
    assert_same_edits(&editable, &edited(&second));
    assert!(second.scene.skins.len() == 1, "the skin is still there");
}

#[test]
fn removed_nodes_and_animations_are_gone_and_the_rest_moves_as_before() {
    let (mut first, _) = document("a.glb", &animated().glb());
    first.scene.add_object("new", primitives::cube(1.0), Material::default());
    let count = first.scene.nodes().len();
    let victim = first.scene.nodes().iter().find(|(_, node)| node.parent().is_none()).expect("a root").0;
    let removed = first.scene.remove(victim);
    first.scene.animations.clear();
    let (second, _) = document("a.glb", &first.encode().expect("small").to_bytes());
    assert_eq!(second.scene.nodes().len(), count - removed, "as many as are left");
    assert_eq!(second.scene.animations, [], "none");
}

#[test]
fn a_changed_animation_keeps_its_place_and_names_what_it_cannot_hold() {
    let mut doc = animated();
    doc.json["animations"][0]["extras"] = json!("kept");
    let pointer = json!({"sampler": 0, "target": {"path": "pointer"}});
    push(&mut doc.json["animations"][0]["channels"], pointer);
    let (mut first, _) = document("a.glb", &doc.glb());
    assert_eq!(first.encode().expect("small").what_would_be_lost(), [], "as long as it stays");
    let again = first.scene.animations[0].clone();
    first.scene.animations.push(again);
    first.scene.animations[0].name = "renamed".to_owned();
    let file = first.encode().expect("small");
    let lost: Vec<String> = file.what_would_be_lost().iter().map(ToString::to_string).collect();
    let saved = file.to_bytes();
    let (second, _) = document("a.glb", &saved);
    let names = |document: &NativeDocument| -> Vec<String> {
        document.scene.animations.iter().map(|animation| animation.name.clone()).collect()
    };
    let sorted = |mut names: Vec<String>| {
        names.sort();
        names
    };
    assert_eq!(sorted(names(&second)), sorted(names(&first)), "both are there");
    let json = json_of(&saved);
    assert_eq!(json["animations"][0]["extras"], json!("kept"), "in its place");
    // The copy takes the place of the one that it equals, and the other is new.
    assert_eq!(lost, [""; 0], "the channel is still in the copy");
    first.scene.animations.pop();
    let file = first.encode().expect("small");
    let lost = file.what_would_be_lost();
    let what = "animation 0: its channels that move something other than nodes";
    assert_eq!(lost.iter().map(ToString::to_string).collect::<Vec<_>>(), [what], "now it is gone");
}

/// A file must not grow by a mesh each time that it is opened, edited and saved.
#[test]
fn a_mesh_that_is_written_anew_leaves_nothing_behind() {
    let mut doc = doc_of(&saved(&edited_document(primitives::torus(2.0, 0.5, 30, 20))));
    let view = doc.view(b"known to nobody");
    doc.json["extensions"] = json!({"VENDOR_data": {"bufferView": view}});
    let mut bytes = saved(&document("a.glb", &doc.glb()).0);
    let mut lengths = Vec::new();
    for step in 0..4 {
        let (mut next, _) = document("a.glb", &bytes);
        let (id, mut mesh) = (only_mesh(&next.scene).0, edited(&next));
        mesh.set_position(VertexId::new(0), Vec3::splat(step as f32));
        put(&mut next, id, &mesh);
        bytes = saved(&next);
        assert_same_edits(&edited(&next), &edited(&document("b.glb", &bytes).0));
        let again = doc_of(&bytes);
        let view = &again.json["bufferViews"][view];
        let start = view["byteOffset"].as_u64().expect("an offset") as usize;
        assert_eq!(&again.bytes[start..start + 15], b"known to nobody", "views of others keep their bytes");
        lengths.push(bytes.len());
    }
    let grown = lengths[3] - lengths[0];
    assert!(grown < 3 * 4000, "three savings left {grown} bytes of {}", lengths[0]);
}

/// Four copies of a square, of which the extension makes three.
fn instanced() -> Doc {
    let mut doc = Doc::square();
    let places = doc.floats("VEC3", &[0., 0., 0., 5., 0., 0., 9., 0., 0.]);
    let attributes = json!({"attributes": {"TRANSLATION": places}});
    doc.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": attributes});
    doc.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    push(&mut doc.json["nodes"], json!({"mesh": 0}));
    doc
}

/// Copies that an extension makes are part of the file until one is changed.
#[test]
fn instances_stay_an_extension_until_one_is_moved() {
    let doc = instanced();
    let (mut first, _) = document("a.glb", &doc.glb());
    assert_eq!(json_of(&saved(&first))["nodes"], doc.json["nodes"], "as it was");
    let copy = first.scene.nodes().iter().find(|(_, node)| node.mesh.is_some()).expect("a copy").0;
    first.scene.node_mut(copy).expect("just found").transform.translate(DVec3::Y);
    let (second, _) = document("a.glb", &saved(&first));
    let places = |scene: &Scene| -> Vec<DVec3> {
        let shown = scene.nodes().iter().filter(|(_, node)| node.mesh.is_some());
        shown.map(|(id, _)| scene.world_transform(id).translation).collect()
    };
    assert_eq!(places(&second.scene), places(&first.scene), "each where it was");
}

/// Everything that a copy can have of its own.
#[test]
fn whatever_changes_of_a_copy_is_saved() {
    type Change = fn(&mut Scene, NodeId);
    let changes: [(&str, Change); 8] = [
        ("nothing", |_, _| {}),
        ("name", |scene, id| scene.node_mut(id).expect("there").name = "renamed".to_owned()),
        ("visibility", |scene, id| scene.node_mut(id).expect("there").visible = false),
        ("light", |scene, id| scene.node_mut(id).expect("there").light = Some(Box::new(Light::point(3.0)))),
        ("camera", |scene, id| {
            let camera = trigon_camera::Projection::perspective(0.5, 0.25, Some(9.0)).expect("valid");
            scene.node_mut(id).expect("there").camera = Some(Box::new(camera));
        }),
        ("material", |scene, id| {
            let red = scene.add_material(Material::from_color(Vec3::X));
            scene.node_mut(id).expect("there").materials = vec![red];
        }),
        ("child", |scene, id| {
            scene.add_child(id, Node::default().with_name("child").at(DVec3::Z)).expect("it is there");
        }),
        ("parent", |scene, id| scene.set_parent(id, None).expect("no circle")),
    ];
    let described = |scene: &Scene| -> Vec<String> {
        let describe = |(id, node): (NodeId, &Node)| {
            let place = scene.world_transform(id).translation;
            let depth = std::iter::successors(node.parent(), |&id| scene.node(id)?.parent()).count();
            let color = node.materials.first().and_then(|&id| scene.materials.get(id)).map(|m| m.base_color);
            let has = (node.mesh.is_some(), node.visible, &node.light, &node.camera);
            format!("{place} {depth} {:?} {has:?} {color:?}", node.name)
        };
        let mut all: Vec<String> = scene.nodes().iter().map(describe).collect();
        all.sort();
        all
    };
    for (what, change) in changes {
        let (mut first, _) = document("a.glb", &instanced().glb());
        let is_copy = |(_, node): &(NodeId, &Node)| node.mesh.is_some() && node.parent().is_some();
        let copy = first.scene.nodes().iter().find(is_copy).expect("a copy").0;
        change(&mut first.scene, copy);
        let bytes = saved(&first);
        let (second, _) = document("a.glb", &bytes);
        assert_eq!(described(&second.scene), described(&first.scene), "{what}");
        let uses = json_of(&bytes)["nodes"].to_string().contains("EXT_mesh_gpu_instancing");
        assert_eq!(uses, what == "nothing", "{what}: the extension can say no more than places");
    }
}

/// A mesh of two materials and of lines that have none of their own.
#[test]
fn an_object_in_another_material_keeps_the_mesh_of_the_file() {
    let mut doc = Doc::square();
    let plain = doc.primitive().clone();
    let with = |material: usize| {
        let mut primitive = plain.clone();
        primitive["material"] = json!(material);
        primitive
    };
    let unread = json!({"attributes": {"_HEAT": plain["indices"]}, "material": 0});
    doc.json["meshes"][0]["primitives"] = json!([with(1), unread, with(0), with(1), plain.clone()]);
    doc.json["materials"] = json!([{"name": "red"}, {"name": "blue"}]);
    let (mut first, _) = document("a.glb", &doc.glb());
    let green = first.scene.add_material(Material::default().with_name("green"));
    let (id, node) = first.scene.nodes().iter().next().expect("the only one");
    let is_blue = |&id: &_| first.scene.materials.get(id).is_some_and(|material| material.name == "blue");
    let blue = node.materials.iter().position(is_blue).expect("a slot");
    first.scene.node_mut(id).expect("just found").materials[blue] = green;
    let now = json_of(&saved(&first));
    let name = |primitive: &Value| -> Option<String> {
        let material = primitive["material"].as_u64()? as usize;
        now["materials"][material]["name"].as_str().map(str::to_owned)
    };
    let found: Vec<Option<String>> =
        now["meshes"][0]["primitives"].as_array().expect("a list").iter().map(name).collect();
    let expected = [Some("green"), Some("red"), Some("red"), Some("green"), None];
    assert_eq!(found, expected.map(|name| name.map(str::to_owned)), "each primitive of blue is green");
}
