//! Times the workloads, or saves their images:
//!
//! `cargo run --release -p trigon-study --example workloads -- --csv --threads 1,2 W2 W3`

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use clap::Parser;
use image::ExtendedColorType;
use std::error::Error;
use std::fs::{self, File};
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use trigon_raster::simd::SimdLevel;
use trigon_raster::{DepthTest, ExecuteSettings, Rasterizer, StageTimes, TileSize};
use trigon_scene::quality::Preset;
use trigon_study::workloads::{Canvas, Scene, Timings, Workload};

/// Draw the workloads over and over, and print how long a frame takes.
#[derive(Parser)]
struct Arguments {
    /// Print comma-separated values instead of a table
    #[arg(long)]
    csv: bool,
    /// Numbers of threads to draw with, one after the other
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1")]
    threads: Vec<NonZeroUsize>,
    /// Draw with these instructions: scalar, sse2, avx2, avx512 or neon; the best, unless given
    #[arg(long, value_name = "LEVEL")]
    simd: Option<SimdLevel>,
    /// Cut the image into squares of 8, 16, 32 or 64 pixels
    #[arg(long, value_name = "PIXELS", value_parser = tile_size)]
    tile: Option<TileSize>,
    /// Draw with the samples of this preset: draft, standard, high or reference; with those of the workload, unless given
    #[arg(long, value_name = "PRESET")]
    preset: Option<Preset>,
    /// Test depth at every sample, leaving nothing out as a whole
    #[arg(long)]
    late: bool,
    /// How many frames to time
    #[arg(long, value_name = "N", default_value = "12")]
    repetitions: usize,
    /// Draw exactly this many frames first, whatever they take: to count instructions, as the difference of two runs
    #[arg(long, value_name = "N")]
    warm_up: Option<usize>,
    /// Tell how long each stage of a frame takes, too
    #[arg(long)]
    stages: bool,
    /// Save the images in this folder
    #[arg(long, value_name = "FOLDER")]
    png: Option<PathBuf>,
    /// Append each frame's time to this file, to pool several runs
    #[arg(long, value_name = "FILE")]
    samples: Option<PathBuf>,
    /// The workloads whose names begin so; all, unless given
    #[arg(value_name = "WORKLOAD")]
    workloads: Vec<String>,
}

fn tile_size(pixels: &str) -> Result<TileSize, &'static str> {
    match pixels {
        "8" => Ok(TileSize::Pixels8),
        "16" => Ok(TileSize::Pixels16),
        "32" => Ok(TileSize::Pixels32),
        "64" => Ok(TileSize::Pixels64),
        _ => Err("it is one of 8, 16, 32 and 64"),
    }
}

impl Arguments {
    fn settings(&self, threads: NonZeroUsize) -> ExecuteSettings {
        ExecuteSettings {
            threads: Some(threads),
            simd: self.simd,
            tile_size: self.tile.unwrap_or_default(),
            depth_test: if self.late { DepthTest::Late } else { DepthTest::Hierarchical },
            timed: self.stages,
        }
    }

    fn chosen(&self) -> Result<Vec<Workload>, String> {
        let unknown = |prefix: &&String| !Workload::ALL.iter().any(|w| w.name().starts_with(prefix.as_str()));
        if let Some(prefix) = self.workloads.iter().find(unknown) {
            let names = Workload::ALL.map(Workload::name).join(", ");
            return Err(format!("no workload begins with {prefix:?}; there are {names}"));
        }
        let wanted = |workload: &Workload| {
            self.workloads.is_empty()
                || self.workloads.iter().any(|prefix| workload.name().starts_with(prefix.as_str()))
        };
        Ok(Workload::ALL.into_iter().filter(wanted).collect())
    }
}

/// One workload with one number of threads.
struct Line<'a> {
    /// Who draws.
    renderer: &'a str,
    workload: Workload,
    threads: NonZeroUsize,
    work: f64,
    timings: &'a Timings,
}

impl Line<'_> {
    const CSV_HEADER: &'static str = "peer,workload,threads,ms_median,ms_min,ms_max,unit_rate";

    fn csv(&self) -> String {
        let Self { renderer, workload, threads, timings, .. } = self;
        let [median, min, max] = [timings.median(), timings.min(), timings.max()];
        let rate = self.work / median / 1e3;
        format!("{renderer},{},{threads},{median:.3},{min:.3},{max:.3},{rate:.2}", workload.name())
    }

    fn text(&self) -> String {
        let Self { workload, threads, timings, .. } = self;
        let [median, min, max] = [timings.median(), timings.min(), timings.max()];
        format!("{:<16} {threads:>2} threads {median:>10.3} ms ({min:.3} to {max:.3})", workload.name())
    }

    fn samples(&self) -> String {
        let times: Vec<String> =
            self.timings.milliseconds().iter().map(|time| format!("{time:.4}")).collect();
        let Self { renderer, workload, threads, .. } = self;
        format!("{renderer},{},{threads},{},{}", workload.name(), self.work / 1e6, times.join(","))
    }
}

/// The stages of the last frame in milliseconds; those in tiles summed over the
/// threads.
fn stage_line(times: StageTimes) -> String {
    let StageTimes { vertices, set_up, visibility, shading, blending, resolve } = times;
    let stages = [
        ("vertices", vertices),
        ("set-up and bins", set_up),
        ("visibility", visibility),
        ("shading", shading),
        ("blending", blending),
        ("resolve", resolve),
    ];
    let parts = stages.map(|(name, time)| format!("{name} {:.2}", time.as_secs_f64() * 1e3));
    format!("# {}", parts.join(", "))
}

fn save(folder: &Path, workload: Workload, scene: &Scene, pixels: &[[u8; 4]]) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let path = folder.join(format!("trigon-{}.png", workload.name()));
    let size = scene.size;
    Ok(image::save_buffer(path, pixels.as_flattened(), size.x, size.y, ExtendedColorType::Rgba8)?)
}

fn append(path: &Path, line: &str) -> std::io::Result<()> {
    writeln!(File::options().create(true).append(true).open(path)?, "{line}")
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.csv {
        println!("{}", Line::CSV_HEADER);
    }
    let mut renderer =
        arguments.preset.map_or_else(|| "trigon".to_owned(), |preset| format!("trigon-{preset}"));
    if let Some(level) = arguments.simd {
        renderer.push_str(&format!("-{level}"));
    }
    for workload in arguments.chosen()? {
        let scene = workload.scene();
        let scene = arguments.preset.map_or(scene.clone(), |preset| scene.at_quality(preset.quality()));
        let mut pixels = vec![[0; 4]; scene.pixel_count()];
        for &threads in &arguments.threads {
            let rasterizer = Rasterizer::new(arguments.settings(threads))?;
            let mut canvas = Canvas::new(rasterizer, &scene, &mut pixels)?;
            let mut stages = StageTimes::default();
            let frame = || stages = canvas.draw(&scene).times;
            let timings = match arguments.warm_up {
                Some(warm_up) => Timings::of_frames_after(warm_up, arguments.repetitions, frame),
                None => Timings::of_frames(arguments.repetitions, frame),
            };
            let line = Line {
                renderer: &renderer,
                workload,
                threads,
                work: workload.work(&scene),
                timings: &timings,
            };
            println!("{}", if arguments.csv { line.csv() } else { line.text() });
            if arguments.stages {
                println!("{}", stage_line(stages));
            }
            if let Some(path) = &arguments.samples {
                append(path, &line.samples())?;
            }
            if let Some(folder) = &arguments.png {
                save(folder, workload, &scene, &pixels)?;
            }
        }
    }
    Ok(())
}
