//! Presses on the view: clicks that select, the gizmo and the axes in the corner, and V and Alt+V, which open
//! the mesh on the pointer's side of the selection; and texture coordinates from the view.

use trigon_document::scene::NodeId;
use trigon_document::{
    Command, Extrude, ObjectName, PICK_RADIUS, Picks, ProjectUvs, Rip, Select, SelectAction, TransformSpace,
};
use trigon_window::egui::{Pos2, Rect, vec2};
use trigon_window::scene::math::DVec2;
use trigon_window::{Hands, Modifiers, Pane, Stage};

use super::button_start::Click;
use super::editor::{Editor, Message};
use super::panes::pane_of;
use crate::overlay::{Gizmo, GizmoKind, Handle, axis_view_at, camera_at, light_at};
use crate::request::{Request, ToolKind, ViewRequest};
use crate::tool::{Axis, Frames, Freedom, Selected};

/// Selects what is at a place of the window.
pub(crate) fn click(editor: &mut Editor, stage: &mut Stage, at: DVec2, modifiers: Modifiers) {
    if let Some(command) = command(editor, stage, at, modifiers) {
        editor.perform(stage, Request::Run(command));
    }
}

fn command(editor: &mut Editor, stage: &Stage, at: DVec2, modifiers: Modifiers) -> Option<Command> {
    let has = |modifier| modifiers.contains(modifier);
    let action = if has(Modifiers::SHIFT) { SelectAction::Toggle } else { SelectAction::Replace };
    let is_editing = editor.document.selection().is_editing();
    if let Some(object) = overlay_at(editor, stage, at).filter(|_| !is_editing) {
        return Some(Select { objects: vec![ObjectName::of(object)], action, ..Select::default() }.into());
    }
    let (alt, ctrl) = (has(Modifiers::ALT), has(Modifiers::CTRL));
    let pane = stage.pane_at(at);
    let at = at - pane.area.origin();
    ask(editor, stage, &pane, |picks, radius| match (is_editing && alt, is_editing && ctrl) {
        (true, true) => picks.edge_ring(at, radius, action),
        (true, false) => picks.edge_loop(at, radius, action),
        (false, true) => picks.path(at, radius),
        (false, false) => picks.click(at, radius, action),
    })
}

