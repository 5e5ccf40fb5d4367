//! A model file becomes an image file: the whole program.
//!
//! `cargo run --release -p trigon-io --example image -- model.glb image.png`

use trigon_io::{LoadOptions, Pixels, load, write_png};
use trigon_scene::{RenderSettings, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(model), Some(image)) = (arguments.next(), arguments.next()) else {
        return Err("say which model and which image: image MODEL IMAGE.png".into());
    };
    let scene = load(model, &LoadOptions::default())?.scene;
    let settings = RenderSettings::new(800, 600);
    let frame = render(&scene, &scene.overview(settings.aspect()), &settings)?;
    write_png(image, frame.width, frame.height, Pixels::Rgba8(&frame.color))?;
    Ok(())
}
