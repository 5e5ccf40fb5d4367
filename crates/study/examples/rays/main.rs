//! How many rays a second one thread follows, eight at a time, through four scenes, for comparison with other programs:
//!
//! `cargo run --release -p trigon-study --example rays -- --write FOLDER`
//!
//! writes the triangles, the rays and trigon's hits, and without `--write` the same rays are timed. All files are
//! sequences of little-endian numbers of 4 bytes:
//!
//! - `SCENE.triangles`: three corners of three `f32`
//! - `SCENE-SET.rays`: origin, direction and end of the range, seven `f32`
//! - `SCENE-SET.hits`: the number of the triangle, `u32`, and the distance in lengths of the direction, `f32`. Number
//!   2³² − 1 is a miss. Where any hit will do, all hits are triangle 0 at distance 0.
//!
//! `sets` has a line for each set: its scene, its name, and `closest` or `any`. Lines of output are
//! `trigon,SCENE,build,MILLISECONDS` and `trigon,SCENE,SET,MILLIONS OF RAYS A SECOND,HITS,DIFFERENCES`; the differences
//! are from the hits in the folder. `tests/peers/rays.sh` times other programs with the same files in turns.

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

mod scenes;
mod sets;

use clap::Parser;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};
use sets::{Query, Set};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trigon_math::simd::Token;
use trigon_math::{Bvh, Ray, Rays, Vec3, at_level};
use trigon_raster::simd::LANES;

/// Time rays through four scenes, or write them.
#[derive(Parser)]
struct Arguments {
    /// Where scenes, rays and hits are
    folder: PathBuf,
    /// Write them
    #[arg(long)]
    write: bool,
    /// How often to follow each ray; the median counts
    #[arg(long, value_name = "N", default_value = "5")]
    repetitions: usize,
    /// Time only these scenes
    scenes: Vec<String>,
}

/// Rays that are timed together. Few enough to take less time than a slice of the scheduler, so that the median of each
/// is free from other work on the machine.
const BLOCK: usize = 512;

/// What the number of a triangle is where nothing is hit.
const MISS: u32 = u32::MAX;

#[derive(Clone, Copy, Default, PartialEq)]
struct Hit {
    triangle: u32,
    distance: f32,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.write { write(&arguments.folder) } else { time(&arguments) }
}

fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let mut lines = String::new();
    for setting in scenes::all() {
        let (name, bvh) = (setting.name, Bvh::new(&setting.triangles));
        let corners = setting.triangles.iter().flatten().flat_map(|corner| corner.to_array());
        store(&folder.join(format!("{name}.triangles")), corners.map(f32::to_le_bytes))?;
        for set in sets::of(&setting, &bvh) {
            let mut hits = vec![Hit::default(); set.queries.len()];
            ask(&bvh, set.is_any, &set.queries, &mut hits);
            let numbers = set.queries.iter().flat_map(numbers);
            store(&folder.join(format!("{name}-{}.rays", set.name)), numbers.map(f32::to_le_bytes))?;
            let words = hits.iter().flat_map(|hit| [hit.triangle.to_le_bytes(), hit.distance.to_le_bytes()]);
            store(&folder.join(format!("{name}-{}.hits", set.name)), words)?;
            lines += &format!("{name} {} {}\n", set.name, if set.is_any { "any" } else { "closest" });
        }
    }
    Ok(fs::write(folder.join("sets"), lines)?)
}

fn numbers(query: &Query) -> [f32; 7] {
    let [origin, direction] = [query.ray.origin.to_array(), query.ray.direction.to_array()];
    [origin[0], origin[1], origin[2], direction[0], direction[1], direction[2], query.end]
}

fn store(path: &Path, words: impl Iterator<Item = [u8; 4]>) -> Result<(), Box<dyn Error>> {
    Ok(fs::write(path, words.flatten().collect::<Vec<u8>>())?)
}

fn load<const N: usize>(path: &Path) -> Result<Vec<[f32; N]>, Box<dyn Error>> {
    let bytes =
        fs::read(path).map_err(|error| format!("{}: {error}; run with --write first", path.display()))?;
    let words: Vec<f32> = bytes.as_chunks::<4>().0.iter().map(|word| f32::from_le_bytes(*word)).collect();
    Ok(words.as_chunks::<N>().0.to_vec())
}

