//! How many threads does a picture want?

use super::*;
use crate::threads::{Shared, THREADS, TIMES_OF_THE_SOURCE, draw_by_face, square};

const TIME: &str = "µs per frame";
const THEIRS: &str = "source D's way";
const OURS: &str = "engine";

pub(super) fn measure(effort: Effort) -> Chapter {
    let size = effort.pick([960, 540], [1920, 1080]);
    let faces = &square(size);
    let theirs = nanoseconds(effort.rounds(), &THREADS, |threads| -> Box<dyn FnMut()> {
        Box::new(move || drop(draw_by_face(faces, size, threads)))
    });
    let ours = nanoseconds(effort.rounds(), &THREADS, |threads| -> Box<dyn FnMut()> {
        let mut shared = Shared::new(faces, size, threads);
        Box::new(move || shared.draw())
    });
    let rows_of = |way: &'static str, times: &[Spread]| -> Vec<Row> {
        let row = |(threads, time): (&usize, &Spread)| {
            let name = if *threads == 0 { "none".to_owned() } else { threads.to_string() };
            Row::new(format!("threads, {way}"), name).timed(TIME, time.scaled(1e-3))
        };
        THREADS.iter().zip(times).map(row).collect()
    };
    let published = THREADS.iter().zip(TIMES_OF_THE_SOURCE).map(|(&threads, time)| [place(threads), time]);
    let line = |times: &[Spread]| {
        THREADS.iter().zip(times).map(|(&threads, time)| [place(threads), time.median * 1e-3]).collect()
    };
    let lines = vec![
        ("source D's table 4.1, its machine".to_owned(), published.collect()),
        (format!("{THEIRS}, here"), line(&theirs)),
        ("engine, here".to_owned(), line(&ours)),
    ];
    let axes = ["threads (the first point is without)", TIME];
    Chapter {
        name: "threads",
        title: "How many threads does a picture want?",
        text: "Source D's table 4.1 again: a square of two faces that fills most of the picture, new threads for each face with a \
               share of its rows, compiled with optimisation; and the engine, whose threads last and take tiles in turn.",
        findings: findings(&theirs, &ours),
        plots: vec![Plot::growth("threads", "Frame time by threads", axes, lines)],
        pictures: Vec::new(),
        rows: [rows_of(THEIRS, &theirs), rows_of(OURS, &ours)].concat(),
    }
}

/// Where a number of threads lies on a logarithmic axis; none, left of one.
fn place(threads: usize) -> f64 {
    if threads == 0 { 0.5 } else { threads as f64 }
}

fn findings(theirs: &[Spread], ours: &[Spread]) -> Vec<String> {
    let best = |times: &[Spread]| {
        let best =
            (0..times.len()).fold(0, |best, i| if times[i].median < times[best].median { i } else { best });
        (THREADS[best], times[0].median / times[best].median)
    };
    let ((their_count, their_gain), (our_count, our_gain)) = (best(theirs), best(ours));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    vec![
        format!(
            "With {cores} processors the source's way is fastest with {their_count} threads, {} as fast as without; the source found 32 \
             and 4.1× on eight. With 128 a frame takes {} µs more than with the best here.",
            format_args!("{}×", number(their_gain)),
            number((theirs[8].median - theirs[0].median / their_gain.max(1.0)) * 1e-3),
        ),
        format!(
            "The engine takes {} µs with one thread and is fastest with {our_count}, {} as fast as that: tiles are equal work, and \
             threads that are there need no starting.",
            number(ours[1].median * 1e-3),
            format_args!("{}×", number(our_gain)),
        ),
    ]
}
