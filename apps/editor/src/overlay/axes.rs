//! The axes in the corner: they show the directions of x, y and z, and a click on one looks along it. Here
//! are also the 3D cursor and the origins of selected objects.

use trigon_document::Document;
use trigon_document::scene::camera::AxisView;
use trigon_document::scene::math::DVec3;
use trigon_window::egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, vec2};

use super::view::OverlayView;
use super::{AXIS_COLORS, AXIS_NAMES, SELECTED};

/// From the middle to the balls, in logical pixels.
const ARM: f32 = 34.0;
/// Of a ball, in logical pixels.
const BALL: f32 = 9.0;

/// One end of an axis.
struct End {
    at: Pos2,
    /// As it is shown: 0 to 2.
    axis: usize,
    is_positive: bool,
    /// In the document.
    direction: DVec3,
    /// Towards the eye: larger is nearer.
    nearness: f64,
}

/// The six ends, the farthest first.
fn ends(view: &OverlayView, center: Pos2) -> Vec<End> {
    let camera = view.camera();
    let mut ends: Vec<End> = (0..6)
        .map(|index| {
            let (axis, is_positive) = (index / 2, index % 2 == 0);
            let direction = view.up().axes().col(axis) * if is_positive { 1.0 } else { -1.0 };
            let in_view = camera.orientation.conjugate() * direction;
            let at = center + ARM * vec2(in_view.x as f32, -in_view.y as f32);
            End { at, axis, is_positive, direction, nearness: in_view.z }
        })
        .collect();
    ends.sort_by(|a, b| a.nearness.total_cmp(&b.nearness));
    ends
}

/// Draws the axes around a point.
pub(crate) fn draw_axes(painter: &Painter, view: &OverlayView, center: Pos2) {
    for End { at, axis, is_positive, .. } in ends(view, center) {
        let color = AXIS_COLORS[axis];
        if is_positive {
            painter.line_segment([center, at], Stroke::new(2.0, color));
            painter.circle_filled(at, BALL, color);
            let font = FontId::proportional(12.0);
            painter.text(at, Align2::CENTER_CENTER, AXIS_NAMES[axis], font, Color32::BLACK);
        } else {
            painter.circle_filled(at, BALL, color.gamma_multiply(0.35));
            painter.circle_stroke(at, BALL, Stroke::new(1.0, color));
        }
    }
}

/// The view along the axis whose ball is under the pointer: from where the ball is.
pub(crate) fn axis_view_at(view: &OverlayView, center: Pos2, pointer: Pos2) -> Option<AxisView> {
    let end = ends(view, center).into_iter().rev().find(|end| end.at.distance(pointer) <= BALL)?;
    Some(match end.direction.to_array() {
        [1.0, _, _] => AxisView::Right,
        [-1.0, _, _] => AxisView::Left,
        [_, 1.0, _] => AxisView::Top,
        [_, -1.0, _] => AxisView::Bottom,
        [_, _, 1.0] => AxisView::Front,
        _ => AxisView::Back,
    })
}

/// Of the cursor's ring, in logical pixels.
const RADIUS: f32 = 10.0;
/// Pieces of the ring, which change their colour.
const PIECES: usize = 16;
/// Of an origin, in logical pixels.
const DOT: f32 = 3.0;

/// Draws the 3D cursor: a ring of red and white with a cross, readable on any image.
pub(crate) fn draw_cursor(painter: &Painter, view: &OverlayView, cursor: DVec3) {
    let Some(center) = view.point(cursor) else { return };
    let at = |piece: usize| {
        let turn = piece as f32 / PIECES as f32 * std::f32::consts::TAU;
        center + RADIUS * trigon_window::egui::Vec2::angled(turn)
    };
    for piece in 0..PIECES {
        let color = if piece % 2 == 0 { Color32::from_rgb(230, 40, 40) } else { Color32::WHITE };
        painter.line_segment([at(piece), at(piece + 1)], Stroke::new(1.5, color));
    }
    for direction in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
        let ends = [center + direction * (RADIUS * 0.5), center + direction * (RADIUS * 1.5)];
        painter.line_segment(ends, Stroke::new(1.0, Color32::from_gray(20)));
    }
}

/// Draws a dot at the origin of each selected object, the active one's brighter.
pub(crate) fn draw_origins(painter: &Painter, document: &Document, view: &OverlayView) {
    let selection = document.selection();
    let transforms = document.nodes().visible_transforms();
    for &id in &selection.objects {
        let Some(world) = transforms.get(id.index()).copied().flatten() else { continue };
        if let Some(center) = view.point(world.translation) {
            let color = if selection.active == Some(id) { Color32::WHITE } else { SELECTED };
            painter.circle_filled(center, DOT, color);
            painter.circle_stroke(center, DOT, Stroke::new(1.0, Color32::BLACK));
        }
    }
}

#[cfg(test)]
mod tests {
    use trigon_window::egui::pos2;

    use super::super::view::tests::front;
    use super::*;

    #[test]
    fn a_click_on_a_ball_looks_from_there() {
        let (view, center) = (front(), pos2(100.0, 100.0));
        let at = |x: f32, y: f32| axis_view_at(&view, center, center + vec2(x, y));
        assert_eq!(at(ARM, 0.0), Some(AxisView::Right));
        assert_eq!(at(-ARM, 3.0), Some(AxisView::Left));
        assert_eq!(at(0.0, -ARM), Some(AxisView::Top));
        assert_eq!(at(0.0, ARM), Some(AxisView::Bottom));
        assert_eq!(at(0.0, 0.0), Some(AxisView::Front), "the nearer of two");
        assert_eq!(at(20.0, 20.0), None);
    }
}
