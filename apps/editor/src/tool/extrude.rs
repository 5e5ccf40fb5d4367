//! E: extrudes, then moves the result: along the mean normal, or locked like a move. Cancelling also removes
//! the new geometry.

use trigon_document::mesh::math::{DMat3, DVec3};
use trigon_document::{Command, Document, ElementKind, Extrude, TransformSpace};
use trigon_window::{Hands, Input, Modifiers};

use super::bevel::PreviewTool;
use super::constraint::{Axis, Constraint, Frames, Freedom, Orientation};
use super::expression::Quantity;
use super::modal::{Modal, Step};
use super::numeric::NumericEntry;
use super::selected::Selected;
use super::snap::{SnapSettings, rounded, rounded_along};
use super::translate::typed_offset;
use super::view::ToolView;
use super::{Tool, ToolState, TransformKind};

/// An extrusion that runs.
#[derive(Debug)]
pub(crate) struct ExtrudeTool {
    modal: Modal,
    selected: Selected,
    constraint: Constraint,
    frames: Frames,
    snap: SnapSettings,
    /// Whether each face is extruded along its own normal.
    individual: bool,
    /// Whether faces are selected: they are extruded by a distance.
    has_faces: bool,
    text: String,
}

impl ExtrudeTool {
    /// Starts on what is selected in edit mode; `None` where nothing is. The geometry is there at
    /// once.
    pub(crate) fn start(
        individual: bool,
        snap: SnapSettings,
        document: &mut Document,
        hands: Hands,
        view: &ToolView,
    ) -> Option<Self> {
        let selected = Selected::of(document).filter(|selected| selected.is_editing)?;
        let frames = Frames::new(Orientation::Normal, selected.local, selected.normal, view);
        let modal = Modal::new(hands, NumericEntry::new(Quantity::Length, 1));
        let has_faces = has_faces(document);
        let constraint = Constraint::default();
        let text = String::new();
        let mut tool = Self { modal, selected, constraint, frames, snap, individual, has_faces, text };
        tool.update(document, view);
        Some(tool)
    }

    fn snaps(&self) -> bool {
        self.snap.is_on != self.modal.inverts_snapping()
    }

    fn extrusion(&self, distance: f64, offset: DVec3) -> Command {
        let (offset, space) = (offset.to_array(), TransformSpace::World);
        Extrude { distance, offset, space, individual: self.individual }.into()
    }

    fn distance(&self, view: &ToolView) -> Result<f64, String> {
        if let Some(typed) = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())? {
            return Ok(typed);
        }
        let normal = self.selected.normal.z_axis;
        let dragged = view.dragged_along(self.selected.median(), normal, self.modal.pointer.way());
        let step = self.snap.length_step(self.modal.is_precise());
        Ok(if self.snaps() { rounded(dragged, step) } else { dragged })
    }

    fn offset(&self, view: &ToolView) -> Result<DVec3, String> {
        let (axes, freedom) = (self.constraint.axes(&self.frames), self.constraint.freedom());
        if let Some(offset) = typed_offset(&self.modal.numeric, freedom, &axes)? {
            return Ok(offset);
        }
        let (from, way) = (self.selected.median(), self.modal.pointer.way());
        let offset = match (freedom, self.constraint.axis(&self.frames)) {
            (Some(Freedom::Along(_)), Some(axis)) => axis * view.dragged_along(from, axis, way),
            (Some(Freedom::Across(_)), Some(normal)) => view.dragged_within(from, normal, way),
            _ => view.dragged(from, way),
        };
        let step = self.snap.length_step(self.modal.is_precise());
        Ok(if self.snaps() { rounded_along(offset, &axes, step) } else { offset })
    }

    /// E S and E R: what is extruded stays where it is, and is scaled or turned.
    fn confirm_unmoved(&mut self, key: char, document: &mut Document) -> ToolState {
        self.modal.show(document, self.extrusion(0.0, DVec3::ZERO));
        document.confirm();
        ToolState::ConfirmedThen(if key == 's' { TransformKind::Scale } else { TransformKind::Rotate })
    }
}

fn has_faces(document: &Document) -> bool {
    let kind = document.selection().kind();
    if kind == ElementKind::Face {
        return true;
    }
    let mut meshes = document.selection().meshes();
    meshes
        .any(|(id, selection)| document.mesh(id).is_some_and(|mesh| !selection.faces(mesh, kind).is_empty()))
}

impl PreviewTool for ExtrudeTool {
    fn command(&mut self, view: &ToolView) -> Result<Command, String> {
        if self.has_faces && self.constraint.freedom().is_none() {
            let distance = self.distance(view)?;
            self.text = format!("Extrude {distance:.4} m along normals");
            return Ok(self.extrusion(distance, DVec3::ZERO));
        }
        let offset = self.offset(view)?;
        self.text = format!("Extrude {:.4} m{}", offset.length(), self.constraint.status(&self.frames));
        Ok(self.extrusion(0.0, offset))
    }

    fn key(&mut self, key: char, document: &mut Document, view: &ToolView) -> ToolState {
        let across = self.modal.modifiers().contains(Modifiers::SHIFT);
        match (key, Axis::of_key(key)) {
            (_, Some(axis)) => {
                // Locks are to the world's axes first.
                let local = self.selected.local;
                self.frames = Frames::new(Orientation::Global, local, DMat3::IDENTITY, view);
                self.constraint.press(if across { Freedom::Across(axis) } else { Freedom::Along(axis) });
            }
            ('c', _) => self.constraint.clear(),
            ('i', _) => self.individual = !self.individual,
            ('s' | 'r', _) => return self.confirm_unmoved(key, document),
            _ => return ToolState::Running,
        }
        let count = match self.constraint.freedom() {
            Some(Freedom::Across(_)) => 2,
            None if !self.has_faces => 3,
            _ => 1,
        };
        self.modal.numeric.set_count(count);
        self.update(document, view)
    }
}

impl Tool for ExtrudeTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        match self.modal.step(input, hands) {
            Step::ToggleSnapping => {
                self.snap.is_on ^= true;
                self.update(document, view)
            }
            step => self.step(step, document, view),
        }
    }

    fn status(&self) -> String {
        let typed = self.modal.typed();
        let text = format!("{} {}", self.text, typed);
        self.modal.status(format!("{text} X/Y/Z: lock, C: clear, I: individual ({})", on(self.individual)))
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }
}

/// For the status line.
pub(super) fn on(is_on: bool) -> &'static str {
    if is_on { "on" } else { "off" }
}
