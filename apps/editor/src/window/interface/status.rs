//! The status line: the keys and numbers of the active tool, results and errors, and the selection.

use trigon_document::{Document, ElementKind};
use trigon_window::egui::{Align, Color32, Layout, RichText, Ui};

use crate::window::editor::{Editor, Message};
use crate::window::loading::Loading;

/// Readable on the panel's dark grey.
const REFUSAL: Color32 = Color32::from_rgb(255, 170, 90);

/// Shows it.
pub(super) fn line(ui: &mut Ui, editor: &Editor) {
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(counts(&editor.document));
            ui.separator();
            if let Some(text) = under_way(editor) {
                ui.label(text);
                ui.separator();
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let text = match (&editor.tool, &editor.message) {
                    (Some(tool), _) => RichText::new(tool.status()),
                    (None, Message::Info(text)) => RichText::new(text),
                    (None, Message::Refusal(text)) => RichText::new(text).color(REFUSAL),
                };
                ui.add(trigon_window::egui::Label::new(text).truncate());
            });
        });
    });
}

/// What other threads are at.
fn under_way(editor: &Editor) -> Option<String> {
    let loading = editor.loading.as_ref().map(Loading::text);
    loading.or_else(|| editor.saving.as_ref().map(|saving| format!("Saving {}", saving.order.path.display())))
}

/// As "3 of 8 vertices".
fn counts(document: &Document) -> String {
    let selection = document.selection();
    if !selection.is_editing() {
        let all = document.nodes().nodes().len();
        return format!("{} of {all} objects selected", selection.objects.len());
    }
    let counts = selection.kinds().iter().map(|kind| count(document, kind));
    format!("{} selected", counts.collect::<Vec<_>>().join(", "))
}

/// How many elements of a kind are selected, and how many there are.
fn count(document: &Document, kind: ElementKind) -> String {
    let selection = document.selection();
    let (own, mut selected, mut all) = (selection.kind(), 0, 0);
    for (id, elements) in selection.meshes() {
        let Some(mesh) = document.mesh(id) else { continue };
        selected += match kind {
            _ if kind == own => elements.len(),
            ElementKind::Vertex => elements.vertices(mesh, own).len(),
            ElementKind::Edge => elements.edges(mesh, own).len(),
            ElementKind::Face => elements.faces(mesh, own).len(),
        };
        all += match kind {
            ElementKind::Vertex => mesh.vertex_count(),
            ElementKind::Edge => mesh.edge_count(),
            ElementKind::Face => mesh.face_count(),
        };
    }
    let name = match kind {
        ElementKind::Vertex => "vertices",
        ElementKind::Edge => "edges",
        ElementKind::Face => "faces",
    };
    format!("{selected} of {all} {name}")
}