fn time(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let folder = &arguments.folder;
    let mut built: Option<(String, Bvh)> = None;
    for line in fs::read_to_string(folder.join("sets"))?.lines() {
        let [scene, set, kind] = line.split(' ').collect::<Vec<_>>()[..] else {
            return Err(format!("{line}: the folder's file `sets` has three words in each line").into());
        };
        if !arguments.scenes.is_empty() && !arguments.scenes.iter().any(|wanted| wanted == scene) {
            continue;
        }
        let bvh = match built.take() {
            Some((name, bvh)) if name == scene => bvh,
            _ => build(folder, scene)?,
        };
        let queries = load(&folder.join(format!("{scene}-{set}.rays")))?.into_iter().map(query).collect();
        let wanted = load(&folder.join(format!("{scene}-{set}.hits")))?;
        let set = Set { name: set, is_any: kind == "any", queries };
        let mut hits = vec![Hit::default(); set.queries.len()];
        let rate = set.queries.len() as f64 / seconds(&bvh, &set, arguments.repetitions, &mut hits) / 1e6;
        let count = hits.iter().filter(|hit| hit.triangle != MISS).count();
        let wanted =
            wanted.into_iter().map(|[number, distance]| Hit { triangle: number.to_bits(), distance });
        let differences = hits.iter().zip(wanted).filter(|(hit, wanted)| *hit != wanted).count();
        println!("trigon,{scene},{},{rate:.4},{count},{differences}", set.name);
        built = Some((scene.to_owned(), bvh));
    }
    Ok(())
}

fn build(folder: &Path, scene: &str) -> Result<Bvh, Box<dyn Error>> {
    let triangles: Vec<[Vec3; 3]> = load(&folder.join(format!("{scene}.triangles")))?
        .into_iter()
        .map(|[a, b, c, d, e, f, g, h, i]| [Vec3::new(a, b, c), Vec3::new(d, e, f), Vec3::new(g, h, i)])
        .collect();
    let start = Instant::now();
    let bvh = Bvh::new(&triangles);
    println!("trigon,{scene},build,{:.2}", start.elapsed().as_secs_f64() * 1e3);
    Ok(bvh)
}

fn query([a, b, c, d, e, f, end]: [f32; 7]) -> Query {
    Query { ray: Ray { origin: Vec3::new(a, b, c), direction: Vec3::new(d, e, f) }, end }
}

/// The sum over all blocks of the median of each one's times.
fn seconds(bvh: &Bvh, set: &Set, repetitions: usize, hits: &mut [Hit]) -> f64 {
    let mut times = vec![Vec::new(); set.queries.len().div_ceil(BLOCK)];
    for _ in 0..repetitions.max(1) {
        let blocks = set.queries.chunks(BLOCK).zip(hits.chunks_mut(BLOCK));
        for ((queries, hits), times) in blocks.zip(&mut times) {
            let start = Instant::now();
            ask(bvh, set.is_any, queries, hits);
            times.push(start.elapsed().as_secs_f64());
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.iter_mut().map(median).sum()
}

fn ask(bvh: &Bvh, is_any: bool, queries: &[Query], hits: &mut [Hit]) {
    at_level!(Token::best(), simd => for (queries, hits) in queries.chunks(LANES).zip(hits.chunks_mut(LANES)) {
        ask_eight(simd, bvh, is_any, queries, hits);
    });
}

/// Up to eight rays.
#[inline(always)]
fn ask_eight<S: Simd>(simd: S, bvh: &Bvh, is_any: bool, queries: &[Query], hits: &mut [Hit]) {
    let mut columns = [[0.0; LANES]; 7];
    for (lane, query) in queries.iter().enumerate() {
        for (column, number) in columns.iter_mut().zip(numbers(query)) {
            column[lane] = number;
        }
    }
    let column = |number: usize| f32x8::simd_from(simd, columns[number]);
    let rays = Rays {
        origin: [column(0), column(1), column(2)],
        direction: [column(3), column(4), column(5)],
        start: f32x8::splat(simd, 0.0),
        end: column(6),
        active: (1 << queries.len()) - 1,
    };
    let miss = Hit { triangle: MISS, distance: 0.0 };
    if is_any {
        let occluded = bvh.occluded_rays(simd, &rays, None);
        for (lane, hit) in hits.iter_mut().enumerate() {
            *hit = if occluded >> lane & 1 != 0 { Hit::default() } else { miss };
        }
    } else {
        let nearest = bvh.nearest_rays(simd, &rays, &mut |_, _| true);
        for (hit, nearest) in hits.iter_mut().zip(nearest) {
            *hit = nearest.map_or(miss, |hit| Hit { triangle: hit.triangle, distance: hit.distance });
        }
    }
}
