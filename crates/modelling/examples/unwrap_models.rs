//! Unwraps meshes and measures the time: for `tests/peers/blender_unwrap.py`.
//!
//! Reads lines of standard input: an OBJ file of triangles in which `l` lines are seams, a file to write, the number of
//! steps that reduce stretch, and the margin. Writes u and v of each corner of each face to the file, v upwards, and a
//! line of JSON to standard output: the seconds of unwrapping and of packing the result again, and what the operation
//! reports; or the reason of a refusal.

use std::error::Error;
use std::fmt::Write as _;
use std::io::{BufRead, Write};
use std::time::Instant;

use trigon_math::Vec3;
use trigon_mesh::MeshBuilder;
use trigon_modelling::{EditMesh, FaceId, PackSettings, UnwrapSettings, Unwrapped, VertexId};

fn main() -> Result<(), Box<dyn Error>> {
    let mut output = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let [file, result, steps, margin] = words[..] else {
            return Err("two files, steps, a margin".into());
        };
        let mut mesh = read(file)?;
        let settings = UnwrapSettings {
            minimize_stretch: steps.parse()?,
            margin: margin.parse()?,
            ..UnwrapSettings::default()
        };
        match unwrap(&mut mesh, &settings) {
            Ok(report) => {
                std::fs::write(result, texture_coordinates(&mesh))?;
                writeln!(output, "{report}")?;
            }
            Err(refusal) => writeln!(output, r#"{{"refusal": {:?}}}"#, refusal.to_string())?,
        }
        output.flush()?;
    }
    Ok(())
}

/// Unwraps all faces, and packs a copy of the result; with what the line of JSON says.
fn unwrap(mesh: &mut EditMesh, settings: &UnwrapSettings) -> Result<String, Box<dyn Error>> {
    let faces: Vec<FaceId> = mesh.faces().collect();
    let start = Instant::now();
    let Unwrapped { islands, not_conformal, turned_over, .. } = mesh.unwrap_faces(&faces, settings)?;
    let seconds = start.elapsed().as_secs_f64();
    let packing = PackSettings { margin: settings.margin, ..PackSettings::default() };
    let mut packed = mesh.clone();
    let start = Instant::now();
    packed.pack_uv_islands(&faces, 0, &packing)?;
    let pack_seconds = start.elapsed().as_secs_f64();
    Ok(format!(
        r#"{{"seconds": {seconds}, "pack_seconds": {pack_seconds}, "islands": {islands}, "not_conformal": {not_conformal}, "turned_over": {turned_over}}}"#
    ))
}

/// The first three numbers of an OBJ line, each before its first slash.
fn numbers<'w, T: std::str::FromStr>(words: impl Iterator<Item = &'w str>) -> Result<Vec<T>, T::Err> {
    words.take(3).map(|word| word.split('/').next().unwrap_or(word).parse()).collect()
}

fn read(path: &str) -> Result<EditMesh, Box<dyn Error>> {
    let mut builder = MeshBuilder::new();
    let mut seams: Vec<[u32; 2]> = Vec::new();
    for line in std::fs::read_to_string(path)?.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                builder.push_vertex(Vec3::from_array(numbers::<f32>(words)?[..].try_into()?));
            }
            Some("f") => {
                let face: Vec<u32> = numbers::<u32>(words)?.into_iter().map(|index| index - 1).collect();
                builder.push_face(&face)?;
            }
            Some("l") => seams.push(numbers::<u32>(words)?[..].try_into()?),
            _ => {}
        }
    }
    let (mut mesh, _) = EditMesh::from_mesh(&builder.build());
    let vertices: Vec<VertexId> = mesh.vertices().collect();
    let edge = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|index| vertices[index as usize - 1]);
        mesh.find_edge(a, b)
    };
    let seams: Vec<_> = seams.iter().filter_map(edge).collect();
    mesh.mark_seams(&seams)?;
    Ok(mesh)
}

fn texture_coordinates(mesh: &EditMesh) -> String {
    let mut text = String::new();
    for corner in mesh.faces().flat_map(|face| mesh.face_corners(face)) {
        let uv = mesh.uv(0, corner).expect("it was unwrapped");
        writeln!(text, "{:?} {:?}", uv.x, 1.0 - f64::from(uv.y)).expect("strings take everything");
    }
    text
}
