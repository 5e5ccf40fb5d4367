//! Reduces meshes to a number of triangles and measures the time: for `tests/peers/blender_reduction.py`.
//!
//! Reads lines of standard input: an OBJ file, of which only `v` and `f` are read, the number of triangles to leave, and
//! the OBJ file to write. For each it writes a line of JSON: the seconds of the operation itself, and how many triangles
//! are left.

mod common;

use std::error::Error;
use std::fmt::Write as _;
use std::io::{BufRead, Write};
use std::time::Instant;

use trigon_math::Vec3;
use trigon_modelling::{DecimateGoal, DecimateSettings, EditMesh, FaceId};

use common::read;

fn main() -> Result<(), Box<dyn Error>> {
    let mut output = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let [from, count, to] = words[..] else { return Err("a file, a number and a file".into()) };
        let mut mesh = read(from)?;
        let settings =
            DecimateSettings { goal: DecimateGoal::Faces, faces: count.parse()?, ..Default::default() };
        let faces: Vec<FaceId> = mesh.faces().collect();
        let start = Instant::now();
        mesh.decimate(&faces, &settings)?;
        let seconds = start.elapsed().as_secs_f64();
        std::fs::write(to, text(&mesh))?;
        writeln!(output, r#"{{"seconds": {seconds}, "faces": {}}}"#, mesh.face_count())?;
        output.flush()?;
    }
    Ok(())
}

fn text(mesh: &EditMesh) -> String {
    let (mesh, _) = mesh.to_mesh();
    let mut text = String::new();
    for Vec3 { x, y, z } in mesh.positions() {
        writeln!(text, "v {x} {y} {z}").expect("strings take all");
    }
    for face in 0..mesh.face_count() {
        let corners: Vec<String> =
            mesh.face_vertices(face).iter().map(|index| (index + 1).to_string()).collect();
        writeln!(text, "f {}", corners.join(" ")).expect("strings take all");
    }
    text
}
