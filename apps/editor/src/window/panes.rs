//! One view or four: which of them the pointer is in, and how tools and overlays see it.
//!
//! The window has one scene and one camera; `trigon_window::Pane` says where its views are. A tool stays in
//! the view in which it was started, and uses that view's own pixels.

use trigon_window::egui::{Align2, FontId, Painter, Pos2, Rect, Stroke, Visuals, pos2, vec2};
use trigon_window::scene::camera::{AxisView, Viewport};
use trigon_window::scene::math::DVec2;
use trigon_window::{Area, Hands, Pane, Stage};

use super::editor::Editor;
use crate::overlay::OverlayView;
use crate::tool::ToolView;

/// Of the names of views, in points.
const NAME: f32 = 13.0;

/// The view that shows a side, or the camera's own; that of the camera where no view shows the side any more.
pub(crate) fn pane_of(stage: &Stage, side: Option<AxisView>) -> Pane {
    let panes = stage.panes();
    let found = panes.iter().find(|pane| pane.side == side).or(panes.iter().find(|pane| pane.side.is_none()));
    *found.expect("one view is the camera's own")
}

/// The same hands in the pixels of a view.
pub(crate) fn in_pane(hands: Hands, pane: &Pane) -> Hands {
    Hands { pointer: hands.pointer.map(|at| at - pane.area.origin()), ..hands }
}

/// The point of the interface at physical pixels of the window.
pub(crate) fn point(stage: &Stage, at: DVec2) -> Pos2 {
    let at = at / points(stage);
    pos2(at.x as f32, at.y as f32)
}

/// Physical pixels to a point of the interface.
pub(super) fn points(stage: &Stage) -> f64 {
    stage.scale() * f64::from(stage.text_scale.clamp(0.5, 4.0))
}

/// From where a view looks.
pub(crate) fn name_of(pane: &Pane) -> &'static str {
    match pane.side {
        Some(AxisView::Top) => "Top",
        Some(AxisView::Front) => "Front",
        Some(AxisView::Right) => "Right",
        _ if pane.orbit.is_orthographic() => "Orthographic",
        _ => "Perspective",
    }
}

/// Names a view in its upper left corner.
pub(crate) fn draw_name(painter: &Painter, visuals: &Visuals, view: &OverlayView, name: &str) {
    let (at, color) = (view.rect().min + vec2(8.0, 6.0), visuals.strong_text_color());
    painter.text(at, Align2::LEFT_TOP, name, FontId::proportional(NAME), color);
}

/// Draws the border of one of several views.
pub(crate) fn draw_border(painter: &Painter, visuals: &Visuals, view: &OverlayView) {
    let stroke = Stroke::new(1.0, visuals.window_stroke.color);
    painter.rect_stroke(view.rect(), 0.0, stroke, trigon_window::egui::StrokeKind::Inside);
}

impl Editor {
    /// A view in points, as everything over the image is drawn.
    pub(crate) fn overlay_view(&self, stage: &Stage, pane: &Pane) -> OverlayView {
        let view = OverlayView::new(&stage.camera_of(pane), pane.area.size, points(stage));
        view.placed_at(pane.area.origin()).with_up(self.up())
    }

    /// How tools see a view.
    pub(crate) fn tool_view(&self, stage: &Stage, pane: &Pane) -> ToolView {
        let (camera, viewport) = (stage.camera_of(pane), pane.area.size);
        ToolView { camera, viewport, scale: stage.scale(), up: self.up() }
    }

    /// Whether the pointer is on the image, beside all panels.
    pub(super) fn is_in_view(&self, stage: &Stage, hands: Hands) -> bool {
        let Some((free, at)) = self.free.zip(hands.pointer) else { return true };
        free.contains(point(stage, at))
    }
}

/// The physical pixels of a part of the interface.
pub(crate) fn area(stage: &Stage, part: Rect) -> Area {
    let pixels = |points_of: f32| (f64::from(points_of.max(0.0)) * points(stage)).round() as u32;
    let (min, max) = (part.min, part.max);
    let [left, top] = [pixels(min.x), pixels(min.y)];
    let (width, height) = (pixels(max.x).saturating_sub(left), pixels(max.y).saturating_sub(top));
    Area { min: [left, top], size: Viewport { width, height } }
}
