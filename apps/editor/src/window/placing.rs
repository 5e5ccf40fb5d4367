//! Where menus put new objects, and parenting.

use trigon_document::{Command, ObjectName, SetParent};
use trigon_window::scene::math::DVec3;

use super::editor::{Editor, Message};

impl Editor {
    /// A command of the menu Add that puts its object beside the 3D cursor as its own place is beside the origin.
    pub(super) fn at_cursor(&self, mut command: Command) -> Command {
        let position = match &mut command {
            Command::AddObject(add) => &mut add.position,
            Command::AddLight(add) => &mut add.position,
            Command::AddEmpty(add) => &mut add.position,
            Command::AddCamera(add) => &mut add.position,
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
}
