//! Questions that must be answered before anything else.

use trigon_window::Stage;
use trigon_window::egui::{Context, Id, Key, Modal, Ui};

use super::widgets::focus_first;
use crate::window::editor::{Editor, Message};
use crate::window::open_file::{Answer, Question};

/// Shows the question, if there is one.
pub(super) fn show(context: &Context, editor: &mut Editor, stage: &mut Stage) {
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
        Question::Recover(left) => {
            ui.heading("Recover a document?");
            let name = left
                .document
                .as_ref()
                .map_or("a document without a file".into(), |path| path.display().to_string());
            ui.label(format!("The editor ended without closing {name}, with {} changes.", left.actions));
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
