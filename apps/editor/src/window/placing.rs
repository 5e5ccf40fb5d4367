//! Where menus put new objects, what goes to the 3D cursor and where that goes, copies, and parenting.

use trigon_document::{Command, ObjectName, OriginTarget, Paste, SetOrigin, SetParent, Translate};
use trigon_window::scene::math::DVec3;

use super::editor::{Editor, Message};
use crate::request::{Orientation, Pivot, Placing};

impl Editor {
    /// A command of a menu as it is meant: one that adds something puts that beside the 3D cursor as its own position is
    /// beside the origin, one that mirrors does so in the shown axes, and one that marks seams unwraps again if that is chosen.
    pub(super) fn in_space(&self, mut command: Command) -> Command {
        let position = match &mut command {
            Command::AddObject(add) => &mut add.position,
            Command::AddLight(add) => &mut add.position,
            Command::AddEmpty(add) => &mut add.position,
            Command::AddCamera(add) => &mut add.position,
            Command::MarkSeam(mark) => {
                mark.live_unwrap = self.uv.live_unwrap;
                return command;
            }
            Command::Mirror(mirror) => {
                mirror.plane.normal = self.up().stored(mirror.plane.normal.into()).to_array();
                return command;
            }
            _ => return command,
        };
        *position = (DVec3::from(*position) + self.tools.cursor).to_array();
        command
    }

    /// Hangs the selected objects on the active one.
    pub(crate) fn set_parent(&mut self, keeps_transform: bool) {
        let selection = self.document.selection();
        let Some(parent) = selection.active.filter(|active| selection.objects.contains(active)) else {
            self.message =
                Message::Refusal("Parent: no object is active; Shift+click the parent last".into());
            return;
        };
        let children = selection.objects.iter().filter(|&&id| id != parent);
        let command = SetParent {
            objects: children.map(|&id| ObjectName::of(id)).collect(),
            parent: Some(ObjectName::of(parent)),
            keep_transform: keeps_transform,
            index: None,
        };
        self.run(command.into());
    }

    /// Remembers what is selected.
    pub(super) fn copy(&mut self) {
        match self.document.copy() {
            Ok(glb) => {
                self.copied = Some(glb.into());
                self.message = Message::Info("Copied; Ctrl+V pastes".into());
            }
            Err(refusal) => self.message = Message::Refusal(refusal.to_string()),
        }
    }

    pub(super) fn paste(&mut self) {
        match self.copied.clone() {
            Some(glb) => self.run(Paste { glb }.into()),
            None => self.message = Message::Refusal("Paste: nothing was copied yet (Ctrl+C)".into()),
        }
    }

    /// Where a pivot is of what is selected.
    fn center(&mut self, pivot: Pivot) -> Option<DVec3> {
        let cursor = self.tools.cursor;
        let basis = self.gizmo_cache.basis(&self.document, pivot, cursor, Orientation::Global);
        basis.map(|basis| basis.center)
    }

    pub(super) fn snap(&mut self, placing: Placing) {
        let pivot = if placing == Placing::CursorToActive { Pivot::Active } else { Pivot::Median };
        let center = match placing {
            Placing::CursorToOrigin => Some(DVec3::ZERO),
            Placing::CursorToGrid => Some(self.tools.cursor.round()),
            _ => self.center(pivot),
        };
        let Some(center) = center else {
            self.message = Message::Refusal("Snap: needs something selected: click it first".into());
            return;
        };
        let goal = match placing {
            Placing::SelectionToCursor => self.tools.cursor,
            Placing::SelectionToGrid => center.round(),
            _ => {
                self.tools.cursor = center;
                self.message = Message::Info("The 3D cursor was moved".into());
                return;
            }
        };
        self.run(Translate { offset: (goal - center).to_array(), ..Translate::default() }.into());
    }

    pub(super) fn origin_to_cursor(&mut self) {
        let (to, point) = (OriginTarget::Point, self.tools.cursor.to_array());
        self.run(SetOrigin { to, point, ..SetOrigin::default() }.into());
    }
}
