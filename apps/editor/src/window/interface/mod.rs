//! Everything around the 3D view. Each part adds its requests to a list, which the editor executes after the
//! layout.

mod bars;
mod menu;
mod overlays;
mod render;
mod side;
mod state;
mod toast;
mod uv;
mod view;

use trigon_window::Stage;
use trigon_window::egui::{Panel, Ui};

use super::editor::{Editor, Message};
use super::panes::area;
use crate::panel::rejected_number;
use crate::request::Request;

/// Shows all of it; returns what is to be done.
pub(crate) fn show(editor: &mut Editor, stage: &mut Stage, ui: &mut Ui) -> Vec<Request> {
    let mut requests = Vec::new();
    editor.leave_side(stage);
    editor.follow_camera(stage);
    view::show_view(ui, editor, stage);
    Panel::top("menus").show(ui, |ui| menu::bar(ui, editor, stage));
    Panel::top("modes").show(ui, |ui| bars::top(ui, editor, stage, &mut requests));
    Panel::bottom("status").show(ui, |ui| side::line(ui, editor));
    if editor.layout.tool_bar {
        Panel::left("tools").resizable(false).exact_size(132.0).show(ui, |ui| bars::tools(ui, editor, stage));
    }
    if editor.layout.side_bar {
        side::show(ui, editor, stage, &mut requests);
    }
    uv::show(ui, editor, &mut requests);
    let free = ui.available_rect_before_wrap();
    editor.free = Some(free);
    stage.view_area = Some(area(stage, free));
    side::adjust(ui.ctx(), editor, free, &mut requests);
    menu::show_search(ui.ctx(), editor, stage);
    menu::popup(ui.ctx(), editor, stage);
    overlays::help(ui.ctx(), editor);
    overlays::rename(ui.ctx(), editor, &mut requests);
    if let Some(text) = rejected_number(ui.ctx()) {
        editor.message = Message::Refusal(text);
    }
    render::show(ui.ctx(), editor, stage);
    toast::show(ui.ctx(), editor, free);
    let waker = stage.waker();
    let chosen = editor.dialog.show(ui.ctx(), &editor.recent, move || waker.wake());
    requests.extend(chosen.map(Request::File));
    overlays::report(ui.ctx(), editor);
    overlays::loading(ui.ctx(), editor, stage);
    overlays::saving(ui.ctx(), editor);
    overlays::show_questions(ui.ctx(), editor, stage);
    requests
}
