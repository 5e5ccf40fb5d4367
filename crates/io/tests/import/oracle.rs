//! Our OBJ reader against tobj, where tobj reads what the file says: not for corners
//! without a texture coordinate or normal in files that have some (tobj repeats the
//! one before), polylines (polygons to tobj) and points (nothing to it).

use std::path::Path;

use proptest::prelude::*;
use trigon_io::{LoadOptions, Loaded};
use trigon_math::{DVec3, Vec3};

/// The numbers of a corner, to the bit: position, texture coordinate, normal,
/// colour. No normal and one that is zero are the same.
pub(crate) type Corner = [Vec<u32>; 4];

fn bits<const N: usize>(values: [f32; N]) -> Vec<u32> {
    // The two zeros are one: v is turned by subtracting it from 1.
    values.map(|value| (value + 0.0).to_bits()).to_vec()
}

/// All faces of a scene, sorted: nodes order them by group.
pub(crate) fn faces_of_scene(loaded: &Loaded) -> Vec<Vec<Corner>> {
    let mut faces = Vec::new();
    for (_, node) in loaded.scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| loaded.scene.meshes().get(mesh)) else { continue };
        let (mesh, offset) = (asset.mesh(), node.transform.translation());
        let attributes = mesh.attributes();
        let corner = |corner: usize| {
            let position = mesh.positions()[mesh.corner_vertices()[corner] as usize].as_dvec3() + offset;
            let coordinate = attributes.uv_sets.first().map(|set| bits(set[corner].to_array()));
            let normal = attributes.corner_normals.as_ref().map_or(Vec3::ZERO, |normals| normals[corner]);
            let color = attributes.corner_colors.as_ref().map(|colors| bits(colors[corner].to_array()));
            [
                bits(position.as_vec3().to_array()),
                coordinate.unwrap_or_default(),
                bits(normal.to_array()),
                color.unwrap_or_default(),
            ]
        };
        faces.extend(mesh.faces().map(|corners| corners.map(corner).collect::<Vec<_>>()));
    }
    faces.sort();
    faces
}

/// All faces that tobj finds, but for those that we leave out with a warning: with a
/// vertex that is not finite, or without three different ones.
pub(crate) fn faces_of_tobj(text: &[u8]) -> Result<Vec<Vec<Corner>>, tobj::LoadError> {
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut &*text, &options, |_| Ok(Default::default()))?;
    let mut faces = Vec::new();
    for mesh in models.iter().map(|model| &model.mesh) {
        let mut start = 0;
        let arity = |face: usize| mesh.face_arities.get(face).map_or(3, |&arity| arity as usize);
        for face in 0.. {
            let corners = start..start + arity(face);
            let Some(vertices) = mesh.indices.get(corners.clone()) else { break };
            start = corners.end;
            let mut distinct = vertices.to_vec();
            distinct.sort_unstable();
            distinct.dedup();
            let is_finite = |&vertex: &u32| {
                let place = 3 * vertex as usize;
                mesh.positions[place..place + 3].iter().all(|value| value.is_finite())
            };
            if distinct.len() >= 3 && distinct.iter().all(is_finite) {
                faces.push(corners.map(|corner| corner_of_tobj(mesh, corner)).collect());
            }
        }
    }
    faces.sort();
    Ok(faces)
}

fn corner_of_tobj(mesh: &tobj::Mesh, corner: usize) -> Corner {
    let color = |value: f64| match value.is_finite() {
        true => trigon_math::color::srgb_to_linear(value.clamp(0.0, 1.0) as f32),
        false => 1.0,
    };
    let vertex = 3 * mesh.indices[corner] as usize;
    let position = DVec3::from_slice(&mesh.positions[vertex..]).as_vec3();
    let coordinate = mesh.texcoord_indices.get(corner).map(|&index| {
        let [u, v] = [0, 1].map(|axis| mesh.texcoords[2 * index as usize + axis]);
        bits([u as f32, (1.0 - v) as f32])
    });
    let normal = |&index: &u32| DVec3::from_slice(&mesh.normals[3 * index as usize..]).as_vec3();
    let normal = mesh.normal_indices.get(corner).map_or(Vec3::ZERO, normal);
    let colors = (!mesh.vertex_color.is_empty()).then(|| {
        let [red, green, blue] = [0, 1, 2].map(|channel| color(mesh.vertex_color[vertex + channel]));
        bits([red, green, blue, 1.0])
    });
    [
        bits(position.to_array()),
        coordinate.unwrap_or_default(),
        bits(normal.to_array()),
        colors.unwrap_or_default(),
    ]
}

