//! Menus at the pointer: their entries, and how keys choose from them.

use trigon_document::Document;
use trigon_window::egui::Pos2;
use trigon_window::matches_search;

use crate::window::actions::{self, Action, CONTEXT_MENU};

/// Typing searches menus that have more entries than this; in others a letter chooses.
const MOST_BY_LETTER: usize = 16;

/// A menu that a key opened.
#[derive(Debug)]
pub(crate) struct Popup {
    pub(super) menu: &'static str,
    /// Where; at the pointer, once it is shown.
    pub(super) at: Option<Pos2>,
    /// Which of the shown entries Enter chooses.
    pub(super) index: usize,
    /// What is searched for.
    pub(super) text: String,
}

/// One line of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct MenuLine {
    pub(super) action: &'static Action,
    /// Its menu within the menu.
    pub(super) section: &'static str,
    /// The letter that chooses it, in lower case.
    pub(super) letter: Option<char>,
}

impl Popup {
    pub(crate) fn new(menu: &'static str) -> Self {
        Self { menu, at: None, index: 0, text: String::new() }
    }

    /// The shown entries: all, or those that are searched for.
    pub(super) fn entries(&self, document: &Document) -> Vec<MenuLine> {
        let mut entries = entries(self.menu, document);
        if self.searches(&entries) {
            let text = self.text.to_lowercase();
            entries.retain(|entry| matches_search(&entry.action.label.to_lowercase(), &text));
        } else {
            set_letters(&mut entries);
        }
        entries
    }

    fn searches(&self, entries: &[MenuLine]) -> bool {
        entries.len() > MOST_BY_LETTER
    }

    /// Something was typed. Returns the entry that this chooses.
    pub(crate) fn typed(&mut self, text: &str, document: &Document) -> Option<&'static Action> {
        if self.searches(&entries(self.menu, document)) {
            self.text += text;
            self.index = 0;
            return None;
        }
        let letter = text.to_lowercase().chars().next()?;
        let entries = self.entries(document);
        entries.iter().find(|entry| entry.letter == Some(letter)).map(|entry| entry.action)
    }

    /// Moves on by this many of `count` entries; after the last comes the first.
    pub(super) fn step(&mut self, by: isize, count: usize) {
        self.index = (self.index as isize + by).rem_euclid(count.max(1) as isize) as usize;
    }
}

/// All entries of a menu, with those of the menus within it below one another, as few movements of the hand as can be.
fn entries(menu: &'static str, document: &Document) -> Vec<MenuLine> {
    let entry = |action: &'static Action, section| MenuLine { action, section, letter: None };
    if menu == CONTEXT_MENU {
        // What is often done with what is selected.
        let is_editing = document.selection().is_editing();
        return actions::context(is_editing).map(|action| entry(action, menu)).collect();
    }
    let also = actions::also_in(menu).map(|action| entry(action, menu));
    let is_within = |action: &&Action| {
        let within = action.menu.strip_prefix(menu);
        !action.opens_menu() && within.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    also.chain(actions::all().filter(is_within).map(|action| entry(action, action.menu))).collect()
}

/// Gives each entry a letter of its own: first the letters that words begin with, then any.
fn set_letters(entries: &mut [MenuLine]) {
    let mut taken = Vec::new();
    for begins_words in [true, false] {
        for entry in entries.iter_mut().filter(|entry| entry.letter.is_none()) {
            let label = entry.action.label.to_lowercase();
            let mut before = ' ';
            let letter = label.chars().find(|&letter| {
                let begins = !std::mem::replace(&mut before, letter).is_alphanumeric();
                letter.is_alphabetic() && (begins || !begins_words) && !taken.contains(&letter)
            });
            taken.extend(letter);
            entry.letter = letter;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_those_of_words_where_they_can_be() {
        let letters = |menu| -> String {
            let popup = Popup::new(menu);
            let entries = popup.entries(&Document::default());
            entries.iter().map(|entry| entry.letter.unwrap_or('-')).collect()
        };
        // As in Blender: X then F deletes faces.
        assert_eq!(letters("Mesh/Delete"), "vefodl", "delete");
        assert_eq!(&letters("View/Display")[..5], "wsmtr", "display");
        for (menu, count) in [("Mesh/Merge", 5), ("Edit/Pivot", 6), ("Edit/Apply", 5)] {
            let mut letters: Vec<char> = letters(menu).chars().collect();
            letters.sort_unstable();
            letters.dedup();
            assert!(letters.len() >= count && !letters.contains(&'-'), "{menu}: {letters:?}");
        }
    }

    #[test]
    fn typing_searches_a_long_menu() {
        let (mut popup, document) = (Popup::new("Add"), Document::default());
        for letter in ["t", "o", "r"] {
            assert!(popup.typed(letter, &document).is_none(), "nothing is chosen yet");
        }
        let names: Vec<_> = popup.entries(&document).iter().map(|entry| entry.action.label).collect();
        assert_eq!(names, ["Torus"], "what is left");
        let mut popup = Popup::new("Mesh/Delete");
        popup.step(-1, 6);
        assert_eq!(popup.index, 5, "before the first comes the last");
        popup.step(1, 6);
        assert_eq!(popup.index, 0, "and after the last the first");
    }
}
