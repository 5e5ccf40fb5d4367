//! Holds the images of other renderers, and trigon's own, against the exact ones:
//!
//! `cargo run --release -p trigon-study --example rivals -- FOLDER > crates/study/rivals/errors.csv`
//!
//! FOLDER holds images of the workloads as `RENDERER-WORKLOAD.png`, such as `euc-0.5.3-W5-cubes10k.png`;
//! `tests/peers/rivals.sh` has them drawn.

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use trigon_raster::Rasterizer;
use trigon_scene::quality::Preset;
use trigon_study::rivals::{Errors, Exact, Measured};
use trigon_study::workloads::{Canvas, Scene, Shading, Workload};

const WORKLOADS: [Workload; 5] = [
    Workload::Torus,
    Workload::KnotPhong,
    Workload::KnotTextured,
    Workload::Cubes,
    Workload::KnotMultisampled,
];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from).ok_or("name the folder of the images")?;
    println!("{}", Measured::HEAD);
    for workload in WORKLOADS {
        let scene = workload.scene();
        let exact = Exact::new(&scene);
        let judge = |renderer: String, image: &[[u8; 4]], is_centred: bool| {
            let errors = Errors::new(&exact, image, is_centred, matches!(scene.shading, Shading::Flat));
            println!("{}", Measured { renderer, workload: workload.name().to_owned(), errors }.line());
        };
        let is_centred = scene.samples == 1;
        judge_exact(&exact, is_centred, judge);
        for (renderer, path) in images(&folder, workload)? {
            let image = image::open(&path)?.into_rgba8();
            if image.dimensions() != (scene.size.x, scene.size.y) {
                return Err(format!("{} is not of the workload's size", path.display()).into());
            }
            // Means of several samples have no colour at the centre.
            let is_supersampled = ["-2x2", "-4x4"].iter().any(|end| renderer.ends_with(end));
            judge(renderer, image.into_raw().as_chunks().0, is_centred && !is_supersampled);
        }
        for (renderer, scene) in own(&scene) {
            let mut canvas = Canvas::with_own_pixels(Rasterizer::default(), &scene)?;
            canvas.draw(&scene);
            judge(renderer, canvas.pixels(), is_centred && scene.samples_per_axis == 1);
        }
    }
    Ok(())
}

/// What bytes can hold at best: the exact image, seen at the centres of pixels and as a mean of rays.
fn judge_exact(exact: &Exact, is_centred: bool, judge: impl Fn(String, &[[u8; 4]], bool)) {
    let bytes = |color: trigon_math::DVec3| {
        let [r, g, b] = (color * 255.0).round().to_array().map(|channel| channel as u8);
        [r, g, b, 255]
    };
    if is_centred {
        let centres: Vec<[u8; 4]> = exact.pixels.iter().map(|pixel| bytes(pixel.color)).collect();
        judge("exact-centres".to_owned(), &centres, true);
    }
    let means: Vec<[u8; 4]> = exact.pixels.iter().map(|pixel| bytes(pixel.mean)).collect();
    judge("exact-means".to_owned(), &means, false);
}

/// The renderers that have drawn a workload, with their images.
fn images(folder: &Path, workload: Workload) -> Result<Vec<(String, PathBuf)>, Box<dyn Error>> {
    let suffix = format!("-{}.png", workload.name());
    let files = fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
    let renderer = |path: &PathBuf| Some(path.file_name()?.to_str()?.strip_suffix(&suffix)?.to_owned());
    let paths = files.iter().map(fs::DirEntry::path);
    let mut images: Vec<_> = paths.filter_map(|path| Some((renderer(&path)?, path))).collect();
    images.retain(|(renderer, _)| !renderer.starts_with("trigon"));
    images.sort();
    Ok(images)
}

/// The scene as trigon draws it: at each preset, or with the samples that the workload has.
fn own(scene: &Scene) -> Vec<(String, Scene)> {
    if scene.samples > 1 {
        return vec![("trigon".to_owned(), scene.clone())];
    }
    let at = |preset: Preset| (format!("trigon-{preset}"), scene.clone().at_quality(preset.quality()));
    Preset::ALL.map(at).to_vec()
}
