//! The outliner: all objects as a tree, for selecting, renaming, hiding, parenting and reordering.
//! However many there are, only the rows in view are laid out.

mod drop;
mod line;
mod rows;
#[cfg(test)]
mod tests;

use trigon_document::scene::NodeId;
use trigon_document::{Command, Document, LeaveEditMode, ObjectName, Select, SelectAction};
use trigon_window::egui::{self, Key, Modifiers, ScrollArea, Ui};

use crate::request::Request;
use rows::Rows;

/// What the outliner remembers.
#[derive(Debug, Default)]
pub(crate) struct OutlinerState {
    search: String,
    rows: Rows,
    /// The object whose name is typed.
    renaming: Option<Renaming>,
    /// The object that was folded or unfolded in this pass.
    toggled: Option<NodeId>,
    /// From where a range is selected: what was clicked last without Shift.
    anchor: Option<NodeId>,
}

/// A name that is typed.
#[derive(Debug)]
struct Renaming {
    object: NodeId,
    text: String,
    /// Whether the field had the focus: it gets it once.
    is_open: bool,
}

impl OutlinerState {
    /// Opens a field that replaces an object's name.
    pub(crate) fn rename(&mut self, document: &Document, object: NodeId) {
        let Some(node) = document.nodes().node(object) else { return };
        self.renaming = Some(Renaming { object, text: node.name.clone(), is_open: false });
    }
}

/// Shows it.
pub(crate) fn outliner(
    ui: &mut Ui,
    document: &Document,
    state: &mut OutlinerState,
    requests: &mut Vec<Request>,
) {
    let field =
        egui::TextEdit::singleline(&mut state.search).hint_text("Search").desired_width(f32::INFINITY);
    ui.add(field).accessible_name("Search objects");
    state.rows.update(document, &state.search);
    if state.rows.is_empty() {
        let text = if state.search.is_empty() { "The scene is empty." } else { "No object has this name." };
        ui.add(egui::Label::new(text).wrap());
    }
    let height = ui.spacing().interact_size.y;
    // The rows are taken out while the rest of the state is changed.
    let rows = std::mem::take(&mut state.rows);
    let area = ScrollArea::vertical().auto_shrink(false);
    let shown = area.show_rows(ui, height, rows.len(), |ui, range| {
        for &row in &rows.as_slice()[range] {
            let Some(node) = document.nodes().node(row.id) else { continue };
            let line = line::Line { document, rows: &rows, row, node };
            ui.push_id(row.id, |ui| line.show(ui, state, requests));
        }
    });
    state.rows = rows;
    if let Some(id) = state.toggled.take() {
        state.rows.toggle(id);
    }
    let last = shown.inner_rect.top() + shown.content_size.y - shown.state.clamped_offset().y;
    let below = shown.inner_rect.with_min_y(last.min(shown.inner_rect.bottom()));
    drop::below_all(ui, below, document, requests);
    keys(ui, shown.inner_rect, document, state, requests);
}

/// F2 and Delete, while the pointer is over the list.
fn keys(
    ui: &Ui,
    area: egui::Rect,
    document: &Document,
    state: &mut OutlinerState,
    requests: &mut Vec<Request>,
) {
    if state.renaming.is_some() || !ui.rect_contains_pointer(area) {
        return;
    }
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    if let Some(active) = document.selection().active.filter(|_| pressed(Key::F2)) {
        state.rename(document, active);
    }
    if !document.selection().objects.is_empty() && !document.selection().is_editing() && pressed(Key::Delete)
    {
        requests.push(Request::Run(trigon_document::DeleteObjects {}.into()));
    }
}

/// Selects objects. Whole objects are selected in object mode only, so edit mode ends.
fn select(document: &Document, objects: Vec<NodeId>, action: SelectAction, requests: &mut Vec<Request>) {
    let selection = document.selection();
    if selection.is_editing() {
        requests.push(Request::Run(LeaveEditMode {}.into()));
    } else if let (&[one], SelectAction::Replace) = (&objects[..], action)
        && selection.active == Some(one)
        && selection.objects.iter().eq([&one])
    {
        // It is all that is selected: nothing to be undone.
        return;
    }
    let objects = objects.into_iter().map(ObjectName::of).collect();
    let select = Select { objects, action, ..Select::default() };
    requests.push(Request::Run(Command::from(select)));
}
