//! The list of keys and commands: typing filters it, and clicking a line runs it.

use egui::{Align2, Context, Grid, RichText, ScrollArea, TextEdit, Window, vec2};

use crate::keymap::{Binding, SheetRow, sheet};
use crate::stage::{Stage, Visibility};

/// Shows the list if it is visible. Returns the selected command.
pub(super) fn show(context: &Context, stage: &mut Stage) -> Option<Binding> {
    if stage.cheat_sheet == Visibility::Hidden {
        return None;
    }
    let mut open = true;
    let mut chosen = None;
    let window = Window::new("Keys and commands").open(&mut open).collapsible(false).fade_in(false);
    let window = window.anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0)).resizable(false);
    let height = (context.content_rect().height() - 120.0).max(40.0);
    window.show(context, |ui| {
        let search = TextEdit::singleline(&mut stage.command_search).hint_text("search");
        let search = ui.add(search.desired_width(f32::INFINITY));
        context.accesskit_node_builder(search.id, |node| node.set_label("search keys and commands"));
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
            let rows = sheet(&stage.keymap);
            let wanted = stage.command_search.to_lowercase();
            let rows: Vec<&SheetRow> = rows.iter().filter(|row| row.contains(&wanted)).collect();
            if rows.is_empty() {
                ui.label("no key or command has this name");
            }
            Grid::new("keys").num_columns(2).spacing([24.0, 4.0]).striped(true).show(ui, |ui| {
                for row in rows {
                    chosen = chosen.take().or(line(ui, row));
                    ui.end_row();
                }
            });
        });
    });
    if !open {
        stage.cheat_sheet = Visibility::Hidden;
    }
    chosen
}

/// A row of the list; keys with a single action can be clicked.
fn line(ui: &mut egui::Ui, row: &SheetRow) -> Option<Binding> {
    ui.label(RichText::new(&row.keys).monospace().strong());
    match &row.binding {
        Some(binding) => ui.button(row.description.as_str()).clicked().then(|| binding.clone()),
        None => {
            ui.label(&row.description);
            None
        }
    }
}
