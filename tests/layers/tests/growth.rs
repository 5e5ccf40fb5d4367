//! Public types that will grow can: see "Types that grow" in `docs/conventions.md`.

use std::fs;
use trigon_layers::{packages, rust_files, workspace};

/// A public struct or enum: its name, the attributes and comments before it, and the file's text.
struct PublicType {
    name: String,
    is_enum: bool,
    before: String,
    file: String,
}

impl PublicType {
    fn has_attribute(&self, attribute: &str) -> bool {
        self.before.lines().any(|line| line.trim() == attribute)
    }

    /// Whether a program can leave fields out: by `Default`, or by a constructor for those that have no default.
    fn has_defaults(&self) -> bool {
        let Self { name, file, before, .. } = self;
        let is_derived = before.lines().any(|line| line.starts_with("#[derive(") && line.contains("Default"));
        let is_written = file.contains(&format!(" Default for {name}"));
        let has_new = file.contains(&format!("impl {name} {{")) && file.contains("pub fn new(");
        is_derived || is_written || has_new
    }
}

/// Those that stand at the start of a line, which the formatter sees to.
fn public_types() -> Vec<PublicType> {
    let mut types = Vec::new();
    for package in packages().expect("folders that can be listed") {
        if package.starts_with(workspace().join("apps")) {
            continue;
        }
        for path in rust_files(&package.join("src")).expect("folders that can be listed") {
            let file = fs::read_to_string(path).expect("a source file");
            for (at, line) in file.match_indices("\npub ").map(|(at, _)| (at + 1, &file[at + 1..])) {
                let (is_enum, rest) = match (line.strip_prefix("pub enum "), line.strip_prefix("pub struct "))
                {
                    (Some(rest), _) => (true, rest),
                    (_, Some(rest)) => (false, rest),
                    _ => continue,
                };
                let name: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
                // What belongs to an item follows the last empty line.
                let before = file[..at].rsplit("\n\n").next().unwrap_or_default().to_owned();
                types.push(PublicType { name, is_enum, before, file: file.clone() });
            }
        }
    }
    types
}

#[test]
fn errors_may_get_further_variants() {
    let types = public_types();
    let errors: Vec<_> = types.iter().filter(|of| of.is_enum && of.before.contains("Error")).collect();
    assert!(errors.len() >= 12, "only {} errors", errors.len());
    let closed: Vec<&str> = errors
        .iter()
        .filter(|of| !of.has_attribute("#[non_exhaustive]"))
        .map(|of| of.name.as_str())
        .collect();
    assert!(closed.is_empty(), "add #[non_exhaustive]: {closed:?}");
}

#[test]
fn options_may_get_further_fields() {
    let endings = ["Settings", "Options", "Limits"];
    let types = public_types();
    let options: Vec<_> =
        types.iter().filter(|of| !of.is_enum && endings.iter().any(|end| of.name.ends_with(end))).collect();
    assert!(options.len() >= 9, "only {} options", options.len());
    let rigid: Vec<&str> = options
        .iter()
        .filter(|of| !of.has_defaults() || of.has_attribute("#[non_exhaustive]"))
        .map(|of| of.name.as_str())
        .collect();
    assert!(rigid.is_empty(), "programs make these with `..Default::default()`: {rigid:?}");
}
