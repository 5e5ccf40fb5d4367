//! PLY in all its encodings.

use trigon_io::{LoadErrorKind, LoadOptions, load_from_slice};
use trigon_math::color::srgb8_to_linear;
use trigon_mesh::Mesh;
use trigon_scene::AlphaMode;

use crate::{loaded, meshes, refused, warnings, warns_once};

const SQUARE: &str = "ply\nformat ascii 1.0\ncomment of a test\nobj_info too\nelement vertex 4\n\
    property float x\nproperty float y\nproperty float z\nelement face 1\n\
    property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

fn mesh(text: &str) -> Mesh {
    let loaded = loaded("a.ply", text.as_bytes());
    assert_eq!(warnings(&loaded), [""; 0], "{text}");
    meshes(&loaded)[0].clone()
}

/// Numbers of a row: what each type takes.
enum Number {
    Byte(u8),
    Short(i16),
    Word(i32),
    Float(f32),
    Double(f64),
}
use Number::{Byte, Double, Float, Short, Word};

fn encode(numbers: &[Number], big: bool) -> Vec<u8> {
    let ordered = |mut bytes: Vec<u8>| {
        if big {
            bytes.reverse();
        }
        bytes
    };
    let encode = |number: &Number| match *number {
        Byte(value) => vec![value],
        Short(value) => ordered(value.to_le_bytes().to_vec()),
        Word(value) => ordered(value.to_le_bytes().to_vec()),
        Float(value) => ordered(value.to_le_bytes().to_vec()),
        Double(value) => ordered(value.to_le_bytes().to_vec()),
    };
    numbers.iter().flat_map(encode).collect()
}

#[test]
fn polygons_stay_polygons_whatever_ends_a_line() {
    for text in [SQUARE.to_owned(), SQUARE.replace('\n', "\r\n"), SQUARE.replace('\n', "\r")] {
        let mesh = mesh(&text);
        assert_eq!((mesh.vertex_count(), mesh.face_count(), mesh.corner_count()), (4, 1, 4), "a square");
    }
}

/// Unknown elements and properties are passed over by their types, in both byte orders.
#[test]
fn binary_files_are_read_in_both_orders() {
    for (order, big) in [("little", false), ("big", true)] {
        for ending in ["\n", "\r\n"] {
            let header = format!(
                "ply\nformat binary_{order}_endian 1.0\nelement odd 1\nproperty list short double lost\n\
                 property int8 gone\nelement vertex 3\nproperty double x\nproperty uchar flag\nproperty float y\n\
                 property list uint8 int16 more\nproperty float z\nelement face 1\nproperty ushort kind\n\
                 property list int uint vertex_index\nend_header\n"
            );
            let mut bytes = header.replace('\n', ending).into_bytes();
            let odd = [Short(2), Double(1.0), Double(2.0), Byte(3)];
            let first = [Double(0.5), Byte(1), Float(1.5), Byte(2), Short(7), Short(8), Float(-2.5)];
            let second = [Double(1.0), Byte(1), Float(0.0), Byte(0), Float(0.0)];
            let third = [Double(0.0), Byte(1), Float(4.0), Byte(1), Short(9), Float(0.0)];
            let face = [Short(9), Word(3), Word(2), Word(1), Word(0)];
            for row in [&odd[..], &first, &second, &third, &face] {
                bytes.extend(encode(row, big));
            }
            let loaded = loaded("a.ply", &bytes);
            assert_eq!(warnings(&loaded), [""; 0], "{order}");
            let mesh = meshes(&loaded)[0];
            assert_eq!(mesh.positions()[0].to_array(), [0.5, 1.5, -2.5], "{order}");
            assert_eq!(mesh.corner_vertices(), [2, 1, 0], "{order}");
        }
    }
}

