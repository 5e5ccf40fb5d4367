//! What parts of the interface remember.

use trigon_document::{Document, ObjectName};
use trigon_window::matches_search;

use crate::panel::{AddState, DevelopmentState, InformationState, OutlinerState, PropertiesState};
use crate::window::actions::{self, Action};

/// What an export could not write.
#[derive(Debug)]
pub(crate) struct Report {
    pub(super) title: String,
    pub(super) lines: Vec<String>,
}

/// The name that is being typed.
#[derive(Debug)]
pub(crate) struct Rename {
    pub(super) object: ObjectName,
    pub(super) name: String,
}

impl Rename {
    /// Of the active object.
    pub(crate) fn of_active(document: &Document) -> Option<Self> {
        let id = document.selection().active?;
        let name = document.nodes().node(id)?.name.clone();
        Some(Self { object: ObjectName::of(id), name })
    }
}

/// What is searched for.
#[derive(Debug, Default)]
pub(crate) struct Search {
    pub(super) text: String,
    /// Which of those found Enter chooses.
    pub(super) index: usize,
}

impl Search {
    /// Actions in whose name, menu or help all words or their synonyms occur. First come actions whose name
    /// begins with the text, then those whose name contains it, then those that contain all words, then those
    /// found by a synonym.
    pub(super) fn found(&self) -> Vec<&'static Action> {
        let text = self.text.to_lowercase();
        let everything =
            |action: &Action| format!("{} {} {}", action.label, action.menu, action.help).to_lowercase();
        let mut found: Vec<_> =
            actions::all().filter(|action| matches_search(&everything(action), &text)).collect();
        let rank = |action: &&Action| {
            let (name, everything) = (action.label.to_lowercase(), everything(action));
            let has_all_words = text.split_whitespace().all(|word| everything.contains(word));
            (!name.starts_with(text.trim()), !name.contains(text.trim()), !has_all_words)
        };
        found.sort_by_key(rank);
        found
    }
}

/// The tabs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Tab {
    Information,
    Add,
    #[default]
    Properties,
    Development,
}

/// What was said last over the view.
#[derive(Debug, Default)]
pub(crate) struct Toast {
    pub(super) text: String,
    /// The number of entries in the history then: the same command again says the same again.
    pub(super) entries: usize,
    /// Until when it is shown, in seconds of the interface's own time.
    pub(super) until: f64,
}

/// What panels remember.
#[derive(Default)]
pub(crate) struct Panels {
    pub(super) toast: Toast,
    pub(super) tab: Tab,
    pub(super) outliner: OutlinerState,
    pub(super) information: InformationState,
    pub(super) add: AddState,
    pub(super) properties: PropertiesState,
    pub(super) development: DevelopmentState,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_find_actions_and_names_come_first() {
        let names = |text: &str| -> Vec<&str> {
            let search = Search { text: text.into(), index: 0 };
            search.found().into_iter().map(|action| action.label).collect()
        };
        assert_eq!(names("undo").first(), Some(&"Undo"), "a whole name");
        assert_eq!(names("loop c").first(), Some(&"Loop Cut"), "its beginning");
        assert!(names("seam mark").contains(&"Mark Seam"), "words in any order");
        assert!(names("no such thing").is_empty(), "nothing");
        assert!(names("exit").contains(&"Quit"), "a synonym");
        assert_eq!(names("").len(), actions::all().count(), "everything");
    }
}
