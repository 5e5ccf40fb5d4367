//! What the `tobj` crate makes of files where it is wrong, and what we make of them: the
//! reasons why it is an oracle of the tests (`oracle`) and not the reader.
//!
//! A layer over it would have to write nearly every line anew before it reads it, as ours
//! did at first: errors have no line, and a file is refused as a whole.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use tobj::LoadError;
use trigon_io::{LoadOptions, Loaded, load};
use trigon_math::{Vec2, Vec4};

use crate::{loaded, meshes, refused, warnings, warns_once};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// The first model that tobj finds. Polygons stay polygons.
fn theirs(text: &[u8]) -> Result<tobj::Mesh, LoadError> {
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut &*text, &options, |_| Ok(Default::default()))?;
    Ok(models.into_iter().next().expect("there is always one").mesh)
}

fn ours(text: &[u8]) -> Loaded {
    loaded("a.obj", text)
}

fn their_materials(text: &str) -> tobj::MTLLoadResult {
    tobj::load_mtl_buf(&mut text.as_bytes())
}

/// A model of one triangle in the material `m` of a library.
fn our_material(library: &str) -> Loaded {
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::write(dir.path().join("a.mtl"), library).expect("a file");
    let path = dir.path().join("a.obj");
    std::fs::write(&path, format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3\n")).expect("a file");
    load(path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn tobj_refuses_a_file_for_one_byte_of_a_comment() {
    let text = [b"# caf\xe9\n", SQUARE.as_bytes(), b"f 1 2 3\n"].concat();
    assert_eq!(theirs(&text).err(), Some(LoadError::ReadError), "theirs");
    assert_eq!(warnings(&ours(&text)), [""; 0], "ours");
}

/// Many exporters break long lines, put comments behind statements, or write tabs.
#[test]
fn tobj_refuses_what_exporters_write() {
    for (what, line, error) in [
        ("a continued line", "f 1 2 \\\n3", LoadError::FaceParseError),
        ("a comment at the end", "f 1 2 3 # end", LoadError::FaceParseError),
        ("a tab before a name", "usemtl\tred\nf 1 2 3", LoadError::MaterialParseError),
        ("one texture coordinate", "vt 0.5\nf 1/1 2/1 3/1", LoadError::TexcoordParseError),
    ] {
        let text = format!("{SQUARE}{line}\n");
        assert_eq!(theirs(text.as_bytes()).err(), Some(error), "theirs: {what}");
        assert_eq!(meshes(&ours(text.as_bytes()))[0].face_count(), 1, "ours: {what}");
    }
}

#[test]
fn tobj_names_no_line() {
    let text = format!("{SQUARE}f 1 2 9\n");
    let error = theirs(text.as_bytes()).expect_err("no such vertex");
    assert_eq!(error.to_string(), "face vertex index out of bounds", "theirs");
    let ours = refused("a.obj", text.as_bytes());
    assert!(
        ours.starts_with("a.obj, line 5: face index \"9\" does not exist; the file has 4 vertices"),
        "{ours}"
    );
}

/// What is not finite spoils bounds, cameras and every triangle at that vertex.
#[test]
fn tobj_keeps_vertices_that_are_not_finite() {
    let text = format!("{SQUARE}v nan 1e400 0\nf 1 2 3\nf 1 2 5\n");
    let theirs = theirs(text.as_bytes()).expect("theirs");
    assert!(theirs.positions.iter().any(|value| !value.is_finite()), "theirs");
    let ours = ours(text.as_bytes());
    assert_eq!(meshes(&ours)[0].face_count(), 1, "ours");
    warns_once(&ours, "a.obj, line 5: ");
}

#[test]
fn tobj_takes_polylines_for_polygons_and_loses_points() {
    let text = format!("{SQUARE}l 1 2 3\np 4\n");
    let theirs = theirs(text.as_bytes()).expect("theirs");
    assert_eq!(theirs.indices, [0, 1, 2], "one triangle, and no point");
    assert_eq!(theirs.face_arities, [0; 0], "nothing tells it from a face");
    let ours = ours(text.as_bytes());
    let mesh = meshes(&ours)[0];
    assert_eq!((mesh.face_count(), mesh.loose_edges().len(), mesh.loose_points().len()), (0, 2, 1), "ours");
}

/// And nothing says which corners had one.
#[test]
fn tobj_repeats_the_last_coordinate_where_a_corner_has_none() {
    let text = format!("{SQUARE}vt 0.25 0.25\nvt 0.75 0.75\nf 1 2/2 3\nf 1/1 3 4\n");
    let theirs = theirs(text.as_bytes()).expect("theirs");
    let read: Vec<f64> =
        theirs.texcoord_indices.iter().map(|&index| theirs.texcoords[2 * index as usize]).collect();
    assert_eq!(read, [0.25, 0.75, 0.75, 0.25, 0.25, 0.25], "two of the file, four made up");
    let ours = ours(text.as_bytes());
    let expected =
        [Vec2::ZERO, Vec2::new(0.75, 0.25), Vec2::ZERO, Vec2::new(0.25, 0.75), Vec2::ZERO, Vec2::ZERO];
    assert_eq!(meshes(&ours)[0].attributes().uv_sets, [expected], "ours");
}

/// An index of 0, or of one before the first, is the number that means "none" to it.
#[test]
fn tobj_takes_wrong_coordinate_indices_for_none() {
    let text = |index: &str| format!("{SQUARE}vt 0.25 0.25\nvt 0.75 0.75\nf 1/2 2/{index} 3/2\n");
    for index in ["0", "-3"] {
        let theirs = theirs(text(index).as_bytes()).expect("theirs");
        assert_eq!(theirs.texcoord_indices, [0; 3], "theirs repeats the one before: {index}");
    }
    assert!(refused("a.obj", text("0").as_bytes()).starts_with("a.obj, line 7: "), "ours");
    warns_once(
        &ours(text("-3").as_bytes()),
        "a.obj, line 7: a texture coordinate or normal index does not exist",
    );
}

/// In release builds the product wraps around, and the file is refused.
#[test]
fn tobj_overflows_on_an_index_far_before_the_first() {
    let text = format!("{SQUARE}vt 0.25 0.25\nf 1/-9 2/1 3/1\n");
    let read = catch_unwind(AssertUnwindSafe(|| theirs(text.as_bytes()).err()));
    if cfg!(debug_assertions) {
        assert!(read.is_err(), "theirs panics");
    } else {
        assert_eq!(read.ok(), Some(Some(LoadError::FaceTexCoordOutOfBounds)), "theirs");
    }
    warns_once(&ours(text.as_bytes()), "a.obj, line 6: a texture coordinate or normal index does not exist");
}

#[test]
fn tobj_gives_colours_to_the_wrong_vertices() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
    // Two colours are there, and the third vertex asks for a third one.
    assert_eq!(theirs(text.as_bytes()).err(), Some(LoadError::FaceColorOutOfBounds), "theirs");
    let text = text.replace("f 1 2 3", "l 1 2");
    let theirs = theirs(text.as_bytes()).expect("theirs");
    assert_eq!(theirs.vertex_color, [1.0, 0.0, 0.0, 0.0, 0.0, 1.0], "red and blue, and both have none");
    let text = text.replace("l 1 2", "f 1 2 3");
    let ours = ours(text.as_bytes());
    let colors = meshes(&ours)[0].attributes().corner_colors.clone().expect("colours");
    assert_eq!(colors, [Vec4::ONE, Vec4::ONE, Vec4::new(1.0, 0.0, 0.0, 1.0)], "ours");
}

/// It wants three numbers without asking how many there are.
#[test]
fn tobj_panics_on_a_grey_material() {
    let library = "newmtl m\nKd 0.5\n";
    assert!(catch_unwind(|| their_materials(library)).is_err(), "theirs");
    let ours = our_material(library);
    let (_, material) = ours.scene.materials.iter().next().expect("a material");
    assert_eq!((material.name.as_str(), warnings(&ours)), ("m", Vec::new()), "one number is grey");
}

#[test]
fn tobj_refuses_a_library_for_one_statement() {
    for statement in ["Ns", "illum two", "map_Kd", "d -halo 0.5", "newmtl"] {
        let library = format!("newmtl m\nKd 1 0 0\n{statement}\n");
        assert!(their_materials(&library).is_err(), "theirs: {statement}");
        let ours = our_material(&library);
        let (_, material) = ours.scene.materials.iter().next().expect("a material");
        assert_eq!(material.name, "m", "ours: {statement}");
    }
}

/// Physically-based numbers, `Tr` and most textures are strings by their name to it, and the
/// options of a texture are part of its file's name.
#[test]
fn tobj_leaves_most_of_a_library_unread() {
    let library = "newmtl m\nPr 0.25\nPm 1\nTr 0.5\nmap_Ke e.png\nnorm n.png\nmap_Kd -s 2 2 1 my wood.png\n";
    let (materials, _) = their_materials(library).expect("theirs");
    let mut unread: Vec<&str> = materials[0].unknown_param.keys().map(String::as_str).collect();
    unread.sort_unstable();
    assert_eq!(unread, ["Pm", "Pr", "Tr", "map_Ke", "norm"], "theirs");
    assert_eq!(materials[0].diffuse_texture.as_deref(), Some("-s 2 2 1 my wood.png"), "theirs");
    assert!(
        warnings(&our_material(library)).iter().any(|warning| warning.contains("\"my wood.png\"")),
        "ours looks for the file itself"
    );
}

/// Several libraries in one line are one name to it.
#[test]
fn tobj_asks_for_one_library_a_line() {
    let text = format!("mtllib a.mtl b.mtl\n{SQUARE}f 1 2 3\n");
    let asked = std::cell::RefCell::new(Vec::new());
    let options = tobj::LoadOptions::default();
    let note = |name: &Path| {
        asked.borrow_mut().push(name.to_owned());
        Ok(Default::default())
    };
    let read = tobj::load_obj_buf(&mut text.as_bytes(), &options, note);
    assert!(read.is_ok(), "theirs");
    assert_eq!(asked.into_inner(), [Path::new("a.mtl b.mtl")], "theirs");
    let ours = ours(text.as_bytes());
    assert_eq!(
        warnings(&ours).iter().filter(|warning| warning.contains("material library")).count(),
        2,
        "ours"
    );
}
