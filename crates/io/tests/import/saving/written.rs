//! What is written of scenes of every kind, and files that are damaged.

use super::*;

#[test]
fn one_mesh_in_several_materials_shares_its_numbers() {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("m", primitives::cube(1.0));
    for color in [Vec3::X, Vec3::Y, Vec3::X] {
        let material = scene.add_material(Material::from_color(color));
        scene.add(Node::from_mesh(mesh, material));
    }
    let json = json_of(&glb(&scene));
    assert_eq!(json["meshes"].as_array().map(Vec::len), Some(3), "one for each material");
    assert_eq!(json["accessors"].as_array().map(Vec::len), Some(4), "positions, normals, uv, indices");
}

#[test]
fn loose_edges_points_and_empty_meshes_are_written() {
    let mut scene = Scene::new();
    let mut wires = primitives::polyline(&[Vec3::ZERO, Vec3::X, Vec3::ONE]);
    let values =
        Attributes { corner_colors: Some(Vec::new()), uv_sets: vec![Vec::new()], ..Attributes::default() };
    wires.set_attributes(values).expect("there are no corners");
    scene.add_object("wires", wires.clone(), Material::default());
    scene.add_object("nothing", Mesh::default(), Material::default());
    let again = loaded("a.glb", &glb(&scene));
    assert_eq!(only_mesh(&again.scene).1.loose_edges(), wires.loose_edges(), "lines");
    let again = document("a.glb", &saved(&NativeDocument::new(scene))).0.scene;
    let meshes: Vec<&Mesh> = again.meshes().iter().map(|(_, asset)| asset.mesh()).collect();
    assert!(meshes == [&wires, &Mesh::default()], "to the bit");
}

/// A document in which nothing is left is not lost.
#[test]
fn what_is_saved_with_nothing_to_draw_is_opened_and_shown_by_nobody() {
    let mut empty = Mesh::default();
    let target = MorphTarget { name: "wide".into(), ..MorphTarget::default() };
    let values = Attributes {
        face_smooth: Some(Vec::new()),
        uv_sets: vec![Vec::new(); 2],
        morph_targets: vec![target],
        ..Attributes::default()
    };
    empty.set_attributes(values).expect("there is nothing");
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("nothing", empty.clone());
    for name in ["red", "blue"] {
        let material = scene.add_material(Material::default().with_name(name));
        let node = scene.add(Node::from_mesh(mesh, material));
        scene.node_mut(node).expect("just added").visible = false;
    }
    let bytes = saved(&NativeDocument::new(scene));
    let (again, warnings) = document("a.glb", &bytes);
    assert_eq!(warnings, [], "nothing is odd");
    assert!(again.scene.meshes().iter().all(|(_, asset)| *asset.mesh() == empty), "the mesh");
    let materials = again.scene.nodes().iter().map(|(_, node)| again.scene.materials.get(node.materials[0]));
    let names: Vec<&str> = materials.map(|material| material.expect("it is there").name.as_str()).collect();
    assert_eq!(names, ["red", "blue"], "its materials");
    assert!(saved(&again) == bytes, "the second file is the first");
    // For a viewer there is nothing.
    let error = load_from_slice("a.glb", &bytes, &LoadOptions::default()).expect_err("nothing to draw");
    assert_eq!(error.kind, LoadErrorKind::Empty, "{error}");
    for (name, text) in [
        ("a.obj", "v 0 0 0\n"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
        ),
        ("a.off", "OFF\n0 0 0\n"),
        ("a.stl", "solid a\nendsolid a\n"),
    ] {
        let (opened, _) = document(name, text.as_bytes());
        assert_eq!(opened.scene.nodes().len(), 0, "{name} is a document without objects");
        let error =
            load_from_slice(name, text.as_bytes(), &LoadOptions::default()).expect_err("nothing to draw");
        assert_eq!(error.kind, LoadErrorKind::Empty, "{name}: {error}");
    }
}

