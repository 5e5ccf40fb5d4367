//! What several parts of the interface do to widgets.

use trigon_window::egui;

/// Gives the keyboard to a widget if no other has it.
pub(super) fn focus_first(widget: &egui::Response) {
    if widget.ctx.memory(|memory| memory.focused().is_none()) {
        widget.request_focus();
    }
}

/// A label for those who use a screen reader, and for tests.
pub(super) fn label(response: &egui::Response, text: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(text));
}
