//! One row of the outliner: fold, kind, name, visibility. Its icons are painted: the interface's fonts have
//! letters only.

use trigon_document::scene::{Node, NodeId};
use trigon_document::{Document, ObjectName, RenameObject, SelectAction, ShowObjects};
use trigon_window::egui;
use trigon_window::egui::{
    Color32, Key, Painter, Pos2, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo, collapsing_header, vec2,
};

use super::drop::menu;
use super::rows::{Row, Rows};
use super::{OutlinerState, drop, select};
use crate::panel::row::select_all_at_first;
use crate::request::Request;

/// How far children are moved to the right, in points.
const INDENT: f32 = 12.0;

/// The room of an icon, in points.
const ICON_SIZE: Vec2 = Vec2::new(14.0, 18.0);

/// Deeper than that, rows are not moved farther, so that names stay in view.
const DEEPEST: usize = 8;

/// A row with what it shows.
pub(super) struct Line<'l> {
    pub(super) document: &'l Document,
    pub(super) rows: &'l Rows,
    pub(super) row: Row,
    pub(super) node: &'l Node,
}

impl Line<'_> {
    /// Shows the row, and requests what is done in it.
    pub(super) fn show(&self, ui: &mut Ui, state: &mut OutlinerState, requests: &mut Vec<Request>) {
        let Self { document, row, node, .. } = *self;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.add_space(INDENT * row.depth.min(DEEPEST) as f32);
            self.fold(ui, state);
            let kind = Kind::of(node);
            let (icon, response) = ui.allocate_exact_size(ICON_SIZE, Sense::hover());
            kind.paint(ui.painter(), icon, ui.visuals().text_color());
            response.on_hover_text(kind.name());
            let eye = ui.spacing().interact_size.y;
            let width = (ui.available_width() - eye - 4.0).max(eye);
            if state.renaming.as_ref().is_some_and(|renaming| renaming.object == row.id) {
                rename(ui, width, state, requests);
            } else {
                let response = name(ui, width, document, row.id, node);
                self.clicked(ui, &response, state, requests);
                drop::on_row(ui, &response, document, row.id, requests);
                menu(&response, document, state, row.id, requests);
            }
            visibility(ui, eye, node, row.id, requests);
        });
    }

    /// The triangle of a row that others hang on.
    fn fold(&self, ui: &mut Ui, state: &mut OutlinerState) {
        let sense = if self.row.has_children { Sense::click() } else { Sense::empty() };
        let (_, response) = ui.allocate_exact_size(ICON_SIZE, sense);
        if !self.row.has_children {
            return;
        }
        let what = if self.row.is_folded { "Unfold" } else { "Fold" };
        let openness = if self.row.is_folded { 0.0 } else { 1.0 };
        let rect = Rect::from_center_size(response.rect.center(), Vec2::splat(9.0));
        collapsing_header::paint_default_icon(ui, openness, &response.clone().with_new_rect(rect));
        let name = format!("{what} {}", self.node.name);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        if response.clicked() {
            state.toggled = Some(self.row.id);
        }
    }

    fn clicked(&self, ui: &Ui, response: &Response, state: &mut OutlinerState, requests: &mut Vec<Request>) {
        let (id, document) = (self.row.id, self.document);
        if response.double_clicked() {
            state.rename(document, id);
        } else if response.clicked() {
            let modifiers = ui.input(|input| input.modifiers);
            match state.anchor.filter(|_| modifiers.shift) {
                Some(anchor) => {
                    select(document, self.rows.range(anchor, id), SelectAction::Replace, requests);
                }
                None => {
                    state.anchor = Some(id);
                    let action = if modifiers.command { SelectAction::Toggle } else { SelectAction::Replace };
                    select(document, vec![id], action, requests);
                }
            }
        }
    }
}

/// The name, which can be clicked and dragged.
fn name(ui: &mut Ui, width: f32, document: &Document, id: NodeId, node: &Node) -> Response {
    let selection = document.selection();
    let is_selected = selection.objects.contains(&id);
    let shown = if node.name.is_empty() { "(no name)" } else { node.name.as_str() };
    let mut text = RichText::new(shown);
    if selection.active == Some(id) && is_selected {
        text = text.strong();
    }
    if !node.visible {
        text = text.weak();
    }
    let button = egui::Button::selectable(is_selected, text).truncate().sense(Sense::click_and_drag());
    let layout = egui::Layout::left_to_right(egui::Align::Center).with_main_justify(true);
    let size = vec2(width, ui.spacing().interact_size.y);
    let response =
        ui.allocate_ui_with_layout(size, layout.with_main_align(egui::Align::Min), |ui| ui.add(button));
    response.inner.accessible_name(shown)
}

