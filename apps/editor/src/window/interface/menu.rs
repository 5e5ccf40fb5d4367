//! Menus, made from the table of actions.

use trigon_window::Stage;
use trigon_window::egui::{self, Button, Context, Pos2, Ui};

use crate::window::actions::{self, Action, MENUS};
use crate::window::editor::Editor;

/// A menu that a key opened.
#[derive(Debug)]
pub(crate) struct Popup {
    menu: &'static str,
    /// Where; at the pointer, once it is shown.
    at: Option<Pos2>,
}

impl Popup {
    pub(crate) fn new(menu: &'static str) -> Self {
        Self { menu, at: None }
    }
}

/// The bar of menus.
pub(super) fn bar(ui: &mut Ui, editor: &mut Editor, stage: &mut Stage) {
    let mut chosen = None;
    egui::MenuBar::new().ui(ui, |ui| {
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
    for action in actions::all() {
        if action.menu == menu {
            chosen = entry(ui, editor, action).or(chosen);
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
fn entry(ui: &mut Ui, editor: &Editor, action: &'static Action) -> Option<&'static Action> {
    let refusal = action.refusal(&editor.document);
    let button = Button::new(action.label).shortcut_text(editor.keys.text_of(action));
    let shown = ui.add_enabled(refusal.is_none(), button);
    let shown = shown.on_hover_text(action.help);
    let shown = match refusal {
        Some(reason) => shown.on_disabled_hover_text(format!("{}\n{reason}", action.help)),
        None => shown,
    };
    if shown.clicked() {
        ui.close();
        return Some(action);
    }
    None
}

/// The menu that a key opened, at the pointer.
pub(super) fn popup(context: &Context, editor: &mut Editor, stage: &mut Stage) {
    let Some(popup) = &mut editor.popup else { return };
    let is_new = popup.at.is_none();
    let pointer = || context.pointer_latest_pos().unwrap_or_else(|| context.content_rect().center());
    let at = *popup.at.get_or_insert_with(pointer);
    let menu = popup.menu;
    let mut chosen = None;
    let area =
        egui::Area::new(egui::Id::unique(("popup", menu))).fixed_pos(at).order(egui::Order::Foreground);
    let shown = area.constrain(true).fade_in(false).show(context, |ui| {
        egui::Frame::menu(ui.style()).show(ui, |ui| {
            ui.strong(menu.rsplit('/').next().unwrap_or(menu));
            let opens_itself = |action: &Action| action.name.ends_with(".menu");
            for action in actions::all().filter(|action| action.menu == menu && !opens_itself(action)) {
                chosen = entry(ui, editor, action).or(chosen);
            }
            if menu == "Add" {
                chosen = ["Add/Solids", "Add/Light"]
                    .iter()
                    .flat_map(|menu| actions::all().filter(move |action| action.menu == *menu))
                    .fold(chosen, |chosen, action| entry(ui, editor, action).or(chosen));
            }
        });
    });
    let beside = !is_new && shown.response.clicked_elsewhere();
    if chosen.is_some() || beside {
        editor.popup = None;
    }
    if let Some(action) = chosen {
        editor.choose(stage, action);
        context.request_repaint();
    }
}