/// Asks the image; the question is given how near is near enough, in physical pixels.
fn ask<T>(
    editor: &mut Editor,
    stage: &Stage,
    pane: &Pane,
    question: impl FnOnce(&Picks<'_>, f64) -> Option<T>,
) -> Option<T> {
    let (reach, radius) = (editor.reach(), PICK_RADIUS * stage.scale());
    editor.pointing.ask(&editor.document, stage, pane, reach, |picks| question(picks, radius)).flatten()
}

/// The light or the camera whose lines are at a place.
fn overlay_at(editor: &Editor, stage: &Stage, at: DVec2) -> Option<NodeId> {
    let pane = stage.pane_at(at);
    let view = editor.overlay_view(stage, &pane);
    let position = view.logical(at - pane.area.origin());
    light_at(&editor.document, &view, position).or_else(|| camera_at(&editor.document, &view, position))
}

impl Editor {
    /// Adds what hangs together with what is under the pointer.
    pub(super) fn select_linked(&mut self, stage: &Stage) {
        if self.select_island(stage) {
            return;
        }
        match self.pointer.and_then(|at| linked(self, stage, at)) {
            Some(command) => self.run(command),
            None => self.message = Message::Refusal("Linked: point at a mesh that is edited".into()),
        }
    }
}

/// Adds what hangs together with what is at a place; nothing where no edited mesh is.
fn linked(editor: &mut Editor, stage: &Stage, at: DVec2) -> Option<Command> {
    let pane = stage.pane_at(at);
    let at = at - pane.area.origin();
    ask(editor, stage, &pane, |picks, radius| picks.linked(at, radius, SelectAction::Add))
}

/// From the corner of the view to the middle of the axes, in points.
const AXES: f32 = 56.0;
/// In a smaller view there are none, in points.
const LEAST_VIEW: f32 = 240.0;

impl Editor {
    /// The gizmo in a view, while something is selected that it could move.
    pub(crate) fn gizmo(&mut self, stage: &Stage, pane: &Pane) -> Option<Gizmo> {
        let kind = self.tools.gizmo.filter(|_| self.tool.is_none() && self.view.overlays)?;
        let (pivot, orientation) = (self.tools.pivot, self.tools.orientation);
        let basis = self.gizmo_cache.basis(&self.document, pivot, self.tools.cursor, orientation)?;
        let view = self.tool_view(stage, pane);
        let axes = Frames::new(orientation, basis.local, basis.normal, &view).chosen;
        Some(Gizmo { kind, center: basis.center, axes })
    }

    /// Where the axes in the corner are; `None` where there is no room for them.
    pub(crate) fn axes_center(&self) -> Option<Pos2> {
        let free: Rect = self.free?;
        let fits = self.view.overlays && free.width() >= LEAST_VIEW && free.height() >= LEAST_VIEW;
        fits.then(|| free.right_top() + vec2(-AXES, AXES))
    }

    /// A press on one of them; returns whether it was.
    pub(crate) fn press_gizmo(&mut self, stage: &mut Stage, hands: Hands) -> bool {
        let Some(press) = Click::new(hands) else { return false };
        let pane = stage.pane_at(press.at);
        let view = self.overlay_view(stage, &pane);
        let at = view.logical(press.at - pane.area.origin());
        if let Some(axis) = self
            .axes_center()
            .filter(|_| pane.side.is_none())
            .and_then(|center| axis_view_at(&view, center, at))
        {
            self.perform(stage, Request::View(ViewRequest::Axis(axis)));
            return true;
        }
        let Some(gizmo) = self.gizmo(stage, &pane) else { return false };
        let Some(handle) = gizmo.handle_at(&view, at) else { return false };
        let tool = match gizmo.kind {
            GizmoKind::Move => ToolKind::Move,
            GizmoKind::Rotate => ToolKind::Rotate,
            GizmoKind::Scale => ToolKind::Scale,
        };
        let freedom = match handle {
            Handle::Axis(axis) => Some(Freedom::Along(Axis::ALL[axis])),
            Handle::Plane(axis) => Some(Freedom::Across(Axis::ALL[axis])),
            Handle::View => None,
        };
        self.start_held(stage, tool, freedom, press);
        true
    }
}

impl Editor {
    /// Rips, and moves what came loose.
    pub(super) fn rip(&mut self, stage: &mut Stage, fill: bool) {
        let Some(selected) = Selected::of(&self.document) else { return };
        let pane = self.pointer.map_or_else(|| pane_of(stage, None), |at| stage.pane_at(at));
        let (view, middle) = (self.tool_view(stage, &pane), selected.median());
        let to_pointer = self.pointer.zip(view.screen(middle));
        let way = to_pointer.map_or(DVec2::X, |(at, from)| at - pane.area.origin() - from);
        let direction = view.dragged(middle, way).to_array();
        let before = self.entries();
        self.run(Rip { direction, space: TransformSpace::World, fill }.into());
        if self.entries() > before {
            self.start_tool(stage, ToolKind::Move);
        }
    }

    /// Projects texture coordinates of the selection in the direction of the view at the pointer, in parallel. The
    /// longer side of the selection fills the image, and the middle of the selection is in its middle.
    pub(super) fn project_from_view(&mut self, stage: &Stage) {
        let Some(selected) = Selected::of(&self.document) else { return };
        let pane = self.pointer.map_or_else(|| pane_of(stage, None), |at| stage.pane_at(at));
        let camera = stage.camera_of(&pane);
        let [right, up] = [camera.right(), camera.up()];
        let projected = || selected.points.iter().map(|point| DVec2::new(right.dot(*point), up.dot(*point)));
        let low = projected().fold(DVec2::INFINITY, DVec2::min);
        let high = projected().fold(DVec2::NEG_INFINITY, DVec2::max);
        let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
        let projection = ProjectUvs {
            center: (right * middle.x + up * middle.y).into(),
            normal: (-camera.forward()).into(),
            up: up.into(),
            height: if size > 0.0 { size } else { 1.0 },
            space: TransformSpace::World,
            ..ProjectUvs::default()
        };
        self.run(projection.into());
    }

    /// Extrudes, and moves the result along its normals.
    pub(super) fn extrude_along_normals(&mut self, stage: &mut Stage) {
        let before = self.entries();
        self.run(Extrude::default().into());
        if self.entries() > before {
            self.start_tool(stage, ToolKind::ShrinkFatten);
        }
    }
}
