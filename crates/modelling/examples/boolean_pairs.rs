//! Combines pairs of meshes and measures the results: for `tests/peers/blender_booleans.py`.
//!
//! Reads lines of standard input: two OBJ files, and the twelve numbers of the map from the second one's space to the
//! first one's (three columns of a matrix, then the offset). For each it writes a line of JSON: for all three operations,
//! and for the difference the other way round, the seconds, the volume, the number of faces and whether every side of a
//! face has exactly one opposite side; or the reason of a refusal. Of the files only `v` and `f` are read.

mod common;

use std::collections::HashMap;
use std::error::Error;
use std::io::{BufRead, Write};
use std::time::Instant;

use trigon_math::{DAffine3, DVec3};
use trigon_modelling::{BooleanOperation, BooleanTool, EditMesh};

use common::read;

fn main() -> Result<(), Box<dyn Error>> {
    let mut output = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let [a, b, numbers @ ..] = &words[..] else { return Err("two files and twelve numbers".into()) };
        let numbers: Vec<f64> = numbers.iter().map(|word| word.parse()).collect::<Result<_, _>>()?;
        let transform = DAffine3::from_cols_array(numbers[..].try_into()?);
        let (a, b) = (read(a)?, read(b)?);
        let mut moved = EditMesh::new();
        moved.join_mesh(&b, &transform)?;
        let tool = |mesh, transform| [BooleanTool { mesh, transform }];
        let results = [
            result("UNION", &a, &tool(&b, transform), BooleanOperation::Union),
            result("DIFFERENCE", &a, &tool(&b, transform), BooleanOperation::Difference),
            result("INTERSECT", &a, &tool(&b, transform), BooleanOperation::Intersection),
            result("REVERSE", &moved, &tool(&a, DAffine3::IDENTITY), BooleanOperation::Difference),
        ];
        let volumes = [volume(&a), volume(&moved)];
        writeln!(output, r#"{{"volumes": {volumes:?}, {}}}"#, results.join(", "))?;
        output.flush()?;
    }
    Ok(())
}

/// A member of the line: what an operation made, or why it was refused.
fn result(name: &str, mesh: &EditMesh, tools: &[BooleanTool<'_>], operation: BooleanOperation) -> String {
    let mut mesh = mesh.clone();
    let start = Instant::now();
    let result = mesh.boolean(tools, operation);
    let seconds = start.elapsed().as_secs_f64();
    match result {
        Ok(_) => format!(
            r#""{name}": {{"seconds": {seconds}, "volume": {}, "faces": {}, "closed": {}}}"#,
            volume(&mesh),
            mesh.face_count(),
            is_closed(&mesh)
        ),
        Err(refusal) => format!(r#""{name}": {{"refusal": {:?}}}"#, refusal.to_string()),
    }
}

/// By the divergence theorem along the x axis.
fn volume(mesh: &EditMesh) -> f64 {
    let mut sum = 0.0;
    let mut add = |[a, b, c]: [DVec3; 3]| {
        let area = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
        sum += area / 6.0 * (a.x + b.x + c.x);
    };
    for face in mesh.faces() {
        let outline: Vec<DVec3> = mesh.face_vertices(face).map(|v| mesh.position(v).as_dvec3()).collect();
        (1..outline.len() - 1).for_each(|i| add([outline[0], outline[i], outline[i + 1]]));
    }
    sum
}

fn is_closed(mesh: &EditMesh) -> bool {
    let mut sides = HashMap::new();
    for face in mesh.faces() {
        let ring: Vec<_> = mesh.face_vertices(face).collect();
        for (i, &from) in ring.iter().enumerate() {
            *sides.entry([from, ring[(i + 1) % ring.len()]]).or_insert(0) += 1;
        }
    }
    sides.iter().all(|(&[from, to], &count)| count == 1 && sides.get(&[to, from]) == Some(&1))
}
