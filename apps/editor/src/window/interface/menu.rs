//! Menus, generated from the table of actions, and the command search: every action by its name.

use trigon_window::egui::containers::menu::menu_style;
use trigon_window::egui::{
    Align, Align2, Area, Button, Context, Frame, Id, Key, Layout, MenuBar, Order, Response, RichText,
    ScrollArea, TextEdit, Ui,
};
use trigon_window::{Stage, egui};

use super::bars::{focus_first, label};
use crate::window::actions;
use crate::window::actions::{Action, CONTEXT_MENU, MENUS};
use crate::window::editor::Editor;
use crate::window::panels::Popup;

/// In points.
const POPUP_WIDTH: f32 = 220.0;

/// The bar of menus.
pub(super) fn bar(ui: &mut Ui, editor: &mut Editor, stage: &mut Stage) {
    let mut chosen = None;
    MenuBar::new().ui(ui, |ui| {
        for menu in MENUS {
            ui.menu_button(menu, |ui| chosen = entries(ui, editor, menu).or(chosen));
        }
    });
    if let Some(action) = chosen {
        editor.choose(stage, action);
        ui.ctx().request_repaint();
    }
}

/// The entries of a menu: its actions, and the menus within it where they first come up.
fn entries(ui: &mut Ui, editor: &Editor, menu: &str) -> Option<&'static Action> {
    let mut chosen = None;
    let mut within: Vec<&str> = Vec::new();
    for action in actions::all().filter(|action| !action.opens_menu()) {
        if action.menu == menu {
            if entry(ui, editor, action).clicked() {
                ui.close();
                chosen = Some(action);
            }
            continue;
        }
        let Some(name) = action.menu.strip_prefix(menu).and_then(|rest| rest.strip_prefix('/')) else {
            continue;
        };
        if !within.contains(&name) {
            within.push(name);
            ui.menu_button(name, |ui| chosen = entries(ui, editor, action.menu).or(chosen));
        }
    }
    chosen
}

/// One action with its key; greyed, with the reason, while it cannot run.
fn entry(ui: &mut Ui, editor: &Editor, action: &Action) -> Response {
    let refusal = action.refusal(&editor.document);
    let shortcut = RichText::new(editor.keys.text_of(action)).weak();
    let shown = ui.add_enabled(refusal.is_none(), Button::new(action.label).right_text(shortcut));
    label(&shown, action.label);
    let reason = refusal.map_or_else(String::new, |reason| format!("{}\n{reason}", action.help));
    shown.on_hover_text(action.help).on_disabled_hover_text(reason)
}

/// A menu with those within it below one another, as few movements of the hand as can be.
fn all_entries(ui: &mut Ui, editor: &Editor, menu: &str) -> Option<&'static Action> {
    if menu == CONTEXT_MENU {
        return context_entries(ui, editor);
    }
    let (mut chosen, mut current) = (None, menu);
    ui.strong(menu.rsplit('/').next().unwrap_or(menu));
    for action in actions::also_in(menu) {
        chosen = focusable_entry(ui, editor, action).or(chosen);
    }
    for action in actions::all().filter(|action| !action.opens_menu()) {
        let within = action.menu.strip_prefix(menu);
        if !within.is_some_and(|rest| rest.is_empty() || rest.starts_with('/')) {
            continue;
        }
        if action.menu != current {
            current = action.menu;
            ui.separator();
        }
        chosen = focusable_entry(ui, editor, action).or(chosen);
    }
    chosen
}

/// An entry that arrows and Enter choose, too; itself if it was chosen.
fn focusable_entry(ui: &mut Ui, editor: &Editor, action: &'static Action) -> Option<&'static Action> {
    let shown = entry(ui, editor, action);
    if shown.enabled() {
        focus_first(&shown);
    }
    shown.clicked().then_some(action)
}

/// What is often done with what is selected.
fn context_entries(ui: &mut Ui, editor: &Editor) -> Option<&'static Action> {
    let (mut chosen, is_editing) = (None, editor.document.selection().is_editing());
    for action in actions::context(is_editing) {
        chosen = focusable_entry(ui, editor, action).or(chosen);
    }
    chosen
}

/// The menu that a key or the right button opened, at the pointer.
pub(super) fn popup(context: &Context, editor: &mut Editor, stage: &mut Stage) {
    let Some(Popup { menu, at }) = &mut editor.popup else { return };
    let is_new = at.is_none();
    let pointer = || context.pointer_latest_pos().unwrap_or_else(|| context.content_rect().center());
    let (menu, at) = (*menu, *at.get_or_insert_with(pointer));
    let mut chosen = None;
    let area = Area::new(Id::unique(("popup", menu))).fixed_pos(at).order(Order::Foreground);
    let shown = area.constrain(true).fade_in(false).show(context, |ui| {
        Frame::menu(ui.style()).show(ui, |ui| {
            menu_style(ui.style_mut());
            ui.set_max_width(POPUP_WIDTH);
            ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
                chosen = all_entries(ui, editor, menu);
            });
        });
    });
    let beside = !is_new && shown.response.clicked_elsewhere();
    let escaped = context.input(|input| input.key_pressed(Key::Escape));
    if chosen.is_some() || beside || escaped {
        editor.popup = None;
    }
    if let Some(action) = chosen {
        editor.choose(stage, action);
        context.request_repaint();
    }
}

/// Shows it, and does what was chosen.
pub(super) fn show_search(context: &Context, editor: &mut Editor, stage: &mut Stage) {
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
