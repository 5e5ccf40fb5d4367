//! No circle of files crosses folders in a crate, and within a folder none holds more than four. The circles of top-level
//! modules, each with its folder, are those listed here.

use std::path::PathBuf;
use trigon_layers::{Circle, Crate, circles, module_circles, packages};

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
    assert!(roots.len() >= 11, "nine crates and two apps: {roots:?}");
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

/// Top-level modules that need each other although none of their files do. `docs/architecture.md` says why; a change that
/// adds one to a circle shows here.
const MODULE_CIRCLES: [(&str, &str); 5] = [
    ("edit", "command document"),
    ("io", "export formats load"),
    ("raster", "bin ink line pass pipeline point resolve setup shade tile vertex view"),
    ("scene", "effects frame outputs render settings"),
    ("scene", "node skin"),
];

#[test]
fn top_level_modules_form_the_known_circles() {
    let circles = roots().into_iter().flat_map(|(name, root)| {
        let circles = module_circles(&Crate::read(&root).expect("files that parse"));
        circles.into_iter().map(move |circle| (name.clone(), circle.join(" ")))
    });
    let found: Vec<(String, String)> = circles.collect();
    let known = MODULE_CIRCLES.map(|(name, circle)| (name.to_owned(), circle.to_owned()));
    assert_eq!(found, known, "the circles of modules");
}
