//! Bevel (Ctrl+B) and inset (I), and what both have in common with extrude: each previews one command, which
//! follows the pointer and typed numbers.

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_document::{Bevel, BevelWidth, Command, Document, InnerMiter, Inset, InsetMode, OuterMiter};
use trigon_window::{Hands, Input};

use super::expression::Quantity;
use super::extrude::on;
use super::modal::{Modal, Step};
use super::numeric::NumericEntry;
use super::selected::Selected;
use super::view::ToolView;
use super::{Tool, ToolState};

/// What the pointer and typed numbers change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Adjusting {
    Width,
    Segments,
    Profile,
}

/// A bevel that runs.
#[derive(Debug)]
pub(crate) struct BevelTool {
    modal: Modal,
    /// The middle of what is selected.
    middle: DVec3,
    command: Bevel,
    adjusting: Adjusting,
    /// What counted when the pointer began to change something else: where it was, and the values then.
    from: DVec2,
    before: Bevel,
}

/// Pixels for one segment more, and for all profiles from 0 to 1.
const SEGMENT: f64 = 20.0;
const PROFILES: f64 = 400.0;
/// Percent for one pixel.
const PERCENT: f64 = 0.25;
/// The most that the kernel makes.
const MOST_SEGMENTS: f64 = 100.0;

impl BevelTool {
    /// Starts on what is selected in edit mode; `None` where nothing is.
    pub(crate) fn start(
        vertices: bool,
        document: &mut Document,
        hands: Hands,
        view: &ToolView,
    ) -> Option<Self> {
        let selected = Selected::of(document).filter(|selected| selected.is_editing)?;
        let modal = Modal::new(hands, NumericEntry::new(Quantity::Length, 1));
        let command = Bevel { width: 0.0, vertices, clamp_overlap: false, ..Bevel::default() };
        let (middle, from, before) = (selected.median(), modal.pointer.position(), command.clone());
        let adjusting = Adjusting::Width;
        let mut tool = Self { modal, middle, command, adjusting, from, before };
        tool.update(document, view);
        Some(tool)
    }

    fn follow(&mut self, view: &ToolView) -> Result<(), String> {
        let position = self.modal.pointer.position();
        let center = view.screen(self.middle).unwrap_or(DVec2::ZERO);
        let away = position.distance(center) - self.from.distance(center);
        let across = (position.x - self.from.x) / view.scale;
        let typed = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())?;
        match self.adjusting {
            Adjusting::Width => {
                let dragged = self.before.width + away * self.width_per_pixel(view);
                self.command.width = typed.unwrap_or(dragged.max(0.0));
            }
            Adjusting::Segments => {
                let dragged = f64::from(self.before.segments) + across / SEGMENT;
                self.set_segments(typed.unwrap_or(dragged));
            }
            Adjusting::Profile => {
                self.command.profile =
                    typed.unwrap_or(self.before.profile + across / PROFILES).clamp(0.0, 1.0);
            }
        }
        Ok(())
    }

    fn width_per_pixel(&self, view: &ToolView) -> f64 {
        if self.command.width_type == BevelWidth::Percent {
            return PERCENT / view.scale;
        }
        view.metres_per_pixel(self.middle)
    }

    /// Changes what the width measures; the drag so far then starts from zero.
    fn next_width_type(&mut self) {
        self.command.width_type = match self.command.width_type {
            BevelWidth::Offset => BevelWidth::Width,
            BevelWidth::Width => BevelWidth::Depth,
            BevelWidth::Depth => BevelWidth::Percent,
            BevelWidth::Percent => BevelWidth::Absolute,
            BevelWidth::Absolute => BevelWidth::Offset,
        };
        self.adjust(Adjusting::Width);
        self.from = self.modal.pointer.start();
        self.before.width = 0.0;
    }

    fn set_segments(&mut self, segments: f64) {
        self.command.segments = segments.round().clamp(1.0, MOST_SEGMENTS) as u32;
    }

    fn adjust(&mut self, adjusting: Adjusting) {
        let is_length = adjusting == Adjusting::Width && self.command.width_type != BevelWidth::Percent;
        let quantity = if is_length { Quantity::Length } else { Quantity::Factor };
        self.modal.numeric = NumericEntry::new(quantity, 1);
        self.adjusting = adjusting;
        self.from = self.modal.pointer.position();
        self.before = self.command.clone();
    }
}

