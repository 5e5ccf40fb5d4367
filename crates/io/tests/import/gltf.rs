//! glTF: accessors of every kind, primitives, nodes, cameras, lights, and what
//! is refused.

use serde_json::{Value, json};
use trigon_camera::Projection;
use trigon_io::{LoadErrorKind, LoadOptions, Loaded, load, load_from_slice};
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_scene::{AlphaMode, LightKind, MetallicRoughness, Shading};

use crate::{loaded, meshes, refused, warnings, warns_once};

/// A document under construction: JSON and the bytes of its only buffer.
pub(crate) struct Doc {
    pub(crate) json: Value,
    pub(crate) bytes: Vec<u8>,
}

impl Doc {
    /// Two triangles of a square, as four points and six indices, in one node.
    pub(crate) fn square() -> Self {
        let mut doc = Self {
            json: json!({"asset": {"version": "2.0"}, "accessors": [], "bufferViews": []}),
            bytes: Vec::new(),
        };
        let position = doc.floats("VEC3", &[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]);
        let indices = doc.accessor(5121, "SCALAR", 6, &[0, 1, 2, 0, 2, 3]);
        doc.json["meshes"] =
            json!([{"primitives": [{"attributes": {"POSITION": position}, "indices": indices}]}]);
        doc.json["nodes"] = json!([{"mesh": 0}]);
        doc
    }

    pub(crate) fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "MAT4" => 16,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(5126, kind, values.len() / width, &bytes)
    }

    pub(crate) fn accessor(&mut self, component: u32, kind: &str, count: usize, data: &[u8]) -> usize {
        let view = self.view(data);
        push(
            &mut self.json["accessors"],
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count}),
        )
    }

    pub(crate) fn view(&mut self, data: &[u8]) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let offset = self.bytes.len();
        self.bytes.extend(data);
        push(
            &mut self.json["bufferViews"],
            json!({"buffer": 0, "byteOffset": offset, "byteLength": data.len()}),
        )
    }

    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// The document as a GLB.
    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut document = self.json.clone();
        let others = self.json["buffers"].as_array().into_iter().flatten().skip(1).cloned();
        let own = json!({"byteLength": self.bytes.len()});
        document["buffers"] = std::iter::once(own).chain(others).collect();
        let header = ::gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 };
        let json = serde_json::to_vec(&document).expect("JSON").into();
        let glb = ::gltf::Glb { header, json, bin: Some((&self.bytes).into()) };
        // It fills in the lengths, and pads the chunks.
        glb.to_vec().expect("memory takes it")
    }

    pub(crate) fn load(&self) -> Loaded {
        loaded("a.glb", &self.glb())
    }

    pub(crate) fn refused(&self) -> String {
        refused("a.glb", &self.glb())
    }
}

pub(crate) fn push(list: &mut Value, item: Value) -> usize {
    if list.is_null() {
        *list = json!([]);
    }
    let list = list.as_array_mut().expect("a list");
    list.push(item);
    list.len() - 1
}

#[test]
fn a_square_arrives() {
    let loaded = Doc::square().load();
    let mesh = meshes(&loaded)[0];
    assert_eq!(
        (mesh.vertex_count(), mesh.edge_count(), mesh.face_count()),
        (4, 5, 2),
        "welded along the diagonal"
    );
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
    let (_, material) = loaded.scene.materials.iter().next().expect("the default material");
    let rough_metal = MetallicRoughness { metallic: 1.0, roughness: 1.0, ..MetallicRoughness::default() };
    let expected = (Vec4::ONE, Shading::MetallicRoughness(rough_metal));
    assert_eq!((material.base_color, material.shading), expected, "as the specification has it");
}

