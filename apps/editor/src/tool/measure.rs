//! Distances and angles between points of the scene. The document does not change.

use trigon_document::Document;
use trigon_document::mesh::math::{DVec3, elementary};
use trigon_document::modelling::FaceId;
use trigon_document::scene::MeshId;
use trigon_window::{Hands, Input, Key, PointerButton};

use super::expression::Quantity;
use super::modal::{FaceTool, Modal, Step, ToolLabel};
use super::numeric::NumericEntry;
use super::snap::{SnapTarget, SnapTargets};
use super::translate::shown;
use super::view::ToolView;
use super::{Tool, ToolMarks, ToolState};

/// A line of points whose lengths and angles are shown.
#[derive(Debug)]
pub(crate) struct MeasureTool {
    modal: Modal,
    targets: SnapTargets,
    /// Whether what faces hide is found: X-ray.
    through: bool,
    points: Vec<DVec3>,
    /// What a click would add.
    hovered: Option<DVec3>,
}

impl MeasureTool {
    /// Starts with what is visible.
    pub(crate) fn start(document: &Document, through: bool, hands: Hands) -> Self {
        let modal = Modal::new(hands, NumericEntry::new(Quantity::Factor, 1));
        Self { modal, targets: SnapTargets::all(document), through, points: Vec::new(), hovered: None }
    }

    /// A vertex near the pointer, or else a point of an edge, or else of the face under it; with Ctrl that alone.
    fn hover_at(&mut self, view: &ToolView) {
        let kinds = [SnapTarget::Vertex, SnapTarget::Edge, SnapTarget::Face];
        let kinds = if self.modal.inverts_snapping() { &kinds[2..] } else { &kinds[..] };
        let at = self.modal.pointer.in_window();
        self.hovered =
            at.and_then(|at| kinds.iter().find_map(|&kind| self.targets.find(kind, view, at, self.through)));
    }

    fn add(&mut self) -> ToolState {
        let Some(point) = self.hovered else {
            return self.modal.refuse("there is nothing under the pointer");
        };
        self.modal.clear_refusal();
        self.points.push(point);
        ToolState::Running
    }

    fn take_back(&mut self) -> ToolState {
        if self.points.pop().is_some() { ToolState::Running } else { ToolState::Cancelled }
    }

    /// The points, and that under the pointer.
    fn line(&self) -> Vec<DVec3> {
        let hovered = self.hovered.filter(|point| self.points.last().is_some_and(|last| last != point));
        self.points.iter().copied().chain(hovered).collect()
    }
}

/// What a line of points measures.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Measures {
    /// The lengths of its last part and of all of it, in metres.
    last: f64,
    whole: f64,
    /// The angle between its last two parts, in degrees.
    angle: Option<f64>,
}

impl Measures {
    /// Of at least two points.
    fn of(line: &[DVec3]) -> Option<Self> {
        let [.., from, to] = line else { return None };
        let whole = line.windows(2).map(|part| part[0].distance(part[1])).sum();
        let angle = match line {
            [.., before, corner, end] => {
                let [back, ahead] = [before - corner, end - corner];
                let is_angle = back != DVec3::ZERO && ahead != DVec3::ZERO;
                is_angle.then(|| elementary::atan2(back.cross(ahead).length(), back.dot(ahead)).to_degrees())
            }
            _ => None,
        };
        Some(Self { last: from.distance(*to), whole, angle })
    }

    fn in_words(&self) -> String {
        let mut text = format!("{} m", shown(self.last));
        if let Some(angle) = self.angle {
            text += &format!(", {angle:.2}°, {} m in all", shown(self.whole));
        }
        text
    }
}

impl FaceTool for MeasureTool {
    fn wants_face(&self) -> bool {
        false
    }

    fn hover(&mut self, _: &Document, view: &ToolView, _: Option<(MeshId, FaceId)>) {
        self.hover_at(view);
    }
}

impl Tool for MeasureTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        let step = self.modal.step(input, hands);
        self.hover_at(view);
        match (input, step) {
            (Input::Key { logical: Some(Key::Backspace), .. }, _) => self.take_back(),
            (Input::Pressed(PointerButton::Left), Step::Confirm) => self.add(),
            (_, Step::Confirm | Step::Cancel) => Modal::cancel(document),
            _ => ToolState::Running,
        }
    }

    fn status(&self) -> String {
        let measures = Measures::of(&self.line()).map(|measures| measures.in_words() + ". ");
        let text = format!(
            "Measure: {}Click: add a point, Ctrl: anywhere on a face, Backspace: take back, Escape: end",
            measures.unwrap_or_default()
        );
        self.modal.explained(text)
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }

    fn marks(&self) -> ToolMarks {
        let line = self.line();
        let label = Measures::of(&line)
            .zip(line.last())
            .map(|(measures, &at)| ToolLabel { at, text: measures.in_words() });
        ToolMarks {
            lines: line.windows(2).map(|part| [part[0], part[1]]).collect(),
            point: self.hovered,
            label,
            ..ToolMarks::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A right triangle with legs of 3 m and 4 m.
    #[test]
    fn lengths_add_up_and_angles_are_those_at_the_last_corner() {
        let line =
            [DVec3::new(3.0, 0.0, 0.0), DVec3::ZERO, DVec3::new(0.0, 4.0, 0.0), DVec3::new(3.0, 0.0, 0.0)];
        let of = |count: usize| Measures::of(&line[..count]);
        assert_eq!(of(1), None, "a point measures nothing");
        assert_eq!(of(2), Some(Measures { last: 3.0, whole: 3.0, angle: None }), "a length");
        assert_eq!(of(3), Some(Measures { last: 4.0, whole: 7.0, angle: Some(90.0) }), "the right angle");
        let all = of(4).expect("four points");
        assert_eq!((all.last, all.whole), (5.0, 12.0), "the hypotenuse and all sides");
        // 36.8699 degrees: the angle whose tangent is 3/4, from a table.
        assert_eq!(all.in_words(), "5.0000 m, 36.87°, 12.0000 m in all");
        let twice = [DVec3::ZERO, DVec3::X, DVec3::X];
        assert_eq!(Measures::of(&twice).and_then(|measures| measures.angle), None, "no angle with a point");
    }
}
