//! Identifiers use the glossary's exact words, and no crate has two types of one name.

use trigon_layers::{Crate, NameFaults, packages};

/// Crates that still have everyday words. This list only shrinks: a crate that has none left is taken out.
const NOT_YET_RENAMED: [&str; 0] = [];
/// Crates in which two types still share a name. This list only shrinks, too.
const WITH_SHARED_TYPE_NAMES: [&str; 0] = [];

/// What is wrong with a crate, given what was found and whether the crate is listed as not done.
fn faults(name: &str, found: &[String], is_listed: bool) -> Vec<String> {
    match (is_listed, found.is_empty()) {
        (true, true) => vec![format!("{name} has none left: take it out of the list\n")],
        (false, false) => found.iter().map(|fault| format!("{name}: {fault}\n")).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn names_are_exact() {
    let mut wrong = String::new();
    for folder in packages().expect("folders that can be listed") {
        let name = folder.file_name().expect("not the root").to_string_lossy().into_owned();
        let roots = ["lib.rs", "main.rs"].map(|root| folder.join("src").join(root));
        let mut found = NameFaults::default();
        for root in roots.iter().filter(|root| root.is_file()) {
            let of = NameFaults::of(&Crate::read(root).expect("files that parse")).expect("files that parse");
            found.words.extend(of.words);
            found.shared_types.extend(of.shared_types);
        }
        wrong.extend(faults(&name, &found.words, NOT_YET_RENAMED.contains(&name.as_str())));
        wrong.extend(faults(&name, &found.shared_types, WITH_SHARED_TYPE_NAMES.contains(&name.as_str())));
    }
    assert!(wrong.is_empty(), "use exact words:\n{wrong}");
}
