//! The top bar with modes and settings, and the tools on the left.

use trigon_document::ElementKind;
use trigon_window::egui::{Atom, Button, Ui};
use trigon_window::{Stage, egui};

use crate::icon::Icon;
use crate::request::{
    DisplayMode, GizmoKind, Orientation, Pivot, Request, SnapSource, SnapTarget, SolidColor, UiRequest,
    ViewRequest,
};
use crate::window::actions;
use crate::window::actions::ToolButton;
use crate::window::editor::Editor;

/// Mode, element kinds, projection, display, snapping, pivot, orientation.
pub(super) fn top(ui: &mut Ui, editor: &Editor, stage: &Stage, requests: &mut Vec<Request>) {
    ui.horizontal_wrapped(|ui| {
        mode(ui, editor, requests);
        ui.separator();
        view(ui, editor, stage, requests);
        ui.separator();
        tool_settings(ui, editor, requests);
    });
}

fn mode(ui: &mut Ui, editor: &Editor, requests: &mut Vec<Request>) {
    let selection = editor.document.selection();
    let is_editing = selection.is_editing();
    for (name, edits) in [("Object Mode", false), ("Edit Mode", true)] {
        if ui.selectable_label(is_editing == edits, name).clicked() && is_editing != edits {
            requests.push(Request::Ui(UiRequest::ToggleEditMode));
        }
    }
    if !is_editing {
        return;
    }
    ui.separator();
    let kinds = [
        ("Vertex", ElementKind::Vertex, Icon::Vertex),
        ("Edge", ElementKind::Edge, Icon::Edge),
        ("Face", ElementKind::Face, Icon::Face),
    ];
    for (name, kind, icon) in kinds {
        let is_chosen = selection.kinds().contains(kind);
        let shown = ui.add(Button::selectable(is_chosen, (icon.atom(), name)));
        if shown.on_hover_text("Shift adds or removes this kind of element").clicked() {
            let extend = ui.input(|input| input.modifiers.shift);
            requests.push(Request::Ui(UiRequest::Select { kind, extend }));
        }
    }
}

fn view(ui: &mut Ui, editor: &Editor, stage: &Stage, requests: &mut Vec<Request>) {
    let projection = if stage.orbit.is_orthographic() { "Orthographic" } else { "Perspective" };
    if ui.button(projection).on_hover_text("Numpad5 switches").clicked() {
        requests.push(Request::View(ViewRequest::ToggleOrthographic));
    }
    let modes = [
        ("Wireframe", DisplayMode::Wireframe),
        ("Solid", DisplayMode::Solid),
        ("Matcap", DisplayMode::Matcap),
        ("Textured", DisplayMode::Textured),
        ("Rendered", DisplayMode::Rendered),
    ];
    let chosen = choice(ui, "Display", editor.view.display, &modes);
    requests.extend(chosen.map(|mode| Request::View(ViewRequest::Display(mode))));
    if editor.view.display == DisplayMode::Solid {
        let colors = [("Material", SolidColor::Material), ("Texture", SolidColor::Texture)];
        let chosen = choice(ui, "Color", editor.view.solid, &colors);
        requests.extend(chosen.map(|color| Request::View(ViewRequest::Solid(color))));
    }
    if ui.selectable_label(editor.view.x_ray, "X-Ray").clicked() {
        requests.push(Request::View(ViewRequest::ToggleXRay));
    }
    let four_views = ui.selectable_label(stage.four_views, "Four Views");
    if four_views.on_hover_text("Four views: top, front, right and the current one").clicked() {
        requests.push(Request::View(ViewRequest::ToggleFourViews));
    }
}

