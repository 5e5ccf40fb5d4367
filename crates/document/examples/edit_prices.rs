//! What commands cost on large meshes, with their history and the mesh's attributes, and what their undo costs.
//!
//! ```text
//! cargo run --release -p trigon-document --example edit_prices [-- PART OF A NAME]
//! ```
//! Prints rows of `program,operation,input,threads,median,shortest,longest`, times in milliseconds. The rows are
//! those of `tests/peers/blender_edit.py`, for the same grid: quads on a wavy sheet with one set of texture
//! coordinates.

use std::time::Instant;

use serde_json::{Value, json};
use trigon_document::mesh::math::elementary::sin_cos;
use trigon_document::mesh::{Mesh, primitives};
use trigon_document::scene::{Material, Scene};
use trigon_document::{Command, Document, MeshSelection};

/// A command on a grid.
struct Row {
    name: &'static str,
    /// Quads along each side.
    side: u32,
    /// What is selected before: elements of this kind, each so many.
    kind: &'static str,
    every: usize,
    /// At most so many.
    most: usize,
    command: Value,
    runs: usize,
}

fn rows() -> Vec<Row> {
    let all =
        |name, kind, command| Row { name, side: 500, kind, every: 1, most: usize::MAX, command, runs: 5 };
    let tenth = |name, kind, command| Row { every: 10, ..all(name, kind, command) };
    let large = |name, most, command| Row { side: 1000, most, ..all(name, "vertex", command) };
    let face = |name, command| Row { side: 1000, most: 1, ..all(name, "face", command) };
    let edge = |name, command| Row { side: 1000, most: 1, ..all(name, "edge", command) };
    let individual = json!({ "op": "inset", "mode": "individual", "thickness": 0.0005 });
    vec![
        all("catmull-clark (1000000 faces out)", "vertex", json!({ "op": "catmull_clark" })),
        all("extrude region, all faces", "face", json!({ "op": "extrude", "distance": 0.01 })),
        tenth(
            "extrude individual, a tenth",
            "face",
            json!({ "op": "extrude", "distance": 0.01, "individual": true }),
        ),
        tenth("inset individual, a tenth", "face", individual),
        Row {
            side: 200,
            ..tenth(
                "bevel a tenth of the edges, 1 segment",
                "edge",
                json!({ "op": "bevel", "width": 0.0005 }),
            )
        },
        all("subdivide flat", "edge", json!({ "op": "subdivide" })),
        all(
            "merge by distance, nothing to merge",
            "vertex",
            json!({ "op": "merge", "at": "distance", "distance": 1e-6 }),
        ),
        all("triangulate", "face", json!({ "op": "triangulate" })),
        all("recalculate normals", "face", json!({ "op": "recalculate_normals" })),
        tenth("delete a tenth of the faces", "face", json!({ "op": "delete", "what": "faces" })),
        large("select all", 0, json!({ "op": "select_all" })),
        large("select linked", 1, json!({ "op": "select_linked" })),
        large("select more", 1, json!({ "op": "select_more" })),
        large("move 10000 vertices", 10_000, json!({ "op": "translate", "offset": [0, 0.01, 0] })),
        face("extrude one face", json!({ "op": "extrude", "distance": 0.01 })),
        face("inset one face", json!({ "op": "inset", "thickness": 0.0001 })),
        edge("bevel one edge", json!({ "op": "bevel", "width": 0.0001 })),
        edge("one loop cut", json!({ "op": "loop_cut" })),
    ]
}

fn main() {
    let part = std::env::args().nth(1).unwrap_or_default();
    for row in rows().iter().filter(|row| row.name.contains(&part)) {
        print(row);
    }
    if "enter edit mode".contains(&part) {
        let times = (0..3).map(|_| milliseconds(|document| run(document, &edit()), &mut document(1000)));
        tell("enter edit mode", 1000, times.collect());
    }
}

/// A wavy sheet.
fn sheet(side: u32) -> Mesh {
    let mut sheet = primitives::grid(2.0, 2.0, side, side);
    for position in sheet.positions_mut() {
        let (sine, _) = sin_cos(4.5 * (f64::from(position.x) + 1.0));
        let (_, cosine) = sin_cos(3.5 * (f64::from(position.z) + 1.0));
        position.y = (0.1 * sine * cosine) as f32;
    }
    sheet
}

fn document(side: u32) -> Document {
    let mut scene = Scene::new();
    scene.add_object("sheet", sheet(side), Material::default());
    Document::new(scene)
}

fn edit() -> Value {
    json!({ "op": "edit_objects", "objects": ["sheet"] })
}

fn run(document: &mut Document, command: &Value) {
    let command: Command = serde_json::from_value(command.clone()).expect("a command");
    document.run(command).expect("it is possible");
}

/// The document of a row, with what is to be selected.
fn prepared(row: &Row) -> Document {
    let mut document = document(row.side);
    run(&mut document, &edit());
    run(&mut document, &json!({ "op": "set_element_kind", "kind": row.kind }));
    run(&mut document, &json!({ "op": "select_all" }));
    let all: Vec<u32> =
        document.selection().meshes().next().map_or(Vec::new(), |(_, selection)| selected(selection));
    let some: Vec<u32> = all.into_iter().step_by(row.every).take(row.most).collect();
    if row.every > 1 || row.most < usize::MAX {
        run(&mut document, &json!({ "op": "select", "elements": some }));
    }
    document
}

fn selected(selection: &MeshSelection) -> Vec<u32> {
    selection.indices().collect()
}

fn milliseconds(work: impl FnOnce(&mut Document), document: &mut Document) -> f64 {
    let start = Instant::now();
    work(document);
    start.elapsed().as_secs_f64() * 1e3
}

fn print(row: &Row) {
    let (mut times, mut undone) = (Vec::new(), Vec::new());
    for _ in 0..row.runs {
        // Undone and done again, a mesh keeps its room: each run has a mesh of its own.
        let mut document = prepared(row);
        times.push(milliseconds(|document| run(document, &row.command), &mut document));
        undone.push(milliseconds(|document| document.undo().expect("it was done"), &mut document));
    }
    tell(row.name, row.side, times);
    tell(&format!("undo: {}", row.name), row.side, undone);
}

#[expect(clippy::print_stdout, reason = "this is what it is for")]
fn tell(name: &str, side: u32, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let (median, quads) = (times[times.len() / 2], side * side);
    let (shortest, longest) = (times[0], times[times.len() - 1]);
    println!("trigon,{name},{quads} quads,1,{median:.2},{shortest:.2},{longest:.2}");
}
