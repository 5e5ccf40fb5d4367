//! Skins, morph targets and animations: positions against an evaluation in
//! f64, written anew from the specification.

use serde_json::json;
use trigon_io::Loaded;
use trigon_math::{DAffine3, DMat4, DQuat, DVec3, Vec3};
use trigon_mesh::{Deformed, RenderMesh};
use trigon_scene::{NodeId, Outputs, Property, RenderSettings, Transform, render};

use crate::gltf::{Doc, push};
use crate::{warnings, warns_once};

/// The node of a name.
fn node(loaded: &Loaded, name: &str) -> NodeId {
    let mut nodes = loaded.scene.nodes().iter();
    nodes.find(|(_, node)| node.name == name).expect("a node of that name").0
}

/// The positions in the world and the normals of a node's mesh as it is posed.
fn posed(loaded: &Loaded, name: &str) -> (Vec<DVec3>, Vec<Vec3>) {
    let scene = &loaded.scene;
    let id = node(loaded, name);
    let holder = scene.node(id).expect("just found");
    let mesh = scene.meshes().get(holder.mesh.expect("a mesh")).expect("in the scene").mesh();
    let (mut deformed, pose) = (Deformed::default(), scene.skin_pose(id));
    let (world, palette) =
        pose.map_or((scene.world_transform(id), Vec::new()), |pose| (pose.world, pose.palette));
    RenderMesh::from_mesh(mesh).deform(&holder.morph_weights, &palette, &mut deformed);
    let positions = deformed.positions.iter().map(|position| world.transform_point3(position.as_dvec3()));
    (positions.collect(), deformed.normals)
}

fn near(found: DVec3, exact: DVec3) -> bool {
    (found - exact).length() <= 1e-6 * (1.0 + exact.length())
}

