//! Clicks that select.

use trigon_document::scene::NodeId;
use trigon_document::{Command, ObjectName, PICK_RADIUS, Picks, Select, SelectAction};
use trigon_window::scene::math::DVec2;
use trigon_window::{Modifiers, Pane, Stage};

use super::editor::{Editor, Message};
use super::panes::overlay_view;
use crate::overlay::{camera_at, light_at};
use crate::request::Request;

/// Selects what is at a place of the window.
pub(crate) fn click(editor: &mut Editor, stage: &mut Stage, at: DVec2, modifiers: Modifiers) {
    if let Some(command) = command(editor, stage, at, modifiers) {
        editor.perform(stage, Request::Run(command));
    }
}

fn command(editor: &mut Editor, stage: &Stage, at: DVec2, modifiers: Modifiers) -> Option<Command> {
    let has = |modifier| modifiers.contains(modifier);
    let action = if has(Modifiers::SHIFT) { SelectAction::Toggle } else { SelectAction::Replace };
    let is_editing = editor.document.selection().is_editing();
    if let Some(object) = overlay_at(editor, stage, at).filter(|_| !is_editing) {
        return Some(Select { objects: vec![ObjectName::of(object)], action, ..Select::default() }.into());
    }
    let (alt, ctrl) = (has(Modifiers::ALT), has(Modifiers::CTRL));
    let pane = stage.pane_at(at);
    let at = at - pane.area.origin();
    ask(editor, stage, &pane, |picks, radius| match (is_editing && alt, is_editing && ctrl) {
        (true, true) => picks.edge_ring(at, radius, action),
        (true, false) => picks.edge_loop(at, radius, action),
        (false, true) => picks.path(at, radius),
        (false, false) => picks.click(at, radius, action),
    })
}

/// Asks the image; the question is given how near is near enough, in physical pixels.
fn ask<T>(
    editor: &mut Editor,
    stage: &Stage,
    pane: &Pane,
    question: impl FnOnce(&Picks<'_>, f64) -> Option<T>,
) -> Option<T> {
    let (reach, radius) = (editor.reach(), PICK_RADIUS * stage.scale());
    editor.pointing.ask(&editor.document, stage, pane, reach, |picks| question(picks, radius)).flatten()
}

/// The light or the camera whose lines are at a place.
fn overlay_at(editor: &Editor, stage: &Stage, at: DVec2) -> Option<NodeId> {
    let pane = stage.pane_at(at);
    let view = overlay_view(stage, &pane);
    let place = view.logical(at - pane.area.origin());
    light_at(&editor.document, &view, place).or_else(|| camera_at(&editor.document, &view, place))
}

impl Editor {
    /// Adds what hangs together with what is under the pointer.
    pub(super) fn select_linked(&mut self, stage: &Stage) {
        match self.pointer.and_then(|at| linked(self, stage, at)) {
            Some(command) => self.run(command),
            None => self.message = Message::Refusal("Linked: point at a mesh that is edited".into()),
        }
    }
}

/// Adds what hangs together with what is at a place; nothing where no edited mesh is.
fn linked(editor: &mut Editor, stage: &Stage, at: DVec2) -> Option<Command> {
    let pane = stage.pane_at(at);
    let at = at - pane.area.origin();
    ask(editor, stage, &pane, |picks, radius| picks.linked(at, radius, SelectAction::Add))
}
