//! Colours of lines and points, as every format that has them gives them.

use serde_json::json;
use trigon_io::Loaded;
use trigon_math::color::{srgb_to_linear, srgb8_to_linear};
use trigon_math::{Vec3, Vec4};
use trigon_scene::AlphaMode;

use crate::gltf::Doc;
use crate::{loaded, meshes, warnings};

/// The colours of vertices of the only mesh.
fn colors(loaded: &Loaded) -> Vec<Vec4> {
    let [mesh] = meshes(loaded)[..] else { panic!("one mesh") };
    assert_eq!(warnings(loaded), [""; 0], "nothing to warn of");
    mesh.attributes().vertex_colors.clone().expect("vertices have colours")
}

/// Lines and points between vertices that are all written.
fn document(mode: u32, places: &[f32], channels: &[u8]) -> Doc {
    let mut doc = Doc::square();
    let count = places.len() / 3;
    let position = doc.floats("VEC3", places);
    let color = doc.accessor(5121, "VEC4", count, channels);
    doc.json["accessors"][color]["normalized"] = json!(true);
    *doc.primitive() = json!({"mode": mode, "attributes": {"POSITION": position, "COLOR_0": color}});
    doc
}

#[test]
fn channels_of_a_gltf_are_linear() {
    let places = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    let channels = [255, 128, 0, 255, 1, 2, 3, 4, 0, 0, 0, 0, 7, 7, 7, 255];
    for mode in 0..4 {
        let found = colors(&document(mode, &places, &channels).load());
        let expected = channels
            .as_chunks::<4>()
            .0
            .iter()
            .map(|row| Vec4::from_array(row.map(|channel| f32::from(channel) / 255.0)));
        assert_eq!(found, expected.collect::<Vec<_>>(), "in mode {mode}");
    }
}

/// Three axes, each in its colour, begin at one place.
#[test]
fn lines_that_meet_keep_their_colours() {
    let places = [0., 0., 0., 1., 0., 0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0., 0., 1.];
    let [red, green, blue] = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]];
    let loaded = document(1, &places, [red, red, green, green, blue, blue].as_flattened()).load();
    let found = colors(&loaded);
    let mesh = meshes(&loaded)[0];
    assert_eq!(mesh.vertex_count(), 6, "the place of all three counts for each");
    for (edge, expected) in mesh.loose_edges().iter().zip([Vec3::X, Vec3::Y, Vec3::Z]) {
        assert_eq!(edge.map(|end| found[end as usize]), [expected.extend(1.0); 2], "of {edge:?}");
    }
    let one_color = document(1, &places, &[9; 24]).load();
    assert_eq!(meshes(&one_color)[0].vertex_count(), 4, "what is the same is one vertex");
}

/// White beside coloured ones; the colours of faces stay at their corners.
#[test]
fn parts_without_colours_are_white() {
    let mut doc = Doc::square();
    let position = doc.floats("VEC3", &[5., 0., 0., 6., 0., 0.]);
    let color = doc.floats("VEC4", &[0., 1., 0., 1., 0., 0., 1., 1.]);
    let list = doc.json["meshes"][0]["primitives"].as_array_mut().expect("a list");
    list.push(json!({"mode": 0, "attributes": {"POSITION": position, "COLOR_0": color}}));
    let loaded = doc.load();
    let found = colors(&loaded);
    assert_eq!(found[..4], [Vec4::ONE; 4], "of the square");
    assert_eq!(found[4..], [Vec4::new(0., 1., 0., 1.), Vec4::new(0., 0., 1., 1.)], "of the points");
    assert_eq!(meshes(&loaded)[0].attributes().corner_colors, None, "faces have none");
}

const CLOUD: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\n";

const ROWS: &str = "end_header\n0 0 0 255 0 0\n1 0 0 0 128 0\n0 1 0 1 2 3\n0 0 1 0 0 255\n";

fn srgb(channels: [u8; 3]) -> Vec4 {
    Vec3::from_array(channels.map(srgb8_to_linear)).extend(1.0)
}

#[test]
fn a_cloud_in_a_ply_has_the_colours_of_its_vertices() {
    let all = [[255, 0, 0], [0, 128, 0], [1, 2, 3], [0, 0, 255]].map(srgb);
    let read = loaded("a.ply", format!("{CLOUD}{ROWS}").as_bytes());
    assert_eq!(colors(&read), all, "sRGB");
    let (_, material) = read.scene.materials.iter().next().expect("one");
    assert_eq!((material.base_color, material.alpha_mode), (Vec4::ONE, AlphaMode::Opaque), "as they are");
    let without =
        loaded("a.ply", format!("{CLOUD}{}", ROWS.replace("1 0 0 0 128", "nan 0 0 0 128")).as_bytes());
    let found = meshes(&without)[0].attributes().vertex_colors.clone().expect("colours");
    assert_eq!(found, [all[0], all[2], all[3]], "those of the vertices that have a place");
}

