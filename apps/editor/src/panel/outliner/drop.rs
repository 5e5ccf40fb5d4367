//! What can be done to a row of the outliner: dragging it onto another row to set the parent or between rows
//! to reorder, and its menu.

use trigon_document::scene::{NodeId, Scene};
use trigon_document::{
    Command, DeleteObjects, Document, DuplicateObjects, ObjectName, ReorderObject, SelectAction, SetParent,
    ShowObjects,
};
use trigon_window::egui;
use trigon_window::egui::{DragAndDrop, Rect, Response, Ui};

use super::{OutlinerState, select};
use crate::request::Request;

/// Where a row is dropped on another one.
#[derive(Debug, Clone, Copy, PartialEq)]
enum DropZone {
    Before,
    On,
    After,
}

/// The upper and the lower quarter of a row mean between rows.
fn drop_zone(rect: Rect, pointer: egui::Pos2) -> DropZone {
    let share = (pointer.y - rect.top()) / rect.height();
    match share {
        share if share < 0.25 => DropZone::Before,
        share if share > 0.75 => DropZone::After,
        _ => DropZone::On,
    }
}

/// Takes a row up, or takes what is dropped on it.
pub(super) fn on_row(
    ui: &Ui,
    response: &Response,
    document: &Document,
    id: NodeId,
    requests: &mut Vec<Request>,
) {
    response.dnd_set_drag_payload(id);
    let Some(pointer) = response.hover_pos().or_else(|| ui.ctx().pointer_latest_pos()) else { return };
    let zone = drop_zone(response.rect, pointer);
    if response.dnd_hover_payload::<NodeId>().is_some_and(|dragged| *dragged != id) {
        mark(ui, response.rect, zone);
    }
    if let Some(dragged) = response.dnd_release_payload::<NodeId>().filter(|dragged| **dragged != id) {
        dropped(document, *dragged, id, zone, requests);
    }
}

/// A line between rows, or a frame around the one.
fn mark(ui: &Ui, rect: Rect, zone: DropZone) {
    let stroke = ui.visuals().selection.stroke;
    let painter = ui.painter();
    match zone {
        DropZone::Before => painter.hline(rect.x_range(), rect.top(), stroke),
        DropZone::After => painter.hline(rect.x_range(), rect.bottom(), stroke),
        DropZone::On => painter.rect_stroke(rect, 2.0, stroke, egui::StrokeKind::Inside),
    };
}

fn dropped(document: &Document, dragged: NodeId, on: NodeId, zone: DropZone, requests: &mut Vec<Request>) {
    if zone == DropZone::On {
        return requests.push(hang(objects(document, dragged), Some(on)));
    }
    let scene = document.nodes();
    let (Some(node), Some(target)) = (scene.node(dragged), scene.node(on)) else { return };
    // Its position among the others, without itself.
    let siblings = siblings(scene, on);
    let mut others = siblings.iter().filter(|&&sibling| sibling != dragged);
    let Some(at) = others.position(|&sibling| sibling == on) else { return };
    let to = at as u32 + u32::from(zone == DropZone::After);
    let object = ObjectName::of(dragged);
    let command: Command = if node.parent() == target.parent() {
        ReorderObject { object: Some(object), to }.into()
    } else {
        let parent = target.parent().map(ObjectName::of);
        SetParent { objects: vec![object], parent, keep_transform: true, index: Some(to) }.into()
    };
    requests.push(Request::Run(command));
}

/// An object and those that hang where it hangs, in their order.
pub(super) fn siblings(scene: &Scene, id: NodeId) -> Vec<NodeId> {
    match scene.node(id).and_then(|node| node.parent()).and_then(|parent| scene.node(parent)) {
        Some(parent) => parent.children().to_vec(),
        None => scene.roots().collect(),
    }
}

/// What is dragged: all that is selected, if this is.
fn objects(document: &Document, dragged: NodeId) -> Vec<NodeId> {
    let selected = &document.selection().objects;
    if selected.contains(&dragged) { selected.iter().copied().collect() } else { vec![dragged] }
}

/// Hangs objects on another one; they stay where they are.
pub(super) fn hang(objects: Vec<NodeId>, parent: Option<NodeId>) -> Request {
    let objects = objects.into_iter().map(ObjectName::of).collect();
    let parent = parent.map(ObjectName::of);
    Request::Run(SetParent { objects, parent, keep_transform: true, index: None }.into())
}

/// What is dropped below the last row hangs on nothing any more.
pub(super) fn below_all(ui: &Ui, area: Rect, document: &Document, requests: &mut Vec<Request>) {
    let is_released = ui.input(|input| input.pointer.any_released());
    if !is_released || !ui.rect_contains_pointer(area) {
        return;
    }
    // Rows have taken theirs by now.
    if let Some(dragged) = DragAndDrop::take_payload::<NodeId>(ui.ctx()) {
        requests.push(hang(objects(document, *dragged), None));
    }
}

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
    let siblings = siblings(document.nodes(), id);
    let Some(at) = siblings.iter().position(|&sibling| sibling == id) else { return };
    ui.separator();
    let mut move_to = |ui: &mut Ui, name: &str, to: Option<usize>| {
        let button = ui.add_enabled(to.is_some(), egui::Button::new(name));
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
    let button = egui::Button::new("Parent the other selected here");
    if ui.add_enabled(!others.is_empty(), button).clicked() {
        requests.push(hang(others, Some(id)));
    }
    let has_parent = document.nodes().node(id).is_some_and(|node| node.parent().is_some());
    if ui.add_enabled(has_parent, egui::Button::new("Clear parent")).clicked() {
        requests.push(hang(vec![id], None));
    }
}
