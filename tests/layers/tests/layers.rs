//! No circle of files crosses folders in any crate, and within a folder none holds more than four.

use std::path::{Path, PathBuf};
use trigon_layers::{Crate, circles};

/// The root files of all crates and apps.
fn roots() -> Vec<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folders = ["crates", "apps"].map(|part| workspace.join(part).read_dir().unwrap());
    let sources = folders.into_iter().flatten().map(|entry| entry.unwrap().path().join("src"));
    let roots = sources.flat_map(|source| [source.join("lib.rs"), source.join("main.rs")]);
    let mut roots: Vec<PathBuf> = roots.filter(|root| root.is_file()).collect();
    roots.sort();
    roots
}

#[test]
fn folders_depend_on_each_other_one_way() {
    let roots = roots();
    assert!(roots.len() >= 11, "nine crates and two apps: {roots:?}");
    let mut faults = String::new();
    for root in roots {
        let of = Crate::read(&root).unwrap();
        for circle in circles(&of) {
            if circle.folder_count > 1 || circle.files.len() > 4 {
                faults += &format!("{} ({} files): {circle}", root.display(), of.file_count());
            }
        }
    }
    assert!(faults.is_empty(), "{faults}");
}
