//! What commands cost that make or change whole meshes, and what undoing and redoing them costs.
//!
//! ```text
//! cargo run --release -p trigon-document --example undo_prices [-- PART OF A NAME]
//! ```
//! Prints rows of `operation,faces before,faces after,run,undo,redo,undo / run`, times in milliseconds: medians of
//! five runs, each with a document of its own. Everything is a command, also what comes before it.

use std::time::Instant;

use serde_json::{Value, json};
use trigon_document::scene::Scene;
use trigon_document::{Command, Document};

/// A command, and the commands before it: lists of JSON objects without brackets.
struct Row {
    name: &'static str,
    before: &'static [&'static str],
    command: Value,
}

/// 100,000 quads.
const TORUS: &str = r#"{ "op": "add_object", "object": { "shape": "torus", "major_radius": 1, "minor_radius": 0.4,
    "major_segments": 500, "minor_segments": 200 } }"#;
/// 5,000 quads.
const SMALL_TORUS: &str = r#"{ "op": "add_object", "object": { "shape": "torus", "major_radius": 1, "minor_radius": 0.4,
    "major_segments": 100, "minor_segments": 50 } }"#;
/// 90,000 quads.
const GRID: &str = r#"{ "op": "add_object", "object": { "shape": "grid", "width": 2, "depth": 2, "columns": 300, "rows": 300 } }"#;
/// 81,920 triangles.
const SPHERE: &str =
    r#"{ "op": "add_object", "object": { "shape": "icosphere", "radius": 1, "subdivisions": 6 } }"#;
const SPHERE_BESIDE: &str = r#"{ "op": "add_object", "object": { "shape": "icosphere", "radius": 1, "subdivisions": 6 },
    "position": [0.3, 0.4, 0.5] }"#;
const DISC: &str = r#"{ "op": "add_object", "object": { "shape": "disc", "radius": 0.3, "segments": 800 } }"#;
const DISC_ABOVE: &str = r#"{ "op": "add_object", "object": { "shape": "disc", "radius": 0.3, "segments": 800 },
    "position": [0, 1, 0] }"#;
const JOINED: &str = r#"{ "op": "select", "objects": [0, 1] }, { "op": "join_objects" }"#;
const BOTH: &str = r#"{ "op": "select", "objects": [1, 0] }"#;
const FACES: &str =
    r#"{ "op": "edit_objects" }, { "op": "set_element_kind", "kind": "face" }, { "op": "select_all" }"#;
const EDGES: &str =
    r#"{ "op": "edit_objects" }, { "op": "set_element_kind", "kind": "edge" }, { "op": "select_all" }"#;
const VERTICES: &str =
    r#"{ "op": "edit_objects" }, { "op": "set_element_kind", "kind": "vertex" }, { "op": "select_all" }"#;
/// Edges without faces.
const ONLY_EDGES: &str = r#"{ "op": "delete", "what": "only_faces" }, { "op": "set_element_kind", "kind": "edge" },
    { "op": "select_all" }"#;
const HALF: &str = r#"{ "op": "select_within", "min": [-9, 0.001, -9] }, { "op": "delete", "what": "faces" },
    { "op": "select_all" }"#;
const UPPER: &str = r#"{ "op": "select_within", "min": [-9, 0.001, -9] }"#;
const SOLIDIFIED: &str = r#"{ "op": "add_modifier", "modifier": { "kind": "solidify" } }"#;
const SMOOTHED: &str = r#"{ "op": "add_modifier", "modifier": { "kind": "subdivision", "levels": 1 } }"#;
const FIRST: &str = r#"{ "op": "select", "elements": [0] }"#;
const LOOP: &str = r#"{ "op": "select_loop" }"#;
const LINKED: &str = r#"{ "op": "select_linked" }"#;
const BORDER: &str = r#"{ "op": "select_border" }"#;
const BOX_UVS: &str = r#"{ "op": "project_uvs_on_box" }"#;
const SMART_UVS: &str = r#"{ "op": "smart_project" }"#;
const LEAVE: &str = r#"{ "op": "leave_edit_mode" }"#;

