//! Menus, generated from the table of actions, and the command search: every action by its name.

use trigon_document::Document;
use trigon_window::egui::containers::menu::menu_style;
use trigon_window::egui::text::{LayoutJob, TextFormat};
use trigon_window::egui::{
    Align, Align2, Area, Button, Color32, Context, Event, EventFilter, Frame, Id, Key, Layout, MenuBar,
    Order, Response, RichText, ScrollArea, Stroke, TextEdit, TextStyle, Ui,
};
use trigon_window::{Stage, egui};

use super::bars::label;
use super::state::state_of;
use crate::icon::Icon;
use crate::window::actions;
use crate::window::actions::{Action, MENUS};
use crate::window::editor::Editor;
use crate::window::popup::Popup;

/// In points.
const POPUP_WIDTH: f32 = 220.0;

/// What is left of the window above and below a menu of the bar, in points.
const BAR_HEIGHT: f32 = 48.0;

/// The bar of menus.
pub(super) fn bar(ui: &mut Ui, editor: &mut Editor, stage: &mut Stage) {
    let mut chosen = None;
    MenuBar::new().ui(ui, |ui| {
        for menu in MENUS {
            ui.menu_button(menu, |ui| {
                // Where it is longer than the window, the wheel scrolls it.
                let height = ui.ctx().content_rect().height() - BAR_HEIGHT;
                ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
                    chosen = entries(ui, editor, stage, menu).or(chosen);
                });
            });
        }
    });
    if let Some(action) = chosen {
        editor.choose(stage, action);
        ui.ctx().request_repaint();
    }
}

/// The entries of a menu: its actions, and the menus within it where they first come up.
fn entries(ui: &mut Ui, editor: &Editor, stage: &Stage, menu: &str) -> Option<&'static Action> {
    let mut chosen = None;
    let mut within: Vec<&str> = Vec::new();
    for action in actions::all().filter(|action| !action.opens_menu()) {
        if action.menu == menu {
            if entry(ui, editor, action, Shown { letter: None, is_on: state_of(action, editor, stage) })
                .clicked()
            {
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
            ui.menu_button(name, |ui| chosen = entries(ui, editor, stage, action.menu).or(chosen));
        }
    }
    chosen
}

/// How an entry of a menu looks.
#[derive(Clone, Copy)]
struct Shown {
    /// The letter that chooses it.
    letter: Option<char>,
    /// Whether it is on, if it is a switch.
    is_on: Option<bool>,
}

/// One action with its key; greyed, with the reason, while it cannot run. The letter that chooses it is underlined, and
/// a switch that is on has a mark.
fn entry(ui: &mut Ui, editor: &Editor, action: &Action, Shown { letter, is_on }: Shown) -> Response {
    let refusal = action.refusal(&editor.document);
    let shortcut = RichText::new(editor.keys.text_of(action)).weak();
    let text = underlined(ui, action.label, letter);
    let button = match is_on {
        Some(true) => Button::new((Icon::On.atom(), text)).selected(true),
        Some(false) => Button::new((Icon::Off.atom(), text)),
        None => Button::new(text),
    };
    let shown = ui.add_enabled(refusal.is_none(), button.right_text(shortcut));
    label(&shown, action.label);
    let reason = refusal.map_or_else(String::new, |reason| format!("{}\n{reason}", action.help));
    shown.on_hover_text(action.help).on_disabled_hover_text(reason)
}

/// A text in which the first of these letters is underlined.
fn underlined(ui: &Ui, text: &str, letter: Option<char>) -> LayoutJob {
    let font = TextStyle::Button.resolve(ui.style());
    let plain = TextFormat::simple(font, Color32::PLACEHOLDER);
    let is_it = |found: char| letter.is_some_and(|letter| found.to_lowercase().eq([letter]));
    let mut job = LayoutJob::default();
    let at = text.find(is_it).unwrap_or(text.len());
    let width = text[at..].chars().next().map_or(0, char::len_utf8);
    let line = Stroke::new(1.0, ui.visuals().text_color());
    job.append(&text[..at], 0.0, plain.clone());
    job.append(&text[at..at + width], 0.0, TextFormat { underline: line, ..plain.clone() });
    job.append(&text[at + width..], 0.0, plain);
    job
}

/// The menu that a key or the right button opened, at the pointer.
pub(super) fn popup(context: &Context, editor: &mut Editor, stage: &mut Stage) {
    let Some(mut popup) = editor.popup.take() else { return };
    let is_new = popup.at.is_none();
    let pointer = || context.pointer_latest_pos().unwrap_or_else(|| context.content_rect().center());
    let at = *popup.at.get_or_insert_with(pointer);
    let mut chosen = popup_keys(context, &mut popup, &editor.document);
    let area = Area::new(Id::unique(("popup", popup.menu))).fixed_pos(at).order(Order::Foreground);
    let shown = area.constrain(true).fade_in(false).show(context, |ui| {
        Frame::menu(ui.style()).show(ui, |ui| {
            menu_style(ui.style_mut());
            ui.set_max_width(POPUP_WIDTH);
            ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
                chosen = popup_entries(ui, editor, stage, &mut popup).or(chosen);
            });
        });
    });
    let beside = !is_new && shown.response.clicked_elsewhere();
    let escaped = context.input(|input| input.key_pressed(Key::Escape));
    if let Some(action) = chosen {
        editor.choose(stage, action);
        context.request_repaint();
    } else if !beside && !escaped {
        editor.popup = Some(popup);
    }
}

/// Letters, Backspace, and arrows.
fn popup_keys(context: &Context, popup: &mut Popup, document: &Document) -> Option<&'static Action> {
    let mut chosen = None;
    let count = popup.entries(document).len();
    let events = context.input(|input| input.events.clone());
    for event in events {
        match event {
            Event::Text(text) => chosen = popup.typed(&text, document).or(chosen),
            Event::Key { key: Key::Backspace, pressed: true, .. } => drop(popup.text.pop()),
            Event::Key { key: Key::ArrowDown, pressed: true, .. } => popup.step(1, count),
            Event::Key { key: Key::ArrowUp, pressed: true, .. } => popup.step(-1, count),
            _ => {}
        }
    }
    chosen
}

/// The lines of the menu; the one that was chosen. The current one has the keyboard, so that Enter chooses it.
fn popup_entries(ui: &mut Ui, editor: &Editor, stage: &Stage, popup: &mut Popup) -> Option<&'static Action> {
    let (mut chosen, mut section) = (None, popup.menu);
    let title = popup.menu.rsplit('/').next().unwrap_or(popup.menu);
    ui.strong(if popup.text.is_empty() { title } else { &popup.text });
    let entries = popup.entries(&editor.document);
    if entries.is_empty() {
        let nothing =
            ui.add(Button::new("no entry has this name").sense(egui::Sense::focusable_noninteractive()));
        nothing.request_focus();
    }
    for (index, entry) in entries.iter().enumerate() {
        if std::mem::replace(&mut section, entry.section) != entry.section {
            ui.separator();
        }
        let looks = Shown { letter: entry.letter, is_on: state_of(entry.action, editor, stage) };
        let shown = self::entry(ui, editor, entry.action, looks);
        if index == popup.index && !shown.has_focus() {
            shown.request_focus();
            shown.scroll_to_me(None);
        }
        let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(shown.id, filter));
        chosen = shown.clicked().then_some(entry.action).or(chosen);
    }
    chosen
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
