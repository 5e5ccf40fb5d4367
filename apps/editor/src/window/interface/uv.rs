//! The UV view beside the 3D view, and what is done in it by the pointer.

use trigon_document::SelectAction;
use trigon_window::egui;
use trigon_window::egui::{Align2, FontId, Id, Painter, Panel, PointerButton, Rect, Response, Sense, Ui};
use trigon_window::scene::math::elementary;

use super::bars::choice;
use crate::overlay::{GestureOutline, draw_gesture};
use crate::request::Request;
use crate::uv::{self, Backdrop, Drawing, UvCanvas};
use crate::window::editor::Editor;

/// In points.
const LEAST_WIDTH: f32 = 160.0;

/// A line of the wheel magnifies by this factor for each point that it scrolls.
const ZOOM_PER_POINT: f64 = 0.0024;

/// Shows it while it is open, in half of what is free at first.
pub(super) fn show(ui: &mut Ui, editor: &mut Editor, requests: &mut Vec<Request>) {
    if !editor.uv.is_open {
        editor.uv.canvas = None;
        return;
    }
    let free = ui.available_width();
    let most = (free - LEAST_WIDTH).max(LEAST_WIDTH);
    let panel = Panel::right(Id::unique("uv")).resizable(true).default_size(free * 0.5);
    panel.size_range(LEAST_WIDTH..=most).show(ui, |ui| {
        settings(ui, editor, requests);
        let (response, painter) = ui.allocate_painter(ui.available_size(), Sense::click_and_drag());
        let canvas = editor.uv.camera.canvas(response.rect);
        editor.uv.canvas = Some(canvas);
        navigate(ui, editor, &response, &canvas);
        let drawing = editor.uv.draw(&painter, &canvas, &editor.document);
        if drawing == Drawing::NotEditing || drawing == Drawing::NoCoordinates {
            editor.uv.box_from = None;
        } else {
            select(editor, &painter, &response, &canvas, requests);
        }
        explain(&painter, drawing, ui.visuals().strong_text_color());
    });
}

/// What lies behind, and what colours faces.
fn settings(ui: &mut Ui, editor: &mut Editor, requests: &mut Vec<Request>) {
    ui.horizontal_wrapped(|ui| {
        ui.strong("UV");
        let backdrops =
            [("Image", Backdrop::Image), ("Checker", Backdrop::Checker), ("Nothing", Backdrop::Nothing)];
        let view = &mut editor.uv;
        view.backdrop = choice(ui, "Backdrop", view.backdrop, &backdrops).unwrap_or(view.backdrop);
        let stretch = ui.toggle_value(&mut view.colors.stretch, "Stretch");
        stretch.on_hover_text(
            "Blue faces have the lengths of the surface, red ones are stretched or turned over",
        );
        let overlaps = ui.toggle_value(&mut view.colors.overlaps, "Overlaps");
        overlaps.on_hover_text("Marks faces that lie on others");
        let live = ui.toggle_value(&mut view.live_unwrap, "Live Unwrap");
        live.on_hover_text("Islands follow pins that are moved, and all faces follow seams that are marked");
        for name in ["uv.unwrap", "uv.smart", "uv.pack", "uv.follow", "uv.pin", "uv.stitch"] {
            let Some(action) = crate::window::actions::named(name) else { continue };
            let refusal = action.refusal(&editor.document);
            let button = ui.add_enabled(refusal.is_none(), egui::Button::new(action.label));
            let button =
                button.on_hover_text(action.help).on_disabled_hover_text(refusal.unwrap_or_default());
            if button.clicked() {
                requests.push(action.request());
            }
        }
        if ui.button("Fit").on_hover_text("Shows what is selected, or all (Home)").clicked() {
            frame(editor);
        }
    });
}

/// Shows what is selected as large as it fits.
fn frame(editor: &mut Editor) {
    if let (Some(canvas), Some([low, high])) = (editor.uv.canvas, uv::bounds(&editor.document)) {
        editor.uv.camera.frame(canvas.rect, low, high);
    }
}

/// The middle button moves what is seen, and the wheel magnifies.
fn navigate(ui: &Ui, editor: &mut Editor, response: &Response, canvas: &UvCanvas) {
    let camera = &mut editor.uv.camera;
    let pans = ui.input(|input| input.modifiers.alt) && response.dragged_by(PointerButton::Primary);
    if response.dragged_by(PointerButton::Middle) || pans {
        camera.pan(canvas, response.drag_delta());
    }
    let scrolled = ui.input(|input| input.smooth_scroll_delta.y);
    if let Some(at) = response.hover_pos().filter(|_| scrolled != 0.0) {
        camera.zoom(canvas, at, elementary::exp(f64::from(scrolled) * ZOOM_PER_POINT));
    }
}

/// A click selects an element, a drag those in a box; Shift adds and Ctrl takes away.
fn select(
    editor: &mut Editor,
    painter: &Painter,
    response: &Response,
    canvas: &UvCanvas,
    requests: &mut Vec<Request>,
) {
    let modifiers = painter.ctx().input(|input| input.modifiers);
    let Some(at) = response.interact_pointer_pos() else { return editor.uv.box_from = None };
    if response.clicked() {
        let action = if modifiers.shift { SelectAction::Toggle } else { SelectAction::Replace };
        requests.extend(uv::click(&editor.document, canvas, at, action).map(Request::Run));
    }
    if response.drag_started_by(PointerButton::Primary) && !modifiers.alt {
        editor.uv.box_from = painter.ctx().input(|input| input.pointer.press_origin());
    }
    let Some(from) = editor.uv.box_from else { return };
    if response.drag_stopped() {
        editor.uv.box_from = None;
        let action = match (modifiers.shift, modifiers.ctrl) {
            (true, _) => SelectAction::Add,
            (false, true) => SelectAction::Remove,
            (false, false) => SelectAction::Replace,
        };
        let command = uv::within(&editor.document, canvas, Rect::from_two_pos(from, at), action);
        requests.push(Request::Run(command));
    } else {
        draw_gesture(painter, &GestureOutline::Box([from, at]));
    }
}

/// What is to be done where nothing is seen.
fn explain(painter: &Painter, drawing: Drawing, color: egui::Color32) {
    let text = match drawing {
        Drawing::All => return,
        Drawing::SelectedOnly => "Too many faces to show: only selected ones are",
        Drawing::NoCoordinates => "No texture coordinates yet: select faces and unwrap them (U)",
        Drawing::NotEditing => "Enter edit mode to see texture coordinates (Tab)",
    };
    let at = painter.clip_rect().center_top() + egui::vec2(0.0, 12.0);
    painter.text(at, Align2::CENTER_TOP, text, FontId::proportional(14.0), color);
}