/// The field that replaces a name: Enter or a click elsewhere accepts it, Escape does not.
fn rename(ui: &mut Ui, width: f32, state: &mut OutlinerState, requests: &mut Vec<Request>) {
    let Some(renaming) = &mut state.renaming else { return };
    let field = egui::TextEdit::singleline(&mut renaming.text).desired_width(width);
    let mut field = field.show(ui);
    let response = Response::clone(&field.response).accessible_name("New name");
    if !renaming.is_open {
        response.request_focus();
        select_all_at_first(&mut field);
        renaming.is_open = true;
    } else if response.lost_focus() {
        if !ui.input(|input| input.key_pressed(Key::Escape)) {
            let (object, name) = (ObjectName::of(renaming.object), renaming.text.clone());
            requests.push(Request::Run(RenameObject { object, name }.into()));
        }
        state.renaming = None;
    }
}

/// The eye: open while the object is shown.
fn visibility(ui: &mut Ui, size: f32, node: &Node, id: NodeId, requests: &mut Vec<Request>) {
    let (rect, response) = ui.allocate_exact_size(vec2(size, size), Sense::click());
    let visuals = ui.style().interact(&response);
    let color = if node.visible { visuals.text_color() } else { ui.visuals().weak_text_color() };
    paint_eye(ui.painter(), rect, node.visible, color);
    let what = if node.visible { "Hide" } else { "Show" };
    let name = format!("{what} {}", node.name);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    if response.on_hover_text(what).clicked() {
        let show = ShowObjects { objects: vec![ObjectName::of(id)], visible: !node.visible };
        requests.push(Request::Run(show.into()));
    }
}

/// What a node holds, as it is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Mesh,
    Light,
    Camera,
    Empty,
}

impl Kind {
    pub(super) fn of(node: &Node) -> Self {
        match node {
            Node { mesh: Some(_), .. } => Self::Mesh,
            Node { light: Some(_), .. } => Self::Light,
            Node { camera: Some(_), .. } => Self::Camera,
            _ => Self::Empty,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Mesh => "Mesh",
            Self::Light => "Light",
            Self::Camera => "Camera",
            Self::Empty => "Empty",
        }
    }

    /// A cube, a sun, a camera, a cross.
    pub(super) fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        let stroke = Stroke::new(1.0, color);
        let center = rect.center();
        let at = |x: f32, y: f32| center + vec2(x, y);
        let lines = |lines: &[[Pos2; 2]]| {
            for &line in lines {
                painter.line_segment(line, stroke);
            }
        };
        match self {
            Self::Mesh => {
                let outline = [(0.0, -5.0), (4.5, -2.5), (4.5, 2.5), (0.0, 5.0), (-4.5, 2.5), (-4.5, -2.5)];
                let outline = outline.map(|(x, y)| at(x, y));
                for corner in 0..6 {
                    lines(&[[outline[corner], outline[(corner + 1) % 6]]]);
                }
                [1, 3, 5].into_iter().for_each(|corner| lines(&[[center, outline[corner]]]));
            }
            Self::Light => {
                painter.circle_filled(center, 2.0, color);
                for (x, y) in [(1.0, 0.0), (0.7, 0.7), (0.0, 1.0), (-0.7, 0.7)] {
                    for side in [-1.0, 1.0] {
                        lines(&[[at(3.2 * side * x, 3.2 * side * y), at(5.0 * side * x, 5.0 * side * y)]]);
                    }
                }
            }
            Self::Camera => {
                let body = Rect::from_min_max(at(-5.0, -3.0), at(1.5, 3.0));
                painter.rect_stroke(body, 1.0, stroke, StrokeKind::Middle);
                lines(&[
                    [at(1.5, 0.0), at(5.0, -3.0)],
                    [at(5.0, -3.0), at(5.0, 3.0)],
                    [at(5.0, 3.0), at(1.5, 0.0)],
                ]);
            }
            Self::Empty => lines(&[[at(-4.0, 0.0), at(4.0, 0.0)], [at(0.0, -4.0), at(0.0, 4.0)]]),
        }
    }
}

/// An open eye, or a closed one.
pub(super) fn paint_eye(painter: &Painter, rect: Rect, is_open: bool, color: Color32) {
    let center = rect.center();
    let stroke = Stroke::new(1.0, color);
    let lid = |height: f32| {
        // A flat arch through both corners of the eye.
        let points = (-4..=4).map(|step| {
            let x = step as f32 / 4.0;
            center + vec2(6.0 * x, height * (1.0 - x * x))
        });
        painter.line(points.collect(), stroke);
    };
    lid(3.5);
    if is_open {
        lid(-3.5);
        painter.circle_filled(center, 2.0, color);
    }
}
