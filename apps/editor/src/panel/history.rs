//! The history list, latest entry first; a click undoes or redoes up to an entry.

use trigon_document::{Document, Entry};
use trigon_window::egui::{self, Ui};

use crate::request::Request;

/// The maximum number of entries listed on each side of the current one.
const MOST: usize = 50;

/// Shows the list. A click requests as many undos or redos as lead to that entry.
pub(crate) fn history(ui: &mut Ui, document: &Document, requests: &mut Vec<Request>) {
    let history = document.history();
    let (done, undone) = (history.done(), history.undone());
    for (index, entry) in undone.iter().enumerate().take(MOST).rev() {
        if line(ui, entry, false).on_hover_text("Redoes everything up to here").clicked() {
            requests.extend(std::iter::repeat_n(Request::Redo, index + 1));
        }
    }
    for (undos, entry) in done.iter().rev().enumerate().take(MOST) {
        if line(ui, entry, undos == 0).on_hover_text("Undoes everything after this").clicked() {
            requests.extend(std::iter::repeat_n(Request::Undo, undos));
        }
    }
    let more = done.len().saturating_sub(MOST) + history.dropped();
    match (done.len(), more) {
        (0, 0) => drop(ui.weak("Nothing was done yet.")),
        (_, 0) if ui.selectable_label(false, "Start").clicked() => {
            requests.extend(std::iter::repeat_n(Request::Undo, done.len()));
        }
        (_, 0) => {}
        _ => drop(ui.weak(format!("and {more} before"))),
    }
}

fn line(ui: &mut Ui, entry: &Entry, is_now: bool) -> egui::Response {
    ui.selectable_label(is_now, entry.command().name())
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_document::scene::Scene;

    use super::super::testing::Case;
    use super::*;

    #[test]
    fn a_click_leads_back_and_forth() {
        let document = Document::new(Scene::new());
        let mut case = Case::new([260.0, 400.0], document, (), |ui, document, (), requests| {
            history(ui, document, requests);
        });
        for op in ["add_empty", "add_light", "select_all", "delete_objects"] {
            case.command(json!({ "op": op }));
        }
        case.click("Add Light");
        assert_eq!(case.take_requests(), [Request::Undo, Request::Undo], "what came after it");
        assert_eq!(case.document().nodes().nodes().len(), 2, "before they were deleted");
        case.click("Start");
        assert_eq!(case.document().nodes().nodes().len(), 0, "before all");
        case.click("Delete Objects");
        assert_eq!(case.document().history().done().len(), 4, "all again");
        case.image("history");
    }
}
