//! The list of keys, and the rename field.

use trigon_document::RenameObject;
use trigon_window::egui::{self, Align2, Context, Grid, Key, RichText, ScrollArea, TextEdit};

use super::widgets::label;
use crate::panel::select_all_at_first;
use crate::request::Request;
use crate::window::actions::{self, MENUS};
use crate::window::editor::Editor;

/// What the mouse does; it is in no table.
const MOUSE: [(&str, &str); 9] = [
    ("Middle drag", "orbit"),
    ("Shift+Middle drag", "pan"),
    ("Ctrl+Middle drag, wheel", "zoom"),
    ("Alt+Left drag", "orbit, if Emulate Three-Button Mouse is on"),
    ("Left click", "select"),
    ("Shift+Left click", "add to the selection, or remove from it"),
    ("Alt+Left click", "select a loop"),
    ("Ctrl+Alt+Left click", "select a ring"),
    ("Ctrl+Left click", "select the shortest path"),
];

/// All keys, menu by menu.
pub(super) fn help(context: &Context, editor: &mut Editor) {
    let mut is_open = editor.layout.help;
    let height = (context.content_rect().height() - 160.0).max(60.0);
    let window = egui::Window::new("Keys and Mouse").open(&mut is_open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0; 2]).show(context, |ui| {
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
            Grid::new("keys").num_columns(2).spacing([24.0, 4.0]).striped(true).show(ui, |ui| {
                for (keys, does) in MOUSE {
                    ui.label(RichText::new(keys).monospace());
                    ui.label(does);
                    ui.end_row();
                }
                for menu in MENUS {
                    let in_menu = actions::all().filter(|action| action.menu.split('/').next() == Some(menu));
                    for action in in_menu {
                        let keys = editor.keys.text_of(action);
                        if !keys.is_empty() {
                            ui.label(RichText::new(keys).monospace());
                            ui.label(format!("{}: {}", action.label, action.help));
                            ui.end_row();
                        }
                    }
                }
            });
        });
    });
    editor.layout.help = is_open;
}

/// The field, while it is open.
pub(super) fn rename(context: &Context, editor: &mut Editor, requests: &mut Vec<Request>) {
    let Some(rename) = &mut editor.rename else { return };
    let (mut is_open, mut is_done) = (true, false);
    let window = egui::Window::new("Rename").open(&mut is_open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0; 2]).show(context, |ui| {
        let mut field = TextEdit::singleline(&mut rename.name).show(ui);
        let typed = &field.response;
        label(typed, "name of the object");
        is_done = typed.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        is_done |= ui.button("Rename").clicked();
        if !is_done {
            typed.request_focus();
        }
        select_all_at_first(&mut field);
    });
    if is_done {
        let (object, name) = (rename.object.clone(), rename.name.clone());
        requests.push(Request::Run(RenameObject { object, name }.into()));
    }
    if is_done || !is_open || context.input(|input| input.key_pressed(Key::Escape)) {
        editor.rename = None;
    }
}
