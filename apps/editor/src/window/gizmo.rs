//! The gizmo on the selection, the axes in the corner, and presses on them.

use trigon_window::egui::{Pos2, Rect, vec2};
use trigon_window::{Hands, Pane, Stage};

use super::click::Click;
use super::editor::Editor;
use super::panes::{overlay_view, tool_view};
use crate::overlay::{Gizmo, GizmoKind, Handle, axis_view_at};
use crate::request::{Request, ToolKind, ViewRequest};
use crate::tool::{Axis, Frames, Freedom};

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
        let view = tool_view(stage, pane);
        let axes = Frames::new(orientation, basis.local, basis.normal, &view).chosen;
        Some(Gizmo { kind, center: basis.center, axes })
    }

    /// Where the axes in the corner are; `None` where there is no room for them.
    pub(crate) fn axes_center(&self) -> Option<Pos2> {
        let free: Rect = self.free?;
        let has_room = self.view.overlays && free.width() >= LEAST_VIEW && free.height() >= LEAST_VIEW;
        has_room.then(|| free.right_top() + vec2(-AXES, AXES))
    }

    /// A press on one of them; returns whether it was.
    pub(crate) fn press_gizmo(&mut self, stage: &mut Stage, hands: Hands) -> bool {
        let Some(press) = Click::new(hands) else { return false };
        let pane = stage.pane_at(press.at);
        let view = overlay_view(stage, &pane);
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