impl PreviewTool for BevelTool {
    fn command(&mut self, view: &ToolView) -> Result<Command, String> {
        self.follow(view)?;
        Ok(self.command.clone().into())
    }

    fn key(&mut self, key: char, document: &mut Document, view: &ToolView) -> ToolState {
        let command = &mut self.command;
        match key {
            'a' => self.adjust(Adjusting::Width),
            's' => self.adjust(Adjusting::Segments),
            'p' => self.adjust(Adjusting::Profile),
            'm' => self.next_width_type(),
            'c' => command.clamp_overlap ^= true,
            'v' => command.vertices ^= true,
            'h' => command.harden_normals ^= true,
            'k' => command.mark_sharp ^= true,
            'u' => command.mark_seams ^= true,
            'o' => {
                command.outer_miter = match command.outer_miter {
                    OuterMiter::Sharp => OuterMiter::Patch,
                    OuterMiter::Patch => OuterMiter::Arc,
                    OuterMiter::Arc => OuterMiter::Sharp,
                }
            }
            'i' => {
                command.inner_miter = match command.inner_miter {
                    InnerMiter::Sharp => InnerMiter::Arc,
                    InnerMiter::Arc => InnerMiter::Sharp,
                }
            }
            _ => return ToolState::Running,
        }
        self.update(document, view)
    }
}

impl Tool for BevelTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        match self.modal.step(input, hands) {
            Step::Wheel(lines) => {
                self.set_segments(f64::from(self.command.segments) + lines);
                self.before.segments = self.command.segments;
                self.update(document, view)
            }
            step => self.step(step, document, view),
        }
    }

    fn status(&self) -> String {
        let command = &self.command;
        let (width, unit) =
            (command.width, if command.width_type == BevelWidth::Percent { "%" } else { "m" });
        let switches = [
            ("C: clamp", command.clamp_overlap),
            ("V: vertices", command.vertices),
            ("H: harden", command.harden_normals),
            ("K: sharp", command.mark_sharp),
            ("U: seam", command.mark_seams),
        ];
        let switches = switches.map(|(name, is_on)| format!("{name} ({})", on(is_on))).join(", ");
        self.modal.status(format!(
            "Bevel A: {width:.4} {unit} {} M: {}, S/wheel: segments {}, P: profile {:.3}, {switches}, \
             O: outer ({}), I: inner ({})",
            self.modal.typed(),
            name(command.width_type),
            command.segments,
            command.profile,
            name(command.outer_miter),
            name(command.inner_miter),
        ))
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }
}

/// The name of a choice, as the status line shows it.
fn name(choice: impl std::fmt::Debug) -> String {
    format!("{choice:?}").to_lowercase()
}

/// An inset that runs.
#[derive(Debug)]
pub(crate) struct InsetTool {
    modal: Modal,
    /// The middle of what is selected.
    middle: DVec3,
    command: Inset,
    /// Where the pointer was when Ctrl went down, and how deep the faces were: Ctrl changes the depth
    /// instead of the thickness.
    deepening: Option<(DVec2, f64)>,
    /// How far the pointer went meanwhile, which counts for nothing else.
    spent: DVec2,
}

