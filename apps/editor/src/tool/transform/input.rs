//! Keys, wheel and pointer during a transform.

use trigon_document::mesh::math::{DVec2, elementary};
use trigon_document::{Document, Proportional};
use trigon_window::Modifiers;

use super::super::ToolState;
use super::super::constraint::{Axis, Frames, Freedom, nearest_axis};
use super::super::expression::Quantity;
use super::super::numeric::NumericEntry;
use super::super::slide::Slide;
use super::super::snap::{SnapTarget, nearest_on_screen};
use super::super::view::ToolView;
use super::TransformTool;
use crate::tool::TransformKind;
use crate::tool::snap::SnapTargets;

impl TransformTool {
    /// The same as a slide along edges, from the beginning.
    pub(crate) fn sliding(mut self, document: &mut Document, view: &ToolView) -> Self {
        self.become_kind(TransformKind::Slide, document, view);
        self
    }

    pub(super) fn become_kind(&mut self, kind: TransformKind, document: &mut Document, view: &ToolView) {
        document.cancel();
        self.kind = kind;
        self.modal.numeric = NumericEntry::new(Quantity::Length, 1);
        (self.turn, self.slide) = (0.0, None);
        if kind == TransformKind::Slide {
            self.slide = Some(Slide::of(document, view, self.modal.pointer.position()));
        }
        self.renew_numbers();
    }

    pub(super) fn update(&mut self, document: &mut Document, view: &ToolView) -> ToolState {
        if self.is_choosing_source {
            return ToolState::Running;
        }
        self.frames = Frames::new(self.settings.orientation, self.selected.local, self.selected.normal, view);
        if self.is_choosing_axis {
            let axes = self.frames.chosen;
            let axis = nearest_axis(view, self.pivot(), &axes, self.modal.pointer.way());
            let across = self.modal.is_precise();
            self.constraint
                .set(axis.map(|axis| if across { Freedom::Across(axis) } else { Freedom::Along(axis) }));
            self.renew_numbers();
        }
        self.follow_turn(view);
        if self.needs_targets() {
            self.targets = Some(SnapTargets::of(document));
        }
        let command = match self.kind {
            TransformKind::Translate => self.translate(view),
            TransformKind::Rotate => self.rotate(view),
            TransformKind::Trackball => self.trackball(view),
            TransformKind::Scale => self.scale(view),
            TransformKind::ShrinkFatten | TransformKind::PushPull | TransformKind::ToSphere => {
                self.deform(view)
            }
            TransformKind::Slide => self.slide_along(),
        };
        match command {
            Ok(command) => self.modal.show(document, command),
            Err(why) => self.modal.refuse(why),
        }
    }

    fn needs_targets(&self) -> bool {
        let target = self.settings.snap.target;
        self.targets.is_none() && self.snaps() && !matches!(target, SnapTarget::Increment | SnapTarget::Grid)
    }

    /// Adds up how far the pointer went around the pivot, so that it may go round more than once.
    fn follow_turn(&mut self, view: &ToolView) {
        let position = self.modal.pointer.position();
        let from = std::mem::replace(&mut self.turned_from, position);
        if let Some(center) = view.screen(self.pivot()) {
            // y points down in images, so this is counter-clockwise on the screen.
            let (a, b) = (from - center, position - center);
            let turn = elementary::atan2(b.x * a.y - b.y * a.x, a.dot(b));
            self.turn += turn.to_degrees();
        }
    }

    pub(super) fn key(&mut self, key: char, document: &mut Document, view: &ToolView) -> ToolState {
        let shift = self.modal.modifiers().contains(Modifiers::SHIFT);
        let kind = match (key, self.kind) {
            ('g', TransformKind::Translate) if self.selected.is_editing => Some(TransformKind::Slide),
            ('g', TransformKind::Translate) => None,
            ('g', _) => Some(TransformKind::Translate),
            ('r', TransformKind::Rotate) => Some(TransformKind::Trackball),
            ('r', _) => Some(TransformKind::Rotate),
            ('s', kind) if kind != TransformKind::Scale => Some(TransformKind::Scale),
            _ => None,
        };
        match (key, Axis::of_key(key), kind) {
            (_, Some(axis), _) => {
                self.constraint.press(if shift { Freedom::Across(axis) } else { Freedom::Along(axis) });
                self.renew_numbers();
            }
            (_, _, Some(kind)) => self.become_kind(kind, document, view),
            ('c', ..) => {
                self.constraint.clear();
                self.renew_numbers();
            }
            ('o', ..) if self.selected.is_editing => self.toggle_proportional(),
            ('a', ..) if self.kind == TransformKind::Translate && self.snaps() => {
                self.retained.extend(self.snapped);
            }
            ('b', ..) if self.kind == TransformKind::Translate => {
                document.cancel();
                self.is_choosing_source = true;
                self.text = "Click the point to snap".into();
                return ToolState::Running;
            }
            _ => return ToolState::Running,
        }
        self.update(document, view)
    }

    fn toggle_proportional(&mut self) {
        self.settings.proportional = match self.settings.proportional {
            Some(_) => None,
            None => Some(Proportional::default()),
        };
    }

    /// The nearest of all selected points becomes the one that follows the pointer.
    pub(super) fn choose_source(&mut self, document: &mut Document, view: &ToolView) -> ToolState {
        let position = self.modal.pointer.in_window().unwrap_or(DVec2::ZERO);
        let projector = view.projector();
        let screen = |point| projector.to_screen(point);
        self.source = nearest_on_screen(&self.selected.points, screen, position, f64::INFINITY);
        self.is_choosing_source = false;
        // From now on the point is under the pointer.
        self.modal.pointer = Default::default();
        self.modal.pointer.moved(self.source.and_then(screen), false);
        self.modal.pointer.moved(Some(position), false);
        self.settings.snap.is_on = true;
        if matches!(self.settings.snap.target, SnapTarget::Increment | SnapTarget::Grid) {
            self.settings.snap.target = SnapTarget::Vertex;
        }
        self.update(document, view)
    }

    pub(super) fn wheel(&mut self, lines: f64, document: &mut Document, view: &ToolView) -> ToolState {
        /// How much a line changes the radius, as Blender does.
        const FACTOR: f64 = 1.1;
        let Some(near) = &mut self.settings.proportional else { return ToolState::Running };
        near.radius = (near.radius * elementary::pow(FACTOR, lines)).clamp(1e-6, 1e6);
        self.update(document, view)
    }
}