/// A block of a file: vertices, then faces of them and of what came before.
#[derive(Clone, Debug)]
struct Block {
    statement: String,
    numbers: Vec<[String; 6]>,
    /// Of each corner a number to choose by, and whether to count backwards.
    faces: Vec<Vec<(prop::sample::Index, bool)>>,
}

fn block() -> impl Strategy<Value = Block> {
    let number = prop_oneof!["-?[0-9]{1,3}", "-?[0-9]{0,3}\\.[0-9]{1,17}", "-?[0-9]\\.[0-9]{0,5}e[+-]?[0-9]"];
    let statement = "(g|o|usemtl|#| *) [a-c1-3]{1,2}";
    let corner = (any::<prop::sample::Index>(), any::<bool>());
    (
        statement,
        prop::collection::vec(prop::array::uniform6(number), 3..8),
        prop::collection::vec(prop::collection::vec(corner, 3..7), 0..6),
    )
        .prop_map(|(statement, numbers, faces)| Block { statement, numbers, faces })
}

/// The blocks as text; the three switches say what its vertices have besides a
/// place.
fn spell(blocks: &[Block], [coordinates, normals, colors]: [bool; 3], ending: &str) -> String {
    let (mut text, mut count) = (String::new(), 0);
    for block in blocks {
        for [x, y, z, a, b, c] in &block.numbers {
            let color = if colors { format!(" {a} {b} {c}") } else { String::new() };
            text += &format!("v {x}  {y}\t{z}{color}{ending}");
            text += &if coordinates { format!("vt {a} {b}{ending}") } else { String::new() };
            text += &if normals { format!(" vn {c} {a} {x} {ending}") } else { String::new() };
        }
        count += block.numbers.len();
        text += &format!("{}{ending}", block.statement);
        for face in &block.faces {
            text += "f";
            for (choice, backward) in face {
                let index = choice.index(count) as i64;
                let index = if *backward { index - count as i64 } else { index + 1 };
                text += &match (coordinates, normals) {
                    (false, false) => format!(" {index}"),
                    (true, false) => format!(" {index}/{index}"),
                    (false, true) => format!(" {index}//{index}"),
                    (true, true) => format!(" {index}/{index}/{index}"),
                };
            }
            text += ending;
        }
    }
    text
}

proptest! {
    #[test]
    fn every_face_is_what_tobj_reads(
        blocks in prop::collection::vec(block(), 1..6),
        has in any::<[bool; 3]>(),
        ending in prop::sample::select(vec!["\n", "\r\n"]),
    ) {
        let text = spell(&blocks, has, ending);
        let expected = faces_of_tobj(text.as_bytes()).expect("tobj reads such text");
        match trigon_io::load_from_slice("a.obj", text.as_bytes(), &LoadOptions::default()) {
            Ok(loaded) => prop_assert_eq!(faces_of_scene(&loaded), expected, "{}", text),
            Err(error) => prop_assert!(expected.is_empty(), "{}", error),
        }
    }
}

/// The files of the project's corpus that both read.
#[test]
fn files_are_what_tobj_reads() {
    let mut compared = 0;
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus/obj");
    for entry in std::fs::read_dir(corpus).expect("the corpus").flatten() {
        let bytes = std::fs::read(entry.path()).expect("a file");
        let loaded = trigon_io::load_from_slice("a.obj", &bytes, &LoadOptions::default());
        if let (Ok(expected), Ok(loaded)) = (faces_of_tobj(&bytes), loaded) {
            compared += 1;
            assert_eq!(faces_of_scene(&loaded), expected, "{}", entry.path().display());
        }
    }
    assert!(compared >= 3, "the corpus is there: {compared} files");
}