#[test]
fn equal_places_are_one_vertex_and_corners_keep_the_split() {
    let mut doc = Doc::square();
    let six = doc.floats("VEC3", &[0., 0., 0., 1., 0., 0., 1., 1., 0., -0., 0., 0., 1., 1., 0., 0., 1., 0.]);
    let uv = doc.floats("VEC2", &[0., 0., 1., 0., 1., 1., 5., 5., 6., 6., 5., 6.]);
    *doc.primitive() = json!({"attributes": {"POSITION": six, "TEXCOORD_0": uv}});
    let loaded = doc.load();
    let mesh = meshes(&loaded)[0];
    assert_eq!((mesh.vertex_count(), mesh.edge_count()), (4, 5), "the two triangles share an edge");
    assert_eq!(mesh.attributes().uv_sets[0][3], Vec2::splat(5.0), "and keep their own coordinates");
}

#[test]
fn primitives_are_slots_of_one_mesh() {
    let mut doc = Doc::square();
    let first = doc.primitive().clone();
    let mut second = first.clone();
    second["material"] = json!(0);
    doc.json["materials"] = json!([{"name": "red", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]}, "extensions": {"KHR_materials_unlit": {}}}]);
    doc.json["meshes"][0]["primitives"] = json!([first, second]);
    doc.json["nodes"] = json!([{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"}]);
    let loaded = doc.load();
    assert_eq!(loaded.scene.meshes().len(), 1, "two nodes share a mesh");
    let slots = meshes(&loaded)[0].attributes().face_materials.clone();
    assert_eq!(slots, Some(vec![0, 0, 1, 1]), "a slot for each primitive");
    let (_, node) = loaded.scene.nodes().iter().nth(1).expect("the second node");
    let red = loaded.scene.materials.get(node.materials[1]).expect("a material");
    assert_eq!(
        (red.base_color, red.shading),
        (Vec4::new(1.0, 0.0, 0.0, 0.5), Shading::Unlit),
        "colour and shading"
    );
    assert_eq!(
        (red.alpha_mode, red.double_sided),
        (AlphaMode::Mask { cutoff: 0.25 }, true),
        "alpha and sides"
    );
}

#[test]
fn integers_of_every_kind_are_positions_too() {
    // KHR_mesh_quantization: the same three points in all types.
    let cases: [(u32, bool, Vec<u8>, Vec3); 5] = [
        (5120, false, vec![0, 0, 0, 0, 127, 0, 0, 0, 0, 129, 0, 0], Vec3::new(127.0, 0.0, 0.0)),
        (5120, true, vec![0, 0, 0, 0, 127, 0, 0, 0, 0, 128, 0, 0], Vec3::X),
        (5121, true, vec![0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0], Vec3::X),
        (
            5122,
            true,
            [0i16, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0].iter().flat_map(|v| v.to_le_bytes()).collect(),
            Vec3::X,
        ),
        (
            5123,
            false,
            [0u16, 0, 0, 0, 65535, 0, 0, 0, 0, 9, 0, 0].iter().flat_map(|v| v.to_le_bytes()).collect(),
            Vec3::X * 65535.0,
        ),
    ];
    for (component, normalized, bytes, second) in cases {
        let mut doc = Doc::square();
        let accessor = doc.accessor(component, "VEC3", 3, &bytes);
        let view = doc.json["accessors"][accessor]["bufferView"].as_u64().expect("a view") as usize;
        doc.json["bufferViews"][view]["byteStride"] = json!(bytes.len() / 3);
        doc.json["accessors"][accessor]["normalized"] = json!(normalized);
        doc.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        *doc.primitive() = json!({"attributes": {"POSITION": accessor}});
        let loaded = doc.load();
        assert_eq!(
            meshes(&loaded)[0].positions()[1],
            second,
            "component {component}, normalized {normalized}"
        );
    }
}

#[test]
fn sparse_values_replace_and_absent_views_are_zero() {
    let mut doc = Doc::square();
    let (indices, values) = (
        doc.view(&[1, 0, 2, 0]),
        doc.view(&[2.0f32, 0., 0., 0., 3., 0.].iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>()),
    );
    let sparse = json!({"count": 2, "indices": {"bufferView": indices, "componentType": 5123}, "values": {"bufferView": values}});
    let accessor = push(
        &mut doc.json["accessors"],
        json!({"componentType": 5126, "type": "VEC3", "count": 3, "sparse": sparse}),
    );
    *doc.primitive() = json!({"attributes": {"POSITION": accessor}});
    let loaded = doc.load();
    assert_eq!(
        meshes(&loaded)[0].positions(),
        [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 3.0],
        "zeros and replacements"
    );
    doc.json["accessors"][accessor]["sparse"]["count"] = json!(4);
    assert!(doc.refused().contains("sparse"), "more than there are");
    doc.json["accessors"][accessor]["sparse"]["count"] = json!(2);
    doc.json["accessors"][accessor]["count"] = json!(2);
    assert!(doc.refused().contains("sparse index 2"), "out of range");
}

#[test]
fn claims_beyond_the_bytes_are_refused() {
    let position = |key: &str, value: Value| {
        let mut doc = Doc::square();
        doc.json["accessors"][0][key] = value;
        doc.refused()
    };
    for count in [0u64, 5, 1 << 32, (1 << 62) + 1, u64::MAX] {
        assert!(position("count", json!(count)).contains("accessor 0"), "count {count}");
    }
    for offset in [1u64, 1 << 32, u64::MAX - 7, u64::MAX] {
        assert!(position("byteOffset", json!(offset)).contains("accessor 0"), "offset {offset}");
    }
    assert!(position("type", json!("VEC2")).contains("type"), "a type that is none of POSITION's");
    assert!(position("max", json!([1, 1])).contains("max"), "bounds of another size");
    let view = |key: &str, value: Value| {
        let mut doc = Doc::square();
        doc.json["bufferViews"][0][key] = value;
        doc.refused()
    };
    for value in [49u64, 4_000_000_000, u64::MAX] {
        view("byteStride", json!(value));
        view("byteLength", json!(value.saturating_add(30)));
        view("byteOffset", json!(value.saturating_add(30)));
    }
    assert!(view("byteStride", json!(4)).contains("4 bytes apart"), "elements that overlap");
    assert!(view("buffer", json!(1)).contains("buffer 1"), "no such buffer");
}

#[test]
fn indices_are_checked() {
    for (component, bytes) in
        [(5121, vec![0, 1, 4]), (5125, [0u32, 1, u32::MAX].iter().flat_map(|v| v.to_le_bytes()).collect())]
    {
        let mut doc = Doc::square();
        let accessor = doc.accessor(component, "SCALAR", 3, &bytes);
        doc.primitive()["indices"] = json!(accessor);
        assert!(
            doc.refused().contains("does not exist; the primitive has 4 vertices"),
            "component {component}"
        );
    }
    let mut doc = Doc::square();
    doc.primitive()["indices"] = json!(0);
    assert!(doc.refused().contains("accessor 0"), "positions are no indices");
}

#[test]
fn optional_attributes_that_do_not_fit_are_ignored() {
    let mut doc = Doc::square();
    let normal = doc.floats("VEC3", &[0., 0., 1.]);
    let color = doc.floats("VEC3", &[f32::NAN, 0., 0., 0.5, 0.5, 0.5, 2., 0., 0., 1., 1., 1.]);
    doc.primitive()["attributes"]["NORMAL"] = json!(normal);
    doc.primitive()["attributes"]["COLOR_0"] = json!(color);
    let loaded = doc.load();
    warns_once(&loaded, "NORMAL has 1 values for 4 vertices");
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(
        colors[..3],
        [Vec4::ONE, Vec4::new(0.5, 0.5, 0.5, 1.0), Vec4::new(1.0, 0.0, 0.0, 1.0)],
        "clean, opaque"
    );
}

#[test]
fn nodes_hang_together_in_f64() {
    let mut doc = Doc::square();
    doc.json["nodes"] = json!([
        {"children": [2, 1], "translation": [10_000_000.001, 0, 0]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1, 0, 0, 1]},
        {"mesh": 0, "rotation": [0, 0, 0, 0], "name": "turned"},
        {"mesh": 0, "name": "elsewhere"}]);
    doc.json["scenes"] = json!([{"nodes": [3]}, {"nodes": [0]}]);
    doc.json["scene"] = json!(1);
    let loaded = doc.load();
    let scene = &loaded.scene;
    let ids: Vec<_> = scene.nodes().iter().map(|(id, _)| id).collect();
    assert_eq!(ids.len(), 3, "the default scene only");
    assert_eq!(scene.node(ids[0]).expect("a node").children(), [ids[2], ids[1]], "in the file's order");
    assert_eq!(
        scene.world_transform(ids[1]).translation,
        DVec3::new(10_000_000.001 + 0.1, 0.0, 0.0),
        "all digits"
    );
    warns_once(&loaded, "rotation has no length");
}

#[test]
fn broken_node_trees_are_refused() {
    for nodes in [
        json!([{"mesh": 0, "children": [0]}]),
        json!([{"mesh": 0}, {"children": [2]}, {"children": [1]}]),
        json!([{"children": [1, 1]}, {"mesh": 0}]),
        json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]),
        json!([{"mesh": 0, "children": [9]}]),
        json!([{"mesh": 9}]),
    ] {
        let mut doc = Doc::square();
        doc.json["nodes"] = nodes.clone();
        assert!(doc.refused().contains("node"), "{nodes}");
    }
}