fn rows() -> Vec<Row> {
    let row = |name, before, command| Row { name, before, command };
    let diagonal: Vec<Value> = (0..=300).map(|i| json!({ "at": "vertex", "vertex": 302 * i })).collect();
    let mut rows = vec![
        row("unwrap", &[SPHERE, FACES, HALF], json!({ "op": "unwrap" })),
        row("unwrap, 10 steps", &[SPHERE, FACES, HALF], json!({ "op": "unwrap", "minimize_stretch": 10 })),
        row("smart_project", &[TORUS, FACES], json!({ "op": "smart_project" })),
        row("pack_islands", &[TORUS, FACES, SMART_UVS], json!({ "op": "pack_islands" })),
        row("average_island_scale", &[TORUS, FACES, SMART_UVS], json!({ "op": "average_island_scale" })),
        row("project_uvs", &[TORUS, FACES], json!({ "op": "project_uvs" })),
        row("project_uvs_on_box", &[TORUS, FACES], json!({ "op": "project_uvs_on_box" })),
        row("project_uvs_cylinder", &[TORUS, FACES], json!({ "op": "project_uvs_cylinder" })),
        row("project_uvs_sphere", &[TORUS, FACES], json!({ "op": "project_uvs_sphere" })),
        row("follow_active_quad", &[GRID, FACES, BOX_UVS], json!({ "op": "follow_active_quad" })),
        row("stitch_uvs", &[SMALL_TORUS, EDGES, SMART_UVS], json!({ "op": "stitch_uvs" })),
        row("straighten_uvs", &[TORUS, EDGES, BOX_UVS, FIRST, LOOP], json!({ "op": "straighten_uvs" })),
        row("align_uvs", &[TORUS, VERTICES, BOX_UVS], json!({ "op": "align_uvs" })),
        row(
            "transfer_uvs",
            &[GRID, FACES, BOX_UVS, LEAVE, TORUS],
            json!({ "op": "transfer_uvs", "from": 0 }),
        ),
        row("bisect", &[TORUS, FACES], json!({ "op": "bisect", "clear_outer": true, "fill": true })),
        row(
            "intersect_faces",
            &[SPHERE, SPHERE_BESIDE, JOINED, FACES, FIRST, LINKED],
            json!({ "op": "intersect_faces" }),
        ),
        row("knife_project", &[DISC_ABOVE, GRID, FACES], json!({ "op": "knife_project", "objects": [0] })),
        row("decimate", &[SPHERE, FACES], json!({ "op": "decimate", "ratio": 0.1 })),
        row("un_subdivide", &[TORUS, FACES], json!({ "op": "un_subdivide" })),
        row("solidify", &[GRID, FACES], json!({ "op": "solidify" })),
        row(
            "spin",
            &[DISC, FACES, ONLY_EDGES],
            json!({ "op": "spin", "center": [1, 0, 0], "axis": [0, 0, 1], "steps": 128 }),
        ),
        row(
            "spin, as a screw",
            &[DISC, FACES, ONLY_EDGES],
            json!({ "op": "spin", "center": [1, 0, 0], "axis": [0, 0, 1], "steps": 32, "turns": 4, "height": 1 }),
        ),
        row("poke", &[TORUS, FACES], json!({ "op": "poke" })),
        row("wireframe", &[TORUS, FACES], json!({ "op": "wireframe", "thickness": 0.001 })),
        row("convex_hull", &[SPHERE, VERTICES], json!({ "op": "convex_hull" })),
        row("voxel_remesh", &[SPHERE, FACES], json!({ "op": "voxel_remesh", "voxel_size": 0.01 })),
        row(
            "bridge",
            &[DISC, DISC_ABOVE, JOINED, EDGES, BORDER],
            json!({ "op": "bridge", "cuts": 100, "interpolation": "path" }),
        ),
        row("grid_fill", &[DISC, FACES, ONLY_EDGES], json!({ "op": "grid_fill" })),
        row("make_solid", &[SPHERE, FACES, HALF], json!({ "op": "make_solid" })),
        row("rip a loop", &[TORUS, EDGES, FIRST, LOOP], json!({ "op": "rip" })),
        row("rip all edges", &[TORUS, EDGES], json!({ "op": "rip" })),
        row(
            "extend_vertices",
            &[GRID, EDGES, BORDER, r#"{ "op": "set_element_kind", "kind": "vertex" }"#],
            json!({ "op": "extend_vertices" }),
        ),
        row("tube", &[DISC, FACES, ONLY_EDGES], json!({ "op": "tube", "radius": 0.01, "sides": 100 })),
        row("mirror a copy", &[TORUS, FACES], json!({ "op": "mirror", "copy": true })),
        row("symmetrize", &[TORUS, FACES], json!({ "op": "symmetrize" })),
        row("tris_to_quads", &[SPHERE, FACES], json!({ "op": "tris_to_quads" })),
        row("dissolve_flat", &[GRID, FACES], json!({ "op": "dissolve_flat" })),
        row("duplicate", &[TORUS, FACES], json!({ "op": "duplicate" })),
        row("separate", &[TORUS, FACES, UPPER], json!({ "op": "separate" })),
        row(
            "separate loose parts",
            &[SPHERE, SPHERE_BESIDE, JOINED],
            json!({ "op": "separate", "by": "loose_parts" }),
        ),
        row("apply_modifier, solidify", &[GRID, SOLIDIFIED], json!({ "op": "apply_modifier" })),
        row("apply_modifier, subdivision", &[TORUS, SMOOTHED], json!({ "op": "apply_modifier" })),
        row("knife", &[GRID, FACES], json!({ "op": "knife", "strokes": [diagonal] })),
    ];
    rows.extend(["union", "difference", "intersection"].map(|operation| Row {
        name: operation,
        before: &[SPHERE, SPHERE_BESIDE, BOTH],
        command: json!({ "op": "boolean", "operation": operation }),
    }));
    rows
}

fn main() {
    let part = std::env::args().nth(1).unwrap_or_default();
    for row in rows().iter().filter(|row| row.name.contains(&part)) {
        measure(row);
    }
}

/// The document before the command.
fn prepared(row: &Row) -> Document {
    let mut document = Document::new(Scene::new());
    for commands in row.before {
        let commands: Vec<Command> = serde_json::from_str(&format!("[{commands}]")).expect("commands");
        for command in commands {
            document.run(command).expect(row.name);
        }
    }
    document
}

fn faces(document: &Document) -> usize {
    let scene = document.nodes();
    let used = scene.nodes().iter().filter_map(|(_, node)| node.mesh);
    let count = |id| match document.mesh(id) {
        Some(mesh) => mesh.face_count(),
        None => scene.meshes().get(id).map_or(0, |asset| asset.mesh().face_count()),
    };
    used.map(count).sum()
}

fn milliseconds(work: impl FnOnce(&mut Document), document: &mut Document) -> f64 {
    let start = Instant::now();
    work(document);
    start.elapsed().as_secs_f64() * 1e3
}

#[expect(clippy::print_stdout, reason = "this is what it is for")]
fn measure(row: &Row) {
    let command: Command = serde_json::from_value(row.command.clone()).expect("a command");
    let (mut counts, mut times) = ([0; 2], [(); 3].map(|()| Vec::new()));
    for _ in 0..5 {
        let mut document = prepared(row);
        counts[0] = faces(&document);
        let run = |document: &mut Document| drop(document.run(command.clone()).expect(row.name));
        times[0].push(milliseconds(run, &mut document));
        counts[1] = faces(&document);
        times[1].push(milliseconds(|document| document.undo().expect("it was done"), &mut document));
        times[2].push(milliseconds(|document| document.redo().expect("it was undone"), &mut document));
    }
    let [run, undo, redo] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    let [before, after] = counts;
    println!("{},{before},{after},{run:.2},{undo:.2},{redo:.2},{:.3}", row.name, undo / run);
}
