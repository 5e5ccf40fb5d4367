//! Every crate and app can be published: its manifest says what registries and docs.rs show, its README's examples
//! are tests, and it includes no file from outside of its folder. `.ci/package` builds the packages themselves.

use std::fs;
use std::path::Path;
use trigon_layers::{packages, rust_files, workspace};

const KEYS: [&str; 8] = [
    "description = ",
    "readme = \"README.md\"",
    "documentation = \"https://docs.rs/trigon-",
    "license.workspace = true",
    "categories.workspace = true",
    "keywords.workspace = true",
    "rust-version",
    "[package.metadata.docs.rs]",
];

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn manifests_say_what_registries_show() {
    for package in packages().expect("folders that can be listed") {
        let manifest = text(&package.join("Cargo.toml"));
        let missing: Vec<&str> = KEYS.into_iter().filter(|key| !manifest.contains(key)).collect();
        assert!(missing.is_empty(), "{}/Cargo.toml: {missing:?}", package.display());
    }
    let manifest = text(&workspace().join("Cargo.toml"));
    let own: Vec<&str> = manifest.lines().filter(|line| line.starts_with("trigon-")).collect();
    let own = own.iter().filter(|line| line.contains("path = "));
    assert!(own.clone().count() >= 11, "eleven crates");
    let without: Vec<_> = own.filter(|line| !line.contains("version = ")).collect();
    assert!(without.is_empty(), "a package finds its dependencies by their versions: {without:?}");
}

#[test]
fn examples_of_readmes_are_tests() {
    for package in packages().expect("folders that can be listed") {
        let readme = text(&package.join("README.md"));
        if readme.contains("```rust") {
            let root = text(&package.join("src/lib.rs"));
            let is_tested = root.contains("#[cfg(doctest)]\n#[doc = include_str!(\"../README.md\")]");
            assert!(is_tested, "{}/src/lib.rs runs no examples of README.md", package.display());
        } else {
            assert!(package.starts_with(workspace().join("apps")), "{}: no example", package.display());
        }
    }
}

/// Files that a source file includes at compile time, as they are written there.
fn included(source: &str) -> impl Iterator<Item = &str> {
    source.split("include").skip(1).filter_map(|rest| {
        let rest = ["!(\"", "_str!(\"", "_bytes!(\""].iter().find_map(|start| rest.strip_prefix(start))?;
        rest.split('"').next()
    })
}

#[test]
fn packages_include_no_file_from_outside() {
    let (mut count, mut faults) = (0, Vec::new());
    for package in packages().expect("folders that can be listed") {
        for path in rust_files(&package).expect("folders that can be listed") {
            // Each `..` leaves a folder, from the one of the source file upwards.
            let depth = path.strip_prefix(&package).expect("within the package").components().count() - 1;
            for name in included(&text(&path)) {
                count += 1;
                let is_outside = name.split('/').filter(|part| *part == "..").count() > depth;
                faults.extend(is_outside.then(|| format!("{}: {name}", path.display())));
            }
        }
    }
    assert!(count >= 10, "only {count} files are included");
    assert!(
        faults.is_empty(),
        "read these files when the test runs, or move them into the package: {faults:#?}"
    );
}