#[test]
fn a_chain_of_nodes_may_be_deep_but_not_endless() {
    let chain = |depth: usize| {
        let mut doc = Doc::square();
        let link = |index: usize| {
            if index + 1 < depth { json!({"children": [index + 1]}) } else { json!({"mesh": 0}) }
        };
        doc.json["nodes"] = (0..depth).map(link).collect();
        doc
    };
    let loaded = chain(50_000).load();
    assert!(!loaded.scene.bounds().is_empty(), "the square hangs at the end");
    assert!(chain(100_002).refused().contains("deep"), "beyond the limit");
}

#[test]
fn cameras_and_lights_stand_on_nodes() {
    let mut doc = Doc::square();
    doc.json["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25}},
        {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 8}},
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0}}]);
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": std::f32::consts::PI, "color": [1, 0, 0]}, {"type": "spot", "range": 20,
            "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}, {"type": "spot", "spot": {"outerConeAngle": 7}}]}});
    doc.json["nodes"] = json!([{"mesh": 0}, {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"camera": 1, "extensions": {"KHR_lights_punctual": {"light": 1}}}, {"camera": 2, "extensions": {"KHR_lights_punctual": {"light": 2}}}]);
    let loaded = doc.load();
    let nodes: Vec<_> = loaded.scene.nodes().iter().map(|(_, node)| node).collect();
    assert_eq!(
        nodes[1].camera.as_deref().copied(),
        Projection::perspective(0.5, 0.25, None).ok(),
        "no far plane"
    );
    assert_eq!(
        nodes[2].camera.as_deref().copied(),
        Projection::orthographic(6.0, 0.0, 8.0).ok(),
        "half extents"
    );
    assert_eq!(nodes[3].camera, None, "a camera at no distance sees nothing");
    warns_once(&loaded, "camera 2");
    let light = nodes[1].light.as_ref().expect("a light");
    assert_eq!((light.kind, light.color), (LightKind::Directional, Vec3::X), "the sun");
    assert!((light.intensity - 1.0).abs() < 1e-6, "π lux show white: {}", light.intensity);
    assert_eq!(light.range, f32::INFINITY, "no range");
    let spot = nodes[2].light.as_ref().expect("a light");
    assert_eq!((spot.kind, spot.range), (LightKind::Spot { inner: 0.25, outer: 0.5 }, 20.0), "a cone");
    let mended = nodes[3].light.as_ref().expect("a light").kind;
    assert_eq!(
        mended,
        LightKind::Spot { inner: 0.0, outer: std::f32::consts::FRAC_PI_2 },
        "at most half a sphere"
    );
    warns_once(&loaded, "light 2");
}

