//! The list of keys and commands: typing filters it, and clicking a line runs it. It has as many columns as fit. While it
//! is searched all keys are letters of the search; Escape closes it.

use std::borrow::Cow;

use egui::{Align2, Context, Grid, Id, Rect, RichText, ScrollArea, TextEdit, Window, vec2};

use crate::keymap::{Binding, SheetRow, sheet};
use crate::stage::{Stage, Visibility};

/// A column is at least so wide, in points; its longest lines are wrapped.
const COLUMN: f32 = 360.0;

/// And no wider than this.
const WIDEST: f32 = 440.0;

/// What the window takes beside the columns: its frame, title and search, in points.
const BESIDE: egui::Vec2 = vec2(48.0, 104.0);

/// Between two columns, in points.
const GAP: f32 = 16.0;

/// How the list fills an area, in points.
struct Fit {
    /// Of all columns.
    size: egui::Vec2,
    columns: u16,
    /// Of a column.
    width: f32,
    /// Of a key or a description, which share a column.
    cell: f32,
}

impl Fit {
    fn new(free: egui::Vec2) -> Self {
        let size = (free - BESIDE).max(vec2(200.0, 40.0));
        let columns = ((size.x / COLUMN) as u16).clamp(1, 3);
        let width = (size.x / f32::from(columns) - GAP).min(WIDEST);
        Self { size, columns, width, cell: (width - 16.0) / 2.0 }
    }
}

/// The widget that is typed into.
pub(super) fn search_id() -> Id {
    Id::unique("the search of the list of keys")
}

/// Shows the list if it is visible, in the area that no panel covers. Returns the selected command.
pub(super) fn show(context: &Context, free: Rect, stage: &mut Stage) -> Option<Binding> {
    if stage.cheat_sheet == Visibility::Hidden {
        return None;
    }
    let mut open = true;
    let mut chosen = None;
    let window = Window::new("Keys and commands").open(&mut open).collapsible(false).fade_in(false);
    let window = window.anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0));
    let Fit { size, columns: count, width, cell } = Fit::new(free.size());
    window.auto_sized().constrain_to(free).show(context, |ui| {
        ui.set_max_width(size.x);
        let is_searched = ui.memory(|memory| memory.has_focus(search_id()));
        let search = TextEdit::singleline(&mut stage.command_search).id(search_id()).hint_text("search");
        let search = ui.add(search.desired_width(f32::INFINITY));
        if is_searched && !ui.is_enabled() {
            // In the first pass, which only finds out the size, no widget keeps the keyboard.
            search.request_focus();
        }
        context.accesskit_node_builder(search.id, |node| node.set_label("search keys and commands"));
        let rows: Vec<SheetRow> =
            sheet(&stage.keymap).into_iter().filter(|row| row.matches(&stage.command_search)).collect();
        if rows.is_empty() {
            ui.label("no key and no command of that name");
        }
        // Rows below the last visible one are not noticed without a bar.
        ui.style_mut().spacing.scroll = egui::style::ScrollStyle::solid();
        ScrollArea::vertical().max_height(size.y).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                for (number, column) in columns(&rows, count.into()).into_iter().enumerate() {
                    ui.push_id(number, |ui| {
                        ui.vertical(|ui| {
                            ui.set_width(width);
                            for section in column {
                                chosen = chosen.take().or(show_section(ui, section, cell));
                            }
                        });
                    });
                }
            });
        });
    });
    if !open {
        stage.cheat_sheet = Visibility::Hidden;
    }
    chosen
}

/// A heading and its rows, of two cells that are no wider than that.
fn show_section(ui: &mut egui::Ui, rows: &[SheetRow], cell: f32) -> Option<Binding> {
    let (section, mut chosen) = (rows.first().map_or(Cow::Borrowed(""), |row| row.section.clone()), None);
    ui.strong(section.as_ref());
    Grid::new(section.as_ref()).num_columns(2).spacing([12.0, 2.0]).max_col_width(cell).striped(true).show(
        ui,
        |ui| {
            for row in rows {
                chosen = chosen.take().or(line(ui, row));
                ui.end_row();
            }
        },
    );
    ui.add_space(6.0);
    chosen
}

/// The sections in so many columns, in their order, none much longer than the others.
fn columns(rows: &[SheetRow], count: usize) -> Vec<Vec<&[SheetRow]>> {
    /// A heading takes as much as so many rows.
    const HEADING: usize = 2;
    let sections: Vec<&[SheetRow]> = rows.chunk_by(|one, next| one.section == next.section).collect();
    let tall = |most: usize| {
        let mut columns: Vec<Vec<&[SheetRow]>> = vec![Vec::new()];
        let mut height = 0;
        for section in &sections {
            let more = section.len() + HEADING;
            if height + more > most && height > 0 {
                columns.push(Vec::new());
                height = 0;
            }
            height += more;
            columns.last_mut().expect("there is one").push(section);
        }
        columns
    };
    let all = rows.len() + HEADING * sections.len();
    // The lowest columns that are few enough.
    (1..=all.max(1)).map(tall).find(|columns| columns.len() <= count).unwrap_or_default()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::Keymap;

    #[test]
    fn as_many_columns_are_shown_as_fit_and_none_is_too_narrow() {
        for free in (150..2500).map(|width| vec2(width as f32, 700.0)) {
            let Fit { size, columns, width, cell } = Fit::new(free);
            assert_eq!(size, vec2((free.x - 48.0).max(200.0), 596.0), "{free}: all but the frame");
            let count = f32::from(columns);
            assert!((1..=3).contains(&columns), "{free}: {columns}");
            assert!(columns == 1 || size.x / count >= 360.0, "{free}: {columns} columns are narrow");
            assert!(columns == 3 || size.x / (count + 1.0) < 360.0, "{free}: one more would fit");
            let used = count * (width + 16.0);
            assert!(used <= size.x + 0.01, "{free}: {used} with gaps");
            assert!(width == 440.0 || (width < 440.0 && used > size.x - 0.01), "{free}: all is used");
            assert!((2.0 * cell + 16.0 - width).abs() < 1e-3, "{free}: two cells to a column");
        }
        assert_eq!(Fit::new(vec2(100.0, 100.0)).size, vec2(200.0, 40.0), "room for a few lines");
    }

    #[test]
    fn columns_hold_every_row_once_and_are_about_as_long() {
        let rows = sheet(&Keymap::default());
        for count in 1..=3 {
            let columns = columns(&rows, count);
            assert!(columns.len() <= count, "{count} at most");
            let shown: Vec<&SheetRow> = columns.iter().flatten().copied().flatten().collect();
            assert_eq!(shown, rows.iter().collect::<Vec<_>>(), "{count} columns: all, in their order");
            let longest = columns.iter().map(|column| column.iter().map(|rows| rows.len()).sum::<usize>());
            let longest = longest.max().expect("a column");
            assert!(longest * count <= rows.len() * 2, "{count} columns: the longest has {longest} rows");
        }
    }
}
