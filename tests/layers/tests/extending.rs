//! The patches of `docs/extending` apply, and `docs/extending.md` names the files that each one touches. Whether
//! they compile and pass their tests, `.ci/extending` tries.

use std::collections::BTreeSet;
use std::fs;
use trigon_layers::{Patch, workspace};

/// Each patch, and how many files it may touch.
const PATCHES: [(&str, usize); 4] =
    [("sheen.patch", 4), ("file-format.patch", 3), ("viewer-key.patch", 2), ("edit-operation.patch", 3)];

fn patch(name: &str) -> Patch {
    let text = fs::read_to_string(workspace().join("docs/extending").join(name)).expect("a patch");
    Patch::parse(&text)
}

#[test]
fn patches_apply_and_touch_few_files() {
    let folder = workspace().join("docs/extending").read_dir().expect("a folder of patches");
    assert_eq!(folder.count(), PATCHES.len(), "every patch is listed here");
    for (name, most) in PATCHES {
        let patch = patch(name);
        assert!((1..=most).contains(&patch.files.len()), "{name} touches {} files", patch.files.len());
        let faults: Vec<String> = patch.files.iter().filter_map(|file| file.fault(&workspace())).collect();
        assert!(faults.is_empty(), "make docs/extending/{name} anew, .ci/extending says how: {faults:?}");
        let has_test = patch.description.iter().any(|line| line.starts_with("Test: cargo test "));
        assert!(has_test, "{name} says how it is tested, before its first file");
    }
}

#[test]
fn the_guide_names_the_files_of_each_patch() {
    let guide = fs::read_to_string(workspace().join("docs/extending.md")).expect("the guide");
    for (name, _) in PATCHES {
        let (_, after) = guide.split_once(&format!("(extending/{name})")).expect("a link to each patch");
        let section = after.split("\n## ").next().unwrap_or_default();
        let bullets = section.lines().filter_map(|line| line.strip_prefix("- `")?.split('`').next());
        let named: BTreeSet<&str> = bullets.collect();
        let patch = patch(name);
        let touched: BTreeSet<&str> = patch.files.iter().map(|file| file.path.as_str()).collect();
        assert_eq!(named, touched, "files of {name}");
    }
}