#[test]
fn extensions_that_are_required_are_named() {
    let mut doc = Doc::square();
    doc.json["extensionsRequired"] = json!(["EXT_not_real"]);
    let message = doc.refused();
    assert!(message.contains("EXT_not_real") && message.contains("re-export"), "{message}");
    let mut doc = Doc::square();
    doc.json["extensionsUsed"] = json!(["EXT_not_real", "KHR_materials_unlit"]);
    warns_once(&doc.load(), "EXT_not_real");
}

#[test]
fn a_required_extension_is_named_though_no_material_uses_it() {
    for name in ["KHR_texture_basisu", "KHR_xmp_json_ld"] {
        let mut doc = Doc::square();
        doc.json["extensionsUsed"] = json!([name]);
        doc.json["extensionsRequired"] = json!([name]);
        let all = warnings(&doc.load());
        assert!(all.len() == 1 && all[0].contains("requires") && all[0].contains(name), "{all:#?}");
    }
}

#[test]
fn an_extension_that_is_not_declared_is_named() {
    let mut doc = Doc::square();
    doc.json["nodes"][0]["extras"] = json!({"extensions": {"EXT_in_extras": {}}});
    doc.json["nodes"][0]["extensions"] = json!({"EXT_undeclared": {}});
    let all = warnings(&doc.load());
    assert!(all.len() == 1 && all[0].contains("EXT_undeclared is not drawn"), "{all:#?}");
}

