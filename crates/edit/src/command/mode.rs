//! Object mode, edit mode, and which kind of element is selected.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, ObjectName, Outcome};
use crate::document::Change;
use crate::error::EditError;
use crate::selection::ElementKind;

/// Starts to edit the meshes of objects: vertices, edges and faces can be selected then.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct EditObjects {
    /// The objects; those that are selected if none are named.
    pub objects: Vec<ObjectName>,
}

impl Action for EditObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let objects = if self.objects.is_empty() {
            change.selection().objects.iter().copied().collect()
        } else {
            let found: Result<Vec<_>, _> =
                self.objects.iter().map(|name| name.find(change.scene())).collect();
            found?
        };
        let meshes = change.meshes_of(objects.iter().copied());
        if meshes.is_empty() {
            let needed = "at least one object with a mesh";
            return Err(EditError::NothingSelected { command: "edit mode", needed });
        }
        for &mesh in &meshes {
            change.mesh(mesh);
            change.selection_mut().enter(mesh);
        }
        let selection = change.selection_mut();
        selection.objects.extend(&objects);
        selection.active = selection.active.or(objects.last().copied());
        Ok(Outcome::silent())
    }
}

/// Goes back to whole objects. What was selected within them is forgotten.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LeaveEditMode {}

impl Action for LeaveEditMode {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.selection_mut().leave();
        Ok(Outcome::silent())
    }
}

/// Selects vertices, edges or faces from now on. What follows from the old selection stays
/// selected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetElementKind {
    /// Which kind.
    pub kind: ElementKind,
}

impl Action for SetElementKind {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (selection, meshes) = change.selection_and_meshes();
        selection.set_kind(self.kind, meshes);
        Ok(Outcome::silent())
    }
}
