//! The rows of the list of keys. Lines are made from the tables of bindings, so the list is always complete and
//! correct.

use std::borrow::Cow;

use super::action::Action;
use super::binding::{Binding, Keymap};
use super::synonyms::matches_search;
use crate::input::Modifiers;

/// A line of the cheat sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetRow {
    /// The heading that it stands under.
    pub section: Cow<'static, str>,
    /// What is pressed, dragged or turned.
    pub keys: String,
    /// What that does.
    pub description: String,
    /// What it does, if it is one thing, done at once.
    pub binding: Option<Binding>,
}

impl SheetRow {
    /// Whether a search finds it: by its keys, its words, its name, or words that mean the same.
    #[must_use]
    pub fn matches(&self, search: &str) -> bool {
        let name = self.binding.as_ref().map_or("", |binding| binding.name.as_ref());
        let text = format!("{} {} {} {name}", self.section, self.keys, self.description);
        matches_search(&text.to_lowercase(), &search.to_lowercase())
    }
}

impl Keymap {
    /// The lines of the cheat sheet: the mouse first, then the keys under their headings.
    #[must_use]
    pub fn sheet(&self) -> Vec<SheetRow> {
        sheet(self)
    }
}

/// The heading of what the mouse does.
const MOUSE: Cow<'static, str> = Cow::Borrowed("Mouse");

/// What the wheel does, which is not in the tables.
const WHEEL: [(&str, &str); 2] = [("Wheel", "zoom"), ("Ctrl+Wheel", "zoom to the pointer")];

/// All lines: the mouse first, then the keys in their order, those with the
/// same description together.
pub(crate) fn sheet(keymap: &Keymap) -> Vec<SheetRow> {
    let mut rows: Vec<SheetRow> = Vec::new();
    let row = |keys, description: &str| SheetRow {
        section: MOUSE,
        keys,
        description: description.into(),
        binding: None,
    };
    for drag in keymap.drags() {
        let keys = format!("{}{} drag", drag.modifiers, drag.button);
        add_from(&mut rows, 0, row(keys, &drag.description));
    }
    for (keys, description) in WHEEL {
        rows.push(row(keys.into(), description));
    }
    for click in keymap.clicks() {
        let keys = format!("{}{} click", click.modifiers, click.button);
        rows.push(row(keys, &click.description));
    }
    let mouse = rows.len();
    let mut rest = keymap.bindings();
    while let Some(first) = rest.first() {
        let run = rest
            .iter()
            .take_while(|next| (&next.description, &next.section) == (&first.description, &first.section))
            .count();
        let Binding { section, description, action, .. } = first;
        let one =
            rest[..run].iter().all(|other| other.name == first.name) && !matches!(action, Action::Hold(_));
        let binding = one.then(|| first.clone());
        let (keys, description) = (keys_of(&rest[..run]), description.to_string());
        add_from(&mut rows, mouse, SheetRow { section: section.clone(), keys, description, binding });
        rest = &rest[run..];
    }
    rows
}

/// Adds to the row with the same description from `start` on, or a new row.
fn add_from(rows: &mut Vec<SheetRow>, start: usize, new: SheetRow) {
    let is_same = |row: &&mut SheetRow| row.description == new.description && row.section == new.section;
    match rows[start..].iter_mut().find(is_same) {
        Some(row) => row.keys = format!("{}, {}", row.keys, new.keys),
        None => rows.push(new),
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