#[test]
fn of_a_matrix_and_a_translation_the_matrix_is_used_and_said() {
    let mut doc = Doc::square();
    doc.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]);
    doc.json["nodes"][0]["translation"] = json!([7, 0, 0]);
    let loaded = doc.load();
    warns_once(&loaded, "node 0: it has both a matrix and a translation");
    assert_eq!(loaded.scene.bounds().min, DVec3::new(5.0, 0.0, 0.0), "where the matrix puts it");
}

#[test]
fn the_same_fault_of_many_nodes_is_one_warning() {
    let mut doc = Doc::square();
    doc.json["nodes"] = vec![json!({"mesh": 0, "rotation": [0, 0, 0, 0.5]}); 10_000].into();
    let all = warnings(&doc.load());
    assert!(all.len() == 1 && all[0].contains("… and 9999 more"), "{all:#?}");
}

#[test]
fn instances_that_refer_to_nothing_are_said() {
    let mut doc = Doc::square();
    let scales = doc.floats("VEC3", &[1., 1., 1., f32::NAN, 1., 1.]);
    let attributes = json!({"TRANSLATION": 99, "SCALE": scales});
    doc.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}});
    let loaded = doc.load();
    warns_once(&loaded, "the TRANSLATION of its instances");
    warns_once(&loaded, "an instance has a value that is not finite");
}

#[test]
fn instances_count_as_the_nodes_that_they_are() {
    let mut doc = Doc::square();
    let places = doc.floats("VEC3", &[0., 0., 0., 5., 0., 0., 9., 0., 0.]);
    let attributes = json!({"attributes": {"TRANSLATION": places}});
    doc.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": attributes});
    push(&mut doc.json["nodes"], json!({"mesh": 0}));
    push(&mut doc.json["nodes"], json!({"name": "empty"}));
    let bytes = doc.glb();
    let load = |nodes: usize, corners: usize| {
        let mut options = LoadOptions::default();
        (options.limits.nodes, options.limits.corners) = (nodes, corners);
        load_from_slice("a.glb", &bytes, &options).map(|loaded| loaded.scene.nodes().len())
    };
    // Two triangles, three times and once.
    let corners = 6 * 4;
    assert_eq!(
        load(6, corners).ok(),
        Some(6),
        "three copies below the node that they are of, and two others"
    );
    for (nodes, corners) in [(5, corners), (6, corners - 1)] {
        let error = load(nodes, corners).expect_err("one fewer");
        assert_eq!(error.kind, LoadErrorKind::Limit, "{error}");
    }
}

