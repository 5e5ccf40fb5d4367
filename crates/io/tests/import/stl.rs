//! STL as text and as bytes.

use trigon_math::color::srgb_to_linear;

use crate::{loaded, meshes, refused, warnings, warns_once};

const TEXT: &str = "solid first part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   \
    vertex 1 1 0\n  endloop\n endfacet\n facet normal 0 0 0\n  outer loop\n   vertex 0 0 0\n   vertex 1 1 0\n   \
    vertex -0 1 0\n  endloop\n endfacet\nendsolid first part\n";

/// A binary file with two triangles of a square.
fn binary(header: &[u8], attributes: [u16; 2]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2u32.to_le_bytes());
    let corners = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]];
    for (triangle, attribute) in [[0, 1, 2], [0, 2, 3]].iter().zip(attributes) {
        bytes.extend([0; 12]);
        for &corner in triangle {
            let [x, y]: [f32; 2] = corners[corner];
            bytes.extend([x, y, 0.0].iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

fn color(channels: [u8; 3]) -> [f32; 4] {
    let [red, green, blue] = channels.map(|channel| srgb_to_linear(f32::from(channel) / 31.0));
    [red, green, blue, 1.0]
}

#[test]
fn vertices_at_the_same_place_are_one() {
    for text in [TEXT.to_owned(), TEXT.replace('\n', "\r\n"), TEXT.to_uppercase()] {
        let loaded = loaded("a.stl", text.as_bytes());
        assert_eq!(warnings(&loaded), [""; 0], "{text}");
        let mesh = meshes(&loaded)[0];
        assert_eq!((mesh.vertex_count(), mesh.edge_count()), (4, 5), "a square of two triangles");
    }
    let loaded = loaded("a.stl", &binary(b"", [0, 0]));
    assert_eq!(meshes(&loaded)[0].vertex_count(), 4, "binary, too");
}

/// The word that text begins with stands in many a binary header.
#[test]
fn a_binary_file_may_begin_with_solid() {
    for name in ["a.stl", ""] {
        let loaded = loaded(name, &binary(b"solid made by a CAD program", [0, 0]));
        assert_eq!(
            (warnings(&loaded).len(), meshes(&loaded)[0].face_count()),
            (0, 2),
            "{name:?} by its size"
        );
    }
    let mut longer = binary(b"solid x", [0, 0]);
    longer.extend([0; 7]);
    warns_once(&loaded("a.stl", &longer), "byte 191: there are bytes after the 2 triangles");
}

#[test]
fn solids_are_nodes() {
    let text = TEXT.to_owned() + "solid empty\nendsolid\n" + &TEXT.replace("first part", "second");
    let loaded = loaded("a.stl", text.as_bytes());
    let names: Vec<&str> = loaded.scene.nodes().iter().map(|(_, node)| node.name.as_str()).collect();
    assert_eq!(names, ["first part", "second"], "those with facets");
}

#[test]
fn colours_of_viscam_have_blue_in_the_lowest_bits() {
    let loaded = loaded("a.stl", &binary(b"", [0x8000 | 31 << 10 | 7, 31]));
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors[0].to_array(), color([31, 0, 7]), "red, green, blue");
    assert_eq!(colors[3].to_array(), [1.0; 4], "without the bit there is none");
}

#[test]
fn colours_of_magics_have_red_in_the_lowest_bits() {
    let loaded = loaded("a.stl", &binary(b"COLOR=\x00\xff\x00\xff", [31 | 7 << 10, 0x8000]));
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors[0].to_array(), color([31, 0, 7]), "red, green, blue");
    assert_eq!(colors[3].to_array(), [0.0, 1.0, 0.0, 1.0], "with the bit it is that of all");
}

#[test]
fn broken_files_say_where() {
    let message = refused("a.stl", TEXT.replace("vertex 1 0 0", "vertex 1 b 0").as_bytes());
    assert!(message.starts_with("a.stl, line 5: \"b\" is not a number"), "{message}");
    let message = refused("a.stl", TEXT.replace("vertex 1 0 0", "vertex 1 0").as_bytes());
    assert!(message.contains("line 5: a vertex has fewer than 3 coordinates"), "{message}");
    assert!(refused("a.stl", b"").contains("0 bytes"), "empty");
    assert!(refused("a.stl", b"solid x\nendsolid").contains("nothing to draw"), "no facet");
    warns_once(
        &loaded("a.stl", TEXT.replace("outer", "inner").as_bytes()),
        "line 3: the statement \"inner\"",
    );
    let within = &TEXT[..TEXT.rfind("   vertex").expect("there are some")];
    warns_once(&loaded("a.stl", within.as_bytes()), "the file ends within a facet");
}

#[test]
fn a_binary_file_that_is_too_short_shows_what_there_is() {
    let mut bytes = binary(b"", [0, 0]);
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let loaded = loaded("a.stl", &bytes);
    warns_once(&loaded, "byte 184: the header claims 4294967295 triangles, and the file ends after 2");
    assert_eq!(meshes(&loaded)[0].face_count(), 2, "both");
}
