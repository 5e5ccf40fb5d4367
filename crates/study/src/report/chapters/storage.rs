//! How should a mesh be stored?

use super::*;
use crate::storage::{REPRESENTATIONS, Representation, Storage, Triangles};
use std::hint::black_box;

const BYTES: &str = "bytes per face";
const PICK: &str = "picking an edge, ns";
const PICK_READS: &str = "reads";
const MOVE: &str = "faces of a moved vertex, ns";
const MOVE_READS: &str = "reads of that";
const WALK: &str = "neighbours, ns";
const WALK_READS: &str = "reads of those";

/// A way to ask a representation.
type Task = fn(&dyn Storage, &Triangles, u32);

const TASKS: [(Task, &str, &str); 3] =
    [(pick, PICK, PICK_READS), (change, MOVE, MOVE_READS), (walk, WALK, WALK_READS)];

pub(super) fn measure(effort: Effort) -> Chapter {
    let mut rows = Vec::new();
    for subdivisions in [3, 5] {
        rows.extend(of_ball(&Triangles::ball(subdivisions), effort));
    }
    Chapter {
        name: "storage",
        title: "How should a mesh be stored that is edited?",
        text: "The representations that source D weighs (section 1.3), by memory and by three searches: the edge nearest to a \
               point on a face, the faces whose planes change with a vertex, and a vertex's neighbours. A read is an index looked \
               at, counted where it is read, by a second copy that is not timed. All give the same answers.",
        findings: findings(),
        plots: Vec::new(),
        images: Vec::new(),
        rows,
    }
}

fn of_ball(ball: &Triangles, effort: Effort) -> Vec<Row> {
    let faces = ball.triangles.len();
    let made: Vec<Box<dyn Storage>> = REPRESENTATIONS.iter().map(|way| (way.plain)(ball)).collect();
    let bytes = made.iter().map(|storage| storage.bytes() as f64 / faces as f64);
    let row = |(way, bytes): (&Representation, f64)| Row::new(case(faces), way.name).with(BYTES, bytes);
    let mut rows: Vec<Row> = REPRESENTATIONS.iter().zip(bytes).map(row).collect();
    for (task, time_name, reads_name) in TASKS {
        // Elements all over the mesh.
        let queried: Vec<u32> = (0..32).map(|i| i * (ball.positions.len() as u32 - 1) / 31).collect();
        let queried = &queried;
        let ask = |storage: &dyn Storage| queried.iter().for_each(|&element| task(storage, ball, element));
        let reads: Vec<u64> = REPRESENTATIONS
            .iter()
            .map(|way| {
                let counted = (way.counted)(ball);
                ask(&*counted);
                counted.reads()
            })
            .collect();
        let indices: Vec<usize> = (0..made.len()).collect();
        let times = nanoseconds(effort.rounds(), &indices, |index| -> Box<dyn FnMut()> {
            let (storage, repeats) = (&*made[index], repeats(reads[index]));
            Box::new(move || (0..repeats).for_each(|_| ask(storage)))
        });
        for ((row, time), reads) in rows.iter_mut().zip(times).zip(reads) {
            let time = time.per(queried.len() * repeats(reads) as usize);
            *row = row.clone().timed(time_name, time).with(reads_name, reads as f64 / queried.len() as f64);
        }
    }
    rows
}

/// How often the questions are asked in a timed run, if answering them once takes this many reads:
/// often enough that the clock and what the run before left in the caches do not count.
fn repeats(reads: u64) -> u32 {
    const READS: u64 = 1 << 20;
    (READS / reads.max(1)).clamp(1, 1000) as u32
}

fn case(faces: usize) -> String {
    format!("{faces} faces")
}

fn pick(storage: &dyn Storage, ball: &Triangles, face: u32) {
    let [a, b, c] = ball.triangles[face as usize].map(|vertex| ball.positions[vertex as usize]);
    black_box(storage.nearest_edge(face, a * 0.5 + b * 0.45 + c * 0.05));
}

fn change(storage: &dyn Storage, _: &Triangles, vertex: u32) {
    black_box(storage.triangles_around(vertex));
}

fn walk(storage: &dyn Storage, _: &Triangles, vertex: u32) {
    black_box(storage.neighbours(vertex));
}

pub(super) fn findings() -> Vec<String> {
    vec![
        "Source D rejects vertex lists and face lists for want of edges, and winged edges as redundant.".to_owned(),
        "Faces with edges have no way from a vertex to its faces. An editor that drags vertices of large meshes derives it \
         once for the drag."
            .to_owned(),
    ]
}

pub(super) fn headlines() -> Vec<Headline> {
    let [vertices, faces, winged, corners, own] = REPRESENTATIONS.map(|way| way.name);
    let large =
        |names: [&'static str; 2], task: &'static str| Headline::within(case(20 << 10), names, [task, BYTES]);
    vec![
        large([vertices, faces], PICK),
        large([winged, faces], PICK),
        large([own, faces], PICK),
        large([own, corners], MOVE),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_are_those_of_one_question() {
        let ball = Triangles::ball(1);
        let rows = of_ball(&ball, Effort::Once);
        let of = |way: &str, quantity: &str| value(&rows, &case(80), way, quantity);
        // A face of theirs is three indices.
        assert_eq!(of("face lists", PICK_READS), 3.0, "the edge nearest to a point on a face");
        // Theirs are the neighbours of each vertex, so each of 120 edges is two indices.
        assert_eq!(of("vertex lists", PICK_READS), 240.0, "all edges, without faces");
        // 80 faces have 42 vertices of 12 bytes, and three indices each.
        let least = (42.0 * 12.0 + 80.0 * 12.0) / 80.0;
        for way in REPRESENTATIONS {
            let bytes = of(way.name, BYTES);
            assert!((least..10.0 * least).contains(&bytes), "{}: {bytes} bytes per face", way.name);
            let walk = of(way.name, WALK_READS);
            assert!(walk >= 5.0, "{}: {walk} reads for five or six neighbours", way.name);
        }
    }

    #[test]
    fn what_is_soon_answered_is_asked_again() {
        let expected = [(0, 1000), (1, 1000), (1 << 15, 32), (1 << 20, 1), (1 << 30, 1)];
        for (reads, times) in expected {
            assert_eq!(repeats(reads), times, "{reads} reads");
        }
    }
}