#[test]
fn values_of_vertices_go_to_their_corners() {
    let text = SQUARE.replace(
        "property float z\n",
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n\
         property uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float s\nproperty float t\n",
    );
    let rows = [
        "0 0 0 0 0 1 255 0 0 255 0 0",
        "1 0 0 0 0 1 0 128 0 255 1 0",
        "1 1 0 0 0 1 0 0 255 51 1 1",
        "0 1 0 0 1 0 1 2 3 255 0 1",
    ];
    let text = text.replace("0 0 0\n1 0 0\n1 1 0\n0 1 0\n", &format!("{}\n", rows.join("\n")));
    let loaded = loaded("a.ply", text.as_bytes());
    let attributes = meshes(&loaded)[0].attributes();
    let colors = attributes.corner_colors.as_ref().expect("colours");
    assert_eq!(colors[1].y, srgb8_to_linear(128), "sRGB");
    assert_eq!(colors[2].w, 0.2, "alpha");
    assert_eq!(
        attributes.corner_normals.as_ref().expect("normals")[3].to_array(),
        [0.0, 1.0, 0.0],
        "normals"
    );
    assert_eq!(attributes.uv_sets[0][0].to_array(), [0.0, 1.0], "v downwards");
    let (_, material) = loaded.scene.materials.iter().next().expect("one");
    assert_eq!(material.alpha_mode, AlphaMode::Blend, "one is translucent");
}

#[test]
fn names_of_texture_coordinates_and_colours_differ() {
    for (u, v) in [("s", "t"), ("u", "v"), ("texture_u", "texture_v")] {
        let text =
            SQUARE.replace("float z\n", &format!("float z\nproperty double {u}\nproperty double {v}\n"));
        let text = text.replace(" 0\n", " 0 0.25 0.5\n").replace("vertex 4 0.25 0.5", "vertex 4");
        assert_eq!(mesh(&text).attributes().uv_sets[0][0].to_array(), [0.25, 0.5], "{u}");
    }
    let text = SQUARE
        .replace("float z\n", "float z\nproperty float red\nproperty float green\nproperty float blue\n");
    let mesh = mesh(&text.replace(" 0\n", " 0 1 0.5 0\n"));
    let color = mesh.attributes().corner_colors.as_ref().expect("colours")[0];
    assert_eq!((color.x, color.z), (1.0, 0.0), "floats go to 1");
}

#[test]
fn corners_and_faces_have_values_of_their_own() {
    let text = SQUARE
        .replace("vertex_indices\n", "vertex_indices\nproperty list uchar float texcoord\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n")
        .replace("4 0 1 2 3\n", "4 0 1 2 3 8 0 0 1 0 1 1 0 1 255 0 0\n");
    let attributes = mesh(&text).attributes().clone();
    assert_eq!(attributes.uv_sets[0][2].to_array(), [1.0, 0.0], "MeshLab's");
    assert_eq!(attributes.corner_colors.expect("colours")[3].to_array(), [1.0, 0.0, 0.0, 1.0], "the face's");
}

#[test]
fn a_file_without_faces_is_points() {
    let text = SQUARE.split("element face").next().expect("a header").to_owned()
        + "end_header\n0 0 0\n1 0 0\n1 1 0\nnan 1 0\n";
    let loaded = loaded("cloud.ply", text.as_bytes());
    warns_once(&loaded, "vertex 3: a vertex has a position that is not finite");
    assert_eq!(meshes(&loaded)[0].loose_points(), [0, 1, 2], "those that have a place");
}

#[test]
fn strips_and_edges_are_read() {
    let text = SQUARE
        .replace("element face 1\nproperty list uchar int vertex_indices", "element tristrips 1\nproperty list int int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty int vertex2")
        .replace("4 0 1 2 3\n", "8 0 1 3 2 -1 1 2 3\n0 2\n");
    let mesh = mesh(&text);
    assert_eq!(mesh.corner_vertices(), [0, 1, 3, 3, 1, 2, 1, 2, 3], "every second one turned round");
    assert_eq!(mesh.loose_edges(), [[0, 2]], "the edge");
}

#[test]
fn a_far_model_is_as_sharp_as_a_near_one() {
    let text = SQUARE
        .replace("float x", "double x")
        .replace("\n1 ", "\n10000000.25 ")
        .replace("\n0 ", "\n10000000 ");
    let loaded = loaded("a.ply", text.as_bytes());
    let (_, node) = loaded.scene.nodes().iter().next().expect("one");
    let places = meshes(&loaded)[0].positions();
    let x = |vertex: usize| node.transform.translation().x + f64::from(places[vertex].x);
    assert_eq!((x(0), x(1)), (10_000_000.0, 10_000_000.25), "in f64");
}

