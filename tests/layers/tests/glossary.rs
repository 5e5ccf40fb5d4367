//! Identifiers use the glossary's exact words, and no crate has two types of one name.

use trigon_layers::{Crate, NameFaults, packages};

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
        let found = found.words.iter().chain(&found.shared_types);
        wrong.extend(found.map(|fault| format!("{name}: {fault}\n")));
    }
    assert!(wrong.is_empty(), "use exact words:\n{wrong}");
}
