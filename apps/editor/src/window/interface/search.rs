//! The command search: every action by its name.

use trigon_window::Stage;
use trigon_window::egui::{self, Align2, Button, Context, Key, RichText, ScrollArea, TextEdit, Ui};

use super::widgets::label;
use crate::window::actions::Action;
use crate::window::editor::Editor;

/// Shows it, and does what was chosen.
pub(super) fn show(context: &Context, editor: &mut Editor, stage: &mut Stage) {
    let Some(mut search) = editor.search.take() else { return };
    let (mut chosen, mut is_open) = (None, true);
    let window = egui::Window::new("Find Command").open(&mut is_open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_TOP, [0.0, 90.0]).default_width(420.0).show(context, |ui| {
        let field = TextEdit::singleline(&mut search.text).hint_text("name of a command");
        let typed = ui.add(field.desired_width(f32::INFINITY));
        label(&typed, "name of a command");
        if typed.changed() {
            search.index = 0;
        }
        let found = search.found();
        step(ui, &mut search.index, found.len());
        if typed.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            chosen = found.get(search.index).copied();
        }
        typed.request_focus();
        if found.is_empty() {
            ui.label("no command has this name");
        }
        ScrollArea::vertical().max_height(320.0).auto_shrink([false, true]).show(ui, |ui| {
            for (index, action) in found.into_iter().enumerate() {
                chosen = row(ui, editor, action, index == search.index).or(chosen);
            }
        });
    });
    if let Some(action) = chosen {
        editor.choose(stage, action);
        context.request_repaint();
    } else if is_open && !context.input(|input| input.key_pressed(Key::Escape)) {
        editor.search = Some(search);
    }
}

/// Up and down.
fn step(ui: &Ui, index: &mut usize, count: usize) {
    let pressed = |key| ui.input(|input| input.key_pressed(key));
    if pressed(Key::ArrowDown) {
        *index = (*index + 1).min(count.saturating_sub(1));
    }
    if pressed(Key::ArrowUp) {
        *index = index.saturating_sub(1);
    }
}

fn row(ui: &mut Ui, editor: &Editor, action: &'static Action, is_current: bool) -> Option<&'static Action> {
    let text = format!("{} — {}", action.label, action.menu.replace('/', ", "));
    let refusal = action.refusal(&editor.document);
    let shortcut = RichText::new(editor.keys.text_of(action)).weak();
    let button = Button::selectable(is_current, text).right_text(shortcut);
    let width = ui.available_width();
    let shown = ui.add_enabled(refusal.is_none(), button.min_size(egui::vec2(width, 0.0)));
    label(&shown, action.label);
    if is_current {
        shown.scroll_to_me(None);
    }
    let shown = shown.on_hover_text(action.help).on_disabled_hover_text(refusal.unwrap_or_default());
    shown.clicked().then_some(action)
}
