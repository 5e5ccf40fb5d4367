//! A data set from a model: images from all around and above, each with depth, normals
//! and ids as NumPy arrays, and the cameras that took them.
//!
//! `cargo run --release -p trigon-io --example data_set -- FOLDER [MODEL [COUNT [SEED]]]`
//!
//! The same arguments give the same files on every machine.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use trigon_io::{LoadOptions, Output, Pixels, load, write_npy, write_png};
use trigon_scene::camera::Camera;
use trigon_scene::{Outputs, Renderer, showcase, views};

/// What is written of each view.
const HELD: [Output; 4] = [Output::Depth, Output::Normals, Output::ObjectIds, Output::FaceIds];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("say where: data_set FOLDER [MODEL [COUNT [SEED]]]")?);
    let scene = match arguments.next() {
        Some(model) => load(model, &LoadOptions::default())?.scene,
        None => showcase(),
    };
    let count: usize = arguments.next().map_or(Ok(12), |count| count.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(0), |seed| seed.parse())?;
    fs::create_dir_all(&folder)?;

    let mut outputs = Outputs::default();
    HELD.into_iter().for_each(|output| output.ask_for(&mut outputs));
    let mut renderer = Renderer::builder().size(256, 256).samples(8).outputs(outputs).build();
    let viewpoints = views::hemisphere(count, seed);
    let cameras: Vec<Camera> = scene.surround(viewpoints, renderer.settings().aspect()).collect();
    renderer.render_many(&scene, cameras.iter().copied(), |number, frame| {
        let name = |ending: &str| folder.join(format!("{number:04}.{ending}"));
        write_png(name("png"), frame.width, frame.height, Pixels::Rgba8(&frame.color))?;
        for output in HELD {
            write_npy(name(&format!("{output}.npy")), frame, output)?;
        }
        Ok::<(), Box<dyn Error>>(())
    })?;
    fs::write(folder.join("cameras.csv"), table(&cameras)?)?;
    Ok(())
}

/// A row for each camera: its number, where it stands in metres, and the unit
/// quaternion that turns its axes (x right, y up, looking along −z) into the world's.
fn table(cameras: &[Camera]) -> Result<String, std::fmt::Error> {
    let mut table = "number,x,y,z,qx,qy,qz,qw\n".to_owned();
    for (number, Camera { position, orientation: turn, .. }) in cameras.iter().enumerate() {
        let [x, y, z] = position.to_array();
        writeln!(table, "{number},{x},{y},{z},{},{},{},{}", turn.x, turn.y, turn.z, turn.w)?;
    }
    Ok(table)
}
