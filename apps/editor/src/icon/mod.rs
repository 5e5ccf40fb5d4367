//! Icons of tools, tabs, kinds of elements and of objects. They are drawn as lines in the colour of the text beside
//! them: so they are sharp at every scale, in both themes, and need no font.

mod shapes;

use trigon_window::egui::{Atom, Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};

/// What an icon stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Icon {
    SelectBox,
    SelectCircle,
    SelectLasso,
    Move,
    Rotate,
    Scale,
    Extrude,
    Inset,
    Bevel,
    LoopCut,
    Slide,
    ShrinkFatten,
    Vertex,
    Edge,
    Face,
    Properties,
    Add,
    Information,
    Development,
    Mesh,
    Light,
    Camera,
    Empty,
    Shown,
    Hidden,
}

/// A part of an icon. Coordinates go from −1 at the left and at the top to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    /// Lines from point to point.
    Line(&'static [[f32; 2]]),
    /// Lines from point to point, and back to the first.
    Loop(&'static [[f32; 2]]),
    /// A convex area.
    Area(&'static [[f32; 2]]),
    /// A circle: centre and radius.
    Circle([f32; 2], f32),
    /// A filled circle: centre and radius.
    Dot([f32; 2], f32),
}

/// Of an icon in a button or a row, in points.
const SIZE: f32 = 14.0;

impl Icon {
    /// The icon of an action of the table that has one.
    pub(crate) fn of_action(name: &str) -> Option<Self> {
        Some(match name {
            "select.box" => Self::SelectBox,
            "select.circle" => Self::SelectCircle,
            "select.lasso" => Self::SelectLasso,
            "tool.move" => Self::Move,
            "tool.rotate" => Self::Rotate,
            "tool.scale" => Self::Scale,
            "mesh.extrude" => Self::Extrude,
            "mesh.inset" => Self::Inset,
            "mesh.bevel" => Self::Bevel,
            "mesh.loop_cut" => Self::LoopCut,
            "mesh.edge_slide" => Self::Slide,
            "tool.shrink_fatten" => Self::ShrinkFatten,
            _ => return None,
        })
    }

    /// The icon within a button, beside its text.
    pub(crate) fn atom(self) -> Atom<'static> {
        Atom::paint(vec2(SIZE, SIZE), move |ui, args| {
            self.paint(ui.painter(), args.rect, args.fallback_text_color);
        })
    }

    /// Draws it into the largest square in the middle of a rectangle.
    pub(crate) fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        let half = 0.5 * rect.width().min(rect.height()).min(SIZE);
        let at = |[x, y]: [f32; 2]| rect.center() + half * vec2(x, y);
        let points = |points: &[[f32; 2]]| -> Vec<Pos2> { points.iter().map(|&point| at(point)).collect() };
        let stroke = Stroke::new(half * 0.18, color);
        for part in self.parts() {
            painter.add(match *part {
                Part::Line(line) => Shape::line(points(line), stroke),
                Part::Loop(line) => Shape::closed_line(points(line), stroke),
                Part::Area(area) => Shape::convex_polygon(points(area), color, Stroke::NONE),
                Part::Circle(center, radius) => Shape::circle_stroke(at(center), radius * half, stroke),
                Part::Dot(center, radius) => Shape::circle_filled(at(center), radius * half, color),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn icons_stay_within_their_square() {
        let all = [
            Icon::SelectBox,
            Icon::SelectCircle,
            Icon::SelectLasso,
            Icon::Move,
            Icon::Rotate,
            Icon::Scale,
            Icon::Extrude,
            Icon::Inset,
            Icon::Bevel,
            Icon::LoopCut,
            Icon::Slide,
            Icon::ShrinkFatten,
            Icon::Vertex,
            Icon::Edge,
            Icon::Face,
            Icon::Properties,
            Icon::Add,
            Icon::Information,
            Icon::Development,
            Icon::Mesh,
            Icon::Light,
            Icon::Camera,
            Icon::Empty,
            Icon::Shown,
            Icon::Hidden,
        ];
        for icon in all {
            let inside = |point: &[f32; 2]| point.iter().all(|at| at.abs() <= 1.0);
            for part in icon.parts() {
                let is_inside = match part {
                    Part::Line(points) | Part::Loop(points) | Part::Area(points) => points.iter().all(inside),
                    Part::Circle([x, y], radius) | Part::Dot([x, y], radius) => {
                        x.abs().max(y.abs()) + radius <= 1.0
                    }
                };
                assert!(is_inside, "{icon:?}: {part:?}");
            }
        }
    }
}
