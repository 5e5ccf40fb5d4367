//! The menu of a row.

use trigon_document::scene::NodeId;
use trigon_document::{
    Command, DeleteObjects, Document, DuplicateObjects, ObjectName, ReorderObject, SelectAction, ShowObjects,
};
use trigon_window::egui::{Response, Ui};

use super::{OutlinerState, drop, select};
use crate::request::Request;

/// Opens with the right button, which also selects the row if it is not.
pub(super) fn menu(
    response: &Response,
    document: &Document,
    state: &mut OutlinerState,
    id: NodeId,
    requests: &mut Vec<Request>,
) {
    let is_selected = document.selection().objects.contains(&id);
    if response.secondary_clicked() && (!is_selected || document.selection().is_editing()) {
        select(document, vec![id], SelectAction::Replace, requests);
    }
    response.context_menu(|ui| {
        if ui.button("Rename").clicked() {
            state.rename(document, id);
        }
        commands(ui, document, id, requests);
        order(ui, document, id, requests);
        parents(ui, document, id, requests);
    });
}

fn commands(ui: &mut Ui, document: &Document, id: NodeId, requests: &mut Vec<Request>) {
    let visible = document.nodes().node(id).is_some_and(|node| node.visible);
    let offered: [(&str, Command); 4] = [
        (
            if visible { "Hide" } else { "Show" },
            ShowObjects { objects: Vec::new(), visible: !visible }.into(),
        ),
        ("Duplicate", DuplicateObjects::default().into()),
        ("Duplicate linked", DuplicateObjects { linked: true, ..DuplicateObjects::default() }.into()),
        ("Delete", DeleteObjects {}.into()),
    ];
    for (name, command) in offered {
        if ui.button(name).clicked() {
            requests.push(Request::Run(command));
        }
    }
}

fn order(ui: &mut Ui, document: &Document, id: NodeId, requests: &mut Vec<Request>) {
    let siblings = drop::siblings(document.nodes(), id);
    let Some(at) = siblings.iter().position(|&sibling| sibling == id) else { return };
    ui.separator();
    let mut move_to = |ui: &mut Ui, name: &str, to: Option<usize>| {
        let button = ui.add_enabled(to.is_some(), trigon_window::egui::Button::new(name));
        if let Some(to) = to.filter(|_| button.clicked()) {
            let object = Some(ObjectName::of(id));
            requests.push(Request::Run(ReorderObject { object, to: to as u32 }.into()));
        }
    };
    move_to(ui, "Move up", at.checked_sub(1));
    move_to(ui, "Move down", (at + 1 < siblings.len()).then_some(at + 1));
}

/// Hanging all that is selected on the active object, or on nothing.
fn parents(ui: &mut Ui, document: &Document, id: NodeId, requests: &mut Vec<Request>) {
    let selected = &document.selection().objects;
    let others: Vec<NodeId> = selected.iter().copied().filter(|&other| other != id).collect();
    ui.separator();
    let button = trigon_window::egui::Button::new("Parent the other selected here");
    if ui.add_enabled(!others.is_empty(), button).clicked() {
        requests.push(drop::hang(others, Some(id)));
    }
    let has_parent = document.nodes().node(id).is_some_and(|node| node.parent().is_some());
    if ui.add_enabled(has_parent, trigon_window::egui::Button::new("Clear parent")).clicked() {
        requests.push(drop::hang(vec![id], None));
    }
}
