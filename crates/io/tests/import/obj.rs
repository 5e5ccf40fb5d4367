//! OBJ text: what is kept, what is counted, and which line is named.

use proptest::prelude::*;
use trigon_math::{DVec3, Vec2, Vec3, Vec4};

use crate::{loaded, meshes, refused, warnings, warns_once};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn obj(text: &str) -> trigon_io::Loaded {
    loaded("a.obj", text.as_bytes())
}

#[test]
fn polygons_stay_polygons_and_edges_are_their_own() {
    let loaded = obj(&format!("{SQUARE}f 1 2 3 4\nl 1 3\np 2\n"));
    let mesh = meshes(&loaded)[0];
    assert_eq!(
        (mesh.vertex_count(), mesh.face_count(), mesh.edge_count()),
        (4, 1, 5),
        "a square and a diagonal"
    );
    assert_eq!(mesh.loose_edges().len(), 1, "the line");
    assert_eq!(mesh.loose_points().len(), 1, "the point");
    assert_eq!(mesh.face_vertices(0), [0, 1, 2, 3], "in the file's order");
    assert_eq!(warnings(&loaded), [""; 0], "nothing to warn of");
}

#[test]
fn line_endings_marks_and_continuations_do_not_matter() {
    let plain = format!("{SQUARE}f 1 2 3\n");
    let utf16: Vec<u8> = format!("\u{feff}{plain}").encode_utf16().flat_map(u16::to_be_bytes).collect();
    let variants = [
        plain.replace('\n', "\r\n").into_bytes(),
        plain.replace('\n', "\r").into_bytes(),
        format!("\u{feff}{plain}").into_bytes(),
        plain.replace("f 1 2", "f 1 \\\n 2").into_bytes(),
        plain.replace("f 1", "   f\t+1").replace("3\n", "3 # a comment\n").into_bytes(),
        [b"# caf\xe9\n".as_slice(), plain.as_bytes()].concat(),
        utf16,
    ];
    for bytes in variants {
        let loaded = loaded("a.obj", &bytes);
        assert_eq!(meshes(&loaded)[0].face_vertices(0), [0, 1, 2], "{:?}", String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn groups_and_objects_are_nodes_and_materials_are_slots() {
    let text = format!(
        "{SQUARE}o a\nusemtl x\nf 1 2 3\nusemtl y\nf 1 3 4\no b\nf 1 2 4\ng part\nf 2 3 4\no a\nf 2 4 1\n"
    );
    let loaded = obj(&text);
    let nodes: Vec<_> = loaded.scene.nodes().iter().map(|(_, node)| node).collect();
    assert_eq!(
        nodes.iter().map(|node| node.name.as_str()).collect::<Vec<_>>(),
        ["a", "b", "b/part"],
        "by name"
    );
    assert_eq!(nodes.iter().map(|node| node.materials.len()).collect::<Vec<_>>(), [2, 1, 1], "slots");
    let slots = meshes(&loaded)[0].attributes().face_materials.clone();
    assert_eq!(slots, Some(vec![0, 1, 1]), "the object was resumed in material y");
    warns_once(&loaded, "material \"x\"");
}

#[test]
fn a_file_without_names_is_named_after_itself() {
    let (_, node) = &obj(&format!("{SQUARE}f 1 2 3\n"))
        .scene
        .nodes()
        .iter()
        .map(|(id, node)| (id, node.clone()))
        .next()
        .expect("a node");
    assert_eq!(node.name, "a", "the file's stem");
}

#[test]
fn coordinates_turn_down_and_missing_ones_are_zero() {
    let loaded = obj(&format!("{SQUARE}vt 0.25 0.25\nvt 0.5\nvn 0 0 2\nf 1/1/1 2/2 3\nf 1 3 4\n"));
    let attributes = meshes(&loaded)[0].attributes();
    let expected =
        [Vec2::new(0.25, 0.75), Vec2::new(0.5, 1.0), Vec2::ZERO, Vec2::ZERO, Vec2::ZERO, Vec2::ZERO];
    assert_eq!(attributes.uv_sets, [expected], "v counts from the top");
    let normals = attributes.corner_normals.as_ref().expect("one corner has one");
    assert_eq!(normals[0], Vec3::new(0.0, 0.0, 2.0), "given");
    assert_eq!(normals[1..], [Vec3::ZERO; 5], "zero means none");
}

#[test]
fn colours_stay_with_their_vertices() {
    let text = "v 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0 nan 0 0\nf 1 2 3 4\n";
    let loaded = obj(text);
    let colors = meshes(&loaded)[0].attributes().corner_colors.clone().expect("colours");
    let (white, red) = (Vec4::ONE, Vec4::new(1.0, 0.0, 0.0, 1.0));
    assert_eq!(colors[..3], [white, red, white], "nothing shifts");
    assert!(colors.iter().all(|color| color.is_finite()), "nothing is not a number");
    warns_once(&loaded, "no colour");
    warns_once(&loaded, "not finite");
}

#[test]
fn smoothing_groups_crease_where_they_meet() {
    // Three walls of a corner; two in one group, the third in another.
    let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    let several = obj(&format!("{cube}s 1\nf 1 3 2\nf 1 4 3\ns 2\nf 1 2 4\n"));
    let normals = meshes(&several)[0].attributes().corner_normals.clone().expect("computed");
    let diagonal = -Vec3::new(1.0, 0.0, 1.0).normalize();
    assert!(normals[0].distance(diagonal) < 1e-6, "smooth within the group: {}", normals[0]);
    assert!(normals[6].distance(-Vec3::Y) < 1e-6, "a crease towards the other: {}", normals[6]);
    let one = obj(&format!("{cube}s 1\nf 1 3 2\ns off\nf 1 4 3\n"));
    assert_eq!(
        meshes(&one)[0].attributes().face_smooth,
        Some(vec![true, false]),
        "one group needs no normals"
    );
}

#[test]
fn far_models_keep_their_shape() {
    let text = "v 10000000.001 0 0\nv 10000000.002 0 0\nv 10000000.002 0.001 0\nf 1 2 3\n";
    let loaded = obj(text);
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    let offset = node.transform.translation();
    let positions = meshes(&loaded)[0].positions();
    let first = offset + positions[0].as_dvec3();
    assert!((first - DVec3::new(10_000_000.001, 0.0, 0.0)).length() < 1e-9, "micrometres survive: {first}");
    let edge = positions[1] - positions[0];
    assert!((edge.x - 0.001).abs() < 1e-8, "the edge is a millimetre: {edge}");
}

#[test]
fn what_is_not_finite_is_left_out_and_the_rest_stays() {
    for number in ["nan", "-inf", "1e400", "1.#IND", "-nan(ind)", "1.#QNAN"] {
        let loaded = obj(&format!("{SQUARE}v {number} 0 0\nf 1 2 3\nf 1 2 5\n"));
        assert_eq!(meshes(&loaded)[0].face_count(), 1, "{number}");
        warns_once(&loaded, "a.obj, line 5: ");
    }
}

#[test]
fn errors_name_the_line() {
    let lines = [
        "f 1 2 0",
        "f 1 2 5",
        "f 1 2 -5",
        "f 1 2 4294967297",
        "f 1 2 -9223372036854775808",
        "f 1/0 2 3",
        "f 1 2 x",
        "f 1/1/1/1 2 3",
        "v 1 2",
        "v 1 2 x",
        "v 1,5 2 3",
        "v 1-2 3 4",
        "v 0 0 \0",
        "vn 1 2",
        "vt",
        "l 9 1",
        "p 0",
        "v 1 1 1 0",
    ];
    for line in lines {
        let message = refused("a.obj", format!("{SQUARE}\n{line}\nf 1 2 3\n").as_bytes());
        assert!(message.starts_with("a.obj, line 6: "), "{line:?}: {message}");
    }
}

#[test]
fn nothing_to_draw_is_said() {
    for text in [
        "",
        "# only a comment",
        SQUARE,
        "f",
        &format!("{SQUARE}f 1\nf 1 2\n"),
        "\0\0\0\0",
        "version https://git-lfs.github.com/spec/v1\n",
    ] {
        refused("a.obj", text.as_bytes());
    }
}

#[test]
fn a_library_that_is_missing_or_outside_is_a_warning() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("model/a.obj");
    std::fs::create_dir(dir.path().join("model")).expect("a folder");
    std::fs::write(dir.path().join("secret.mtl"), "newmtl m\n").expect("a file");
    std::fs::write(dir.path().join("model/my lib.mtl"), "newmtl m\nKd 1 0 0\n").expect("a file");
    for (name, is_found) in [
        ("gone.mtl", false),
        ("../secret.mtl", false),
        ("/dev/zero", false),
        ("gone.mtl MY LIB.mtl", false),
        ("my lib.mtl", true),
        ("sub\\My Lib.mtl", true),
    ] {
        std::fs::write(&path, format!("mtllib {name}\n{SQUARE}usemtl m\nf 1 2 3\n")).expect("a file");
        let loaded =
            trigon_io::load(&path, &trigon_io::LoadOptions::default()).expect("the geometry is fine");
        let (_, material) = loaded.scene.materials.iter().next().expect("a material");
        assert_eq!(material.name == "m", is_found, "{name}: {:#?}", warnings(&loaded));
        assert!(is_found || !loaded.warnings.is_empty(), "{name}: a warning");
        assert!(
            loaded.files.iter().all(|file| file.starts_with(dir.path().join("model"))),
            "{name}: {:?}",
            loaded.files
        );
    }
}

#[test]
fn a_long_line_takes_linear_time() {
    let corners: String = (0..200_000).map(|corner| format!(" {}", corner % 4 + 1)).collect();
    let name = "x".repeat(4 << 20);
    let loaded = obj(&format!("g {name}\n{SQUARE}f{corners}\n"));
    assert_eq!(meshes(&loaded)[0].corner_count(), 200_000, "one huge face");
}

#[test]
fn a_line_that_names_too_many_libraries_says_so() {
    let names: String = (0..65).map(|index| format!(" {index}.mtl")).collect();
    let loaded = obj(&format!("{SQUARE}f 1 2 3\nmtllib{names}\n"));
    warns_once(&loaded, "a.obj, line 6: mtllib names more than 64 libraries");
    assert_eq!(loaded.warnings.len(), 65, "and the 64 are not there: {:#?}", loaded.warnings);
}

#[test]
fn many_groups_materials_and_libraries_take_linear_time() {
    let lines: String =
        (0..100_000).map(|index| format!("mtllib {index}\nusemtl {index}\nf 1 2 3\n")).collect();
    let loaded = obj(&format!("{SQUARE}{lines}"));
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    assert_eq!(node.materials.len(), 100_000, "a slot for each");
    warns_once(&loaded, "a.obj, line 773: more than 256 libraries");
    let groups: String = (0..20_000).map(|index| format!("g {index}\nf 1 2 3\n")).collect();
    assert_eq!(obj(&format!("{SQUARE}{groups}")).scene.nodes().len(), 20_000, "a node for each");
}

proptest! {
    /// Whatever stands in the file, all indices of the mesh are right and all
    /// positions are finite.
    #[test]
    fn no_text_breaks_the_mesh(lines in prop::collection::vec("(v|vt|vn|f|l|p|o|g|s|usemtl|mtllib|#)( -?[0-9]{1,2}(/[0-9]{0,2}){0,2}| [a-z.\\\\]{0,3}){0,5}", 0..40)) {
        let text = format!("{SQUARE}{}\nf 1 2 3\n", lines.join("\n"));
        if let Ok(loaded) = trigon_io::load_from_slice("a.obj", text.as_bytes(), &trigon_io::LoadOptions::default()) {
            for mesh in meshes(&loaded) {
                let count = mesh.vertex_count() as u32;
                prop_assert!((0..mesh.face_count()).all(|face| mesh.face_vertices(face).iter().all(|&vertex| vertex < count)), "indices");
                prop_assert!(mesh.positions().iter().all(|position| position.is_finite()), "positions");
            }
        }
    }
}