/// A quarter turn about z, and where its half stands in a quaternion.
const TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The square follows two joints, the second of which is turned and far up.
pub(crate) fn skinned() -> Doc {
    let mut doc = Doc::square();
    let joints = doc.accessor(5121, "VEC4", 4, &[0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
    let weights = doc.floats("VEC4", &[1., 0., 0., 0., 0.25, 0.75, 0., 0., 0.5, 0.5, 0., 0., 1., 0., 0., 0.]);
    let mut matrices = DMat4::IDENTITY.to_cols_array().map(|v| v as f32).to_vec();
    matrices.extend(DMat4::from_translation(DVec3::new(0.0, -2.0, 0.0)).to_cols_array().map(|v| v as f32));
    let matrices = doc.floats("MAT4", &matrices);
    let primitive = doc.primitive();
    primitive["attributes"]["JOINTS_0"] = json!(joints);
    primitive["attributes"]["WEIGHTS_0"] = json!(weights);
    doc.json["skins"] = json!([{"joints": [2, 3], "inverseBindMatrices": matrices}]);
    doc.json["nodes"] = json!([
        {"name": "body", "mesh": 0, "skin": 0, "translation": [1e7, 5, 5], "scale": [3, 3, 3]},
        {"name": "armature", "children": [2], "translation": [1e7, 0, 0]},
        {"name": "hip", "children": [3], "translation": [0, 1, 0]},
        {"name": "knee", "translation": [0, 2, 0], "rotation": [0, 0, TURN, TURN]}
    ]);
    doc
}

#[test]
fn a_skin_places_vertices_as_the_specification_says() {
    let loaded = skinned().load();
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
    let hip = DAffine3::from_translation(DVec3::new(1e7, 1.0, 0.0));
    let turn = DAffine3::from_quat(DQuat::from_xyzw(0.0, 0.0, TURN, TURN));
    let knee = hip * DAffine3::from_translation(DVec3::new(0.0, 2.0, 0.0)) * turn;
    let maps = [hip, knee * DAffine3::from_translation(DVec3::new(0.0, -2.0, 0.0))];
    let corners = [(0., 0., [1.0, 0.0]), (1., 0., [0.25, 0.75]), (1., 1., [0.5, 0.5]), (0., 1., [0.0, 1.0])];
    let (positions, normals) = posed(&loaded, "body");
    for (x, y, weights) in corners {
        let at = DVec3::new(x, y, 0.0);
        let exact = maps[0].transform_point3(at) * weights[0] + maps[1].transform_point3(at) * weights[1];
        // Not relative to 10⁷ metres: what is far away is as precise as what is near.
        let nearest = positions.iter().map(|found| (*found - exact).length()).fold(f64::MAX, f64::min);
        assert!(nearest < 2e-6, "{at} is at {exact}, not {nearest} m beside it: {positions:?}");
    }
    // Flat, as none are given. The second triangle is folded over by its weights.
    assert_eq!(normals, [Vec3::Z, Vec3::Z, Vec3::Z, -Vec3::Z, -Vec3::Z, -Vec3::Z], "turned about z");
    let bounds = loaded.scene.bounds();
    assert!(bounds.max.y > 2.5 && bounds.max.y < 5.0, "around the posed mesh: {bounds:?}");
}

#[test]
fn broken_skins_are_mended_and_said() {
    let mut doc = skinned();
    let weights =
        doc.floats("VEC4", &[0., 0., 0., 0., -1., f32::NAN, 2., 0., 5., 5., 0., 0., 1., 0., 0., 0.]);
    let joints = doc.accessor(5123, "VEC4", 4, &[9, 0, 0, 0, 0, 0, 0, 0].repeat(4));
    doc.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    doc.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    let matrix = doc.floats("MAT4", &[f32::NAN; 16]);
    doc.json["skins"][0]["inverseBindMatrices"] = json!(matrix);
    doc.json["scenes"] = json!([{"nodes": [0, 3]}]);
    doc.json["nodes"][2]["children"] = json!([]);
    let loaded = doc.load();
    for word in ["skin weights", "joint 9 of 2", "bind matrix for", "not finite", "outside the scene"] {
        assert!(
            warnings(&loaded).iter().any(|warning| warning.contains(word)),
            "{word}: {:#?}",
            warnings(&loaded)
        );
    }
    let (positions, _) = posed(&loaded, "body");
    assert!(positions.iter().all(|position| position.is_finite()), "{positions:?}");
}

#[test]
fn a_skin_and_a_mesh_that_do_not_belong_together_are_said() {
    let mut doc = Doc::square();
    doc.json["skins"] = json!([{"joints": [0]}]);
    doc.json["nodes"][0]["skin"] = json!(0);
    warns_once(&doc.load(), "unskinned");
    doc.json["skins"] = json!([{"joints": [7]}]);
    assert!(doc.refused().contains("node 7 does not exist"), "a reference to nothing");
}

#[test]
fn morph_targets_add_up_sparse_and_quantized() {
    let mut doc = Doc::square();
    let normals = doc.floats("VEC3", &[0., 0., 1.].repeat(4));
    let first = doc.floats("VEC3", &[0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0., 2.]);
    let normal_deltas = doc.floats("VEC3", &[1., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0.]);
    // The second target moves vertex 2 alone, by a sparse accessor of bytes over zeros.
    let (indices, values) = (doc.view(&[2]), doc.view(&[0, 64, 0]));
    let sparse = json!({"componentType": 5120, "normalized": true, "type": "VEC3", "count": 4,
        "sparse": {"count": 1, "indices": {"bufferView": indices, "componentType": 5121},
            "values": {"bufferView": values}}});
    let second = push(&mut doc.json["accessors"], sparse);
    doc.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    doc.primitive()["attributes"]["NORMAL"] = json!(normals);
    doc.primitive()["targets"] = json!([{"POSITION": first, "NORMAL": normal_deltas}, {"POSITION": second}]);
    doc.json["meshes"][0]["weights"] = json!([0.5, 1]);
    doc.json["meshes"][0]["extras"] = json!({"targetNames": ["smile", "frown"]});
    doc.json["nodes"] =
        json!([{"name": "default", "mesh": 0}, {"name": "own", "mesh": 0, "weights": [-2, 0]}]);
    let loaded = doc.load();
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
    let (_, mesh) = loaded.scene.meshes().iter().next().expect("a mesh");
    let targets = &mesh.mesh().attributes().morph_targets;
    assert_eq!(
        targets.iter().map(|target| target.name.as_str()).collect::<Vec<_>>(),
        ["smile", "frown"],
        "names"
    );
    let check = |name, exact: [DVec3; 4], leaning: f64| {
        let (positions, normals) = posed(&loaded, name);
        for exact in exact {
            assert!(positions.iter().any(|&found| near(found, exact)), "{name}: {exact} in {positions:?}");
        }
        let unit = DVec3::new(leaning, 0.0, 1.0).normalize();
        let found = normals.iter().any(|normal| near(normal.as_dvec3(), unit));
        assert!(found, "{name}: a normal leans to {unit}: {normals:?}");
    };
    let up = 64.0 / 127.0;
    let square = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
    let lifted = |by: [f64; 4], second: f64| {
        std::array::from_fn(|i| square[i] + DVec3::Z * by[i] + DVec3::Y * if i == 2 { second } else { 0.0 })
    };
    check("default", lifted([0.0, 0.5, 0.0, 1.0], up), 0.5);
    check("own", lifted([0.0, -2.0, 0.0, -4.0], 0.0), -2.0);
}

#[test]
fn vertices_that_move_apart_stay_apart() {
    let mut doc = Doc::square();
    let six = doc.floats("VEC3", &[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 0., 0., 1., 1., 0., 0., 1., 0.]);
    let deltas = doc.floats("VEC3", &[[0.0; 9], [1.0; 9]].concat());
    *doc.primitive() = json!({"attributes": {"POSITION": six}, "targets": [{"POSITION": deltas}]});
    let loaded = doc.load();
    let (_, mesh) = loaded.scene.meshes().iter().next().expect("a mesh");
    assert_eq!(mesh.mesh().vertex_count(), 6, "the triangles part in the target, so they share no vertex");
}

/// The node moves, turns, and its mesh morphs.
pub(crate) fn animated() -> Doc {
    let mut doc = Doc::square();
    let target = doc.floats("VEC3", &[1.0; 12]);
    doc.primitive()["targets"] = json!([{"POSITION": target}]);
    let times = doc.floats("SCALAR", &[0., 1., 3.]);
    let moves = doc.floats("VEC3", &[0., 0., 0., 2., 0., 0., 2., 4., 0.]);
    // (arriving, value, leaving) for each key.
    let weights = doc.floats("SCALAR", &[0., 0., 1., -1., 0.5, 2., 0., 1., 0.]);
    let half = (TURN * 32767.0).round() as i16;
    let turns: Vec<u8> = [[0, 0, 0, 32767], [0, 0, half, half], [0, 0, 32767, 0]]
        .concat()
        .iter()
        .flat_map(|value: &i16| value.to_le_bytes())
        .collect();
    let turns = doc.accessor(5122, "VEC4", 3, &turns);
    doc.json["accessors"][turns]["normalized"] = json!(true);
    doc.json["nodes"] = json!([{"name": "n", "mesh": 0, "scale": [2, 2, 2]}, {"name": "elsewhere"}]);
    doc.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [1]}]);
    doc.json["animations"] = json!([
        {"name": "all", "samplers": [{"input": times, "output": moves}, {"input": times, "output": turns},
            {"input": times, "output": weights, "interpolation": "CUBICSPLINE"},
            {"input": times, "output": moves, "interpolation": "STEP"}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
            {"sampler": 1, "target": {"node": 0, "path": "rotation"}},
            {"sampler": 2, "target": {"node": 0, "path": "weights"}},
            {"sampler": 3, "target": {"node": 1, "path": "scale"}}]}]);
    doc
}

