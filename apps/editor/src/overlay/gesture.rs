//! The outlines of selecting by a region.

use trigon_window::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind};

/// What is drawn while a region is chosen, in logical pixels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Gesture {
    /// From one corner to the opposite one.
    Box([Pos2; 2]),
    /// A brush around the pointer.
    Circle { center: Pos2, radius: f32 },
    /// The way of the pointer so far; its end is joined to its start.
    Lasso(Vec<Pos2>),
}

const INK: Color32 = Color32::WHITE;
const SHADE: Color32 = Color32::from_black_alpha(160);
const FILL: Color32 = Color32::from_rgba_premultiplied(24, 24, 24, 24);
/// Of a dash, in logical pixels.
const DASH: f32 = 5.0;

/// Draws white dashes on a dark line, readable on any picture.
pub(crate) fn draw_gesture(painter: &Painter, gesture: &Gesture) {
    match gesture {
        Gesture::Box([from, to]) => {
            let area = Rect::from_two_pos(*from, *to);
            painter.rect_filled(area, 0.0, FILL);
            painter.rect_stroke(area, 0.0, Stroke::new(1.0, SHADE), StrokeKind::Middle);
            let corners = [area.left_top(), area.right_top(), area.right_bottom(), area.left_bottom()];
            draw_closed(painter, &corners);
        }
        Gesture::Circle { center, radius } => {
            painter.circle_stroke(*center, *radius, Stroke::new(2.0, SHADE));
            painter.circle_stroke(*center, *radius, Stroke::new(1.0, INK));
        }
        Gesture::Lasso(points) => draw_closed(painter, points),
    }
}

fn draw_closed(painter: &Painter, points: &[Pos2]) {
    let Some(&first) = points.first() else { return };
    let mut line = points.to_vec();
    line.push(first);
    painter.add(Shape::line(line.clone(), Stroke::new(1.5, SHADE)));
    painter.extend(Shape::dashed_line(&line, Stroke::new(1.0, INK), DASH, DASH));
}
