//! Dragging rows: onto another row to set the parent, between rows to reorder.

use trigon_document::scene::{NodeId, Scene};
use trigon_document::{Command, Document, ObjectName, ReorderObject, SetParent};
use trigon_window::egui::{self, DragAndDrop, Rect, Response, Ui};

use crate::request::Request;

/// Where a row is dropped on another one.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Before,
    On,
    After,
}

/// The upper and the lower quarter of a row mean between rows.
fn place(rect: Rect, pointer: egui::Pos2) -> Place {
    let share = (pointer.y - rect.top()) / rect.height();
    match share {
        share if share < 0.25 => Place::Before,
        share if share > 0.75 => Place::After,
        _ => Place::On,
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
    let place = place(response.rect, pointer);
    if response.dnd_hover_payload::<NodeId>().is_some_and(|dragged| *dragged != id) {
        mark(ui, response.rect, place);
    }
    if let Some(dragged) = response.dnd_release_payload::<NodeId>().filter(|dragged| **dragged != id) {
        dropped(document, *dragged, id, place, requests);
    }
}

/// A line between rows, or a frame around the one.
fn mark(ui: &Ui, rect: Rect, place: Place) {
    let stroke = ui.visuals().selection.stroke;
    let painter = ui.painter();
    match place {
        Place::Before => painter.hline(rect.x_range(), rect.top(), stroke),
        Place::After => painter.hline(rect.x_range(), rect.bottom(), stroke),
        Place::On => painter.rect_stroke(rect, 2.0, stroke, egui::StrokeKind::Inside),
    };
}

fn dropped(document: &Document, dragged: NodeId, on: NodeId, place: Place, requests: &mut Vec<Request>) {
    if place == Place::On {
        return requests.push(hang(objects(document, dragged), Some(on)));
    }
    let scene = document.nodes();
    let (Some(node), Some(target)) = (scene.node(dragged), scene.node(on)) else { return };
    // Its position among the others, without itself.
    let siblings = siblings(scene, on);
    let mut others = siblings.iter().filter(|&&sibling| sibling != dragged);
    let Some(at) = others.position(|&sibling| sibling == on) else { return };
    let to = at as u32 + u32::from(place == Place::After);
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
