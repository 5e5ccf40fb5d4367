//! Icons in rows, painted: the interface's fonts have letters only.

use trigon_document::scene::Node;
use trigon_window::egui::{Color32, Painter, Pos2, Rect, Stroke, StrokeKind, vec2};

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

    /// A cube, a sun, a camera, a cross.
    pub(super) fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        let stroke = Stroke::new(1.0, color);
        let center = rect.center();
        let at = |x: f32, y: f32| center + vec2(x, y);
        let lines = |lines: &[[Pos2; 2]]| {
            for &line in lines {
                painter.line_segment(line, stroke);
            }
        };
        match self {
            Self::Mesh => {
                let outline = [(0.0, -5.0), (4.5, -2.5), (4.5, 2.5), (0.0, 5.0), (-4.5, 2.5), (-4.5, -2.5)];
                let outline = outline.map(|(x, y)| at(x, y));
                for corner in 0..6 {
                    lines(&[[outline[corner], outline[(corner + 1) % 6]]]);
                }
                [1, 3, 5].into_iter().for_each(|corner| lines(&[[center, outline[corner]]]));
            }
            Self::Light => {
                painter.circle_filled(center, 2.0, color);
                for (x, y) in [(1.0, 0.0), (0.7, 0.7), (0.0, 1.0), (-0.7, 0.7)] {
                    for side in [-1.0, 1.0] {
                        lines(&[[at(3.2 * side * x, 3.2 * side * y), at(5.0 * side * x, 5.0 * side * y)]]);
                    }
                }
            }
            Self::Camera => {
                let body = Rect::from_min_max(at(-5.0, -3.0), at(1.5, 3.0));
                painter.rect_stroke(body, 1.0, stroke, StrokeKind::Middle);
                lines(&[
                    [at(1.5, 0.0), at(5.0, -3.0)],
                    [at(5.0, -3.0), at(5.0, 3.0)],
                    [at(5.0, 3.0), at(1.5, 0.0)],
                ]);
            }
            Self::Empty => lines(&[[at(-4.0, 0.0), at(4.0, 0.0)], [at(0.0, -4.0), at(0.0, 4.0)]]),
        }
    }
}

/// An open eye, or a closed one.
pub(super) fn paint_eye(painter: &Painter, rect: Rect, is_open: bool, color: Color32) {
    let center = rect.center();
    let stroke = Stroke::new(1.0, color);
    let lid = |height: f32| {
        // A flat arch through both corners of the eye.
        let points = (-4..=4).map(|step| {
            let x = step as f32 / 4.0;
            center + vec2(6.0 * x, height * (1.0 - x * x))
        });
        painter.line(points.collect(), stroke);
    };
    lid(3.5);
    if is_open {
        lid(-3.5);
        painter.circle_filled(center, 2.0, color);
    }
}
