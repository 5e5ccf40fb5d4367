//! Files as people bring them, each with what it must be: by the specification of its format, or by its geometry.

use std::fs;
use std::path::{Path, PathBuf};

use trigon_io::{LoadErrorKind, LoadOptions, Loaded, load, load_from_slice};
use trigon_math::color::{srgb_to_linear, srgb8_to_linear};
use trigon_math::{Vec3, Vec4};
use trigon_scene::{AlphaMode, Material, Shading};

use crate::{meshes, warnings, warns_once};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(name)
}

fn case(name: &str) -> Loaded {
    load(path(name), &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn material(loaded: &Loaded) -> &Material {
    loaded.scene.materials.iter().next().expect("a material").1
}

/// Faces, and the size of the box around them.
fn shape(loaded: &Loaded) -> (usize, [f32; 3]) {
    let faces = meshes(loaded).iter().map(|mesh| mesh.face_count()).sum();
    let all = || meshes(loaded).into_iter().flat_map(|mesh| mesh.positions().iter().copied());
    let (low, high) = (all().reduce(Vec3::min), all().reduce(Vec3::max));
    (faces, (high.expect("places") - low.expect("places")).to_array())
}

#[test]
fn a_text_stl_may_begin_with_a_comment_or_a_mark() {
    for name in ["stl-comment-first/m.stl", "stl-bom/m.stl"] {
        let loaded = case(name);
        assert_eq!(shape(&loaded), (50, [50.0, 1.0, 0.0]), "{name}");
        assert_eq!(warnings(&loaded), [""; 0], "{name}");
    }
    assert_eq!(shape(&case("stl-comment-first/one.stl")), (1, [2.0, 1.0, 0.0]), "one facet");
}

/// The same facets in other spellings of text, also without a name that tells the format.
#[test]
fn a_text_stl_is_known_whatever_stands_before_it() {
    let text = fs::read_to_string(path("stl-comment-first/one.stl")).expect("a file");
    let text = text.split_once('\n').expect("a comment").1.to_owned();
    let utf16: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let long = format!("{}{text}", "# a long licence that nobody reads to its end\n".repeat(100));
    let spellings: [Vec<u8>; 7] = [
        format!("\n\r\n  \n{text}").into_bytes(),
        format!("; made by hand\n// and checked\n{text}").into_bytes(),
        text.replace('\n', " ").into_bytes(),
        format!("\u{feff}{}", text.replace('\n', " ").to_uppercase()).into_bytes(),
        utf16,
        long.into_bytes(),
        text.replace("0 0 0\nouter", "nan\n-nan(ind) 0\nouter").into_bytes(),
    ];
    for bytes in spellings {
        for name in ["a.stl", "stream"] {
            let start = String::from_utf8_lossy(&bytes[..40]).into_owned();
            let loaded = load_from_slice(name, &bytes, &LoadOptions::default());
            let loaded = loaded.unwrap_or_else(|error| panic!("{start}: {error}"));
            assert_eq!(shape(&loaded), (1, [2.0, 1.0, 0.0]), "{start}");
            assert_eq!(warnings(&loaded), [""; 0], "{start}");
        }
    }
    // A line of people in front, which may have words of the format.
    let told = load_from_slice(
        "a.stl",
        format!("Exported by solid works\n{text}").as_bytes(),
        &LoadOptions::default(),
    );
    let told = told.expect("it has a facet");
    warns_once(&told, "line 1: the statement \"Exported\"");
    assert_eq!(shape(&told), (1, [2.0, 1.0, 0.0]), "the facet");
}

#[test]
fn solids_on_one_line_have_their_names() {
    let solid = |name: &str| {
        format!(
            "solid {name} facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid {name}"
        )
    };
    let text = format!("{} {}", solid("left solid"), solid("right"));
    let loaded = load_from_slice("a.stl", text.as_bytes(), &LoadOptions::default()).expect("two solids");
    let names: Vec<&str> = loaded.scene.nodes().iter().map(|(_, node)| node.name.as_str()).collect();
    assert_eq!(names, ["left solid", "right"], "up to the first facet");
}

#[test]
fn text_without_facets_is_no_stl() {
    let page = "<!DOCTYPE html><html><head><title>404</title></head><body>The model that you are looking for is not here</body></html>";
    let error =
        load_from_slice("a.stl", page.as_bytes(), &LoadOptions::default()).map(drop).expect_err("no model");
    assert!(error.to_string().contains("it is text without a facet"), "{error}");
}

/// The bytes of a binary STL with two triangles of a unit square.
fn binary_stl(header: &[u8], attributes: [u16; 2]) -> Vec<u8> {
    let mut bytes = fs::read(path("stl-magics-space/m.stl")).expect("a file");
    bytes[..80].fill(b' ');
    bytes[..header.len()].copy_from_slice(header);
    for (triangle, attribute) in attributes.iter().enumerate() {
        bytes[84 + 50 * triangle + 48..][..2].copy_from_slice(&attribute.to_le_bytes());
    }
    bytes
}

fn stl(header: &[u8], attributes: [u16; 2]) -> Loaded {
    load_from_slice("a.stl", &binary_stl(header, attributes), &LoadOptions::default()).expect("a model")
}

fn linear(color: [u8; 3]) -> Vec3 {
    Vec3::from(color.map(|channel| srgb_to_linear(f32::from(channel) / 255.0)))
}

/// The cube that MeshLab writes was an invisible ghost.
#[test]
fn a_space_in_the_header_of_an_stl_is_no_alpha() {
    for name in ["stl-magics-space/m.stl", "stl-magics-space/pymeshlab-default.stl"] {
        let loaded = case(name);
        assert_eq!(material(&loaded).base_color, linear([127; 3]).extend(1.0), "{name}");
        assert_eq!(material(&loaded).alpha_mode, AlphaMode::Opaque, "{name}");
        warns_once(&loaded, "a separator in place of its alpha");
    }
    let comma = case("stl-magics-space/comma.stl");
    assert_eq!(material(&comma).base_color, linear([127; 3]).extend(1.0), "alpha 255 before a comma");
    assert_eq!(warnings(&comma), [""; 0], "as Magics writes it");
}

/// A header, the colour that it gives to all triangles with its alpha, and the words of a warning.
type HeaderCase = (&'static [u8], Option<([u8; 3], f32)>, &'static str);

#[test]
fn header_colors_of_an_stl_are_believed_if_they_can_be_seen() {
    let cases: [HeaderCase; 9] = [
        (b"COLOR=\xff\x00\x00\xff", Some(([255, 0, 0], 1.0)), ""),
        (b"made by x COLOR=\xff\x00\x00\x33", Some(([255, 0, 0], 0.2)), ""),
        (b"COLOR=\xff\x00\x00\x00", Some(([255, 0, 0], 1.0)), "would be invisible"),
        (b"COLOR=\xff\x00\x00,MATERIAL=\xff\x00\x00\xff", Some(([255, 0, 0], 1.0)), "separator"),
        (b"COLOR=\xff\x00\x00    ", Some(([255, 0, 0], 1.0)), "separator"),
        (b"MATERIAL=\x00\xff\x00\xff\xff\xff\xff\xff\x00\x00\x00\xff", Some(([0, 255, 0], 1.0)), ""),
        (b"COLOR=\xff\x00\x00\xff,MATERIAL=\x00\xff\x00\xff", Some(([0, 255, 0], 1.0)), "MATERIAL counts"),
        (b"COLOR=      ", None, ""),
        (b"COLOR=\x00\x00\x00\x00", None, ""),
    ];
    for (header, expected, warning) in cases {
        let (loaded, header) = (stl(header, [0; 2]), String::from_utf8_lossy(header).into_owned());
        let expected =
            expected.map_or(Material::default().base_color, |(rgb, alpha)| linear(rgb).extend(alpha));
        assert_eq!(material(&loaded).base_color, expected, "{header:?}");
        let is_clear = material(&loaded).alpha_mode == AlphaMode::Blend;
        assert_eq!(is_clear, expected.w < 1.0, "{header:?}");
        match warning {
            "" => assert_eq!(warnings(&loaded), [""; 0], "{header:?}"),
            warning => warns_once(&loaded, warning),
        }
    }
}

/// A header, the attributes of two triangles, their colours if they have any, and the words of a warning.
type AttributeCase = (&'static [u8], [u16; 2], Option<[[f32; 3]; 2]>, &'static str);

#[test]
fn attributes_of_an_stl_are_read_as_their_program_wrote_them() {
    const MAGICS: &[u8] = b"COLOR=\x00\xff\x00\xff,MATERIAL=\x00\xff\x00\xff";
    const RED_LOW: u16 = 31;
    const FLAG: u16 = 0x8000;
    let (red, blue, green, black, white) = ([1., 0., 0.], [0., 0., 1.], [0., 1., 0.], [0.; 3], [1.; 3]);
    let cases: [AttributeCase; 10] = [
        // Magics: the flag is set where there is none.
        (MAGICS, [RED_LOW, FLAG], Some([red, green]), ""),
        (MAGICS, [RED_LOW, 0], Some([red, black]), ""),
        (MAGICS, [0, 0xffff], Some([black, green]), ""),
        (MAGICS, [FLAG, 0xffff], None, ""),
        (MAGICS, [0, 0], None, ""),
        // MeshLab writes the header of Magics, and sets it where there is one.
        (MAGICS, [FLAG | RED_LOW, FLAG | RED_LOW << 10], Some([red, blue]), "taken as colours"),
        (MAGICS, [FLAG | RED_LOW, 0], Some([red, green]), "taken as colours"),
        // VisCAM and SolidView: no header, and blue is low.
        (b"", [FLAG | RED_LOW, 0], Some([blue, white]), ""),
        (b"", [FLAG, FLAG], None, "make every triangle black"),
        (b"", [RED_LOW, 7], None, "lack the bit"),
    ];
    for (header, attributes, expected, warning) in cases {
        let loaded = stl(header, attributes);
        let colors = meshes(&loaded)[0].attributes().corner_colors.clone();
        let of_faces = colors.map(|colors| [0, 3].map(|corner| colors[corner].truncate().to_array()));
        assert_eq!(of_faces, expected, "{attributes:x?}");
        match warning {
            "" => assert_eq!(warnings(&loaded), [""; 0], "{attributes:x?}"),
            warning => warns_once(&loaded, warning),
        }
    }
}

#[test]
fn a_binary_stl_without_a_count_shows_what_there_is() {
    let mut bytes = binary_stl(b"solid streamed", [0; 2]);
    bytes[80..84].fill(0);
    let loaded = load_from_slice("a.stl", &bytes, &LoadOptions::default()).expect("two triangles");
    warns_once(&loaded, "the header claims no triangles, and the 2 that follow are read");
    assert_eq!(shape(&loaded), (2, [1.0, 1.0, 0.0]), "both");
}

/// Ks 1 with Ns 0 is how MeshLab and others say "no highlight": it washed every texture out to white.
#[test]
fn a_placeholder_highlight_leaves_the_texture_as_it_is() {
    for (name, is_placeholder) in [("meshlab", true), ("ns1", true), ("noks", false)] {
        let loaded = case(&format!("obj-meshlab-mtl/{name}.obj"));
        assert_eq!(material(&loaded).shading, Shading::Lambert, "{name}");
        assert!(material(&loaded).base_color_texture.is_some(), "{name}");
        let warned = warnings(&loaded).iter().filter(|warning| warning.contains("placeholder")).count();
        assert_eq!(warned, usize::from(is_placeholder), "{name}: {:?}", warnings(&loaded));
    }
    let highlight = case("obj-meshlab-mtl/ns10.obj");
    assert_eq!(
        material(&highlight).shading,
        Shading::blinn_phong(Vec3::ONE, 10.0),
        "a highlight that is meant"
    );
}

/// One of several materials may be hidden; a model of which nothing is seen is nobody's.
#[test]
fn a_hidden_material_stays_hidden_among_others() {
    let dir = tempfile::tempdir().expect("a folder");
    let load_with = |faces: &str| {
        fs::write(dir.path().join("m.mtl"), "newmtl a\nd 0\nnewmtl b\nTr 0.5\n").expect("a library");
        let model = dir.path().join("m.obj");
        fs::write(&model, format!("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}")).expect("a model");
        let loaded = load(&model, &LoadOptions::default()).expect("a model");
        loaded.scene.materials.iter().map(|(_, material)| material.base_color.w).collect::<Vec<_>>()
    };
    assert_eq!(load_with("usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n"), [0.0, 0.5], "beside another");
    assert_eq!(load_with("usemtl a\nf 1 2 3\n"), [1.0], "alone");
    assert_eq!(
        load_with("f 1 2 3\nusemtl a\nf 1 2 3\n").iter().filter(|alpha| **alpha == 0.0).count(),
        1,
        "beside none"
    );
}

#[test]
fn an_off_is_free_in_its_lines() {
    for name in ["off-all-one-line/m.off", "off-split-face/m.off"] {
        let loaded = case(name);
        assert_eq!(shape(&loaded), (1, [1.0, 1.0, 0.0]), "{name}");
        assert_eq!(meshes(&loaded)[0].corner_vertices(), [0, 1, 2, 3], "{name}");
        assert_eq!(warnings(&loaded), [""; 0], "{name}");
    }
}

fn off(text: &str) -> Loaded {
    load_from_slice("a.off", text.as_bytes(), &LoadOptions::default())
        .unwrap_or_else(|error| panic!("{text:?}: {error}"))
}

#[test]
fn any_layout_of_an_off_is_the_same_square() {
    const PLACES: &str = "0 0 0 1 0 0 1 1 0 0 1 0";
    let numbers = |separator: &str| {
        format!("4{separator}2{separator}0{separator}{PLACES} 3 0 1 2 3 0 2 3").replace(' ', separator)
    };
    let layouts = [
        numbers(" "),
        numbers("\n"),
        format!("OFF {}", numbers(" ")),
        format!("off\r\n{}", numbers("\r\n")),
        format!("\u{feff}OFF # free\n4 2 0\n{PLACES}\n3 0 1 2 3 0 2 3"),
        "OFF\n4 2 0\n0 0 0 1 0 0 # two\n1 1 0 0 1 0\n3 0 1 2\n3 0 2 3\n".to_owned(),
        "OFF\n4 2 0\n0 0\n0 1 0 0 1 1 0\n0 1 0 3\n0 1 2 3 0\n2 # and\n\n3".to_owned(),
        "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 3 0 2 3\n".to_owned(),
        "OFF\n4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1\n2\n3\n0 2 3\n".to_owned(),
    ];
    for text in layouts {
        let loaded = off(&text);
        assert_eq!(shape(&loaded), (2, [1.0, 1.0, 0.0]), "{text:?}");
        assert_eq!(meshes(&loaded)[0].corner_vertices(), [0, 1, 2, 0, 2, 3], "{text:?}");
        assert_eq!(warnings(&loaded), [""; 0], "{text:?}");
    }
}

/// A number that is missing shifts all that follow, where lines mean nothing: it is told where the lines make sense.
#[test]
fn a_row_that_is_cut_is_not_read_on_in_silence() {
    let cut = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1\n0 1 0\n4 3 0 1 2\n";
    warns_once(&off(cut), "line 5: vertex 2 has too few numbers");
    let split = "OFF\n4 1 0\n0 0 0\n1 0\n0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let loaded = off(split);
    assert_eq!(shape(&loaded), (1, [1.0, 1.0, 0.0]), "as the format has it");
    warns_once(&loaded, "the numbers are read as one list");
}

#[test]
fn faces_have_colors_below_vertices_that_share_lines() {
    let loaded = off("OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 255 0\n");
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(
        (colors[0], colors[3]),
        (Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.0, 1.0, 0.0, 1.0)),
        "each its own"
    );
}

#[test]
fn the_color_of_a_face_ends_with_its_line() {
    let places = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    let loaded = off(&format!("OFF\n4 2 0\n{places}3 0\n1 2 255 0 0\n3 0 2 3 # none\n"));
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!((colors[0], colors[3]), (Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::ONE), "red and none");
}

#[test]
fn vertex_colors_of_an_off_need_no_keyword() {
    let loaded = case("off-vertex-colors/m.off");
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors, [Vec4::new(1.0, 0.0, 0.0, 1.0); 3], "red");
    warns_once(&loaded, "vertices have 4 numbers after their places, which are taken as colours");
    let rows = |rows: [&str; 3]| {
        format!("OFF\n3 1 0\n0 0 0 {}\n1 0 0 {}\n1 1 0 {}\n3 0 1 2\n", rows[0], rows[1], rows[2])
    };
    let rgb = off(&rows(["0.5 0 0", "0 0.5 0", "0 0 1"]));
    let colors = meshes(&rgb)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors[0], Vec4::new(srgb_to_linear(0.5), 0.0, 0.0, 1.0), "three from 0 to 1");
    let normals = off(&rows(["0 0 1", "0 -0.6 0.8", "0 0 1"]));
    warns_once(&normals, "taken as normals");
    let normals = meshes(&normals)[0].attributes().corner_normals.clone().expect("normals");
    assert_eq!(normals[1], Vec3::new(0.0, -0.6, 0.8), "a direction is no colour");
    let both = off(&rows(["255 0 0 255 0 0 1", "255 0 0 255 0 -0.6 0.8", "255 0 0 255 0 0 1"]));
    let attributes = meshes(&both)[0].attributes();
    assert_eq!(attributes.corner_colors.as_ref().expect("colours")[1], Vec4::new(1.0, 0.0, 0.0, 1.0), "both");
    let uneven = off(&rows(["1 2", "1", "7 7 7 7"]));
    warns_once(&uneven, "rows of vertices differ in their numbers");
    assert_eq!(shape(&uneven), (1, [1.0, 1.0, 0.0]), "the places");
}

