//! The outlines of region selections.

use trigon_window::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind};

/// What is drawn while a region is chosen, in logical pixels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum GestureOutline {
    /// From one corner to the opposite one.
    Box([Pos2; 2]),
    /// A brush around the pointer.
    Circle { center: Pos2, radius: f32 },
    /// The path of the pointer so far; its end is joined to its start.
    Lasso(Vec<Pos2>),
}

const INK: Color32 = Color32::WHITE;
const SHADE: Color32 = Color32::from_black_alpha(160);
const FILL: Color32 = Color32::from_rgba_premultiplied(24, 24, 24, 24);
/// Of a dash, in logical pixels.
const DASH: f32 = 5.0;

/// Draws white dashes on a dark line, readable on any image.
pub(crate) fn draw_gesture(painter: &Painter, gesture: &GestureOutline) {
    match gesture {
        GestureOutline::Box([from, to]) => {
            let area = Rect::from_two_pos(*from, *to);
            // Of a rectangle without an area egui makes places that are no numbers.
            if area.is_positive() {
                painter.rect_filled(area, 0.0, FILL);
                painter.rect_stroke(area, 0.0, Stroke::new(1.0, SHADE), StrokeKind::Middle);
            }
            let corners = [area.left_top(), area.right_top(), area.right_bottom(), area.left_bottom()];
            draw_closed(painter, &corners);
        }
        GestureOutline::Circle { center, radius } => {
            painter.circle_stroke(*center, *radius, Stroke::new(2.0, SHADE));
            painter.circle_stroke(*center, *radius, Stroke::new(1.0, INK));
        }
        GestureOutline::Lasso(points) => draw_closed(painter, points),
    }
}

fn draw_closed(painter: &Painter, points: &[Pos2]) {
    let Some(&first) = points.first() else { return };
    if points.iter().all(|point| *point == first) {
        return;
    }
    let mut line = points.to_vec();
    line.push(first);
    painter.add(Shape::line(line.clone(), Stroke::new(1.5, SHADE)));
    painter.extend(Shape::dashed_line(&line, Stroke::new(1.0, INK), DASH, DASH));
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_window::egui::{Context, RawInput, epaint::Primitive, pos2};

    /// The first press of a box has no size yet; what is not a number would end the program.
    #[test]
    fn regions_without_a_size_have_places_that_are_numbers() {
        let at = pos2(300.0, 150.0);
        let beside = [pos2(301.0, 150.0), pos2(300.0, 151.0), pos2(300.000_03, 150.0), at];
        let boxes = beside.into_iter().map(|to| GestureOutline::Box([at, to]));
        let lassos = beside.into_iter().map(|to| GestureOutline::Lasso(vec![at, to, at]));
        let circle = GestureOutline::Circle { center: at, radius: 0.0 };
        for gesture in boxes.chain(lassos).chain([circle, GestureOutline::Lasso(vec![at])]) {
            let context = Context::default();
            let mut output = context.run_ui(RawInput::default(), |ui| draw_gesture(ui.painter(), &gesture));
            output.textures_delta.clear();
            for clipped in context.tessellate(output.shapes.clone(), 1.0) {
                let Primitive::Mesh(mesh) = clipped.primitive else { continue };
                assert!(mesh.vertices.iter().all(|vertex| vertex.pos.is_finite()), "{gesture:?}");
            }
        }
    }
}
