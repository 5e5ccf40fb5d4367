//! How the cost of a frame grows, with triangles and with pixels, as a table and as plots:
//!
//! `cargo run --release -p trigon-study --example growth -- --svg docs/images`

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use clap::Parser;
use std::error::Error;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use trigon_math::UVec2;
use trigon_raster::{ExecuteSettings, Rasterizer};
use trigon_scene::quality::plot::{BLUE, GREY, LegendEntry, LegendMark, Plot, PlotLine};
use trigon_study::workloads::{Canvas, Grid, Scene, Shading, Timings};

/// Draw a torus of ever more triangles and a knot on ever more pixels.
#[derive(Parser)]
struct Arguments {
    /// How many threads to draw with
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZeroUsize,
    /// The most triangles
    #[arg(long, value_name = "N", default_value = "50000000")]
    triangles: u32,
    /// The most pixels in a row
    #[arg(long, value_name = "N", default_value = "16384")]
    side: u32,
    /// Save plots in this folder
    #[arg(long, value_name = "FOLDER")]
    svg: Option<PathBuf>,
}

/// What is varied, and how long frames take.
struct Growth {
    name: &'static str,
    /// What the horizontal axis counts.
    unit: &'static str,
    /// (count, milliseconds).
    points: Vec<(f64, f64)>,
}

impl Growth {
    fn new(name: &'static str, unit: &'static str) -> Self {
        println!("{name}: {unit}, ms, ns for each");
        Self { name, unit, points: Vec::new() }
    }

    fn push(&mut self, count: f64, milliseconds: f64) {
        println!("{count:.0}, {milliseconds:.3}, {:.2}", milliseconds * 1e6 / count);
        self.points.push((count, milliseconds));
    }

    /// A plot with logarithmic axes, and the line of a cost that is proportional to
    /// the count.
    fn save(&self, folder: &Path) -> Result<(), Box<dyn Error>> {
        fs::create_dir_all(folder)?;
        let points: Vec<[f64; 2]> = self.points.iter().map(|&(count, time)| [count, time]).collect();
        let [first, last] = [points[0], points[points.len() - 1]];
        let proportional = vec![[first[0], last[1] / last[0] * first[0]], last];
        let entry =
            |text: &str, color| LegendEntry { text: text.to_owned(), mark: LegendMark::Line(color, 1) };
        let plot = Plot {
            title: format!("Time of a frame by {}", self.unit),
            axes: [self.unit, "ms"].map(str::to_owned),
            lines: vec![
                PlotLine { points: proportional, color: GREY, width: 1, disc: 0 },
                PlotLine { points, color: BLUE, width: 1, disc: 3 },
            ],
            legend: vec![entry("proportional", GREY), entry("measured", BLUE)],
            ..Plot::default()
        };
        Ok(fs::write(folder.join(format!("growth-{}.svg", self.name)), plot.to_svg())?)
    }
}

/// How many frames are timed of images that take long.
const LARGE: usize = 5;

/// The median time of a frame in milliseconds.
fn frame_time(scene: &Scene, threads: Option<NonZeroUsize>, frames: usize) -> Result<f64, Box<dyn Error>> {
    let settings = ExecuteSettings { threads, ..Default::default() };
    let mut pixels = vec![[0; 4]; scene.pixel_count()];
    let mut canvas = Canvas::new(Rasterizer::new(settings)?, scene, &mut pixels)?;
    Ok(Timings::of_frames(frames, || canvas.draw(scene)).median())
}

/// W2 with other numbers of triangles.
fn by_triangles(arguments: &Arguments) -> Result<Growth, Box<dyn Error>> {
    let mut growth = Growth::new("triangles", "triangles");
    let most = f64::from(arguments.triangles);
    let steps = [1e4, 1e5, 1e6, 1e7].into_iter().flat_map(|power| [power, 2.0 * power, 5.0 * power]);
    for wanted in steps.take_while(|&count| count <= most) {
        // Twice as many quads along the ring as around it, as in W2.
        let around = (wanted / 4.0).sqrt().round() as u32;
        let scene = Scene::torus(Grid { along: 2 * around, around });
        growth.push(scene.mesh.triangles.len() as f64, frame_time(&scene, Some(arguments.threads), LARGE)?);
    }
    Ok(growth)
}

/// W3 on other numbers of pixels.
fn by_pixels(arguments: &Arguments) -> Result<Growth, Box<dyn Error>> {
    let mut growth = Growth::new("pixels", "pixels of the image");
    let mut scene = Scene::knot(Shading::BlinnPhong);
    let mut side = 256;
    while side <= arguments.side {
        scene.size = UVec2::splat(side);
        growth.push(scene.pixel_count() as f64, frame_time(&scene, Some(arguments.threads), LARGE)?);
        side *= 2;
    }
    Ok(growth)
}

/// An image of 200 by 200 pixels of a small model, with one thread and with two: too
/// little to do is no reason to be slower.
fn small_images() -> Result<(), Box<dyn Error>> {
    const FRAMES: usize = 500;
    println!("200×200 pixels: triangles, ms with one thread, ms with two");
    for around in [16, 50, 160] {
        let mut scene = Scene::torus(Grid { along: 2 * around, around });
        scene.size = UVec2::splat(200);
        let [one, two] = [1, 2].map(|threads| frame_time(&scene, NonZeroUsize::new(threads), FRAMES));
        println!("{}, {:.3}, {:.3}", scene.mesh.triangles.len(), one?, two?);
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    for growth in [by_triangles(&arguments)?, by_pixels(&arguments)?] {
        if let Some(folder) = &arguments.svg {
            growth.save(folder)?;
        }
    }
    small_images()
}