#[test]
fn meshlab_writes_colors_before_normals() {
    let loaded = case("off-meshlab-ncoff/m.off");
    let attributes = meshes(&loaded)[0].attributes();
    assert_eq!(attributes.corner_colors.as_ref().expect("colours")[0], Vec4::new(1.0, 0.0, 0.0, 1.0), "red");
    assert_eq!(
        attributes.corner_normals.as_ref().expect("normals")[0],
        Vec3::new(0.1, -0.2, 0.97),
        "its normal"
    );
    warns_once(&loaded, "the colours of vertices stand before their normals");
    // In the order of the format they stay as they are.
    let text = "NCOFF\n3 1 0\n0 0 0 0.1 -0.2 0.97 255 0 0 255\n1 0 0 0.1 -0.2 0.97 255 0 0 255\n1 1 0 0 0 1 0 0 51 255\n3 0 1 2\n";
    let loaded = off(text);
    assert_eq!(warnings(&loaded), [""; 0], "nothing is odd");
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors[2], Vec4::new(0.0, 0.0, srgb8_to_linear(51), 1.0), "dark blue");
}

/// The texel at the texture coordinate of each corner, at the vertex with a place.
fn texel_at(loaded: &Loaded, place: [f32; 3]) -> [u8; 4] {
    let mesh = meshes(loaded)[0];
    let at = |vertex: &u32| mesh.positions()[*vertex as usize].to_array() == place;
    let corner = mesh.corner_vertices().iter().position(at).expect("a corner there");
    let uv = mesh.attributes().uv_sets[0][corner];
    let slot = mesh.attributes().face_materials.as_ref().map_or(0, |slots| slots[0]);
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    let material = loaded.scene.materials.get(node.materials[slot as usize]).expect("a material");
    assert_eq!(material.base_color, Vec4::ONE, "the texture as it is");
    let texture = loaded.scene.textures.get(material.base_color_texture.expect("a texture").texture);
    let texture = &texture.expect("it is there").texture;
    let texel = |share: f32, count: u32| ((share * count as f32) as u32).min(count - 1);
    let (x, y) = (texel(uv.x, texture.width()), texel(uv.y, texture.height()));
    texture.texels().nth((y * texture.width() + x) as usize).expect("a texel")
}