#[test]
fn places_that_are_not_finite_stay_in_the_native_file_only() {
    let mut mesh = primitives::cube(2.0);
    mesh.positions_mut()[0] = Vec3::new(f32::NAN, f32::INFINITY, -0.0);
    let mut scene = Scene::new();
    scene.add_object("broken", mesh.clone(), Material::default());
    let bytes = saved(&NativeDocument::new(scene));
    let (second, _) = document("a.glb", &bytes);
    let bits =
        |mesh: &Mesh| mesh.positions().iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(only_mesh(&second.scene).1), bits(&mesh), "every bit");
    let json = json_of(&bytes);
    let position = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().expect("an index");
    assert_eq!(json["accessors"][position as usize]["max"], json!([1.0, 1.0, 1.0]), "numbers for others");
}

/// The specification lets animations move a translation, rotation and scale, but no matrix.
#[test]
fn a_matrix_that_is_animated_is_written_in_parts() {
    let turn = DQuat::from_rotation_z(0.5);
    let map = DAffine3::from_scale_rotation_translation(DVec3::new(1.0, 2.0, 3.0), turn, DVec3::X);
    for is_animated in [false, true] {
        let mut scene = Scene::new();
        let id = scene.add_object("cube", primitives::cube(1.0), Material::default());
        scene.node_mut(id).expect("just added").transform = Transform::Affine(map);
        if is_animated {
            let curve = Curve::new(Interpolation::Step, 3, vec![0.5], vec![4.0, 5.0, 6.0]).expect("a curve");
            let channels = vec![Channel { node: id, property: Property::Translation, curve }];
            scene.animations.push(Animation { name: "move".into(), channels });
        }
        let bytes = glb(&scene);
        let node = &json_of(&bytes)["nodes"][0];
        let parts = ["matrix", "translation", "rotation", "scale"].map(|name| node.get(name).is_some());
        let expected = if is_animated { [false, true, true, true] } else { [true, false, false, false] };
        assert_eq!(parts, expected, "animated: {is_animated}");
        let again = loaded("a.glb", &bytes);
        let placed = again.scene.world_transform(node_named(&again.scene, "cube"));
        assert!(placed.abs_diff_eq(map, 1e-6), "animated: {is_animated}: {placed:?}");
    }
}

/// Triangles of a scene, in its world, sorted.
fn triangles(scene: &Scene) -> Vec<[[u32; 3]; 3]> {
    let mut all = Vec::new();
    for (id, node) in scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let (world, render) = (scene.world_transform(id), RenderMesh::from_mesh(asset.mesh()));
        let place = |vertex: u32| {
            let position = world.transform_point3(render.positions[vertex as usize].as_dvec3());
            position.as_vec3().to_array().map(|number| (number + 0.0).to_bits())
        };
        all.extend(render.triangles.iter().map(|triangle| {
            let mut corners = triangle.map(place);
            let first = (0..3).min_by_key(|&corner| corners[corner]).expect("three");
            corners.rotate_left(first);
            corners
        }));
    }
    all.sort_unstable();
    all
}

#[test]
fn every_triangle_of_the_showcase_is_in_the_file() {
    let scene = showcase();
    let again: Loaded = loaded("a.glb", &glb(&scene));
    assert_eq!(triangles(&again.scene), triangles(&scene), "the same triangles");
}

