//! Measuring: clicks snap to vertices, edges and faces; two of them have a distance, three an angle.

use trigon_camera::Projector;
use trigon_math::{DVec2, DVec3, elementary};
use trigon_scene::{Snap, SnapElement};
use trigon_window::{Hands, Input, Key, PointerButton, Stage, Taken, clip_line, egui};

use crate::model::short;

/// How near a vertex has to be to the pointer, in points.
const RADIUS: f64 = 12.0;

/// An angle has three.
const MOST: usize = 3;

const COLOR: egui::Color32 = egui::Color32::from_rgb(255, 200, 60);

/// The points that were clicked, while there is measured.
#[derive(Default)]
pub(super) struct Measuring {
    points: Option<Vec<Snap>>,
    /// Where the pointer is, in physical pixels, if what a click would snap to there is not found yet. It is found
    /// once for each pass of the interface, however often the pointer moves.
    pointer: Option<DVec2>,
    /// What a click would snap to now.
    hovered: Option<Snap>,
}

impl Measuring {
    pub(super) fn toggle(&mut self) {
        let points = if self.points.is_none() { Some(Vec::new()) } else { None };
        *self = Self { points, ..Self::default() };
    }

    /// Another model is shown.
    pub(super) fn forget(&mut self) {
        self.points.iter_mut().for_each(Vec::clear);
        (self.hovered, self.pointer) = (None, None);
    }

    /// A click adds a point, and begins anew after the third one. Escape ends it.
    pub(super) fn input(&mut self, stage: &Stage, input: &Input, hands: Hands) -> Taken {
        let Some(points) = &mut self.points else { return Taken::No };
        let snap = |at: DVec2| stage.snap(at, RADIUS * stage.scale());
        match input {
            Input::Key { logical: Some(Key::Escape), .. } => self.toggle(),
            Input::Clicked(PointerButton::Left) => {
                if points.len() == MOST {
                    points.clear();
                }
                points.extend(hands.pointer.and_then(snap));
            }
            Input::PointerMoved => {
                self.pointer = hands.pointer;
                if self.pointer.is_none() {
                    self.hovered = None;
                }
            }
            _ => return Taken::No,
        }
        Taken::Yes
    }

    /// Shows points, lines between them and what was measured.
    pub(super) fn show(&mut self, ui: &egui::Ui, stage: &Stage) {
        let Some(points) = &self.points else { return };
        if let Some(at) = self.pointer.take() {
            self.hovered = stage.snap(at, RADIUS * stage.scale());
        }
        if stage.shows_scene() {
            self.draw(ui, stage, points);
        }
        let lines = match stage.shows_scene() {
            true => lines(points, self.hovered),
            false => vec!["Press B until one model is shown.".to_owned()],
        };
        let area = egui::Area::new(egui::Id::unique("measuring")).order(egui::Order::Middle);
        let area = area.anchor(egui::Align2::RIGHT_CENTER, [-8.0, 0.0]).fade_in(false);
        area.constrain_to(ui.available_rect_before_wrap()).show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.strong("Measuring (Escape ends it)");
                for line in &lines {
                    ui.add(egui::Label::new(egui::RichText::new(line).monospace()).extend());
                }
            });
        });
    }

    fn draw(&self, ui: &egui::Ui, stage: &Stage, points: &[Snap]) {
        let projector = Projector::new(&stage.camera(), stage.viewport());
        let scale = f64::from(ui.ctx().pixels_per_point());
        let size = stage.viewport().size();
        let painter = ui.painter().with_clip_rect(ui.available_rect_before_wrap());
        let on_screen = |at: DVec2| egui::pos2((at.x / scale) as f32, (at.y / scale) as f32);
        let all = points.iter().chain(self.hovered.as_ref().filter(|_| points.len() < MOST));
        let points: Vec<Option<DVec2>> = all.map(|snap| projector.to_screen(snap.point)).collect();
        for pair in points.windows(2) {
            let [Some(from), Some(to)] = pair else { continue };
            if let Some((from, to)) = clip_line(*from, *to, size) {
                painter.line_segment([on_screen(from), on_screen(to)], egui::Stroke::new(1.5, COLOR));
            }
        }
        let is_inside = |at: &DVec2| at.cmpge(DVec2::ZERO).all() && at.cmplt(size).all();
        for at in points.into_iter().flatten().filter(is_inside) {
            painter.circle_stroke(on_screen(at), 4.0, egui::Stroke::new(1.5, COLOR));
        }
    }
}

/// What is to be read.
fn lines(points: &[Snap], hovered: Option<Snap>) -> Vec<String> {
    let mut lines: Vec<String> =
        points.iter().zip(1..).map(|(snap, number)| format!("{number}: {}", described(snap))).collect();
    match points {
        [] => lines.push("Click a point.".to_owned()),
        [_] => lines.push("Click a second one.".to_owned()),
        [a, b] => lines.extend(distance(a.point, b.point)),
        [a, b, c, ..] => {
            lines.extend(distance(b.point, c.point));
            lines.push(format!("angle     {:.3}\u{b0} at 2", angle(a.point, b.point, c.point)));
        }
    }
    if points.len() < MOST {
        lines.extend(hovered.map(|snap| format!("here: {}", described(&snap))));
    }
    lines
}

/// "vertex 7 (1, 0.5, -2)"
fn described(snap: &Snap) -> String {
    let element = match snap.element {
        SnapElement::Vertex(index) => format!("vertex {index}"),
        SnapElement::Edge(index) => format!("edge {index}"),
        SnapElement::Face(index) => format!("face {index}"),
    };
    let [x, y, z] = snap.point.to_array().map(length);
    format!("{element} ({x}, {y}, {z})")
}

fn distance(from: DVec3, to: DVec3) -> [String; 2] {
    let way = to - from;
    let [dx, dy, dz] = way.to_array().map(length);
    [format!("distance  {}", length(way.length())), format!("dx dy dz  {dx} {dy} {dz}")]
}

/// At `b`, in degrees.
fn angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (one, other) = (a - b, c - b);
    elementary::atan2(one.cross(other).length(), one.dot(other)).to_degrees()
}

/// Short, with its sign.
fn length(value: f64) -> String {
    if value < 0.0 { format!("-{}", short(-value)) } else { short(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_at_the_second_point() {
        for (c, expected) in [
            (DVec3::Y, 90.0),
            (DVec3::X * 7.0, 0.0),
            (DVec3::NEG_X, 180.0),
            (DVec3::new(1.0, 1.0, 0.0), 45.0),
        ] {
            assert!((angle(DVec3::X, DVec3::ZERO, c) - expected).abs() < 1e-12, "{c}");
        }
        assert_eq!(angle(DVec3::X, DVec3::X, DVec3::Y), 0.0, "of a point that is its own neighbour");
    }

    #[test]
    fn distances_have_signs_in_their_parts() {
        let [distance, parts] = distance(DVec3::new(1.0, 5.0, 0.0), DVec3::new(4.0, 1.0, 0.0));
        assert_eq!((distance.as_str(), parts.as_str()), ("distance  5", "dx dy dz  3 -4 0"));
    }
}