const CORNERS: [([f32; 3], [u8; 4]); 4] = [
    ([0.0, 1.0, 0.0], [255, 0, 0, 255]),
    ([1.0, 1.0, 0.0], [0, 255, 0, 255]),
    ([0.0, 0.0, 0.0], [0, 0, 255, 255]),
    ([1.0, 0.0, 0.0], [255, 255, 0, 255]),
];

#[test]
fn a_ply_shows_the_texture_that_a_comment_names() {
    let loaded = case("ply-texturefile/m.ply");
    assert_eq!(warnings(&loaded), [""; 0], "nothing is odd");
    for (place, texel) in CORNERS {
        assert_eq!(texel_at(&loaded, place), texel, "{place:?}");
    }
}

/// A folder with the image of the case, and a PLY with other lines.
fn ply(header: &str, vertices: [&str; 4], faces: [&str; 2]) -> Loaded {
    let dir = tempfile::tempdir().expect("a folder");
    fs::copy(path("ply-texturefile/tex.png"), dir.path().join("my tex.png")).expect("an image");
    let properties = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    let (of_vertices, of_faces) = header.split_once('|').expect("two parts");
    let text = format!(
        "ply\nformat ascii 1.0\ncomment TextureFile my tex.png\n{properties}{of_vertices}element face 2\n\
         property list uchar int vertex_indices\n{of_faces}end_header\n0 0 0 {}\n1 0 0 {}\n1 1 0 {}\n0 1 0 {}\n3 0 1 2 {}\n3 0 2 3 {}\n",
        vertices[0], vertices[1], vertices[2], vertices[3], faces[0], faces[1]
    );
    let model = dir.path().join("m.ply");
    fs::write(&model, text).expect("a model");
    load(&model, &LoadOptions::default()).expect("a model")
}