/// The meshes of a document whose edit data belong to them.
fn editable(document: &NativeDocument) -> impl Iterator<Item = EditMesh> {
    document.edit_data.iter().filter_map(|(&id, data)| {
        let mesh = document.scene.meshes().get(id)?.mesh();
        EditMesh::from_mesh_and_data(mesh, data).ok().map(|(mesh, _)| mesh)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// A native file with some bytes changed: a typed error, or a mesh that keeps every rule.
    #[test]
    fn damaged_native_files_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let mut bytes = saved(&edited_document(with_everything(primitives::cube(2.0))));
        for (place, value) in changes {
            let index = place.index(bytes.len());
            bytes[index] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok((document, _)) = NativeDocument::load_from_slice("a.glb", &bytes, &LoadOptions::default()) {
            for mesh in editable(&document) {
                prop_assert_eq!(mesh.check_structure(), Ok(()));
            }
            drop(document.encode().map(|file| file.to_bytes()));
        }
    }

    /// Numbers in the header and in the columns, with hashes that are right again.
    #[test]
    fn forged_native_files_never_panic(
        column in any::<prop::sample::Index>(),
        word in any::<prop::sample::Index>(),
        value in prop_oneof![any::<u32>(), 0u32..30],
        member in 0usize..6,
    ) {
        let mut doc = doc_of(&saved(&edited_document(with_everything(primitives::cube(2.0)))));
        let header = doc.json["meshes"][0]["extras"]["trigon"].clone();
        let columns = header["columns"].as_object().expect("columns");
        let names: Vec<&String> = columns.keys().collect();
        let name = names[column.index(names.len())].clone();
        let view = columns[&name].as_u64().expect("an index") as usize;
        let own = &mut doc.json["meshes"][0]["extras"]["trigon"];
        match member {
            0 => own["columns"][&name] = json!(value),
            1 => own["jointsPerVertex"] = json!(value),
            2 => own["targets"] = json!(value),
            3 => own["slots"][0] = json!(value),
            4 => drop(own["columns"].as_object_mut().map(|columns| columns.remove(&name))),
            _ => {
                let (offset, length) = {
                    let view = &doc.json["bufferViews"][view];
                    (view["byteOffset"].as_u64(), view["byteLength"].as_u64())
                };
                let (offset, length) = (offset.expect("an offset") as usize, length.expect("a length") as usize);
                let at = offset + word.index(length) / 4 * 4;
                doc.bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
            }
        }
        if let Ok((document, _)) = NativeDocument::load_from_slice("a.glb", &doc.glb(), &LoadOptions::default()) {
            for mesh in editable(&document) {
                prop_assert_eq!(mesh.check_structure(), Ok(()));
            }
        }
    }
}

#[test]
fn a_file_with_buffers_and_images_beside_it_becomes_one() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut doc = crate::texture::textured_square();
    let image = crate::texture::png();
    std::fs::write(dir.path().join("p.png"), &image).expect("a file");
    std::fs::write(dir.path().join("a.bin"), &doc.bytes).expect("a file");
    doc.json["images"] = json!([{"uri": "p.png", "extras": 7}]);
    let unused = json!({"byteLength": 4, "uri": "data:,abcd"});
    doc.json["buffers"] = json!([unused, {"byteLength": doc.bytes.len(), "uri": "a.bin"}]);
    for view in doc.json["bufferViews"].as_array_mut().expect("views") {
        view["buffer"] = json!(1);
    }
    push(&mut doc.json["bufferViews"], json!({"buffer": 0, "byteLength": 4}));
    let path = dir.path().join("a.gltf");
    std::fs::write(&path, serde_json::to_vec(&doc.json).expect("JSON")).expect("a file");
    let (first, _) = NativeDocument::load(&path, &LoadOptions::default()).expect("it loads");
    let out = dir.path().join("b.glb");
    first.encode().expect("small").write(&out).expect("written");
    let bytes = std::fs::read(&out).expect("a file");
    let json = json_of(&bytes);
    assert_eq!(json["buffers"].as_array().map(Vec::len), Some(1), "one buffer");
    assert_eq!(json["images"][0]["extras"], json!(7), "extras stay");
    let (second, warned) = document("b.glb", &bytes);
    assert_eq!(warned, [], "nothing is missing");
    assert_eq!(triangles(&second.scene), triangles(&first.scene), "the same triangles");
    assert_eq!(second.scene.textures.len(), 1, "and the image");
}
