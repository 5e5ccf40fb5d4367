//! What coarser meshes save in the images that show while something moves: drafts of scenes with millions of triangles, as
//! they were and with coarser meshes, in turns.
//!
//! `cargo bench -p trigon-study --bench drafts -- --millions 5,20`

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use clap::Parser;
use std::time::Instant;
use trigon_mesh::primitives;
use trigon_scene::math::DVec3;
use trigon_scene::{Material, Outputs, RenderError, RenderSettings, Renderer, Scene};

/// Draw drafts of rings, and print the medians of their times.
#[derive(Parser)]
struct Arguments {
    /// How many million triangles the scenes have
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "5,20")]
    millions: Vec<u32>,
    /// About how many triangles the coarser meshes have together
    #[arg(long, value_name = "N", default_value = "1000000")]
    most: usize,
    /// How many drafts of each kind
    #[arg(long, value_name = "N", default_value = "15")]
    rounds: usize,
    /// Cargo passes it to every bench
    #[arg(long, hide = true)]
    bench: bool,
}

/// The largest and the smallest drafts of a window of 1920×1080.
const SIZES: [[u32; 2]; 2] = [[1920, 1080], [480, 270]];

/// Four rings of one size.
fn rings(millions: u32) -> Scene {
    let mut scene = Scene::new();
    let around = (f64::from(millions) * 1e6 / 16.0).sqrt().round() as u32;
    for part in 0..4 {
        let mesh = primitives::torus(1.0, 0.3 + 0.02 * part as f32, 2 * around, around);
        let node = scene.add_object("ring", mesh, Material::default());
        let at = DVec3::new(f64::from(part % 2), 0.2 * f64::from(part), f64::from(part / 2)) * 2.0;
        if let Some(node) = scene.node_mut(node) {
            node.transform.translate(at);
        }
    }
    scene
}

/// The median times of drafts in milliseconds.
struct Medians {
    whole: f64,
    coarse: f64,
    /// The triangles of a draft with coarser meshes.
    triangles: u64,
}

/// Draws drafts of both kinds in turns.
fn drafts(scene: &Scene, [width, height]: [u32; 2], rounds: usize) -> Result<Medians, RenderError> {
    let outputs = Outputs { depth: true, ..Outputs::default() };
    let settings = RenderSettings { samples_per_axis: 1, outputs, ..RenderSettings::new(width, height) };
    let camera = scene.overview(settings.aspect());
    let mut coarse = Renderer::new(settings.clone());
    let outputs = Outputs { ids: true, ..outputs };
    let mut whole = Renderer::new(RenderSettings { outputs, ..settings });
    let mut times: [Vec<f64>; 2] = Default::default();
    // The first ones make what the others use.
    for round in 0..=rounds {
        let begun = Instant::now();
        whole.render_shared(scene, &camera, None)?;
        let between = Instant::now();
        coarse.render_draft(scene, &camera, None)?;
        if round > 0 {
            times[0].push((between - begun).as_secs_f64() * 1e3);
            times[1].push(between.elapsed().as_secs_f64() * 1e3);
        }
    }
    let triangles = coarse.stats().primitives;
    let [whole, coarse] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    Ok(Medians { whole, coarse, triangles })
}

fn main() -> Result<(), RenderError> {
    let arguments = Arguments::parse();
    println!("million triangles, size, ms as they were, ms with coarser meshes, triangles of these");
    for &millions in &arguments.millions {
        let scene = rings(millions);
        let begun = Instant::now();
        if let Some(work) = scene.coarse_mesh_work(arguments.most) {
            work.run();
        }
        println!("made in {:.1} s", begun.elapsed().as_secs_f64());
        for size in SIZES {
            let Medians { whole, coarse, triangles } = drafts(&scene, size, arguments.rounds.max(1))?;
            let [width, height] = size;
            println!("{millions}, {width}x{height}, {whole:.1}, {coarse:.1}, {triangles}");
        }
    }
    Ok(())
}
