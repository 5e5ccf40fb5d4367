//! The common part of modal tools: keys that confirm and cancel, the pointer, typed numbers, and the preview
//! of a command. Here is also what all tools are to the window: they take inputs, report their state, and say
//! what is drawn over the image.

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_document::modelling::FaceId;
use trigon_document::scene::MeshId;
use trigon_document::{Command, Document};
use trigon_window::{Hands, Input, Key, Modifiers, PointerButton};

use super::constraint::TransformKind;
use super::numeric::NumericEntry;
use super::view::ToolView;

/// The state that every modal tool holds.
#[derive(Debug, Clone)]
pub(crate) struct Modal {
    pub(crate) pointer: VirtualPointer,
    pub(crate) numeric: NumericEntry,
    /// Why the last preview was refused.
    refusal: Option<String>,
    modifiers: Modifiers,
    /// Whether the tool runs while the left button is held, as from a gizmo.
    confirms_on_release: bool,
}

/// What an input means to a modal tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Step {
    /// The pointer, the modifiers or the typed numbers changed.
    Update,
    Confirm,
    Cancel,
    /// A key of the tool's own, in lower case.
    Key(char),
    /// The middle button went down.
    MiddlePressed,
    MiddleReleased,
    /// Shift+Tab: snapping is switched on or off.
    ToggleSnapping,
    /// In lines away from the user.
    Wheel(f64),
    Nothing,
}

impl Modal {
    /// Starts where the pointer is.
    pub(crate) fn new(hands: Hands, numeric: NumericEntry) -> Self {
        let mut pointer = VirtualPointer::default();
        pointer.moved(hands.pointer, false);
        Self { pointer, numeric, refusal: None, modifiers: hands.modifiers, confirms_on_release: false }
    }

    /// The tool was started by a press that is still held: its release confirms.
    pub(crate) fn confirm_on_release(&mut self) {
        self.confirms_on_release = true;
    }

    /// What an input means. Typed numbers come before keys of the tool.
    pub(crate) fn step(&mut self, input: &Input, hands: Hands) -> Step {
        self.modifiers = hands.modifiers;
        match *input {
            Input::PointerMoved => {
                let is_precise = hands.modifiers.contains(Modifiers::SHIFT);
                if self.pointer.moved(hands.pointer, is_precise) { Step::Update } else { Step::Nothing }
            }
            Input::ModifiersChanged => Step::Update,
            // With Alt the button turns the view in the middle of a tool.
            Input::Pressed(_) if hands.modifiers.contains(Modifiers::ALT) => Step::Nothing,
            Input::Pressed(PointerButton::Left) => Step::Confirm,
            Input::Released(PointerButton::Left) if self.confirms_on_release => Step::Confirm,
            Input::Pressed(PointerButton::Right) => Step::Cancel,
            Input::Pressed(PointerButton::Middle) => Step::MiddlePressed,
            // No release follows when the window lost the keyboard.
            Input::Released(PointerButton::Middle) | Input::FocusLost => Step::MiddleReleased,
            Input::Wheel(lines) => Step::Wheel(lines),
            Input::Key { logical, physical, repeat } => self.key(logical, physical, repeat, hands.modifiers),
            _ => Step::Nothing,
        }
    }

    fn key(
        &mut self,
        logical: Option<Key>,
        physical: Option<Key>,
        repeat: bool,
        modifiers: Modifiers,
    ) -> Step {
        for key in [logical, physical].into_iter().flatten() {
            if self.numeric.key(key, modifiers) {
                return Step::Update;
            }
        }
        // Undo or save in the middle of a tool is no lock of an axis.
        let is_plain = !modifiers.contains(Modifiers::CTRL) && !modifiers.contains(Modifiers::ALT);
        match (logical.or(physical), repeat) {
            (Some(Key::Enter | Key::Space), false) => Step::Confirm,
            (Some(Key::Escape), false) => Step::Cancel,
            (Some(Key::Tab), false) if modifiers.contains(Modifiers::SHIFT) => Step::ToggleSnapping,
            (Some(Key::Character(key)), false) if is_plain => Step::Key(key),
            _ => Step::Nothing,
        }
    }

    /// Whether Ctrl is held: snapping is inverted.
    pub(crate) fn inverts_snapping(&self) -> bool {
        self.modifiers.contains(Modifiers::CTRL)
    }

    /// Whether Shift is held: moves and increments are finer.
    pub(crate) fn is_precise(&self) -> bool {
        self.modifiers.contains(Modifiers::SHIFT)
    }

    pub(crate) fn modifiers(&self) -> Modifiers {
        self.modifiers
    }

    /// Shows what a command does; a refusal is kept for the status line, and the last good preview
    /// stays.
    pub(crate) fn show(&mut self, document: &mut Document, command: Command) -> ToolState {
        self.refusal = document.preview(command).err().map(|refusal| refusal.to_string());
        ToolState::Running
    }

    /// Something else than the document refuses.
    pub(crate) fn refuse(&mut self, why: impl Into<String>) -> ToolState {
        self.refusal = Some(why.into());
        ToolState::Running
    }

    pub(crate) fn confirm(document: &mut Document) -> ToolState {
        document.confirm();
        ToolState::Confirmed
    }

    pub(crate) fn cancel(document: &mut Document) -> ToolState {
        document.cancel();
        ToolState::Cancelled
    }