#[test]
fn a_ply_is_textured_by_its_vertices_too() {
    for (u, v) in [("s", "t"), ("u", "v"), ("texture_u", "texture_v")] {
        let header = format!("property float {u}\nproperty float {v}\n|");
        let loaded = ply(&header, ["0 0", "1 0", "1 1", "0 1"], ["", ""]);
        assert_eq!(warnings(&loaded), [""; 0], "{u}");
        for (place, texel) in CORNERS {
            assert_eq!(texel_at(&loaded, place), texel, "{u}: {place:?}");
        }
    }
    let colored = "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n|";
    let loaded = ply(colored, ["0 0 9 9 9", "1 0 9 9 9", "1 1 9 9 9", "0 1 9 9 9"], ["", ""]);
    warns_once(&loaded, "not drawn beside a texture");
    assert!(meshes(&loaded)[0].attributes().corner_colors.is_none(), "the image has them already");
    let bare = ply("|", [""; 4], [""; 2]);
    warns_once(&bare, "line 3: texture \"my tex.png\" is not drawn: there are no texture coordinates");
}

#[test]
fn faces_of_a_ply_choose_among_textures() {
    let header =
        "comment TextureFile gone.png\n|property list uchar float texcoord\nproperty int texnumber\n";
    let placed = "6 0 0 1 0 1 1";
    let loaded = ply(header, [""; 4], [&format!("{placed} 0"), &format!("{placed} 1")]);
    warns_once(&loaded, "line 8: texture \"gone.png\" is not drawn: there is no such file");
    let mesh = meshes(&loaded)[0];
    assert_eq!(mesh.attributes().face_materials, Some(vec![0, 1]), "each its own");
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    let is_textured = |slot: usize| {
        loaded.scene.materials.get(node.materials[slot]).expect("a material").base_color_texture.is_some()
    };
    assert_eq!((is_textured(0), is_textured(1)), (true, false), "what is there");
    // -1, and no coordinates, mean none.
    let loaded = ply(header, [""; 4], [&format!("{placed} -1"), "0 0"]);
    assert_eq!(meshes(&loaded)[0].attributes().face_materials, None, "nothing shows an image");
    let loaded = ply(header, [""; 4], [&format!("{placed} 0"), "0 0"]);
    assert_eq!(meshes(&loaded)[0].attributes().face_materials, Some(vec![0, 2]), "one of them does");
}

