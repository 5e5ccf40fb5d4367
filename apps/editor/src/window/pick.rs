//! Clicks that select.

use trigon_edit::scene::NodeId;
use trigon_edit::{Command, ObjectName, PICK_RADIUS, Picks, Select, SelectAction};
use trigon_window::scene::math::DVec2;
use trigon_window::{Hands, Modifiers, Pane, Stage};

use super::editor::Editor;
use super::panes::overlay_view;
use crate::overlay::{camera_at, light_at};
use crate::request::Request;

/// A press that moves further than this many logical pixels is no click.
const SLOP: f64 = 4.0;

/// The left button is down.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Click {
    pub(crate) at: DVec2,
    pub(crate) modifiers: Modifiers,
}

impl Click {
    pub(crate) fn new(hands: Hands) -> Option<Self> {
        hands.pointer.map(|at| Self { at, modifiers: hands.modifiers })
    }

    /// Whether the pointer has moved too far for a click.
    pub(crate) fn is_drag(&self, hands: Hands, scale: f64) -> bool {
        hands.pointer.is_some_and(|to| to.distance(self.at) > SLOP * scale)
    }
}

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
    ask(editor, (stage, &pane), |picks, radius| match (is_editing && alt, is_editing && ctrl) {
        (true, true) => picks.edge_ring(at, radius, action),
        (true, false) => picks.edge_loop(at, radius, action),
        (false, true) => picks.path(at, radius),
        (false, false) => picks.click(at, radius, action),
    })
}

/// Asks the picture; the question is given how near is near enough, in physical pixels.
fn ask<T>(
    editor: &mut Editor,
    (stage, pane): (&Stage, &Pane),
    question: impl FnOnce(&Picks<'_>, f64) -> Option<T>,
) -> Option<T> {
    let (reach, radius) = (editor.reach(), PICK_RADIUS * stage.scale());
    editor.pointing.ask(&editor.document, (stage, pane), reach, |picks| question(picks, radius)).flatten()
}

/// The light or the camera whose lines are at a place.
fn overlay_at(editor: &Editor, stage: &Stage, at: DVec2) -> Option<NodeId> {
    let pane = stage.pane_at(at);
    let view = overlay_view(stage, &pane);
    let place = view.logical(at - pane.area.origin());
    light_at(&editor.document, &view, place).or_else(|| camera_at(&editor.document, &view, place))
}

/// Adds what hangs together with what is at a place; nothing where no edited mesh is.
pub(crate) fn linked(editor: &mut Editor, stage: &Stage, at: DVec2) -> Option<Command> {
    let pane = stage.pane_at(at);
    let at = at - pane.area.origin();
    ask(editor, (stage, &pane), |picks, radius| picks.linked(at, radius, SelectAction::Add))
}
