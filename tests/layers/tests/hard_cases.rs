//! `docs/hard-cases.md` has at least 150 rows, and each names tests that exist where the row says.

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