#[test]
fn animations_pose_nodes_and_weights() {
    let mut loaded = animated().load();
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
    let animation = loaded.scene.animations[0].clone();
    assert_eq!((animation.name.as_str(), animation.duration()), ("all", 3.0), "three seconds");
    assert_eq!(animation.channels.len(), 3, "the other scene's node does not move here");
    assert_eq!(animation.channels[2].property, Property::MorphWeights, "in the file's order");
    let pose = loaded.scene.pose(&animation, 2.0);
    loaded.scene.apply_pose(&pose);
    let posed = loaded.scene.node(node(&loaded, "n")).expect("it is there");
    let Transform::Decomposed { translation, rotation, scale } = posed.transform else { panic!("in parts") };
    assert_eq!(
        (translation, scale),
        (DVec3::new(2.0, 2.0, 0.0), DVec3::splat(2.0)),
        "half way; its own scale"
    );
    // From 90° to 180°: 135°, half of which is in the quaternion.
    let (sine, cosine) = trigon_math::elementary::sin_cos(135_f64.to_radians() / 2.0);
    let exact = DQuat::from_xyzw(0.0, 0.0, sine, cosine);
    assert!((rotation - exact).length() < 1e-4, "half way: {rotation}");
    // Hermite from 0.5 to 1 in 2 s, leaving with 2 and arriving with 0, at ½:
    // ½·0.5 + 2·⅛·2 + ½·1 − 2·⅛·0.
    assert_eq!(posed.morph_weights, [1.25], "by the cubic spline");
}

