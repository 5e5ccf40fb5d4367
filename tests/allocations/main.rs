//! What the rasterizer takes from the allocator: nothing once it is warm, and
//! little for a large frame. And what a scene of many nodes takes.
//!
//! One test alone, without the usual harness: the counts are those of the whole process, and
//! the harness allocates when it tells that a test takes long.

mod kinds;
mod nodes;
#[path = "../src/programs.rs"]
mod programs;

use dhat::{HeapStats, Profiler};
use kinds::{Kind, kinds};
use rayon::ThreadPoolBuilder;
use std::num::NonZeroUsize;
use trigon_raster::{ExecuteSettings, Output, Pass, Rasterizer, Target};
use trigon_study::workloads::{Canvas, Workload};

#[global_allocator]
static ALLOCATOR: dhat::Alloc = dhat::Alloc;

/// Width and height of images of several tiles.
const SMALL: u32 = 96;

/// With four samples a pixel, enough to be shared among threads.
const SHARED: u32 = 256;

const NAME: &str = "the_rasterizer_keeps_its_memory";

/// Runs the test unless names of others are asked for.
fn main() {
    let mut names = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).peekable();
    if names.peek().is_none() || names.any(|name| NAME.contains(&name)) {
        the_rasterizer_keeps_its_memory();
    }
}

fn the_rasterizer_keeps_its_memory() {
    let profiler = profiler();
    let kinds = kinds();
    for samples in [1, 4] {
        for (name, pass) in &kinds {
            assert_warm_frames_allocate_nothing(name, pass, samples);
        }
        assert_warm_kinds_in_turn_allocate_nothing(&kinds, samples);
    }
    assert_threads_allocate_what_their_pool_does(&kinds);
    drop(profiler);
    assert_peak_of_a_million_triangles();
    nodes::assert_nodes_are_small();
}

fn profiler() -> Profiler {
    Profiler::builder().testing().build()
}

fn rasterizer(threads: usize) -> Rasterizer {
    let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..Default::default() };
    Rasterizer::new(settings).expect("the best level is supported")
}

fn target(side: u32, samples: u32) -> Target<'static> {
    let outputs = [Output::Srgb8, Output::Depth, Output::Object, Output::Face];
    let target = Target::new(side, side, &outputs).expect("the size is in range");
    target.with_samples(samples).expect("a standard pattern")
}

/// How many blocks `work` allocates.
fn blocks(work: impl FnOnce()) -> u64 {
    let before = HeapStats::get().total_blocks;
    work();
    HeapStats::get().total_blocks - before
}

fn assert_warm_frames_allocate_nothing(name: &str, pass: &Pass<'_>, samples: u32) {
    let (mut rasterizer, mut target) = (rasterizer(1), target(SMALL, samples));
    let mut draw = || {
        rasterizer.draw(pass, &mut target);
    };
    assert!(blocks(&mut draw) > 0, "the first frame of {name} takes what later ones use");
    draw();
    for frame in 2..5 {
        assert_eq!(blocks(&mut draw), 0, "frame {frame} of {name} with {samples} samples");
    }
}

/// One rasterizer for all kinds: none takes away what another kept.
fn assert_warm_kinds_in_turn_allocate_nothing(kinds: &[Kind], samples: u32) {
    let (mut rasterizer, mut target) = (rasterizer(1), target(SMALL, samples));
    for round in 0..4 {
        for (name, pass) in kinds {
            let blocks = blocks(|| {
                rasterizer.draw(pass, &mut target);
            });
            assert!(round < 2 || blocks == 0, "{blocks} blocks for {name} in round {round}");
        }
    }
}

/// A frame has up to three stages that all threads take part in, and to call them
/// to one takes the pool a block. A thread's own memory grows until it has once had
/// the dearest tile, so a frame now and then takes more.
fn assert_threads_allocate_what_their_pool_does(kinds: &[Kind]) {
    const STAGES: u64 = 3;
    // Memory that grows by doubling has then grown to the dearest tile on each thread,
    // in whichever order the threads took the tiles.
    const MOST_FRAMES: usize = 100;
    let (mut rasterizer, mut target) = (rasterizer(2), target(SHARED, 4));
    let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be had");
    let call = || pool.in_place_scope(|scope| scope.spawn_broadcast(|_, _| ()));
    call();
    let of_a_call = blocks(call);
    for (name, pass) in kinds {
        let mut draw = || {
            rasterizer.draw(pass, &mut target);
        };
        // What every frame took would be in the first one that takes no more, too.
        let mut frames = Vec::new();
        while !frames.last().is_some_and(|last| (1..=STAGES * of_a_call).contains(last)) {
            assert!(frames.len() < MOST_FRAMES, "blocks of the frames of {name}: {frames:?}");
            frames.push(blocks(&mut draw));
        }
    }
}

/// Beyond the caller's vertices, indices and image.
fn assert_peak_of_a_million_triangles() {
    const MOST: usize = 40_000_000;
    let scene = Workload::Torus.scene();
    let mut pixels = vec![[0; 4]; scene.pixel_count()];
    for threads in [1, 2] {
        let _profiler = profiler();
        let mut canvas =
            Canvas::new(rasterizer(threads), &scene, &mut pixels).expect("as many pixels as it has");
        for _ in 0..2 {
            canvas.draw(&scene);
        }
        let peak = HeapStats::get().max_bytes;
        assert!(peak <= MOST, "{peak} bytes at most at a time with {threads} threads");
    }
}