    /// The numbers that are being typed; empty where the pointer counts.
    pub(crate) fn typed(&self) -> String {
        if self.numeric.is_active() { self.numeric.status() } else { String::new() }
    }

    /// What was refused is done now.
    pub(crate) fn clear_refusal(&mut self) {
        self.refusal = None;
    }

    /// A line for the status bar: the tool's own, and why nothing happens.
    pub(crate) fn explained(&self, text: String) -> String {
        match &self.refusal {
            Some(refusal) => format!("{text} — {refusal}"),
            None => text,
        }
    }

    /// A line for the status bar: the tool's, and why nothing happens or how it ends.
    pub(crate) fn status(&self, text: String) -> String {
        match &self.refusal {
            Some(_) => self.explained(text),
            None if self.confirms_on_release => format!("{text} — let go: done, right click: cancel"),
            None => format!("{text} — click: done, right click: cancel"),
        }
    }

    /// The distance of the pointer from a position in the image, now and at the start.
    pub(crate) fn distances(&self, from: DVec2) -> [f64; 2] {
        [self.pointer.position().distance(from), self.pointer.start().distance(from)]
    }
}

/// A tool that runs.
pub(crate) trait Tool {
    /// Takes an input.
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState;

    /// Keys and numbers for the status line.
    fn status(&self) -> String;

    /// The state that it shares with all modal tools.
    fn modal(&mut self) -> &mut Modal;

    /// The window put its pointer somewhere else, as at the borders of endless drags: that was no
    /// movement.
    fn pointer_jumped(&mut self, to: DVec2) {
        self.modal().pointer.jumped(to);
    }

    /// What is to be drawn over the image.
    fn marks(&self) -> ToolMarks {
        ToolMarks::default()
    }
}

/// A tool that works on what is under the pointer.
pub(crate) trait FaceTool: Tool {
    /// Whether the face under the pointer matters now.
    fn wants_face(&self) -> bool;

    /// How far beside a face the pointer may be, in logical pixels.
    fn reach(&self) -> f64 {
        0.0
    }

    /// Where the pointer aims, in the pixels of the view; `None` where it is.
    fn aim(&self, _document: &Document, _view: &ToolView) -> Option<DVec2> {
        None
    }

    /// The face that is drawn where the pointer aims, as the window's picks say, after each input.
    fn hover(&mut self, document: &Document, view: &ToolView, face: Option<(MeshId, FaceId)>);
}

/// Whether a tool continues.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ToolState {
    /// It waits for more input.
    Running,
    /// It is over: what it showed is done.
    Confirmed,
    /// As [`Confirmed`](Self::Confirmed), and what it made is turned or scaled next.
    ConfirmedThen(TransformKind),
    /// It is over: the document is as it was.
    Cancelled,
}

/// What a tool draws, in the world.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ToolMarks {
    /// Axes of locks, cuts to come.
    pub(crate) lines: Vec<[DVec3; 2]>,
    /// The reach of proportional editing: a centre and a radius in metres.
    pub(crate) circle: Option<(DVec3, f64)>,
    /// What something snapped to.
    pub(crate) point: Option<DVec3>,
    pub(crate) label: Option<ToolLabel>,
}

/// A text beside a point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToolLabel {
    pub(crate) at: DVec3,
    pub(crate) text: String,
}

/// How much slower the pointer is while Shift is held.
const PRECISE: f64 = 0.1;

/// A pointer that only knows how far it went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct VirtualPointer {
    /// Where the window's pointer was last.
    last: Option<DVec2>,
    /// Where it was first.
    start: Option<DVec2>,
    /// How far it went since, in physical pixels; precise moves count less.
    way: DVec2,
}

impl VirtualPointer {
    /// The window's pointer moved. Whether that changes anything.
    pub(crate) fn moved(&mut self, to: Option<DVec2>, is_precise: bool) -> bool {
        let Some(to) = to else { return false };
        let Some(last) = self.last.replace(to) else {
            self.start = Some(to);
            return false;
        };
        self.way += (to - last) * if is_precise { PRECISE } else { 1.0 };
        to != last
    }

    /// The window put its pointer somewhere else: that was no movement.
    pub(crate) fn jumped(&mut self, to: DVec2) {
        self.last = Some(to);
    }

    /// How far it went, in physical pixels.
    pub(crate) fn way(&self) -> DVec2 {
        self.way
    }

    /// Where it was first; the origin until it was seen.
    pub(crate) fn start(&self) -> DVec2 {
        self.start.unwrap_or(DVec2::ZERO)
    }

    /// Where it is, as if it had never jumped or slowed down.
    pub(crate) fn position(&self) -> DVec2 {
        self.start() + self.way
    }

    /// Where the window's pointer is.
    pub(crate) fn in_window(&self) -> Option<DVec2> {
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jumps_do_not_count_and_precise_moves_count_a_tenth() {
        let mut pointer = VirtualPointer::default();
        let at = |x| Some(DVec2::new(x, 5.0));
        assert!(!pointer.moved(None, false) && !pointer.moved(at(10.0), false), "its first place is no move");
        pointer.moved(at(30.0), false);
        pointer.jumped(DVec2::new(700.0, 5.0));
        pointer.moved(at(710.0), true);
        assert_eq!(
            (pointer.way(), pointer.position()),
            (DVec2::new(21.0, 0.0), DVec2::new(31.0, 5.0)),
            "20 and 10 / 10"
        );
    }
}
