//! No circle of files crosses folders in a crate, and within a folder none holds more than four. No folder needs
//! another folder or file beside it that needs it in turn, and no top-level module needs one that needs it.

use std::path::PathBuf;
use trigon_layers::{Circle, Crate, circles, folder_circles, packages};

/// The root files of all crates and apps, by the names of their folders.
fn roots() -> Vec<(String, PathBuf)> {
    let folders = packages().expect("folders that can be listed");
    let roots = folders.into_iter().flat_map(|folder| {
        let name = folder.file_name().expect("not the root").to_string_lossy().into_owned();
        ["lib.rs", "main.rs"].map(|root| (name.clone(), folder.join("src").join(root)))
    });
    let mut roots: Vec<(String, PathBuf)> = roots.filter(|(_, root)| root.is_file()).collect();
    roots.sort();
    roots
}

fn is_fault(circle: &Circle) -> bool {
    circle.folder_count > 1 || circle.files.len() > 4
}

#[test]
fn folders_depend_on_each_other_one_way() {
    let roots = roots();
    assert!(roots.len() >= 13, "eleven crates and two apps: {roots:?}");
    let (mut faults, mut files) = (String::new(), 0);
    for (name, root) in &roots {
        let of = Crate::read(root).expect("files that parse");
        files += of.file_count();
        let circles: Vec<Circle> = circles(&of).into_iter().filter(is_fault).collect();
        faults.extend(circles.iter().map(|circle| format!("{name}: {circle}")));
    }
    assert!(files > 900, "only {files} files were read");
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn no_folder_needs_one_that_needs_it() {
    let circles = roots().into_iter().flat_map(|(name, root)| {
        let circles = folder_circles(&Crate::read(&root).expect("files that parse"));
        circles.into_iter().map(move |circle| format!("{name}/src/{circle}"))
    });
    assert_eq!(circles.collect::<Vec<_>>(), [""; 0], "parts of a folder that need each other");
}
