//! Reads one large OBJ with our reader or with the `tobj` crate, on one thread, for a profiler
//! to count:
//! `cargo build --release -p trigon-io --example obj_readers`, then
//! `valgrind --tool=callgrind target/release/examples/obj_readers tobj`, and the same with
//! `trigon`.
//!
//! The text is a grid of triangles with texture coordinates and normals, 707 squares a side
//! unless a second argument says so: a million triangles. `none` makes the text and reads
//! nothing, to be taken off.

#![expect(clippy::print_stdout, reason = "printing is what this example is for")]

use std::error::Error;
use std::fmt::Write;
use std::num::NonZeroUsize;

use trigon_io::{LoadOptions, load_from_slice};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let reader = arguments.next().unwrap_or_default();
    let side = arguments.next().map_or(Ok(707), |side| side.parse())?;
    let text = grid(side)?;
    let triangles = match reader.as_str() {
        "trigon" => {
            let options = LoadOptions { threads: NonZeroUsize::new(1), ..LoadOptions::default() };
            let loaded = load_from_slice("grid.obj", text.as_bytes(), &options)?;
            loaded.scene.meshes().iter().map(|(_, asset)| asset.mesh().face_count()).sum()
        }
        "tobj" => {
            let options = tobj::LoadOptions::default();
            let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default()))?;
            models.iter().map(|model| model.mesh.indices.len() / 3).sum::<usize>()
        }
        "none" => 0,
        _ => return Err("name a reader: trigon, tobj or none".into()),
    };
    println!("{} bytes, {triangles} triangles", text.len());
    Ok(())
}

/// A wavy square of two triangles for each of its squares.
fn grid(side: usize) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let each = || (0..=side).flat_map(|row| (0..=side).map(move |column| (row, column)));
    for (row, column) in each() {
        let height = (row * 7919 + column * 104_729) % 1000;
        writeln!(text, "v {}.{:03} 0.{height:03} -{}.5", column, height / 2, row)?;
    }
    for (row, column) in each() {
        writeln!(text, "vt {:.6} {:.6}", column as f64 / side as f64, row as f64 / side as f64)?;
    }
    for (row, column) in each() {
        writeln!(text, "vn 0.{:04} 0.9 -0.{:04}", (row * 31) % 10_000, (column * 17) % 10_000)?;
    }
    for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
        let [a, b] = [row * (side + 1) + column + 1, (row + 1) * (side + 1) + column + 1];
        let corner = |index: usize| format!("{index}/{index}/{index}");
        writeln!(text, "f {} {} {}", corner(a), corner(a + 1), corner(b + 1))?;
        writeln!(text, "f {} {} {}", corner(a), corner(b + 1), corner(b))?;
    }
    Ok(text)
}