#[test]
fn float_colors_of_a_ply_may_go_to_255() {
    let header = |kind: &str| format!("property {kind} red\nproperty {kind} green\nproperty {kind} blue\n|");
    let colors = |kind: &str, rows: [&str; 4]| {
        let loaded = ply(&header(kind), rows, ["", ""]);
        let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
        (colors[0].to_array(), warnings(&loaded).iter().any(|warning| warning.contains("from 0 to 255")))
    };
    let dark = [srgb8_to_linear(51), 1.0, 0.0, 1.0];
    assert_eq!(colors("float", ["51 255 0"; 4]), (dark, true), "as bytes");
    assert_eq!(colors("double", ["0.2 1 0"; 4]), (dark, false), "to 1");
    assert_eq!(colors("uchar", ["51 255 0"; 4]), (dark, false), "bytes");
    // One bright vertex among dark ones tells the range of all.
    assert_eq!(
        colors("float", ["1 0 0", "0 0 0", "0 0 0", "255 0 0"]).0[0],
        srgb8_to_linear(1),
        "one of 255"
    );
}

#[test]
fn a_pointer_of_git_lfs_is_named_in_every_format() {
    let names = ["m.obj", "m.gltf", "m.glb", "m.ply", "m.stl", "m.off"];
    let pointer = fs::read(path("lfs/m.obj")).expect("a pointer");
    for name in names {
        let of_file = load(path("lfs").join(name), &LoadOptions::default()).map(drop).expect_err("no model");
        let of_bytes =
            load_from_slice(name, &pointer, &LoadOptions::default()).map(drop).expect_err("no model");
        for error in [of_file, of_bytes] {
            assert_eq!(error.kind, LoadErrorKind::Malformed, "{error}");
            let text = error.to_string();
            assert!(text.contains("Git LFS pointer") && text.contains("git lfs pull"), "{text}");
        }
    }
}

