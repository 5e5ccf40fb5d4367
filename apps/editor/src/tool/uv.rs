//! Moving, turning and scaling texture coordinates in the UV view: G, R and S there.

use std::f64::consts::TAU;

use trigon_document::mesh::math::{DVec2, elementary};
use trigon_document::{Command, Document, RotateUvs, ScaleUvs, TranslateUvs};
use trigon_window::{Hands, Input};

use super::expression::Quantity;
use super::modal::{Modal, Step};
use super::numeric::NumericEntry;
use super::snap::rounded;
use super::view::ToolView;
use super::{Tool, ToolState};

/// What is done to the coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UvTransform {
    Move,
    Rotate,
    Scale,
}

/// Where coordinates are drawn, in the pixels that the tool's pointer counts in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UvPixels {
    /// The middle of what is transformed.
    pub(crate) center: DVec2,
    /// How long a side of the image is.
    pub(crate) side: f64,
}

/// The only direction that coordinates move or scale in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum UvAxis {
    Across,
    Down,
}

/// A transform of coordinates that runs.
#[derive(Debug)]
pub(crate) struct UvTool {
    modal: Modal,
    kind: UvTransform,
    pixels: UvPixels,
    /// Whether islands follow pins that are moved.
    live_unwrap: bool,
    lock: Option<UvAxis>,
    /// How far the pointer turned around the centre, in turns, and its last direction.
    turns: f64,
    direction: f64,
    text: String,
}

/// With Ctrl, and with Ctrl and Shift: in sides of the image, in degrees, and factors.
const STEPS: [[f64; 2]; 3] = [[1.0 / 16.0, 1.0 / 64.0], [5.0, 1.0], [0.1, 0.01]];

impl UvTool {
    /// Starts on what is selected.
    pub(crate) fn start(kind: UvTransform, pixels: UvPixels, live_unwrap: bool, hands: Hands) -> Self {
        let mut tool = Self {
            modal: Modal::new(hands, NumericEntry::new(Quantity::Factor, 2)),
            kind,
            pixels,
            live_unwrap,
            lock: None,
            turns: 0.0,
            direction: 0.0,
            text: String::new(),
        };
        tool.become_kind(kind);
        tool
    }

    fn become_kind(&mut self, kind: UvTransform) {
        self.kind = kind;
        let (quantity, count, name) = match kind {
            UvTransform::Move => (Quantity::Factor, 2, "Move UVs"),
            UvTransform::Rotate => (Quantity::Angle, 1, "Rotate UVs"),
            UvTransform::Scale => (Quantity::Factor, 2, "Scale UVs"),
        };
        self.modal.numeric = NumericEntry::new(quantity, count);
        self.text = name.into();
        (self.turns, self.direction) = (0.0, self.direction_of_pointer());
    }

    /// In turns, clockwise from the right: y points down.
    fn direction_of_pointer(&self) -> f64 {
        let from_center = self.modal.pointer.position() - self.pixels.center;
        elementary::atan2(from_center.y, from_center.x) / TAU
    }

    fn update(&mut self, document: &mut Document) -> ToolState {
        let now = self.direction_of_pointer();
        let turned = now - self.direction;
        self.turns += turned - turned.round();
        self.direction = now;
        match self.command() {
            Ok(command) => self.modal.show(document, command),
            Err(why) => self.modal.refuse(why),
        }
    }

    /// What the pointer or the typed numbers say.
    fn command(&mut self) -> Result<Command, String> {
        let live_unwrap = self.live_unwrap;
        let typed = match self.modal.numeric.is_active() {
            true => Some(self.modal.numeric.values().map_err(|error| error.to_string())?),
            false => None,
        };
        let value = |index: usize| typed.as_ref().map(|values| values.get(index).copied().flatten());
        Ok(match self.kind {
            UvTransform::Move => {
                let way = self.modal.pointer.way() / self.pixels.side;
                let [across, up] = self.pair([value(0), value(1)], [way.x, -way.y], 0.0);
                self.text = format!("Move UVs ({across:.4}, {up:.4})");
                TranslateUvs { offset: [across, up], live_unwrap, ..TranslateUvs::default() }.into()
            }
            UvTransform::Rotate => {
                let dragged = self.stepped(-360.0 * self.turns);
                let angle = value(0).map_or(dragged, |typed| typed.unwrap_or(0.0));
                self.text = format!("Rotate UVs {angle:.2}°");
                RotateUvs { angle, live_unwrap, ..RotateUvs::default() }.into()
            }
            UvTransform::Scale => {
                let [now, start] = self.modal.distances(self.pixels.center);
                let dragged = if start > 0.0 { now / start } else { 1.0 };
                let factors = self.pair([value(0), value(1).or(value(0))], [dragged; 2], 1.0);
                self.text = format!("Scale UVs ({:.4}, {:.4})", factors[0], factors[1]);
                ScaleUvs { factors, live_unwrap, ..ScaleUvs::default() }.into()
            }
        })
    }

    /// The values of both directions: typed ones, or those of the pointer, and `none` where the other one is locked. A
    /// number typed under a lock is for its direction.
    fn pair(&self, typed: [Option<Option<f64>>; 2], dragged: [f64; 2], none: f64) -> [f64; 2] {
        let second = typed[1].flatten().or(if none == 1.0 { typed[0].flatten() } else { None });
        let all = match typed[0] {
            None => dragged.map(|value| self.stepped(value)),
            Some(first) => [first.unwrap_or(none), second.unwrap_or(none)],
        };
        let first = if typed[0].is_some() { all[0] } else { all[1] };
        match self.lock {
            None => all,
            Some(UvAxis::Across) => [all[0], none],
            Some(UvAxis::Down) => [none, first],
        }
    }

    /// With Ctrl in steps.
    fn stepped(&self, value: f64) -> f64 {
        let steps = STEPS[self.kind as usize];
        match self.modal.inverts_snapping() {
            true => rounded(value, steps[usize::from(self.modal.is_precise())]),
            false => value,
        }
    }

    fn key(&mut self, key: char, document: &mut Document) -> ToolState {
        let toggled = |lock: UvAxis| (self.lock != Some(lock)).then_some(lock);
        match key {
            'x' => self.lock = toggled(UvAxis::Across),
            'y' => self.lock = toggled(UvAxis::Down),
            'g' => self.become_kind(UvTransform::Move),
            'r' => self.become_kind(UvTransform::Rotate),
            's' => self.become_kind(UvTransform::Scale),
            _ => return ToolState::Running,
        }
        self.update(document)
    }
}

impl Tool for UvTool {
    fn input(&mut self, input: &Input, hands: Hands, _: &ToolView, document: &mut Document) -> ToolState {
        match self.modal.step(input, hands) {
            Step::Update => self.update(document),
            Step::Confirm => Modal::confirm(document),
            Step::Cancel => Modal::cancel(document),
            Step::Key(key) => self.key(key, document),
            _ => ToolState::Running,
        }
    }

    fn status(&self) -> String {
        let lock = match self.lock {
            None => "",
            Some(UvAxis::Across) => " along X",
            Some(UvAxis::Down) => " along Y",
        };
        let text = format!("{} {}{lock} X/Y: lock, Ctrl: steps", self.text, self.modal.typed());
        self.modal.status(text)
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }
}
