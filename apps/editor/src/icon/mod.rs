//! Icons of tools, tabs, kinds of elements and of objects. They are drawn as lines in the colour of the text beside
//! them: so they are sharp at every scale, in both themes, and need no font.

mod shapes;

use trigon_window::egui::{Atom, Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};

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
    Knife,
    Measure,
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
    On,
    Off,
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
    /// A part of an ellipse.
    Curve(Arc),
    /// A filled circle: centre and radius.
    Dot([f32; 2], f32),
}

/// A part of an ellipse whose axes are level and upright.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arc {
    center: [f32; 2],
    /// Level and upright.
    radii: [f32; 2],
    /// From where to where, clockwise from the right.
    degrees: [f32; 2],
}

impl Arc {
    /// Points along it, as near to each other as an icon needs.
    fn points(&self) -> Vec<[f32; 2]> {
        let Self { center, radii, degrees: [from, to] } = *self;
        let pieces = ((to - from) / 15.0).ceil();
        let at = |piece: usize| {
            let turn = Vec2::angled((from + (to - from) * piece as f32 / pieces).to_radians());
            [center[0] + radii[0] * turn.x, center[1] + radii[1] * turn.y]
        };
        (0..=pieces as usize).map(at).collect()
    }
}

/// Of an icon in a button or a row, in points.
const SIZE: f32 = 14.0;

impl Icon {
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
                Part::Curve(arc) => Shape::line(points(&arc.points()), stroke),
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
            Icon::Knife,
            Icon::Measure,
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
            Icon::On,
            Icon::Off,
        ];
        for icon in all {
            let inside = |point: &[f32; 2]| point.iter().all(|at| at.abs() <= 1.0);
            for part in icon.parts() {
                let is_inside = match part {
                    Part::Line(points) | Part::Loop(points) | Part::Area(points) => points.iter().all(inside),
                    Part::Curve(arc) => arc.points().iter().all(inside),
                    Part::Dot([x, y], radius) => x.abs().max(y.abs()) + radius <= 1.0,
                };
                assert!(is_inside, "{icon:?}: {part:?}");
            }
        }
    }
}
