//! Turns a changed widget into a request.

use trigon_document::{Command, Document};
use trigon_window::egui::{Response, Ui};

use crate::request::Request;

/// Requests a command. While a value is dragged, each command replaces the one before, so that the whole drag
/// is undone as one.
pub(super) fn submit(
    ui: &Ui,
    document: &Document,
    response: &Response,
    command: Command,
    requests: &mut Vec<Request>,
) {
    let last = document.history().done().last();
    // A command that was refused has left no entry that could be replaced.
    let is_last = last.is_some_and(|entry| entry.command().name() == command.name());
    let replaces = is_last && is_same_drag(ui, response);
    let pressed = press(ui);
    ui.data_mut(|data| data.insert_temp(response.id, pressed));
    requests.push(if replaces { Request::Adjust(command) } else { Request::Run(command) });
}

/// Whether the button of the pointer has been down since the last change of this widget.
pub(super) fn is_same_drag(ui: &Ui, response: &Response) -> bool {
    let pressed = press(ui);
    pressed.is_some() && ui.data(|data| data.get_temp::<Option<f64>>(response.id)) == Some(pressed)
}

/// When the button that is down was pressed. The widget of a colour opens others, so that it
/// is not dragged itself.
fn press(ui: &Ui) -> Option<f64> {
    ui.input(|input| input.pointer.press_start_time().filter(|_| input.pointer.any_down()))
}
