//! Move, rotate, scale, shrink and fatten, and slide: one tool, because each turns into another by
//! its key.

mod input;

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_document::{
    Command, Document, Proportional, PushPull, ShrinkFatten, SlideEdges, SlideVertices, ToSphere,
    TransformSpace,
};
use trigon_window::{Hands, Input};

use super::constraint::TransformKind;
use super::constraint::{Axis, Constraint, Frames, Freedom, Orientation};
use super::expression::Quantity;
use super::modal::{Modal, Step};
use super::numeric::NumericEntry;
use super::selected::Pivot;
use super::selected::Selected;
use super::slide::Slide;
use super::snap::SnapTargets;
use super::snap::{SnapSettings, rounded};
use super::view::ToolView;
use super::{Tool, ToolMarks, ToolState};

/// What the editor's bars say about transforms.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct TransformSettings {
    pub(crate) orientation: Orientation,
    pub(crate) pivot: Pivot,
    pub(crate) snap: SnapSettings,
    /// Where the 3D cursor is.
    pub(crate) cursor: DVec3,
    /// The proportional editing that is on.
    pub(crate) proportional: Option<Proportional>,
}

/// A transform that runs.
#[derive(Debug)]
pub(crate) struct TransformTool {
    pub(super) modal: Modal,
    pub(super) kind: TransformKind,
    pub(super) settings: TransformSettings,
    pub(super) selected: Selected,
    pub(super) constraint: Constraint,
    pub(super) frames: Frames,
    /// The turn of the pointer around the pivot, in degrees, and where the pointer was last.
    pub(super) turn: f64,
    turned_from: DVec2,
    /// What the numbers in the status line are.
    pub(super) text: String,
    /// Found when they are first needed.
    pub(super) targets: Option<SnapTargets>,
    /// The point of the selection that a user chose to snap.
    pub(super) source: Option<DVec3>,
    /// The last target that something snapped to.
    pub(super) snapped: Option<DVec3>,
    /// Targets that a user kept: what is snapped goes to the middle of these and the next one.
    pub(super) retained: Vec<DVec3>,
    /// Whether the next click chooses the source.
    is_choosing_source: bool,
    /// Whether the middle button is down: the movement chooses the axis.
    is_choosing_axis: bool,
    pub(super) slide: Option<Slide>,
}

impl TransformTool {
    /// Starts on what is selected; `None` where nothing is.
    pub(crate) fn start(
        kind: TransformKind,
        settings: TransformSettings,
        document: &Document,
        hands: Hands,
        view: &ToolView,
    ) -> Option<Self> {
        let selected = Selected::of(document)?;
        let frames = Frames::new(settings.orientation, selected.local, selected.normal, view);
        let mut tool = Self {
            modal: Modal::new(hands, NumericEntry::new(Quantity::Length, 1)),
            kind,
            settings,
            selected,
            constraint: Constraint::default(),
            frames,
            turn: 0.0,
            turned_from: hands.pointer.unwrap_or(DVec2::ZERO),
            text: kind.name().into(),
            targets: None,
            source: None,
            snapped: None,
            retained: Vec::new(),
            is_choosing_source: false,
            is_choosing_axis: false,
            slide: None,
        };
        tool.renew_numbers();
        Some(tool)
    }

    /// The same, locked from the beginning, as by a handle of a gizmo, and confirmed when the left button is
    /// let go.
    pub(crate) fn held(mut self, freedom: Option<Freedom>) -> Self {
        self.constraint.set(freedom);
        self.modal.confirm_on_release();
        self.renew_numbers();
        self
    }

    /// The point around which the selection rotates and scales.
    pub(super) fn pivot(&self) -> DVec3 {
        self.settings.pivot.point(&self.selected, self.settings.cursor)
    }

    pub(super) fn center(&self) -> Option<[f64; 3]> {
        self.settings.pivot.center(&self.selected, self.settings.cursor)
    }

    /// Whether parts rotate and scale individually: in edit mode only; objects always do.
    pub(super) fn individual(&self) -> bool {
        self.settings.pivot == Pivot::Individual && self.selected.is_editing
    }

    /// Proportional editing, which needs the vertices of edit mode.
    pub(super) fn proportional(&self) -> Option<Proportional> {
        self.settings.proportional.clone().filter(|_| self.selected.is_editing)
    }

    /// Whether movements snap now.
    pub(super) fn snaps(&self) -> bool {
        self.settings.snap.is_on != self.modal.inverts_snapping()
    }

    /// The number of expected values depends on the lock.
    fn renew_numbers(&mut self) {
        let (quantity, free) = match self.kind {
            TransformKind::Translate => (Quantity::Length, 3),
            TransformKind::Scale => (Quantity::Factor, 3),
            TransformKind::Rotate => return self.set_numbers(Quantity::Angle, 1),
            TransformKind::Trackball => return self.set_numbers(Quantity::Angle, 2),
            TransformKind::ShrinkFatten | TransformKind::PushPull => {
                return self.set_numbers(Quantity::Length, 1);
            }
            TransformKind::Slide | TransformKind::ToSphere => return self.set_numbers(Quantity::Factor, 1),
        };
        let count = match self.constraint.freedom() {
            None => free,
            Some(Freedom::Along(_)) => 1,
            Some(Freedom::Across(_)) => 2,
        };
        self.set_numbers(quantity, count);
    }

