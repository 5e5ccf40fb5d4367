//! cargo-mutants' list of the mutants of a crate.

use crate::error::{Error, Result};
use serde::Deserialize;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The kinds of mutants that cargo-mutants 27 makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
pub(crate) enum Genre {
    /// A function returns a constant at once.
    FnValue,
    BinaryOperator,
    UnaryOperator,
    /// An arm of a `match` is left out.
    MatchArm,
    /// The condition of an arm is always true, or never.
    MatchArmGuard,
    /// A field of a struct expression is left to the `..base`.
    StructField,
}

/// Lines and columns count from 1; columns are characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
pub(crate) struct Position {
    pub(crate) line: usize,
    pub(crate) column: usize,
}

#[derive(Debug, Clone, Deserialize)]
struct Span {
    start: Position,
}

#[derive(Debug, Clone, Deserialize)]
struct Entry {
    file: String,
    genre: Genre,
    name: String,
    replacement: String,
    span: Span,
}

/// One mutant of the list.
#[derive(Debug, Clone)]
pub(crate) struct Mutant {
    /// File and change, and which of several that read alike, without lines and columns: it stays the same when
    /// code around it changes.
    pub(crate) identity: String,
    /// The name of the crate, without `trigon-`.
    pub(crate) krate: &'static str,
    /// From the workspace's root.
    pub(crate) file: String,
    pub(crate) genre: Genre,
    /// What stands there instead.
    pub(crate) replacement: String,
    /// Where the replaced text starts.
    pub(crate) start: Position,
}

/// All mutants of a crate, in the list's order.
pub(crate) fn list(workspace: &Path, krate: &'static str) -> Result<Vec<Mutant>> {
    let package = format!("trigon-{krate}");
    let output = Command::new("cargo")
        .args(["mutants", "--list", "--json", "--in-place", "-p", &package])
        .current_dir(workspace)
        .output()
        .map_err(|error| Error::Program {
            program: "cargo mutants".to_owned(),
            message: error.to_string(),
        })?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(Error::Program { program: "cargo mutants".to_owned(), message });
    }
    let entries: Vec<Entry> = serde_json::from_slice(&output.stdout)
        .map_err(|error| Error::Json { path: PathBuf::from("cargo mutants --list"), error })?;
    Ok(named(entries, krate))
}

fn named(entries: Vec<Entry>, krate: &'static str) -> Vec<Mutant> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let name = |entry: Entry| {
        // "file:line:column: change"
        let change = entry.name.split_once(": ").map_or(entry.name.as_str(), |(_, change)| change);
        let name = format!("{}: {change}", entry.file);
        let count = seen.entry(name.clone()).or_default();
        *count += 1;
        let identity = if *count == 1 { name } else { format!("{name} ({count})") };
        let Entry { file, genre, replacement, span, .. } = entry;
        Mutant { identity, krate, file, genre, replacement, start: span.start }
    };
    entries.into_iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mutants_that_read_alike_are_told_apart() {
        let entry = |line: usize| {
            format!(
                r#"{{"file": "a.rs", "genre": "BinaryOperator", "name": "a.rs:{line}:5: replace + with - in f",
                "replacement": "-", "span": {{"start": {{"line": {line}, "column": 5}}}}}}"#
            )
        };
        let json = format!("[{}, {}]", entry(3), entry(8));
        let mutants = named(serde_json::from_str(&json).expect("entries"), "math");
        let names: Vec<&str> = mutants.iter().map(|mutant| mutant.identity.as_str()).collect();
        assert_eq!(names, ["a.rs: replace + with - in f", "a.rs: replace + with - in f (2)"]);
        assert_eq!(mutants[1].start, Position { line: 8, column: 5 });
    }
}
