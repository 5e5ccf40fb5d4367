//! How should a mesh be stored?

use super::*;
use crate::storage::{REPRESENTATIONS, Storage, Triangles};
use std::hint::black_box;

const BYTES: &str = "bytes per face";
const PICK: &str = "picking an edge, ns";
const PICK_READS: &str = "reads";
const MOVE: &str = "faces of a moved vertex, ns";
const MOVE_READS: &str = "reads of that";
const WALK: &str = "neighbours, ns";
const WALK_READS: &str = "reads of those";

/// A way to ask a representation.
type Task = fn(&dyn Storage, &Triangles, u32) -> u64;

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
        text: "The representations that source D weighs (its section 1.3): memory, and what it takes to find the edge nearest to a \
               point on a face, the faces whose planes change with a vertex, and a vertex's neighbours. A read is an index looked \
               at. All give the same answers.",
        findings: findings(&rows),
        plots: Vec::new(),
        pictures: Vec::new(),
        rows,
    }
}

fn of_ball(ball: &Triangles, effort: Effort) -> Vec<Row> {
    let faces = ball.triangles.len();
    let made: Vec<(&str, Box<dyn Storage>)> =
        REPRESENTATIONS.iter().map(|(name, make)| (*name, make(ball))).collect();
    let mut rows: Vec<Row> = made
        .iter()
        .map(|(name, storage)| {
            Row::new(case(faces), *name).with(BYTES, storage.bytes() as f64 / faces as f64)
        })
        .collect();
    for (task, time_name, reads_name) in TASKS {
        // Elements all over the mesh.
        let asked: Vec<u32> = (0..32).map(|i| i * (ball.positions.len() as u32 - 1) / 31).collect();
        let asked = &asked;
        let indices: Vec<usize> = (0..made.len()).collect();
        let times = nanoseconds(effort.rounds(), &indices, |index| -> Box<dyn FnMut()> {
            let storage = &*made[index].1;
            Box::new(move || {
                black_box(asked.iter().map(|&element| task(storage, ball, element)).sum::<u64>());
            })
        });
        for ((row, time), (_, storage)) in rows.iter_mut().zip(times).zip(&made) {
            let reads: u64 = asked.iter().map(|&element| task(&**storage, ball, element)).sum();
            let share = 1.0 / asked.len() as f64;
            *row = row.clone().timed(time_name, time.scaled(share)).with(reads_name, reads as f64 * share);
        }
    }
    rows
}

fn case(faces: usize) -> String {
    format!("{faces} faces")
}

fn pick(storage: &dyn Storage, ball: &Triangles, face: u32) -> u64 {
    let [a, b, c] = ball.triangles[face as usize].map(|vertex| ball.positions[vertex as usize]);
    storage.nearest_edge(face, a * 0.5 + b * 0.45 + c * 0.05).reads
}

fn change(storage: &dyn Storage, _: &Triangles, vertex: u32) -> u64 {
    storage.triangles_around(vertex).reads
}

fn walk(storage: &dyn Storage, _: &Triangles, vertex: u32) -> u64 {
    storage.neighbours(vertex).reads
}

fn findings(rows: &[Row]) -> Vec<String> {
    let large = case(20 << 10);
    let of = |index: usize, quantity: &str| number(value(rows, &large, REPRESENTATIONS[index].0, quantity));
    vec![
        format!(
            "Source D rejects vertex lists and face lists for want of edges, and winged edges as redundant. Measured: picking takes \
             {} ns with face lists, {} with winged edges, {} with faces and edges, on 20,480 faces; vertex lists, {}. Memory: {}, \
             {}, {} and {} bytes per face.",
            of(1, PICK),
            of(2, PICK),
            of(4, PICK),
            of(0, PICK),
            of(1, BYTES),
            of(2, BYTES),
            of(4, BYTES),
            of(0, BYTES),
        ),
        format!(
            "What faces with edges lack is the way from a vertex to its faces: {} ns instead of {} with a corner table, which takes \
             {} bytes per face. An editor that drags vertices of large meshes derives it once for the drag.",
            of(4, MOVE),
            of(3, MOVE),
            of(3, BYTES),
        ),
    ]
}
