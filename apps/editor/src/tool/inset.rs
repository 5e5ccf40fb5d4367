//! I: insets the selected faces. The thickness grows as the pointer approaches their centre.

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_document::{Command, Document, Inset, InsetMode};
use trigon_window::{Hands, Input};

use super::expression::Quantity;
use super::extrude::on;
use super::modal::Modal;
use super::numeric::NumericEntry;
use super::preview::PreviewTool;
use super::selected::Selected;
use super::view::ToolView;
use super::{Tool, ToolState};

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
        let (place, size) = (self.modal.pointer.place(), view.metres_per_pixel(self.middle));
        match (self.modal.inverts_snapping(), self.deepening) {
            (true, None) => self.deepening = Some((place, self.command.depth)),
            (true, Some((from, depth))) => self.command.depth = depth + (from.y - place.y) * size,
            (false, Some((from, _))) => {
                self.spent += place - from;
                self.deepening = None;
            }
            (false, None) => {
                let center = view.screen(self.middle).unwrap_or(DVec2::ZERO);
                let way = self.modal.pointer.start().distance(center) - (place - self.spent).distance(center);
                self.command.thickness = (way * size).max(0.0);
            }
        }
        if self.modal.numeric.is_active() {
            let values = self.modal.numeric.values().map_err(|error| error.to_string())?;
            let value = |place: usize| values.get(place).copied().flatten();
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
