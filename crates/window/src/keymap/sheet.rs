//! The cheat sheet's lines, from the tables themselves: what is not bound is
//! not listed, and what is bound cannot be forgotten.

use super::action::Action;
use super::binding::{Binding, Keymap};
use crate::input::Modifiers;

/// A line of the cheat sheet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SheetRow {
    pub(crate) keys: String,
    pub(crate) description: String,
    /// What it does, if it is one thing, done at once.
    pub(crate) binding: Option<Binding>,
}

impl SheetRow {
    /// Whether a search for this text, in lower case, finds it.
    pub(crate) fn contains(&self, text: &str) -> bool {
        let name = self.binding.as_ref().map_or("", |binding| binding.name.as_ref());
        [self.keys.as_str(), self.description.as_str(), name]
            .iter()
            .any(|part| part.to_lowercase().contains(text))
    }
}

/// What the wheel does, which is not in the tables.
const WHEEL: [(&str, &str); 2] = [("Wheel", "zoom"), ("Ctrl+Wheel", "zoom to the pointer")];

/// All lines: the mouse first, then the keys in their order, those with the
/// same description together.
pub(crate) fn sheet(keymap: &Keymap) -> Vec<SheetRow> {
    let mut rows: Vec<SheetRow> = Vec::new();
    for drag in keymap.drags() {
        let keys = format!("{}{} drag", drag.modifiers, drag.button);
        add(&mut rows, keys, &drag.description);
    }
    for (keys, description) in WHEEL {
        rows.push(SheetRow { keys: keys.into(), description: description.into(), binding: None });
    }
    for click in keymap.clicks() {
        let keys = format!("{}{} click", click.modifiers, click.button);
        rows.push(SheetRow { keys, description: click.description.to_string(), binding: None });
    }
    let mouse = rows.len();
    let mut rest = keymap.bindings();
    while let Some(first) = rest.first() {
        let run = rest.iter().take_while(|next| next.description == first.description).count();
        add_from(&mut rows, mouse, keys_of(&rest[..run]), &first.description);
        let one = run == 1 && !matches!(first.action, Action::Hold(_));
        if let Some(row) = rows.last_mut().filter(|row| one && row.description == first.description) {
            row.binding = Some(first.clone());
        }
        rest = &rest[run..];
    }
    rows
}

fn add(rows: &mut Vec<SheetRow>, keys: String, description: &str) {
    add_from(rows, 0, keys, description);
}

/// Adds to the row with this description from `start` on, or a new row.
fn add_from(rows: &mut Vec<SheetRow>, start: usize, keys: String, description: &str) {
    match rows[start..].iter_mut().find(|row| row.description == description) {
        Some(row) => row.keys = format!("{}, {keys}", row.keys),
        None => rows.push(SheetRow { keys, description: description.into(), binding: None }),
    }
}

/// The keys of bindings that do the same: "Alt+Left/Right", modifiers once.
fn keys_of(bindings: &[Binding]) -> String {
    let mut text = String::new();
    let mut last: Option<Modifiers> = None;
    for Binding { chord, .. } in bindings {
        match last {
            Some(modifiers) if modifiers == chord.modifiers => text.push_str(&format!("/{}", chord.key)),
            Some(_) => text.push_str(&format!(", {chord}")),
            None => text = chord.to_string(),
        }
        last = Some(chord.modifiers);
    }
    for (long, short) in [("Left/Right/Up/Down", "arrows"), ("PageUp/PageDown", "Page keys")] {
        text = text.replace(long, short);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_binding_is_on_the_sheet() {
        let mut keymap = Keymap::default();
        keymap.bind('g', "grid", Action::Command, "grid");
        let rows = sheet(&keymap);
        for binding in keymap.bindings() {
            let row = rows.iter().find(|row| row.description == binding.description);
            assert!(row.is_some(), "{} ({}) is missing", binding.name, binding.chord);
        }
        assert_eq!(rows.last().map(|row| row.keys.as_str()), Some("G"), "an application's keys come last");
    }

    #[test]
    fn keys_with_one_meaning_share_a_line() {
        let rows = sheet(&Keymap::default());
        let keys = |description: &str| {
            rows.iter().rev().find(|row| row.description == description).map(|row| row.keys.clone())
        };
        let expected = Some("arrows, Shift+arrows".to_owned());
        assert_eq!(keys("orbit"), expected, "arrows are one word");
        assert_eq!(keys("front, right, top view"), Some("1/3/7".to_owned()), "in the order of the text");
        let expected = Some("Alt+arrows/Page keys".to_owned());
        assert_eq!(keys("move the selected object"), expected, "modifiers once");
    }
}
