//! Three objects, and who is seen where: colours say what an image looks like,
//! ids say what it shows. Prints the image as text, one letter an object.
//!
//! `cargo run --release -p trigon-scene --example who_is_where`

#![allow(clippy::print_stdout, reason = "the terminal is the image here")]

use trigon_scene::math::{DVec3, Vec3};
use trigon_scene::mesh::primitives;
use trigon_scene::{Material, Outputs, RenderError, RenderSettings, Scene, render};

fn main() -> Result<(), RenderError> {
    let mut scene = Scene::new();
    let color = |r, g, b| Material::from_color(Vec3::new(r, g, b));
    scene.add_object("teapot", primitives::teapot(6), color(0.7, 0.2, 0.1));
    let ball = scene.add_object("ball", primitives::uv_sphere(0.8, 32, 16), color(0.1, 0.2, 0.7));
    let cube = scene.add_object("cube", primitives::cube(1.2), color(0.2, 0.6, 0.2));
    for (node, at) in [(ball, DVec3::new(2.4, 0.8, 1.6)), (cube, DVec3::new(-2.4, 0.6, 1.4))] {
        if let Some(node) = scene.node_mut(node) {
            node.transform.translate(at);
        }
    }

    let outputs = Outputs { ids: true, ..Outputs::default() };
    let settings = RenderSettings { outputs, ..RenderSettings::new(76, 36) };
    let frame = render(&scene, &scene.overview(settings.aspect()), &settings)?;
    for y in 0..frame.height {
        let letter = |x| {
            let hit = frame.hit(scene.nodes(), x, y)?;
            scene.node(hit.node)?.name.chars().next()
        };
        println!("{}", (0..frame.width).map(|x| letter(x).unwrap_or('.')).collect::<String>());
    }
    Ok(())
}
