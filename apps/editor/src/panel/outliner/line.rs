//! One row of the outliner: fold, kind, name, visibility.

use trigon_document::scene::{Node, NodeId};
use trigon_document::{Document, ObjectName, RenameObject, SelectAction, ShowObjects};
use trigon_window::egui;
use trigon_window::egui::{
    Key, Rect, Response, RichText, Role, Sense, Ui, Vec2, WidgetInfo, collapsing_header, vec2,
};

use super::drop::menu;
use super::rows::{Row, Rows};
use super::{OutlinerState, drop, select};
use crate::icon::Icon;
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
            let (icon, response) = ui.allocate_exact_size(ICON_SIZE, Sense::click());
            kind.icon().paint(ui.painter(), icon, ui.visuals().text_color());
            let what = format!("{} {}", kind.name(), node.name);
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &what));
            self.clicked(ui, &response.on_hover_text(kind.name()), state, requests);
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
    let is_active = selection.active == Some(id) && is_selected;
    if is_active {
        text = text.strong();
    }
    if !node.visible {
        text = text.weak();
    }
    let mut button = egui::Button::selectable(is_selected, text).truncate().sense(Sense::click_and_drag());
    if is_active && selection.objects.len() > 1 {
        button = button.stroke(egui::Stroke::new(1.5, ui.visuals().strong_text_color()));
    }
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
    let eye = if node.visible { Icon::Shown } else { Icon::Hidden };
    eye.paint(ui.painter(), rect, color);
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

    pub(super) fn icon(self) -> Icon {
        match self {
            Self::Mesh => Icon::Mesh,
            Self::Light => Icon::Light,
            Self::Camera => Icon::Camera,
            Self::Empty => Icon::Empty,
        }
    }
}