#[test]
fn edges_in_a_ply_have_the_colours_of_their_vertices() {
    let edges = "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
    let read = loaded("a.ply", format!("{CLOUD}{edges}{ROWS}0 1\n2 3\n").as_bytes());
    assert_eq!(colors(&read)[1], srgb([0, 128, 0]), "the second");
    assert_eq!(meshes(&read)[0].loose_edges(), [[0, 1], [2, 3]], "two lines");
    let faces = "element face 1\nproperty list uchar int vertex_indices\n";
    let both = loaded("a.ply", format!("{CLOUD}{faces}{edges}{ROWS}3 0 1 2\n0 3\n1 3\n").as_bytes());
    assert_eq!(colors(&both)[3], srgb([0, 0, 255]), "the end of the lines");
    let of_corners = meshes(&both)[0].attributes().corner_colors.clone().expect("the face's");
    assert_eq!(of_corners[1], srgb([0, 128, 0]), "the face has its own");
}

#[test]
fn points_and_lines_of_an_obj_have_colours() {
    let read = loaded("a.obj", b"v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 2 0 0 0 0 1\np 3\nl 1 2\n");
    // In the order in which elements use the vertices.
    let expected = [[0., 0., 1.], [1., 0., 0.], [0., 0.5, 0.]];
    let expected = expected.map(|color| Vec3::from_array(color.map(srgb_to_linear)).extend(1.0));
    assert_eq!(colors(&read), expected, "in sRGB");
}

#[test]
fn colours_without_lines_and_points_are_those_of_faces_alone() {
    let read = loaded("a.obj", b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    let attributes = meshes(&read)[0].attributes();
    assert!(attributes.vertex_colors.is_none() && attributes.corner_colors.is_some(), "of corners");
}

/// Faces in blue, and lines or points of the materials of `wires` beside them.
fn beside_faces(wires: &[(u32, usize)]) -> Doc {
    let mut doc = Doc::square();
    let materials = [[0., 0., 1., 1.], [1., 0., 0., 1.], [0., 0.5, 0., 1.]];
    let material = |color| json!({"pbrMetallicRoughness": {"baseColorFactor": color}});
    doc.json["materials"] = materials.map(material).into();
    doc.json["materials"][2]["emissiveFactor"] = json!([0.25, 0., 0.]);
    doc.primitive()["material"] = json!(0);
    for (row, &(mode, material)) in (0..).zip(wires) {
        let place = row as f32 + 5.0;
        let position = doc.floats("VEC3", &[place, 0., 0., place, 1., 0.]);
        let list = doc.json["meshes"][0]["primitives"].as_array_mut().expect("a list");
        list.push(json!({"mode": mode, "material": material, "attributes": {"POSITION": position}}));
    }
    doc
}

/// The base colours of the only object's slots.
fn slot_colors(loaded: &Loaded) -> Vec<Vec4> {
    let (_, node) = loaded.scene.nodes().iter().find(|(_, node)| node.mesh.is_some()).expect("an object");
    node.materials
        .iter()
        .map(|&id| loaded.scene.materials.get(id).expect("its material").base_color)
        .collect()
}

/// A drawing of a part as programs for construction export it: black edges came in the colour of the faces.
#[test]
fn lines_and_points_beside_faces_have_their_own_material() {
    let loaded = beside_faces(&[(1, 1), (0, 1)]).load();
    let [mesh] = meshes(&loaded)[..] else { panic!("one mesh") };
    assert_eq!(
        slot_colors(&loaded),
        [Vec4::new(1., 0., 0., 1.), Vec4::new(0., 0., 1., 1.)],
        "lines come first"
    );
    assert!(
        mesh.attributes().face_materials.as_deref().is_some_and(|slots| slots.iter().all(|&slot| slot == 1))
    );
    assert_eq!(mesh.attributes().vertex_colors, None, "none are needed");
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
}

#[test]
fn lines_and_points_of_several_materials_have_the_colours_of_these() {
    let loaded = beside_faces(&[(1, 1), (0, 2), (3, 0)]).load();
    let [mesh] = meshes(&loaded)[..] else { panic!("one mesh") };
    assert_eq!(slot_colors(&loaded), [Vec4::ONE, Vec4::new(0., 0., 1., 1.)], "white, and that of the faces");
    let colors = mesh.attributes().vertex_colors.as_deref().expect("vertices have colours");
    let found = |vertex: u32| colors[vertex as usize];
    // Base colour plus emission.
    let [red, green, blue] = [[1., 0., 0., 1.], [0.25, 0.5, 0., 1.], [0., 0., 1., 1.]].map(Vec4::from_array);
    assert_eq!(
        mesh.loose_edges().iter().map(|edge| edge.map(found)).collect::<Vec<_>>(),
        [[red; 2], [blue; 2]]
    );
    assert_eq!(mesh.loose_points().iter().map(|&point| found(point)).collect::<Vec<_>>(), [green; 2]);
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
}

#[test]
fn translucent_lines_beside_others_are_opaque_with_a_warning() {
    let mut doc = beside_faces(&[(1, 1), (1, 2)]);
    doc.json["materials"][1]["alphaMode"] = json!("BLEND");
    let [said] = &warnings(&doc.load())[..] else { panic!("one warning") };
    assert!(said.contains("drawn opaque") && said.contains("a mesh of their own"), "{said}");
}