impl InsetTool {
    /// Starts on the faces that are selected in edit mode; `None` where nothing is.
    pub(crate) fn start(document: &mut Document, hands: Hands, view: &ToolView) -> Option<Self> {
        let selected = Selected::of(document).filter(|selected| selected.is_editing)?;
        let modal = Modal::new(hands, NumericEntry::new(Quantity::Length, 2));
        let command = Inset { thickness: 0.0, ..Inset::default() };
        let middle = selected.median();
        let mut tool = Self { modal, middle, command, deepening: None, spent: DVec2::ZERO };
        tool.update(document, view);
        Some(tool)
    }

    fn follow(&mut self, view: &ToolView) -> Result<(), String> {
        let (position, size) = (self.modal.pointer.position(), view.metres_per_pixel(self.middle));
        match (self.modal.inverts_snapping(), self.deepening) {
            (true, None) => self.deepening = Some((position, self.command.depth)),
            (true, Some((from, depth))) => self.command.depth = depth + (from.y - position.y) * size,
            (false, Some((from, _))) => {
                self.spent += position - from;
                self.deepening = None;
            }
            (false, None) => {
                let center = view.screen(self.middle).unwrap_or(DVec2::ZERO);
                let way =
                    self.modal.pointer.start().distance(center) - (position - self.spent).distance(center);
                self.command.thickness = (way * size).max(0.0);
            }
        }
        if self.modal.numeric.is_active() {
            let values = self.modal.numeric.values().map_err(|error| error.to_string())?;
            let value = |index: usize| values.get(index).copied().flatten();
            self.command.thickness = value(0).unwrap_or(0.0);
            self.command.depth = value(1).unwrap_or(self.command.depth);
        }
        Ok(())
    }
}

impl PreviewTool for InsetTool {
    fn command(&mut self, view: &ToolView) -> Result<Command, String> {
        self.follow(view)?;
        Ok(self.command.clone().into())
    }

    fn key(&mut self, key: char, document: &mut Document, view: &ToolView) -> ToolState {
        let toggled = |mode| if self.command.mode == mode { InsetMode::Region } else { mode };
        match key {
            'o' => self.command.mode = toggled(InsetMode::Outset),
            'i' => self.command.mode = toggled(InsetMode::Individual),
            'b' => self.command.open_borders = !self.command.open_borders,
            _ => return ToolState::Running,
        }
        self.update(document, view)
    }
}

impl Tool for InsetTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        let step = self.modal.step(input, hands);
        self.step(step, document, view)
    }

    fn status(&self) -> String {
        let Inset { thickness, depth, mode, open_borders } = &self.command;
        let typed = self.modal.typed();
        self.modal.status(format!(
            "Inset {thickness:.4} m, depth {depth:.4} m {} Ctrl: depth, O: outset ({}), I: individual ({}), \
             B: boundary ({})",
            typed,
            on(*mode == InsetMode::Outset),
            on(*mode == InsetMode::Individual),
            on(*open_borders),
        ))
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }
}

/// A tool that previews one command.
pub(super) trait PreviewTool: Tool {
    /// The command for the pointer and the typed numbers as they are now, or why there is none.
    fn command(&mut self, view: &ToolView) -> Result<Command, String>;

    /// Takes a key of the tool's own.
    fn key(&mut self, key: char, document: &mut Document, view: &ToolView) -> ToolState;

    /// Shows the command, or why there is none.
    fn update(&mut self, document: &mut Document, view: &ToolView) -> ToolState {
        match self.command(view) {
            Ok(command) => self.modal().show(document, command),
            Err(why) => self.modal().refuse(why),
        }
    }

    /// Handles a step for which the tool has no behaviour of its own.
    fn step(&mut self, step: Step, document: &mut Document, view: &ToolView) -> ToolState {
        match step {
            Step::Update => self.update(document, view),
            Step::Confirm => Modal::confirm(document),
            Step::Cancel => Modal::cancel(document),
            Step::Key(key) => self.key(key, document, view),
            Step::MiddlePressed
            | Step::MiddleReleased
            | Step::ToggleSnapping
            | Step::Wheel(_)
            | Step::Nothing => ToolState::Running,
        }
    }
}
