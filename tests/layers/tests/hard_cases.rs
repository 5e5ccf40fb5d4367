//! `docs/hard-cases.md` has at least 150 rows, and each names tests that exist where the row says; and oracles import
//! nothing of what they judge, whether they have files of their own or are parts of tests.

use std::collections::BTreeMap;
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

/// All Rust files below a folder, with their texts.
fn files(folder: &Path) -> Vec<(PathBuf, String)> {
    let files = rust_files(folder).expect("folders that can be listed");
    let text = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a source");
        (path, text)
    };
    files.into_iter().map(text).collect()
}

/// The text of all Rust files below a folder.
fn sources(folder: &Path) -> String {
    files(folder).into_iter().map(|(_, text)| text).collect()
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

/// What a test may not take from the engine to judge it: how nodes are placed, how points are projected, which way faces
/// look.
const JUDGED: [&str; 14] = [
    "world_transform",
    "visible_transforms",
    "to_affine",
    ".matrix(",
    "view_projection",
    "Projector",
    "to_screen",
    "to_camera",
    "height_at",
    "is_closed()",
    "is_mirroring",
    "face_area_vector",
    "face_normal",
    "_normals()",
];

/// The files with tests of the table that call these functions all the same, and why the answer is no oracle there.
const NO_ORACLE: [(&str, &[&str], &str); 21] = [
    (
        "apps/viewer/src/framing.rs",
        &["Projector", "to_screen"],
        "framing is judged by projection, which has its own row",
    ),
    ("apps/viewer/src/scenery.rs", &["world_transform"], "the place of a grid is what is judged"),
    ("apps/viewer/src/series.rs", &["world_transform"], "the keyframe that is shown is what is judged"),
    ("crates/camera/tests/behaviour/fit.rs", &["Projector", "to_screen"], "as framing"),
    (
        "crates/camera/tests/behaviour/orbit.rs",
        &["Projector", "to_screen", "height_at"],
        "tests without a row",
    ),
    ("crates/io/tests/import/gltf.rs", &["world_transform"], "the place that was read is what is judged"),
    ("crates/math/src/predicates/tests.rs", &["is_mirroring"], "it is judged, by 128-bit integers"),
    (
        "crates/mesh/tests/mesh/normals.rs",
        &["_normals()", "face_area_vector"],
        "they are judged, by literal numbers",
    ),
    ("crates/mesh/tests/mesh/rendering.rs", &["_normals()"], "what was given, for tests without a row"),
    ("crates/mesh/tests/mesh/tangents.rs", &["_normals()"], "MikkTSpace is given normals"),
    (
        "crates/modelling/src/operations/table_tests/mod.rs",
        &["face_area_vector"],
        "areas of triangles are judged, by that of the outline, which normals.rs judges",
    ),
    ("crates/scene/src/lighting/mod.rs", &["to_camera"], "a parameter"),
    (
        "crates/scene/src/outputs/tests.rs",
        &["Projector", "to_screen", "world_transform"],
        "tests without a row",
    ),
    (
        "crates/scene/src/pick/tests/points.rs",
        &["Projector", "to_screen", "world_transform"],
        "tests without a row",
    ),
    (
        "tests/src/camera.rs",
        &[".matrix(", "view_projection", "Projector", "to_screen", "to_camera"],
        "they are judged, by the projections' fields; bounds on rounding are scaled by them",
    ),
    (
        "tests/src/hard_cases/depth.rs",
        &[".matrix(", "height_at"],
        "it makes input, and its depths are judged",
    ),
    ("tests/src/hard_cases/edits.rs", &["to_affine"], "it is judged, by its own value at the start"),
    (
        "tests/src/hard_cases/near_plane.rs",
        &[".matrix("],
        "it makes input: what is drawn is judged in clip space",
    ),
    ("tests/src/hard_cases/texture_detail.rs", &[".matrix("], "as near_plane.rs"),
    ("tests/src/hard_cases/transforms.rs", &["world_transform", "visible_transforms"], "they are judged"),
    ("tests/src/scene.rs", &["world_transform", "visible_transforms"], "they are judged"),
];

/// The files that hold tests of rows.
fn files_of(rows: &[Row]) -> BTreeMap<PathBuf, String> {
    let mut folders = BTreeMap::new();
    let mut found = BTreeMap::new();
    for row in rows {
        let mut folder = workspace().join("tests/src");
        for name in row.test.split('`').skip(1).step_by(2) {
            if let Some(package_name) = name.strip_prefix("trigon-") {
                folder = package(package_name);
                continue;
            }
            let start = format!("fn {}(", name.rsplit("::").next().unwrap_or(name));
            let all = folders.entry(folder.clone()).or_insert_with(|| files(&folder));
            found.extend(all.iter().filter(|(_, text)| text.contains(&start)).cloned());
        }
    }
    found
}

#[test]
fn tests_of_hard_cases_judge_by_nothing_of_the_engine() {
    let mut found = Vec::new();
    for (path, text) in &files_of(&rows()) {
        let path = path.strip_prefix(workspace()).expect("within the workspace").to_string_lossy();
        // A module of tests within a source is at its end.
        let tests = text.split_once("#[cfg(test)]").map_or(text.as_str(), |(_, tests)| tests);
        let code = tests.lines().filter(|line| !line.trim_start().starts_with("//"));
        let code: String = code.flat_map(|line| [line, "\n"]).collect();
        found.extend(JUDGED.iter().filter(|word| code.contains(*word)).map(|word| (path.to_string(), *word)));
    }
    let is_listed = |(path, word): &(String, &str)| {
        NO_ORACLE.iter().any(|(p, words, _)| p == path && words.contains(word))
    };
    let faults: Vec<_> = found.iter().filter(|call| !is_listed(call)).collect();
    assert!(faults.is_empty(), "compute it in the test, or say here why it is no oracle: {faults:#?}");
    let calls =
        NO_ORACLE.iter().flat_map(|(path, words, _)| words.iter().map(|word| ((*path).to_owned(), *word)));
    let gone: Vec<_> = calls.filter(|call| !found.contains(call)).collect();
    assert!(gone.is_empty(), "no longer called: {gone:#?}");
}