#[test]
fn a_weight_that_is_not_finite_leaves_the_others_where_they_are() {
    let mut doc = Doc::square();
    let target = doc.floats("VEC3", &[0.; 12]);
    doc.primitive()["targets"] = json!([{"POSITION": target}, {"POSITION": target}]);
    doc.json["nodes"][0]["weights"] = json!([1e300, 0.5]);
    let loaded = doc.load();
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    assert_eq!(node.morph_weights, [0.0, 0.5], "the second target keeps its weight");
    let warned = loaded.warnings.iter().any(|warning| warning.what.contains("too large for 32 bits"));
    assert!(warned, "{:?}", loaded.warnings);
}

#[test]
fn data_uris_are_buffers_and_other_uris_are_not_followed() {
    let mut doc = Doc::square();
    let with_uri = |doc: &mut Doc, uri: &str| {
        doc.json["buffers"] = json!([{"byteLength": doc.bytes.len(), "uri": uri}]);
        serde_json::to_vec(&doc.json).expect("JSON")
    };
    let hex: String = doc.bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    let text = with_uri(&mut doc, &format!("data:application/octet-stream,{hex}"));
    assert_eq!(meshes(&loaded("a.gltf", &text))[0].face_count(), 2, "from the URI itself");
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("model.gltf");
    for uri in [
        "/etc/passwd",
        "../x.bin",
        "%2e%2e/x.bin",
        "file:///etc/passwd",
        "http://example.invalid/x.bin",
        "gone.bin",
        "",
        "/dev/zero",
    ] {
        std::fs::write(&path, with_uri(&mut doc, uri)).expect("a file");
        let error = load(&path, &LoadOptions::default()).map(|_| ()).expect_err("not followed");
        assert!(error.to_string().contains("buffer 0"), "{uri}: {error}");
    }
    std::fs::write(dir.path().join("a b.bin"), &doc.bytes).expect("a file");
    for uri in ["a b.bin", "a%20b.bin", "./a%20b.bin"] {
        std::fs::write(&path, with_uri(&mut doc, uri)).expect("a file");
        let loaded = load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{uri}: {error}"));
        assert_eq!(loaded.files, [path.clone(), dir.path().join("a b.bin")], "{uri}: what was read");
    }
}

/// A few bytes that thousands of primitives or nodes use must not become
/// gigabytes.
#[test]
fn sharing_does_not_multiply_without_bound() {
    let limited = |doc: &Doc| {
        let options = LoadOptions::default();
        let error = load_from_slice("a.glb", &doc.glb(), &options).map(|_| ()).expect_err("too much");
        assert_eq!(error.kind, LoadErrorKind::Limit, "{error}");
    };
    // Points have no corners of faces, and count all the same.
    for mode in [0, 3, 4, 6] {
        let mut doc = Doc::square();
        let zeros = json!({"componentType": 5126, "count": 1 << 20, "type": "VEC3"});
        let position = push(&mut doc.json["accessors"], zeros);
        let primitive = json!({"mode": mode, "attributes": {"POSITION": position}});
        doc.json["meshes"][0]["primitives"] = json!(vec![primitive; 17]);
        limited(&doc);
    }
    let mut doc = Doc::square();
    let indices = doc.accessor(5121, "SCALAR", 60_000, &[0, 1, 2].repeat(20_000));
    doc.primitive()["indices"] = json!(indices);
    doc.json["nodes"] = json!(vec![json!({"mesh": 0}); 2_000]);
    doc.json["scenes"] = json!([{"nodes": (0..2_000).collect::<Vec<_>>()}]);
    limited(&doc);
}

/// Some exporters fill the JSON chunk up with zeros instead of spaces.
#[test]
fn zeros_after_the_json_are_padding() {
    let mut glb = Doc::square().glb();
    let json = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    glb.splice(20 + json..20 + json, [0; 4]);
    let (length, json) = (glb.len() as u32, json as u32 + 4);
    glb[8..12].copy_from_slice(&length.to_le_bytes());
    glb[12..16].copy_from_slice(&json.to_le_bytes());
    loaded("a.glb", &glb);
}