#[test]
fn messages_name_the_place() {
    let cases = [
        (
            SQUARE.replace("4 0 1 2 3", "4 0 1 2 4"),
            "a.ply, line 16: face 0 names vertex 4, and the vertices are 0 to 3",
        ),
        (SQUARE.replace("4 0 1 2 3", "4 0 1 2"), "a.ply, line 16: face 0 has too few values"),
        (SQUARE.replace("4 0 1 2 3", "-1 0"), "a.ply, line 16: face 0 has a list of length -1"),
        (SQUARE.replace("1 1 0", "1 x 0"), "a.ply, line 14: vertex 2 cannot be read: \"x\" is not a number"),
        (SQUARE.replace("vertex 4", "vertex 4000000000"), "the limit"),
        (SQUARE.replace("vertex 4", "vertex 9"), "the header claims 9 vertices, and the file ends after"),
        (SQUARE.replace("float y", "float q"), "no properties x, y and z"),
        (SQUARE.replace("float y", "half y"), "a.ply, line 7: \"half\" is not a PLY number type"),
        (SQUARE.replace("format ascii", "format utf8"), "a.ply, line 2: the format \"utf8\""),
        (SQUARE.replace("end_header", "end"), "the header has no end_header"),
        ("ply\nformat ascii 1.0\nend_header\n".to_owned(), "nothing to draw"),
        ("plyx".to_owned(), "not a PLY file"),
    ];
    for (text, words) in cases {
        let message = refused("a.ply", text.as_bytes());
        let words = if words == "the limit" { "more than 50000000 vertices; raise the limit" } else { words };
        assert!(message.contains(words), "{message:?} says {words:?}");
    }
}

/// Counts are claims: memory is taken for what the file has room for.
#[test]
fn a_short_file_cannot_claim_much() {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 40000000\nproperty double x\n\
        property double y\nproperty double z\nelement face 18446744073709551615\n\
        property list uint uint vertex_indices\nend_header\n";
    let message = refused("a.ply", header.as_bytes());
    assert!(
        message.contains("byte 198: the header claims 40000000 vertices, and the file ends after 0"),
        "{message}"
    );
    let mut bytes = header.replace("40000000", "1").into_bytes();
    bytes.extend([0; 24]);
    bytes.extend(u32::MAX.to_le_bytes());
    let options = LoadOptions::default();
    let error = load_from_slice("a.ply", &bytes, &options).map(drop).expect_err("a list of 4 milliards");
    assert_eq!(error.kind, LoadErrorKind::Limit, "{error}");
}

#[test]
fn a_file_that_ends_among_its_faces_shows_what_there_is() {
    let loaded = loaded("a.ply", SQUARE.replace("element face 1", "element face 7").as_bytes());
    warns_once(&loaded, "the file ends after 1 of 7 elements \"face\"");
    assert_eq!(meshes(&loaded)[0].face_count(), 1, "the one");
}

#[test]
fn odd_rows_and_statements_are_warned_of() {
    let text = SQUARE.replace("4 0 1 2 3", "4 0 1 2 3 9").replace("comment", "remark");
    let loaded = loaded("a.ply", text.as_bytes());
    warns_once(&loaded, "line 3: the statement \"remark\"");
    warns_once(&loaded, "line 16: a row has more values");
}

#[test]
fn flat_faces_are_left_out() {
    let loaded = loaded("a.ply", SQUARE.replace("4 0 1 2 3", "4 0 1 1 0").as_bytes());
    warns_once(&loaded, "face 0: a face has fewer than 3 different vertices");
}

/// Two lists of faces, of which one has colours, indexed past the end of those at first.
#[test]
fn lists_of_faces_with_different_values_are_read() {
    let text = SQUARE
        .replace("end_header", "element face 1\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar int vertex_indices\nend_header")
        + "1 2 3 3 0 1 2\n";
    let mesh = mesh(&text);
    assert_eq!((mesh.face_count(), mesh.attributes().corner_colors.is_none()), (2, true), "no colours");
}
