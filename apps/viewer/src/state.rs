//! State files: the files and flags of a view, as JSON.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde_json::Value;
#[cfg(feature = "window")]
use serde_json::{Map, json};

/// The format that is written, and the only one that is read.
const FORMAT: &str = "trigon state 1";

/// What a window shows, as a command line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct State {
    pub(crate) files: Vec<PathBuf>,
    /// `--flag=value`, one word each.
    pub(crate) flags: Vec<String>,
}

impl State {
    /// Reads a file.
    ///
    /// # Errors
    /// When it cannot be read or is no state file, with its name.
    pub(crate) fn read(path: &Path) -> Result<Self, String> {
        let named = |why: String| format!("{}: {why}", path.display());
        let text = std::fs::read_to_string(path)
            .map_err(|error| named(format!("cannot be read ({error}); check the name")))?;
        Self::from_json(&text).map_err(named)
    }

    fn from_json(text: &str) -> Result<Self, String> {
        let no_state = |why: &str| format!("is no state file ({why}); save one with Ctrl+S in the window");
        let json: Value = serde_json::from_str(text).map_err(|error| no_state(&error.to_string()))?;
        if json["format"] != FORMAT {
            return Err(no_state(&format!("its format is not {FORMAT:?}")));
        }
        let texts = |value: &Value| -> Option<Vec<String>> {
            value.as_array()?.iter().map(|text| text.as_str().map(str::to_owned)).collect()
        };
        let files = texts(&json["files"]).ok_or_else(|| no_state("it has no list of files"))?;
        let options = json["options"].as_object().ok_or_else(|| no_state("it has no options"))?;
        let mut flags = Vec::new();
        for (flag, value) in options {
            let values = match value {
                Value::String(text) => vec![text.clone()],
                other => texts(other).ok_or_else(|| no_state(&format!("{flag} is no text")))?,
            };
            flags.extend(values.into_iter().map(|value| format!("--{flag}={value}")));
        }
        Ok(Self { files: files.into_iter().map(PathBuf::from).collect(), flags })
    }

    /// The words of a command line; files that are named elsewhere take the place of its own.
    pub(crate) fn words(&self, has_files: bool) -> Vec<OsString> {
        let files = self.files.iter().filter(|_| !has_files).map(OsString::from);
        self.flags.iter().map(OsString::from).chain(files).collect()
    }
}

#[cfg(feature = "window")]
impl State {
    /// Writes a file; an old one is replaced at once.
    pub(crate) fn write(&self, path: &Path) -> Result<(), trigon_io::WriteError> {
        let text = self.to_json();
        trigon_io::write_atomically(path, |file| file.write_all(text.as_bytes()))
    }

    fn to_json(&self) -> String {
        let mut options = Map::new();
        for flag in &self.flags {
            let (name, value) = flag.trim_start_matches('-').split_once('=').unwrap_or((flag, "true"));
            let value = Value::from(value);
            match options.get_mut(name) {
                None => drop(options.insert(name.to_owned(), value)),
                Some(Value::Array(list)) => list.push(value),
                Some(first) => *first = json!([first.take(), value]),
            }
        }
        let files: Vec<_> = self.files.iter().map(|file| file.to_string_lossy()).collect();
        let json = json!({"format": FORMAT, "files": files, "options": options});
        format!("{json:#}\n")
    }

    /// As a line for a shell.
    pub(crate) fn command(&self) -> String {
        let files = self.files.iter().map(|file| file.to_string_lossy().into_owned());
        let words = files.chain(self.flags.iter().cloned()).map(|word| quoted(&word));
        let words: Vec<String> = std::iter::once("trigon-viewer".to_owned()).chain(words).collect();
        words.join(" ")
    }
}

/// In single quotes if a shell would read it otherwise.
#[cfg(feature = "window")]
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_=+./,:@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(all(test, feature = "window"))]
mod tests {
    use super::*;

    #[test]
    fn states_come_back_from_their_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.json");
        let state = State {
            files: vec!["/a b/c'd.glb".into()],
            flags: ["--color=#f80", "--outputs=a", "--outputs=b", "--outputs=c", "--up=+Z"]
                .map(str::to_owned)
                .to_vec(),
        };
        state.write(&path).expect("written");
        assert_eq!(State::read(&path), Ok(state.clone()), "as it was");
        let expected =
            r"trigon-viewer '/a b/c'\''d.glb' '--color=#f80' --outputs=a --outputs=b --outputs=c --up=+Z";
        assert_eq!(state.command(), expected, "for a shell");
        assert_eq!(state.words(true).len(), 5, "the files may be others");
    }

    #[test]
    fn what_is_no_state_says_so() {
        for text in [
            "",
            "[]",
            "{}",
            r#"{"format": "trigon state 9"}"#,
            r#"{"format": "trigon state 1"}"#,
            r#"{"format": "trigon state 1", "files": [1], "options": {}}"#,
            r#"{"format": "trigon state 1", "files": [], "options": {"up": 3}}"#,
        ] {
            let message = State::from_json(text).expect_err("no state");
            assert!(message.contains("Ctrl+S"), "{text}: {message}");
        }
        let message = State::read(Path::new("/nowhere/a.json")).expect_err("it is not there");
        assert!(message.contains("/nowhere/a.json"), "{message}");
    }
}
