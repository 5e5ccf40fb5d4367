//! What covers the view: the list of keys, the rename field, and questions that must be answered before
//! anything else.

use trigon_document::RenameObject;
use trigon_window::egui::{Align2, Context, Grid, Id, Key, Modal, RichText, ScrollArea, TextEdit, Ui};
use trigon_window::{Stage, egui};

use super::bars::{focus_first, label};
use crate::panel::select_all_at_first;
use crate::request::Request;
use crate::up::Up;
use crate::window::actions;
use crate::window::actions::MENUS;
use crate::window::editor::{Editor, Message};
use crate::window::open_file::{Answer, Question};

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
    if is_open && context.input(|input| input.key_pressed(Key::Escape)) {
        is_open = false;
    }
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

/// What an export could not write, until that is read.
pub(super) fn report(context: &Context, editor: &mut Editor) {
    let Some(report) = &editor.report else { return };
    let height = (context.content_rect().height() - 200.0).max(60.0);
    let modal = Modal::new(Id::unique("report")).show(context, |ui| {
        ui.set_max_width(520.0);
        ui.heading(&report.title);
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
            for line in &report.lines {
                ui.add(egui::Label::new(format!("• {line}")).wrap());
            }
        });
        ui.add_space(8.0);
        let button = ui.button("Close");
        focus_first(&button);
        button.clicked()
    });
    if modal.inner || context.input(|input| input.key_pressed(Key::Escape)) {
        editor.report = None;
    }
}

/// Shows the question, if there is one.
pub(super) fn show_questions(context: &Context, editor: &mut Editor, stage: &mut Stage) {
    let Some(question) = &editor.question else { return };
    let modal = Modal::new(Id::unique("question")).show(context, |ui| {
        ui.set_max_width(460.0);
        content(ui, question)
    });
    let mut answer = modal.inner;
    if answer.is_none() && context.input(|input| input.key_pressed(Key::Escape)) {
        answer = Some(Answer::Cancel);
    }
    if let Some(answer) = answer {
        editor.answer(stage, answer);
        context.request_repaint();
    }
}

/// The file that is being loaded, and a handle to cancel it.
pub(super) fn loading(context: &Context, editor: &mut Editor, stage: &mut Stage) {
    let Some(loading) = &editor.loading else { return };
    let text = loading.text();
    let modal = Modal::new(Id::unique("loading")).show(context, |ui| {
        ui.label(text);
        ui.button("Cancel").clicked()
    });
    if modal.inner {
        editor.loading = None;
        editor.to_import.clear();
        editor.give_up_loading(stage, Message::Info("Loading was cancelled".into()));
    }
}

/// What closes the document waits until that is saved, or is given up.
pub(super) fn saving(context: &Context, editor: &mut Editor) {
    if !editor.closes_after_save() {
        return;
    }
    let modal = Modal::new(Id::unique("saving")).show(context, |ui| {
        ui.label("Closing when it is saved");
        ui.button("Keep It Open").clicked()
    });
    if modal.inner {
        editor.stay_open();
    }
}

/// The question, and the buttons.
fn content(ui: &mut Ui, question: &Question) -> Option<Answer> {
    match question {
        Question::Unsaved(_) => {
            ui.heading("Save changes?");
            ui.label("The document has unsaved changes.");
            buttons(ui, &[("Save", Answer::Yes), ("Discard", Answer::No), ("Cancel", Answer::Cancel)])
        }
        Question::Losses { path, losses, .. } => {
            ui.heading("Some data would be lost");
            ui.label(format!("{} cannot hold:", path.display()));
            /// More would not fit the window.
            const MOST: usize = 12;
            losses.iter().take(MOST).for_each(|loss| drop(ui.label(format!("• {loss}"))));
            if losses.len() > MOST {
                ui.label(format!("and {} more", losses.len() - MOST));
            }
            buttons(ui, &[("Save Anyway", Answer::Yes), ("Cancel", Answer::Cancel)])
        }
        Question::ChangedOnDisk(order) => {
            ui.heading("The file has changed");
            ui.label(format!("Another program has written {} since it was opened.", order.path.display()));
            ui.label("Reload discards what was done here since the last save.");
            let choices = [
                ("Save As…", Answer::SaveAs),
                ("Overwrite", Answer::Yes),
                ("Reload", Answer::Reload),
                ("Cancel", Answer::Cancel),
            ];
            buttons(ui, &choices)
        }
        Question::Up => {
            ui.heading("Which axis is up?");
            ui.label("Files keep their own; View, Up Axis changes it later.");
            let choices =
                [("Z is up, as in Blender", Answer::Up(Up::Z)), ("Y is up, as in glTF", Answer::Up(Up::Y))];
            buttons(ui, &choices)
        }
        Question::Recover(left) => {
            ui.heading("Recover a document?");
            let name = left
                .document
                .as_ref()
                .map_or("a document without a file".into(), |path| path.display().to_string());
            let changes = if left.actions == 1 { "change" } else { "changes" };
            let actions = left.actions;
            ui.label(format!("The editor ended without closing {name}, with {actions} {changes}."));
            if left.is_cut_off {
                ui.label("The end of its recovery file is incomplete, so the last actions are missing.");
            }
            buttons(ui, &[("Recover", Answer::Yes), ("Discard", Answer::No), ("Later", Answer::Cancel)])
        }
    }
}

/// The first has the keyboard focus: Enter presses it, and Tab moves on to the others.
fn buttons(ui: &mut Ui, all: &[(&str, Answer)]) -> Option<Answer> {
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        let mut answer = None;
        for (text, means) in all {
            let button = ui.button(*text);
            focus_first(&button);
            answer = button.clicked().then_some(*means).or(answer);
        }
        answer
    })
    .inner
}
