//! OFF as text.

use trigon_math::color::srgb8_to_linear;

use crate::{loaded, meshes, refused, warnings, warns_once};

const SQUARE: &str = "OFF\n# a square\n4 1 0\n\n0 0 0\n1 0 0 # right\n1 1 0\n0 1 0\n4 0 1 2 3\n";

#[test]
fn headers_differ() {
    let heads = ["OFF\n4 1 0", "OFF 4 1 0", "OFF4 1 0", "4 1 0", "OFF\r\n4 1"];
    for head in heads {
        let loaded = loaded("a.off", SQUARE.replace("OFF\n# a square\n4 1 0", head).as_bytes());
        assert_eq!(warnings(&loaded), [""; 0], "{head}");
        let mesh = meshes(&loaded)[0];
        assert_eq!((mesh.vertex_count(), mesh.corner_count()), (4, 4), "{head}");
    }
}

#[test]
fn vertices_have_normals_colours_and_coordinates() {
    let row = |place: &str| format!("{place} 0 0 1 255 128 0 51 0.25 0.75\n");
    let rows: String = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"].map(row).concat();
    let text = format!("STCNOFF\n4 1 0\n{rows}4 0 1 2 3\n");
    let loaded = loaded("a.off", text.as_bytes());
    let attributes = meshes(&loaded)[0].attributes();
    assert_eq!(attributes.corner_normals.as_ref().expect("normals")[0].to_array(), [0.0, 0.0, 1.0], "N");
    let color = attributes.corner_colors.as_ref().expect("colours")[0];
    assert_eq!(color.to_array(), [1.0, srgb8_to_linear(128), 0.0, 0.2], "C");
    assert_eq!(attributes.uv_sets[0][0].to_array(), [0.25, 0.25], "ST, v downwards");
}

#[test]
fn faces_have_colours() {
    let text =
        SQUARE.replace("4 1 0\n", "4 3 0\n").replace("4 0 1 2 3", "3 0 1 2 1 0 0\n3 0 2 3\n2 1 3 0 0 1");
    let loaded = loaded("a.off", text.as_bytes());
    let mesh = meshes(&loaded)[0];
    let colors = mesh.attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors[0].to_array(), [1.0, 0.0, 0.0, 1.0], "from 0 to 1");
    assert_eq!(colors[3].to_array(), [1.0; 4], "none is white");
    assert_eq!(mesh.loose_edges(), [[1, 3]], "two vertices are an edge");
}

#[test]
fn broken_files_say_where() {
    let cases = [
        (
            SQUARE.replace("4 0 1 2 3", "4 0 1 2 9"),
            "a.off, line 9: face 0 names vertex 9, and the vertices are 0 to 3",
        ),
        (
            SQUARE.replace("4 0 1 2 3", "5 0 1 2 3"),
            "a.off, line 9: face 0 claims 5 vertices and has 4 numbers",
        ),
        (SQUARE.replace("1 1 0", "1 1"), "line 7: vertex 2 has too few numbers"),
        (SQUARE.replace("1 1 0", "1 y 0"), "line 7: vertex 2: \"y\" is not a number"),
        (SQUARE.replace("4 1 0", "many"), "line 3: \"many\" does not tell how many"),
        (SQUARE.replace("4 1 0", "9 1 0"), "the header claims 9 vertices"),
        (SQUARE.replace("4 1 0", "99999999999999999 1 0"), "more than 50000000 vertices"),
        (SQUARE.replace("OFF", "4OFF"), "which is not read; save it as text in three dimensions"),
        (SQUARE.replace("OFF", "OFF BINARY"), "which is not read"),
        (String::new(), "the file is empty"),
    ];
    for (text, words) in cases {
        let message = refused("a.off", text.as_bytes());
        assert!(message.contains(words), "{message:?} says {words:?}");
    }
    let loaded = loaded("a.off", SQUARE.replace("4 1 0", "4 5 0").as_bytes());
    warns_once(&loaded, "the header claims 5 faces, and the file ends after 1");
}
