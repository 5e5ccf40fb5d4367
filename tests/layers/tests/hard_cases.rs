//! `docs/hard-cases.md` has at least 150 rows, and each names tests that exist where the row says; and oracles import
//! nothing of what they judge.

use std::fs;
use std::path::{Path, PathBuf};
use trigon_layers::{rust_files, workspace};

/// A row of a table of cases.
struct Row {
    case: String,
    test: String,
}

/// The rows of all tables whose first column is the case.
fn rows() -> Vec<Row> {
    let page = fs::read_to_string(workspace().join("docs/hard-cases.md")).expect("the page");
    let mut header: Option<Vec<&str>> = None;
    let mut rows = Vec::new();
    for line in page.lines() {
        if !line.starts_with('|') {
            header = None;
            continue;
        }
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let Some(names) = &header else {
            header = Some(cells);
            continue;
        };
        let is_case = names.first() == Some(&"case") && !line.starts_with("|--");
        if let (true, Some(column)) = (is_case, names.iter().position(|name| *name == "test")) {
            assert_eq!(cells.len(), names.len(), "as many cells as columns: {line}");
            rows.push(Row { case: cells[0].to_owned(), test: cells[column].to_owned() });
        }
    }
    rows
}

/// The text of all Rust files below a folder.
fn sources(folder: &Path) -> String {
    let files = rust_files(folder).expect("folders that can be listed");
    files.iter().map(|path| fs::read_to_string(path).expect("a source")).collect()
}

/// The folder of a package: a crate, or else an application.
fn package(name: &str) -> PathBuf {
    let folders = ["crates", "apps"].map(|parent| workspace().join(parent).join(name));
    folders.into_iter().find(|folder| folder.is_dir()).unwrap_or_else(|| panic!("no package {name}"))
}

/// What a row names that is no test. A name after that of a package is a test of that package.
fn missing(row: &Row) -> Vec<String> {
    let mut text = sources(&workspace().join("tests/src"));
    let (mut missing, mut count) = (Vec::new(), 0);
    for name in row.test.split('`').skip(1).step_by(2) {
        if let Some(package_name) = name.strip_prefix("trigon-") {
            text = sources(&package(package_name));
            continue;
        }
        count += 1;
        let function = name.rsplit("::").next().unwrap_or(name);
        // All tests of a module, or one.
        let is_there = match name.strip_suffix("::*") {
            Some(module) => {
                let module = module.rsplit("::").next().unwrap_or(module);
                text.contains(&format!("mod {module};"))
            }
            None => {
                text.contains(&format!("fn {function}("))
                    || text.contains(&format!("{function}:"))
                    || text.contains(&format!("{function},"))
            }
        };
        if !is_there {
            missing.push(name.to_owned());
        }
    }
    if count == 0 {
        missing.push("a test".to_owned());
    }
    missing
}

#[test]
fn there_are_150_hard_cases_or_more() {
    let count = rows().len();
    assert!(count >= 150, "{count} rows");
}

#[test]
fn every_hard_case_names_tests_that_exist() {
    let fault = |row: &Row| {
        let missing = missing(row);
        (!missing.is_empty()).then(|| format!("`{}` names {missing:?}", row.case))
    };
    let faults: Vec<String> = rows().iter().filter_map(fault).collect();
    assert!(faults.is_empty(), "{faults:#?}");
}

/// What oracles may import: numbers of other crates, vectors of glam (which `trigon_math` hands on), each other, and the
/// types that hold the data that they read.
const DATA: [&str; 4] = ["std::", "num_", "super::", "crate::oracle"];

/// The oracles of whole images: where they are, and the types of data that they read.
const IMAGES: [(&str, &[&str]); 4] = [
    (
        "tests/src/hard_cases/flight_oracle.rs",
        &[
            "trigon_camera::{Camera, Projection}",
            "trigon_mesh::Mesh",
            "trigon_scene::{Node, NodeId, Scene, Transform}",
        ],
    ),
    ("tests/src/hard_cases/flight_facet.rs", &[]),
    ("crates/scene/src/pick/tests/grid.rs", &[]),
    (
        "crates/scene/src/pick/tests/oracle.rs",
        &[
            "trigon_camera::{Camera, Projection}",
            "trigon_mesh::Mesh",
            "crate::{NodeId, Scene, Transform}",
            "super::super::Region",
            "Answer::{No, Open, Yes}",
        ],
    ),
];

/// Vectors and matrices of glam, by the names under which `trigon_math` hands them on.
const VECTORS: [&str; 8] = ["DAffine3", "DMat3", "DQuat", "DVec2", "DVec3", "UVec2", "Vec4", "Vec3"];

/// What of an oracle's text is the engine's doing rather than data.
const DOINGS: [&str; 8] = [
    "world_transform",
    "to_affine",
    ".matrix(",
    "view_projection",
    "is_closed()",
    "Projector",
    ".bounds()",
    "is_mirroring",
];

/// What the file imports that is neither data nor a vector, and the engine's functions that it calls.
fn of_the_engine(text: &str, data: &[&str]) -> Vec<String> {
    // What tests of the oracle itself import is no matter.
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let imports = text.split("\nuse ").skip(1).map(|rest| rest.split(';').next().unwrap_or_default());
    let is_foreign = |import: &&str| {
        let is_data = DATA.iter().any(|start| import.starts_with(start)) || data.contains(import);
        let vectors = import.strip_prefix("trigon_math::").map(|names| names.trim_matches(['{', '}']));
        !is_data && !vectors.is_some_and(|names| names.split(", ").all(|name| VECTORS.contains(&name)))
    };
    let foreign = imports.filter(is_foreign).map(str::to_owned);
    foreign
        .chain(DOINGS.iter().filter(|doing| text.contains(*doing)).map(|doing| (*doing).to_owned()))
        .collect()
}

#[test]
fn oracles_import_nothing_of_what_they_judge() {
    let folder = workspace().join("crates/study/src/oracle");
    let exact =
        rust_files(&folder).expect("a folder that can be listed").into_iter().map(|path| (path, &[][..]));
    let images = IMAGES.iter().map(|(path, data)| (workspace().join(path), *data));
    let fault = |(path, data): (PathBuf, &[&str])| {
        let found = of_the_engine(&fs::read_to_string(&path).expect("a source"), data);
        (!found.is_empty()).then(|| format!("{} has {found:?}", path.display()))
    };
    let faults: Vec<String> = exact.chain(images).filter_map(fault).collect();
    assert!(faults.is_empty(), "{faults:#?}");
}
