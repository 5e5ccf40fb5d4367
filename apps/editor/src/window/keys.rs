//! Key bindings: the default chords, and the changes in a user's file.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use serde_json::Value;
use thiserror::Error;
use trigon_window::{Chord, Key, Modifiers};

use super::actions::{self, Action};

/// Undo is always here, whatever a file says.
const UNDO: Chord = Chord::new(Modifiers::CTRL, Key::Character('z'));

/// The chords of all actions.
#[derive(Debug)]
pub(crate) struct Keys {
    bound: Vec<(Chord, &'static Action)>,
    /// Whether the digits above the letters stand for those of the number pad.
    pub(crate) emulates_numpad: bool,
}

/// A keymap file cannot be used.
#[derive(Debug, PartialEq, Eq, Error)]
#[error("line {line}: {what}")]
pub(crate) struct KeymapError {
    /// From 1.
    pub(crate) line: usize,
    pub(crate) what: String,
}

impl Default for Keys {
    fn default() -> Self {
        Self { bound: defaults().collect(), emulates_numpad: false }
    }
}

fn defaults() -> impl Iterator<Item = (Chord, &'static Action)> {
    actions::all().flat_map(|action| {
        let chords = action.keys.split_whitespace();
        chords.map(move |text| (text.parse().expect("a test reads the table's chords"), action))
    })
}

impl Keys {
    /// The table's chords with those of a file in their place: a JSON object from the names of actions to
    /// chords with spaces between them. Also tells what in it cannot be used and is left out: the action then has its
    /// other chords, or those of the table if it has none.
    ///
    /// # Errors
    /// It is no JSON object.
    pub(crate) fn from_json(text: &str) -> Result<(Self, Vec<String>), KeymapError> {
        let entries: BTreeMap<String, Value> = serde_json::from_str(text)
            .map_err(|error| KeymapError { line: error.line(), what: error.to_string() })?;
        let mut warnings = Vec::new();
        let undo = actions::named("edit.undo").expect("it is in the table");
        let mut chosen: Vec<(Chord, &Action)> = vec![(UNDO, undo)];
        let mut replaced = Vec::new();
        for (name, value) in &entries {
            let line = line_of(text, name);
            let Some(action) = actions::named(name) else {
                warnings.push(format!("line {line}: no action is called {name:?}; --print-keymap lists all"));
                continue;
            };
            let (usable, faults): (Vec<_>, Vec<_>) = chords(value, action).partition(Result::is_ok);
            let faults: Vec<String> = faults.into_iter().filter_map(Result::err).collect();
            // An action with an empty text has no chord; one whose chords are all wrong keeps those of the table.
            if !usable.is_empty() || faults.is_empty() {
                replaced.push(action.name);
            }
            chosen.extend(usable.into_iter().flatten().map(|chord| (chord, action)));
            warnings.extend(faults.into_iter().map(|what| format!("line {line}: {name}: {what}")));
        }
        let free = defaults().filter(|&(chord, action)| {
            let is_taken = |&(taken, by): &(Chord, &Action)| taken == chord && share_a_mode(by, action);
            !replaced.contains(&action.name) && !chosen.iter().any(is_taken)
        });
        let mut bound = chosen.clone();
        bound.extend(free);
        Ok((Self { bound, emulates_numpad: false }, warnings))
    }

    /// What a key does in the mode that the document is in; else what it would do in the other.
    pub(crate) fn find(&self, chord: Chord, is_editing: bool) -> Option<&'static Action> {
        let chord = self.on_pad(chord);
        let mut found = self.bound.iter().filter(|(bound, _)| *bound == chord).map(|(_, action)| *action);
        let first = found.clone().next();
        found.find(|action| action.fits_mode(is_editing)).or(first)
    }

    fn on_pad(&self, chord: Chord) -> Chord {
        match chord.key {
            Key::Character(digit @ '0'..='9') if self.emulates_numpad => {
                Chord { key: Key::Numpad(digit), ..chord }
            }
            _ => chord,
        }
    }

    /// The chords of an action as menus show them.
    pub(crate) fn text_of(&self, action: &Action) -> String {
        let mut chords: Vec<String> = Vec::new();
        for (chord, _) in self.bound.iter().filter(|(_, bound)| bound.name == action.name) {
            let text = chord.to_string();
            if !chords.contains(&text) {
                chords.push(text);
            }
        }
        chords.join(", ")
    }
}

/// All actions with the table's chords, as a file that [`Keys::from_json`] reads.
pub(crate) fn print() -> String {
    let mut text = String::from("{\n");
    let count = actions::all().count();
    for (index, action) in actions::all().enumerate() {
        let comma = if index + 1 == count { "" } else { "," };
        writeln!(text, "  {:?}: {:?}{comma}", action.name, action.keys).expect("strings take all");
    }
    text + "}"
}

/// The chords of an action in a file, each by itself, or why it is none.
fn chords(value: &Value, action: &Action) -> impl Iterator<Item = Result<Chord, String>> {
    let (text, fault) = match value {
        Value::String(text) => (text.as_str(), None),
        _ => ("", Some(format!("write chords as text, as \"Ctrl+S F2\", instead of {value}"))),
    };
    let chord = move |text: &str| match text.parse::<Chord>() {
        Ok(chord) if chord == UNDO && action.name != "edit.undo" => {
            Err(format!("{UNDO} is always undo; use another key"))
        }
        Ok(chord) => Ok(chord),
        Err(error) => Err(error.to_string()),
    };
    text.split_whitespace().map(chord).chain(fault.map(Err))
}

