//! Everything drawn over the image: the grid, lights, cameras, the cursor, gizmos, and the drawings of tools
//! and gestures.

use trigon_document::scene::Region;
use trigon_window::egui::{Color32, FontId, Painter, Rect, Shape, Stroke, Ui, Vec2, vec2};
use trigon_window::scene::camera::Viewport;
use trigon_window::{Pane, Stage};

use crate::overlay::{
    GestureOutline, OverlayView, draw_axes, draw_camera_frame, draw_cameras, draw_cursor, draw_gesture,
    draw_grid, draw_lights, draw_origins,
};
use crate::tool::ToolMarks;
use crate::window::editor::Editor;
use crate::window::images::RenderChoices;
use crate::window::navigation;
use crate::window::panes::{draw_border, draw_name, name_of};

/// Of what tools draw.
const INK: Color32 = Color32::from_rgb(255, 240, 120);
/// What something snapped to, in points.
const SNAPPED: f32 = 7.0;
/// From a point to the text beside it, in points.
const BESIDE: Vec2 = vec2(14.0, 10.0);

/// Draws it, before the panels: they lie over it.
pub(super) fn show_view(ui: &Ui, editor: &mut Editor, stage: &Stage) {
    let panes = stage.panes();
    for pane in &panes {
        let view = editor.overlay_view(stage, pane);
        let painter = ui.painter().with_clip_rect(view.rect());
        show_pane(&painter, editor, stage, pane, &view);
        draw_name(&painter, ui.visuals(), &view, &name(editor, pane));
        if panes.len() > 1 {
            draw_border(&painter, ui.visuals(), &view);
        }
    }
}

/// Draws what lies over one view.
fn show_pane(painter: &Painter, editor: &mut Editor, stage: &Stage, pane: &Pane, view: &OverlayView) {
    let origin = pane.area.origin();
    if let Some((_, camera)) = navigation::camera(&editor.document)
        && editor.view.camera.is_some()
        && pane.side.is_none()
    {
        let RenderChoices { width, height, .. } = editor.images.choices;
        draw_camera_frame(painter, view, &camera, Viewport { width, height });
    }
    if editor.view.overlays {
        draw_grid(painter, view, &|points| stage.distances_at(points.iter().map(|&at| at + origin)));
        draw_lights(painter, &editor.document, view);
        draw_cameras(painter, &editor.document, view);
        draw_origins(painter, &editor.document, view);
        draw_cursor(painter, view, editor.tools.cursor);
    }
    if let Some(gizmo) = editor.gizmo(stage, pane) {
        let pointer = editor.pointer.filter(|at| pane.area.contains(*at));
        let pointer = pointer.map(|at| view.logical(at - origin));
        gizmo.draw(painter, view, pointer.and_then(|at| gizmo.handle_at(view, at)));
    }
    if let Some(tool) = &editor.tool {
        draw_marks(painter, view, &tool.marks());
        if let Some(region) = tool.region().filter(|_| tool.side() == pane.side) {
            draw_gesture(painter, &outline(view, &region));
        }
    }
    if let Some(center) = editor.axes_center().filter(|_| pane.side.is_none()) {
        draw_axes(painter, view, center);
    }
}

/// From where a view looks, and, in the camera's own, the active object: many operations are about that one.
fn name(editor: &Editor, pane: &Pane) -> String {
    let side = name_of(pane);
    let (nodes, active) = (editor.document.nodes(), editor.document.selection().active);
    match active.and_then(|id| nodes.node(id)).filter(|_| pane.side.is_none()) {
        Some(node) => format!("{side} · {}", node.name),
        None => side.into(),
    }
}

fn draw_marks(painter: &Painter, view: &OverlayView, marks: &ToolMarks) {
    let stroke = Stroke::new(1.5, INK);
    for [from, to] in &marks.lines {
        if let Some(line) = view.line(*from, *to) {
            // So that it is seen on light surfaces, too.
            painter.line_segment(line, Stroke::new(3.5, Color32::from_black_alpha(150)));
            painter.line_segment(line, stroke);
        }
    }
    if let Some((center, radius)) = marks.circle
        && let Some(at) = view.point(center)
    {
        painter.circle_stroke(at, (radius / view.pixel_size(center)).min(1e4) as f32, Stroke::new(1.0, INK));
    }
    if let Some(at) = marks.point.and_then(|point| view.point(point)) {
        painter.add(Shape::circle_stroke(at, SNAPPED, stroke));
    }
    if let Some(label) = &marks.label
        && let Some(at) = view.point(label.at)
    {
        let galley = painter.layout_no_wrap(label.text.clone(), FontId::proportional(13.0), INK);
        let area = Rect::from_min_size(at + BESIDE, galley.size());
        painter.rect_filled(area.expand(4.0), 4.0, Color32::from_black_alpha(180));
        painter.galley(area.min, galley, INK);
    }
}

/// A region in physical pixels as it is drawn.
fn outline(view: &OverlayView, region: &Region) -> GestureOutline {
    match region {
        Region::Rectangle { min, max } => GestureOutline::Box([view.logical(*min), view.logical(*max)]),
        Region::Circle { center, radius } => {
            let center = view.logical(*center);
            let right = view.logical(view.physical(center) + trigon_window::scene::math::DVec2::X * *radius);
            GestureOutline::Circle { center, radius: right.x - center.x }
        }
        Region::Lasso(points) => GestureOutline::Lasso(points.iter().map(|at| view.logical(*at)).collect()),
        _ => GestureOutline::Lasso(Vec::new()),
    }
}