/// What a model names may be a pointer, too.
#[test]
fn a_pointer_of_git_lfs_is_named_beside_a_model() {
    let dir = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &[u8]| fs::write(dir.path().join(name), text).expect("a file");
    let pointer = fs::read(path("lfs/m.obj")).expect("a pointer");
    let load = |name: &str| load(dir.path().join(name), &LoadOptions::default());
    put("m.mtl", &pointer);
    put("m.obj", b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    warns_once(&load("m.obj").expect("a model"), "Git LFS pointer");
    put("t.png", &pointer);
    put("m.mtl", b"newmtl m\nmap_Kd t.png\n");
    put("m.obj", b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    let loaded = load("m.obj").expect("a model");
    warns_once(&loaded, "Git LFS pointer");
    warns_once(&loaded, "git lfs pull");
    let gltf = fs::read_to_string(path("gltf-uri/m.gltf")).expect("a model");
    put("big ball.png", &pointer);
    put("m.gltf", gltf.as_bytes());
    warns_once(&load("m.gltf").expect("a model"), "Git LFS pointer");
    put("m.bin", &pointer);
    let buffer = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"uri":"m.bin","byteLength":36}]}"#;
    put("b.gltf", buffer.as_bytes());
    let error = load("b.gltf").map(drop).expect_err("no geometry");
    assert!(error.to_string().contains("Git LFS pointer"), "{error}");
}

