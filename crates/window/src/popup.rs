//! Menus at the pointer, all with the same frame, used with the mouse or with keys.

use egui::containers::menu::menu_style;
use egui::{
    Align, Area, Button, Context, Frame, Id, Key, Layout, Order, Pos2, Response, RichText, ScrollArea, Ui,
};

/// In points.
const WIDTH: f32 = 240.0;

/// What became of a menu in a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PopupEnd<T> {
    /// It is still open.
    Open,
    /// Escape was pressed, or something beside it.
    Closed,
    /// Something was chosen.
    Chosen(T),
}

/// Shows a menu at a place in points: at the pointer if it has none yet, which it keeps from then on.
/// `entries` adds what it offers, as [`popup_entry`], and returns what was chosen.
pub fn popup_menu<T>(
    context: &Context,
    name: &str,
    at: &mut Option<Pos2>,
    entries: impl FnOnce(&mut Ui) -> Option<T>,
) -> PopupEnd<T> {
    let is_new = at.is_none();
    let pointer = || context.pointer_latest_pos().unwrap_or_else(|| context.content_rect().center());
    let position = *at.get_or_insert_with(pointer);
    let mut chosen = None;
    let area = Area::new(Id::unique(("popup", name))).fixed_pos(position).order(Order::Foreground);
    let shown = area.constrain(true).fade_in(false).show(context, |ui| {
        Frame::menu(ui.style()).show(ui, |ui| {
            menu_style(ui.style_mut());
            ui.set_max_width(WIDTH);
            let height = context.content_rect().height() - 24.0;
            // Not limited to the room below the pointer: the menu moves up instead.
            let scroll = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
            scroll.show(ui, |ui| {
                ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| chosen = entries(ui));
            });
        });
    });
    let beside = !is_new && shown.response.clicked_elsewhere();
    let escaped = context.input(|input| input.key_pressed(Key::Escape));
    match chosen {
        Some(chosen) => PopupEnd::Chosen(chosen),
        None if beside || escaped => PopupEnd::Closed,
        None => PopupEnd::Open,
    }
}

/// An entry of a menu with its key on the right. The first one that can be used takes the keyboard, if
/// nothing else has it: arrows and Enter choose.
pub fn popup_entry(ui: &mut Ui, name: &str, keys: &str, is_enabled: bool) -> Response {
    let button = Button::new(name).right_text(RichText::new(keys).weak());
    let shown = ui.add_enabled(is_enabled, button);
    shown.ctx.accesskit_node_builder(shown.id, |node| node.set_label(name));
    if is_enabled && shown.ctx.memory(|memory| memory.focused().is_none()) {
        shown.request_focus();
    }
    shown
}