    fn set_numbers(&mut self, quantity: Quantity, count: usize) {
        if self.modal.numeric.quantity() == quantity {
            self.modal.numeric.set_count(count);
        } else {
            self.modal.numeric = NumericEntry::new(quantity, count);
        }
    }
}

impl Tool for TransformTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        match self.modal.step(input, hands) {
            Step::Update => self.update(document, view),
            Step::Confirm if self.is_choosing_source => self.choose_source(document, view),
            Step::Confirm => Modal::confirm(document),
            Step::Cancel => Modal::cancel(document),
            Step::Key(key) => self.key(key, document, view),
            Step::Wheel(lines) => self.wheel(lines, document, view),
            Step::MiddlePressed => {
                self.is_choosing_axis = true;
                self.update(document, view)
            }
            Step::MiddleReleased => {
                self.is_choosing_axis = false;
                ToolState::Running
            }
            Step::ToggleSnapping => {
                self.settings.snap.is_on ^= true;
                self.update(document, view)
            }
            Step::Nothing => ToolState::Running,
        }
    }

    fn status(&self) -> String {
        let mut text = format!("{} {}", self.text, self.modal.typed());
        text += &self.constraint.status(&self.frames);
        if let Some(near) = self.proportional() {
            text += &format!(" proportional {:.3} m", near.radius);
        }
        if !self.retained.is_empty() {
            text += &format!(" to the middle of {} points", self.retained.len() + 1);
        }
        let keys = match self.kind {
            TransformKind::Translate if self.snapped.is_some() => ", A: one more point, B: source",
            TransformKind::Translate | TransformKind::Scale | TransformKind::Rotate => ", X/Y/Z: lock",
            _ => "",
        };
        self.modal.status(text.trim_end().to_owned() + keys)
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }

    fn marks(&self) -> ToolMarks {
        /// The length of the lines of locks, in metres: beyond every image.
        const FAR: f64 = 1e4;
        let (pivot, axes) = (self.pivot(), self.constraint.axes(&self.frames));
        let free = |axis: &Axis| match self.constraint.freedom() {
            None => false,
            Some(Freedom::Along(along)) => along == *axis,
            Some(Freedom::Across(across)) => across != *axis,
        };
        let line = |axis: Axis| [-FAR, FAR].map(|far| pivot + axes.col(axis.index()) * far);
        ToolMarks {
            lines: Axis::ALL.into_iter().filter(free).map(line).collect(),
            circle: self.proportional().map(|near| (pivot, near.radius)),
            point: self.snapped.filter(|_| self.snaps()),
            ..ToolMarks::default()
        }
    }
}

/// Logical pixels from 0 to a whole sphere.
const WHOLE_SPHERE: f64 = 200.0;

impl TransformTool {
    /// The command that deforms the selection by what the pointer or the numbers say.
    fn deform(&mut self, view: &ToolView) -> Result<Command, String> {
        let way = self.modal.pointer.way();
        let (dragged, step) = if self.kind == TransformKind::ToSphere {
            let factor = (way.x / (WHOLE_SPHERE * view.scale)).clamp(0.0, 1.0);
            (factor, self.settings.snap.factor_step(self.modal.is_precise()))
        } else {
            let up = -way.y * view.metres_per_pixel(self.pivot());
            (up, self.settings.snap.length_step(self.modal.is_precise()))
        };
        let typed = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())?;
        let amount = typed.unwrap_or(if self.snaps() { rounded(dragged, step) } else { dragged });
        let proportional = self.proportional();
        let (text, command) = match self.kind {
            TransformKind::ToSphere => (
                format!("To Sphere {amount:.4}"),
                ToSphere { factor: amount, center: None, proportional }.into(),
            ),
            TransformKind::PushPull => {
                let command = PushPull { distance: amount, center: None, proportional };
                (format!("Push/Pull {amount:.4} m"), command.into())
            }
            _ => {
                let command = ShrinkFatten { distance: amount, proportional };
                (format!("Shrink/Fatten {amount:.4} m"), command.into())
            }
        };
        self.text = text;
        Ok(command)
    }
}

impl TransformTool {
    /// The command that slides what is selected.
    fn slide_along(&mut self) -> Result<Command, String> {
        let Some(slide) = &self.slide else { return Err("nothing is selected that could slide".into()) };
        let (dragged, direction) = slide.follow(self.modal.pointer.way());
        let step = self.settings.snap.factor_step(self.modal.is_precise());
        let dragged = if self.snaps() { rounded(dragged, step) } else { dragged };
        let typed = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())?;
        let factor = typed.unwrap_or(dragged);
        self.text = format!("Slide {factor:.4}");
        Ok(if slide.edges {
            SlideEdges { factor }.into()
        } else {
            SlideVertices { factor, direction: direction.to_array(), space: TransformSpace::World }.into()
        })
    }
}