/// Of `a%2Fb` the format says that the slash is part of a name, and every program takes it for a folder.
#[test]
fn file_names_in_a_gltf_may_be_encoded_or_not() {
    let names = [
        ("big ball.png", "big ball.png"),
        ("big%20ball.png", "big ball.png"),
        ("big%20ball.png", "big%20ball.png"),
        ("big%ball.png", "big%ball.png"),
        ("big%25ball.png", "big%ball.png"),
        ("%E7%90%83.png", "球.png"),
        ("球.png", "球.png"),
        ("a%2Fb.png", "a/b.png"),
        ("sub/./x.png", "sub/x.png"),
        ("tex#1.png", "tex#1.png"),
        ("tex%231.png", "tex#1.png"),
        ("100%.png", "100%.png"),
        // Two more of the kind, and what a program that fetches models leaves.
        ("50%25%20off.png", "50% off.png"),
        ("%ff.png", "%ff.png"),
        ("big%2520ball.png", "big%20ball.png"),
    ];
    let gltf = fs::read_to_string(path("gltf-uri/m.gltf")).expect("a model");
    let load_with = |uri: &str, file: &str| {
        let dir = tempfile::tempdir().expect("a folder");
        let image = dir.path().join(file);
        fs::create_dir_all(image.parent().expect("a folder")).expect("a folder");
        fs::copy(path("ply-texturefile/tex.png"), &image).expect("an image");
        let model = dir.path().join("m.gltf");
        fs::write(&model, gltf.replace("big ball.png", uri)).expect("a model");
        load(&model, &LoadOptions::default()).expect("a model")
    };
    for (uri, file) in names {
        let loaded = load_with(uri, file);
        assert_eq!(warnings(&loaded), [""; 0], "{uri} is {file}");
        assert!(material(&loaded).base_color_texture.is_some(), "{uri} is {file}");
    }
    let guessed = load_with("big ball.png", "big%20ball.png");
    assert!(material(&guessed).base_color_texture.is_some(), "a name that was kept encoded");
    warns_once(&guessed, "is used instead");
    let away = load_with("..%2F..%2Fetc%2Fpasswd", "x.png");
    warns_once(&away, "it leads out of the model's folder");
}
