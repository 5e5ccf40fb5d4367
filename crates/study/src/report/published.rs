//! The published report, for tests that recompute it.

use std::fs;
use std::path::Path;

/// A file of `docs`.
pub(super) fn read(name: &str) -> String {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    fs::read_to_string(docs.join(name)).expect("a published file")
}

/// The lines of numbers of the published file: neither its header nor the names of the columns.
pub(super) fn records() -> Vec<String> {
    let text = read("accuracy.csv");
    text.lines().filter(|line| !line.starts_with('#')).skip(1).map(str::to_owned).collect()
}

/// A line of fields, of which some are quoted.
pub(super) fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut last, mut is_quoted) = (Vec::new(), String::new(), false);
    for letter in line.chars() {
        match letter {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(std::mem::take(&mut last)),
            _ => last.push(letter),
        }
    }
    fields.push(last);
    fields
}
