//! Patches in the unified format of `git diff`, and whether they apply to the files of a folder.

use std::fs;
use std::path::Path;

/// What a patch file holds.
#[derive(Debug)]
pub struct Patch {
    /// The lines before the first file.
    pub description: Vec<String>,
    /// In the order of the patch.
    pub files: Vec<FilePatch>,
}

/// The changes of one file.
#[derive(Debug)]
pub struct FilePatch {
    /// Relative to the repository's root.
    pub path: String,
    /// Whether the patch makes the file.
    pub is_new: bool,
    /// The lines that each hunk expects, context and removed ones, in a row.
    expected: Vec<Vec<String>>,
}

impl Patch {
    /// Reads the text of a patch.
    #[must_use]
    pub fn parse(text: &str) -> Self {
        let mut patch = Self { description: Vec::new(), files: Vec::new() };
        for line in text.lines() {
            if let Some(paths) = line.strip_prefix("diff --git ") {
                let path = paths.split(" b/").last().unwrap_or_default().to_owned();
                patch.files.push(FilePatch { path, is_new: false, expected: Vec::new() });
            } else if let Some(file) = patch.files.last_mut() {
                file.read(line);
            } else {
                patch.description.push(line.to_owned());
            }
        }
        patch
    }
}

impl FilePatch {
    fn read(&mut self, line: &str) {
        match (self.expected.last_mut(), line.as_bytes().first()) {
            (_, Some(b'@')) => self.expected.push(Vec::new()),
            (Some(hunk), Some(b' ' | b'-')) => hunk.push(line[1..].to_owned()),
            (None, _) if line.starts_with("new file mode") => self.is_new = true,
            _ => {}
        }
    }

    /// Why it does not apply to the file below a folder; `None` if it does. Each hunk has to find its lines
    /// behind those of the hunk before.
    #[must_use]
    pub fn fault(&self, root: &Path) -> Option<String> {
        let path = root.join(&self.path);
        if self.is_new {
            return path.exists().then(|| format!("{} exists", self.path));
        }
        let Ok(text) = fs::read_to_string(&path) else { return Some(format!("{} is missing", self.path)) };
        let lines: Vec<&str> = text.lines().collect();
        let mut after = 0;
        for (number, hunk) in (1..).zip(&self.expected) {
            let is_here = |&at: &usize| lines[at..at + hunk.len()].iter().zip(hunk).all(|(a, b)| a == b);
            let place = (after..(lines.len() + 1).saturating_sub(hunk.len())).find(is_here);
            let Some(at) = place else { return Some(format!("{}: hunk {number} does not apply", self.path)) };
            after = at + hunk.len();
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_applies_where_its_lines_stand() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let patch = |line: &str| {
            let text = format!(
                "What it does.\n\ndiff --git a/Cargo.toml b/Cargo.toml\n--- a/Cargo.toml\n+++ b/Cargo.toml\n@@ -1,2 +1,3 @@\n {line}\n+added = true\n"
            );
            Patch::parse(&text)
        };
        let sound = patch("[package]");
        assert_eq!(sound.description, ["What it does.", ""], "before the first file");
        assert_eq!(sound.files[0].path, "Cargo.toml", "the file");
        assert_eq!(sound.files[0].fault(folder), None, "its line is there");
        let fault = patch("[another]").files[0].fault(folder);
        assert_eq!(fault.as_deref(), Some("Cargo.toml: hunk 1 does not apply"), "a line that is not there");
    }
}