fn tool_settings(ui: &mut Ui, editor: &Editor, requests: &mut Vec<Request>) {
    let mut ask = |request: Option<UiRequest>| requests.extend(request.map(Request::Ui));
    let tools = &editor.tools;
    ask(ui.selectable_label(tools.snapping, "Snap").clicked().then_some(UiRequest::Snapping));
    let targets = [
        ("Increment", SnapTarget::Increment),
        ("Grid", SnapTarget::Grid),
        ("Vertex", SnapTarget::Vertex),
        ("Edge", SnapTarget::Edge),
        ("Face", SnapTarget::Face),
    ];
    let sources = [
        ("Closest", SnapSource::Closest),
        ("Center", SnapSource::Center),
        ("Median", SnapSource::Median),
        ("Active", SnapSource::Active),
    ];
    // Without snapping they would only take room.
    if tools.snapping {
        ask(choice(ui, "Snap to", tools.snap_target, &targets).map(UiRequest::Snap));
        ask(choice(ui, "Snap with", tools.snap_source, &sources).map(UiRequest::SnapWith));
    }
    let pivots = [
        ("Bounding Box Center", Pivot::Bounds),
        ("Origin", Pivot::Origin),
        ("3D Cursor", Pivot::Cursor),
        ("Individual Origins", Pivot::Individual),
        ("Median Point", Pivot::Median),
        ("Active Element", Pivot::Active),
    ];
    ask(choice(ui, "Pivot", tools.pivot, &pivots).map(UiRequest::Pivot));
    let orientations = [
        ("Global", Orientation::Global),
        ("Local", Orientation::Local),
        ("Normal", Orientation::Normal),
        ("View", Orientation::View),
    ];
    ask(choice(ui, "Orientation", tools.orientation, &orientations).map(UiRequest::Orientation));
    let gizmos = [
        ("No Gizmo", None),
        ("Move", Some(GizmoKind::Move)),
        ("Rotate", Some(GizmoKind::Rotate)),
        ("Scale", Some(GizmoKind::Scale)),
    ];
    ask(choice(ui, "Gizmo", tools.gizmo, &gizmos).map(UiRequest::Gizmo));
    let proportional = ui.selectable_label(tools.proportional, "Proportional");
    ask(proportional.clicked().then_some(UiRequest::Proportional));
}

/// A list of which one is chosen. Returns another choice.
pub(super) fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    current: T,
    all: &[(&str, T)],
) -> Option<T> {
    let text = all.iter().find(|(_, value)| *value == current).map_or("", |(text, _)| *text);
    let mut chosen = None;
    let shown = egui::ComboBox::from_id_salt(name).selected_text(text).width(0.0).show_ui(ui, |ui| {
        for (text, value) in all {
            if ui.selectable_label(*value == current, *text).clicked() {
                chosen = Some(*value);
            }
        }
    });
    label(&shown.response, &format!("{name}: {text}"));
    shown.response.on_hover_text(name);
    chosen
}

/// A button for each tool of the mode, with its key in the tool tip.
pub(super) fn tools(ui: &mut Ui, editor: &mut Editor, stage: &mut Stage) {
    let is_editing = editor.document.selection().is_editing();
    let mut chosen = None;
    ui.add_space(4.0);
    for ToolButton { action, icon } in actions::tools() {
        if !action.fits_mode(is_editing) {
            continue;
        }
        let refusal = action.refusal(&editor.document);
        let text = format!("{} ({})\n{}", action.label, editor.keys.text_of(action), action.help);
        let width = ui.available_width();
        let is_active = editor.tool.as_ref().is_some_and(|tool| action.starts(tool.kind));
        let button = Button::new((icon.atom(), action.label, Atom::grow()))
            .min_size(egui::vec2(width, 26.0))
            .truncate()
            .selected(is_active);
        let shown = ui.add_enabled(refusal.is_none(), button).on_hover_text(&text);
        let reason = refusal.unwrap_or_default();
        if shown.on_disabled_hover_text(format!("{text}\n{reason}")).clicked() {
            chosen = Some(action);
        }
    }
    if let Some(action) = chosen {
        editor.choose(stage, action);
        ui.ctx().request_repaint();
    }
}

/// Gives the keyboard to a widget if no other has it.
pub(super) fn focus_first(widget: &egui::Response) {
    if widget.ctx.memory(|memory| memory.focused().is_none()) {
        widget.request_focus();
    }
}

/// A label for those who use a screen reader, and for tests.
pub(super) fn label(response: &egui::Response, text: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(text));
}