/// Whether two actions fit one of the modes.
fn share_a_mode(one: &Action, other: &Action) -> bool {
    [false, true].iter().any(|&is_editing| one.fits_mode(is_editing) && other.fits_mode(is_editing))
}

/// The line, from 1, in which a name stands.
fn line_of(text: &str, name: &str) -> usize {
    let quoted = format!("{name:?}");
    text.lines().position(|line| line.contains(&quoted)).map_or(1, |index| index + 1)
}

/// Where a user's keymap is.
pub(crate) fn file() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = |path: &str| std::env::home_dir().map(|home| home.join(path));
    let folder = if cfg!(target_os = "windows") {
        variable("APPDATA")
    } else if cfg!(target_os = "macos") {
        home("Library/Application Support")
    } else {
        variable("XDG_CONFIG_HOME").or_else(|| home(".config"))
    };
    folder.map(|folder| folder.join("trigon").join("editor-keymap.json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn action_at(keys: &Keys, chord: &str, is_editing: bool) -> Option<&'static str> {
        keys.find(chord.parse().expect("a chord"), is_editing).map(|action| action.name)
    }

    #[test]
    fn a_chord_means_what_fits_the_mode() {
        let keys = Keys::default();
        assert_eq!(action_at(&keys, "X", false), Some("edit.delete"), "objects");
        assert_eq!(action_at(&keys, "X", true), Some("delete.menu"), "elements");
        assert_eq!(action_at(&keys, "I", false), Some("mesh.inset"), "which can then say why not");
        assert_eq!(action_at(&keys, "Ctrl+Alt+F12", true), None, "nothing");
    }

    #[test]
    fn the_printed_keymap_is_the_default_one() {
        let (keys, warnings) = Keys::from_json(&print()).expect("it is one");
        assert_eq!(warnings, [""; 0], "all is known");
        for action in actions::all() {
            assert_eq!(keys.text_of(action), Keys::default().text_of(action), "{}", action.name);
        }
    }

    #[test]
    fn a_file_changes_keys_and_what_it_gets_wrong_is_named_by_line() {
        let (keys, warnings) = Keys::from_json(
            "{\n \"mesh.inset\": \"Ctrl+F9 U\",\n \"mesh.saw\": \"K\",\n \"select.all\": \"I\"\n}",
        )
        .expect("usable");
        assert_eq!(action_at(&keys, "U", true), Some("mesh.inset"), "as the file says");
        assert_eq!(action_at(&keys, "I", true), Some("select.all"), "its old key is another's");
        assert_eq!(action_at(&keys, "A", true), None, "and A is free");
        assert!(warnings[0].contains("line 3") && warnings[0].contains("mesh.saw"), "{warnings:?}");
        let error = Keys::from_json("{\n \"a\": }").map(|_| ()).expect_err("no JSON");
        assert_eq!(error.line, 2, "{error}");
    }

    #[test]
    fn a_bad_chord_is_named_and_left_out_and_the_others_are_used() {
        let (keys, warnings) = Keys::from_json(
            "{\n \"mesh.inset\": \"Ctrl+ U\",\n \"mesh.bevel\": \"Nonsense+\",\n \"mesh.fill\": 5,\n \"select.all\": \"\"\n}",
        )
        .expect("usable");
        assert_eq!(action_at(&keys, "U", true), Some("mesh.inset"), "the chord beside the bad one");
        assert_eq!(action_at(&keys, "Ctrl+B", true), Some("mesh.bevel"), "as without the file");
        assert_eq!(action_at(&keys, "F", true), Some("mesh.fill"), "as without the file");
        assert_eq!(action_at(&keys, "A", true), None, "it was given none");
        for (line, name) in [(2, "mesh.inset"), (3, "mesh.bevel"), (4, "mesh.fill")] {
            let named = |warning: &&String| warning.contains(&format!("line {line}: {name}"));
            assert_eq!(warnings.iter().filter(named).count(), 1, "{warnings:?}");
        }
    }

    #[test]
    fn ctrl_z_is_never_anything_but_undo() {
        let (keys, warnings) = Keys::from_json("{\n \"mesh.inset\": \"Ctrl+Z U\"\n}").expect("usable");
        assert!(warnings[0].contains("line 2") && warnings[0].contains("always undo"), "{warnings:?}");
        assert_eq!(action_at(&keys, "Ctrl+Z", true), Some("edit.undo"), "as always");
        assert_eq!(action_at(&keys, "U", true), Some("mesh.inset"), "the other one is used");
        let (keys, _) = Keys::from_json("{ \"edit.undo\": \"F5\" }").expect("one key more");
        for is_editing in [false, true] {
            assert_eq!(action_at(&keys, "Ctrl+Z", is_editing), Some("edit.undo"), "still");
            assert_eq!(action_at(&keys, "F5", is_editing), Some("edit.undo"), "and the new one");
        }
    }

    #[test]
    fn without_a_pad_the_row_of_digits_can_stand_for_it() {
        let mut keys = Keys::default();
        assert_eq!(action_at(&keys, "1", true), Some("select.vertices"), "usually");
        keys.emulates_numpad = true;
        assert_eq!(action_at(&keys, "1", true), Some("view.front"), "now");
    }
}
