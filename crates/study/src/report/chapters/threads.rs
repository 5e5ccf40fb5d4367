//! How many threads does an image want?

use super::*;
use crate::threads::{Shared, THREADS, TIMES_OF_THE_SOURCE, draw_by_face, square};
use crate::workloads::{Canvas, Scene, Workload};
use std::num::NonZeroUsize;
use trigon_raster::{ExecuteSettings, Rasterizer};

const TIME: &str = "µs per frame";
const SQUARE: &str = "a square of two faces";

/// The tables.
const THEIRS: &str = "threads, source D's way";
const OURS: &str = "threads, engine";
const WORKLOAD: &str = "threads, engine, 70,000 triangles";

/// The engine has no other threads with one than without any: it is one row.
const OUR_THREADS: &[usize] = &[1, 2, 4, 8, 16, 32, 64, 128];

pub(super) fn measure(effort: Effort) -> Chapter {
    let size = effort.pick([960, 540], [1920, 1080]);
    let faces = &square(size);
    let theirs = nanoseconds(effort.rounds(), &THREADS, |threads| -> Box<dyn FnMut()> {
        Box::new(move || drop(draw_by_face(faces, size, threads)))
    });
    let ours = nanoseconds(effort.rounds(), OUR_THREADS, |threads| -> Box<dyn FnMut()> {
        let mut shared = Shared::new(faces, size, threads);
        Box::new(move || shared.draw())
    });
    let line = |threads: &[usize], times: &[Spread]| {
        threads
            .iter()
            .zip(times)
            .map(|(&threads, time)| [log_position(threads), time.median * 1e-3])
            .collect()
    };
    let published =
        THREADS.iter().zip(TIMES_OF_THE_SOURCE).map(|(&threads, time)| [log_position(threads), time]);
    let lines = vec![
        ("source D's table 4.1, its machine".to_owned(), published.collect()),
        ("source D's way, here".to_owned(), line(&THREADS, &theirs)),
        ("engine, here".to_owned(), line(OUR_THREADS, &ours)),
    ];
    let axes = ["threads (the first point is without)", TIME];
    let their_rows = THREADS.iter().zip(&theirs).map(|(&threads, &time)| their_row(threads, time));
    let our_rows =
        OUR_THREADS.iter().zip(&ours).map(|(&threads, &time)| our_row(OURS, SQUARE, threads, time));
    let rows = their_rows.chain(our_rows).map(|row| row.sized(size)).chain(of_workload(effort)).collect();
    Chapter {
        name: "threads",
        title: "How many threads does an image want?",
        text: "Source D's table 4.1 again, compiled with optimization: a square of two faces that fills most of the image, with new \
               threads for each face and a share of its rows for each. Beside it is the engine, whose threads last and take \
               tiles in turn. The \
               square gives the engine so little to compute that writing memory is most of its work. So it also draws W3, a \
               knot with light in each pixel (docs/performance.md has all workloads with one thread and with two).",
        findings: findings(&theirs, &ours),
        plots: vec![Plot::growth("threads", "Frame time by threads", axes, lines)],
        images: Vec::new(),
        rows,
    }
}

fn their_row(threads: usize, time: Spread) -> Row {
    let row = match threads {
        0 => Row::new(THEIRS, "none").by("source D's way, on the calling thread"),
        _ => Row::new(THEIRS, threads.to_string()).by("source D's way").with_threads(threads),
    };
    row.of(SQUARE).built_anew().timed(TIME, time.scaled(1e-3))
}

fn our_row(case: &str, geometry: &str, threads: usize, time: Spread) -> Row {
    let row = Row::new(case, threads.to_string()).by("engine").of(geometry).with_threads(threads);
    row.timed(TIME, time.scaled(1e-3))
}

/// An image with work in it, with one thread and with two.
fn of_workload(effort: Effort) -> Vec<Row> {
    let scene = &Workload::KnotPhong.scene();
    let threads = [1, 2];
    let times = nanoseconds(effort.rounds(), &threads, |threads| -> Box<dyn FnMut()> {
        let mut canvas = canvas(scene, threads);
        Box::new(move || {
            canvas.draw(scene);
        })
    });
    let size = scene.size.to_array().map(|side| side as usize);
    let row = |(&threads, time): (&usize, Spread)| {
        our_row(WORKLOAD, Workload::KnotPhong.name(), threads, time).sized(size)
    };
    threads.iter().zip(times).map(row).collect()
}

/// A canvas with a rasterizer of so many threads.
fn canvas(scene: &Scene, threads: usize) -> Canvas<'static> {
    let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..Default::default() };
    let rasterizer = Rasterizer::new(settings).expect("no SIMD level was asked for");
    Canvas::with_own_pixels(rasterizer, scene).expect("workloads have a size in range")
}

/// Where a number of threads lies on a logarithmic axis; none, left of one.
fn log_position(threads: usize) -> f64 {
    if threads == 0 { 0.5 } else { threads as f64 }
}

fn findings(theirs: &[Spread], ours: &[Spread]) -> Vec<String> {
    let best = |threads: &[usize], times: &[Spread]| {
        let best =
            (0..times.len()).fold(0, |best, i| if times[i].median < times[best].median { i } else { best });
        threads[best]
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    vec![format!(
        "With {cores} processors the source's way took least with {} threads, the engine with {}. The source found 32 the best, \
         and 4.1× as fast as none, on four cores with eight logical ones.",
        best(&THREADS, theirs),
        best(OUR_THREADS, ours),
    )]
}

pub(super) fn headlines() -> Vec<Headline> {
    let two = |case: &str| Headline::within(case, ["2", "1"], [TIME]);
    vec![two(THEIRS), two(OURS), two(WORKLOAD)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fastest_count_of_threads_is_told() {
        let times = |count: usize, fastest: usize| -> Vec<Spread> {
            let time = |i: usize| if i == fastest { 1.0 } else { 2.0 + i as f64 };
            (0..count).map(|i| Spread { low: 0.5, median: time(i), high: 99.0 }).collect()
        };
        for fastest in 0..OUR_THREADS.len() {
            let said = &findings(&times(THREADS.len(), fastest + 1), &times(OUR_THREADS.len(), fastest))[0];
            let expected =
                format!("with {} threads, the engine with {}.", THREADS[fastest + 1], OUR_THREADS[fastest]);
            assert!(said.contains(&expected), "{said}");
        }
        assert_eq!([0, 1, 4].map(log_position), [0.5, 1.0, 4.0], "on a logarithmic axis none is left of one");
    }

    #[test]
    fn rows_name_their_threads() {
        let time = Spread { low: 1e3, median: 2e3, high: 3e3 };
        let rows = [their_row(0, time), their_row(4, time), our_row(OURS, SQUARE, 4, time)];
        let names = rows.each_ref().map(|row| (row.variant.as_str(), row.conditions.threads));
        assert_eq!(names, [("none", 1), ("4", 4), ("4", 4)], "without threads there is one");
        for row in rows {
            let value = &row.values[0];
            assert_eq!((value.value, value.range), (2.0, Some([1.0, 3.0])), "{}: in µs", row.variant);
        }
    }
}