#[test]
fn channels_that_make_no_sense_are_left_out() {
    let mut doc = animated();
    let back = doc.floats("SCALAR", &[0., 2., 1.]);
    doc.json["animations"][0]["samplers"][0]["input"] = json!(back);
    doc.json["animations"][0]["samplers"][1]["interpolation"] = json!("BEZIER");
    doc.json["animations"][0]["channels"][2]["sampler"] = json!(0);
    let pointer = json!({"sampler": 0, "target": {"path": "pointer"}});
    push(&mut doc.json["animations"][0]["channels"], pointer);
    let loaded = doc.load();
    assert_eq!(loaded.scene.animations.len(), 0, "nothing is left to play");
    for word in ["channel 0", "channel 1", "channel 2", "1 animation channel of something other than nodes"] {
        warns_once(&loaded, word);
    }
    doc.json["animations"][0]["channels"][0]["sampler"] = json!(9);
    assert!(doc.refused().contains("sampler 9 does not exist"), "a reference to nothing");
}

/// Whether the front of a document's mesh is seen from +z, by its first camera.
fn is_seen(doc: &Doc) -> bool {
    let scene = doc.load().scene;
    let camera = scene.cameras()[0].1;
    let outputs = Outputs { ids: true, ..Outputs::default() };
    let settings = RenderSettings { outputs, ..RenderSettings::new(9, 9) };
    let frame = render(&scene, &camera, &settings).expect("an image");
    frame.hit(scene.nodes(), 4, 4).is_some()
}

#[test]
fn mirrored_nodes_show_their_front_and_not_their_back() {
    for (x, y, z) in [(1, 1, 1), (-1, 1, 1), (1, 1, -1), (1, -1, -1), (-1, -1, 1), (-1, -1, -1)] {
        let mut doc = Doc::square();
        let joints = doc.accessor(5121, "VEC4", 4, &[0; 16]);
        let weights = doc.floats("VEC4", &[1., 0., 0., 0.].repeat(4));
        doc.json["cameras"] = json!([{"type": "orthographic",
            "orthographic": {"xmag": 2, "ymag": 2, "znear": 1, "zfar": 9}}]);
        // Whichever way it is mirrored, the square covers the middle of the image.
        doc.json["nodes"] = json!([{"camera": 0, "translation": [0, 0, 5]},
            {"scale": [x, y, z], "children": [2, 3]},
            {"mesh": 0, "translation": [-0.5, -0.5, 0]}, {}]);
        assert_eq!(is_seen(&doc), z > 0, "scaled by {x}, {y}, {z}");
        doc.primitive()["attributes"]["JOINTS_0"] = json!(joints);
        doc.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
        doc.json["skins"] = json!([{"joints": [3]}]);
        doc.json["nodes"][2] = json!({"mesh": 0, "skin": 0});
        doc.json["nodes"][3] = json!({"translation": [-0.5, -0.5, 0]});
        assert_eq!(is_seen(&doc), z > 0, "skinned and scaled by {x}, {y}, {z}");
    }
}
