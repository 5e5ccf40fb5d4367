//! Identifiers use the glossary's exact words, and no crate has two types of one name.

use trigon_layers::{Crate, glossary_violations, packages};

/// Crates that still have everyday words or names that two types share. This list only shrinks: a crate that
/// has none left is taken out.
const NOT_YET_RENAMED: [&str; 7] = ["document", "editor", "io", "mesh", "raster", "scene", "study"];

#[test]
fn identifiers_use_exact_words() {
    let mut faults = String::new();
    for folder in packages().expect("folders that can be listed") {
        let name = folder.file_name().expect("not the root").to_string_lossy().into_owned();
        let roots = ["lib.rs", "main.rs"].map(|root| folder.join("src").join(root));
        let mut violations = Vec::new();
        for root in roots.iter().filter(|root| root.is_file()) {
            let of = Crate::read(root).expect("files that parse");
            violations.extend(glossary_violations(&of).expect("files that parse"));
        }
        match (NOT_YET_RENAMED.contains(&name.as_str()), violations.is_empty()) {
            (true, true) => faults.push_str(&format!("{name} has none left: take it out of the list\n")),
            (false, false) => faults.extend(violations.iter().map(|fault| format!("{name}: {fault}\n"))),
            _ => {}
        }
    }
    assert!(faults.is_empty(), "use exact words:\n{faults}");
}
