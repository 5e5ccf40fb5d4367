//! Object mode, edit mode, and the kind of element that is selected.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, ElementKinds};
use crate::state::Change;

/// Enters edit mode, in which vertices, edges and faces of the objects' meshes can be selected.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct EditObjects {
    /// The objects. Default: the selected ones.
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

/// Returns to object mode. The selection of elements is forgotten.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LeaveEditMode {}

impl Action for LeaveEditMode {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.selection_mut().leave();
        Ok(Outcome::silent())
    }
}

/// Sets which of vertices, edges and faces are selected. The current selection is converted. With several
/// kinds, elements are numbered and selected as those of the first of them, and the others by their parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetElementKind {
    /// Which kind.
    pub kind: ElementKind,
    /// Whether it is added to the kinds that are selected already, or removed from them if it is one of
    /// several.
    #[serde(default)]
    pub extend: bool,
}

impl Action for SetElementKind {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (selection, meshes) = change.selection_and_meshes();
        let one = ElementKinds::one(self.kind);
        selection.set_kinds(if self.extend { selection.kinds().toggled(self.kind) } else { one }, meshes);
        Ok(Outcome::silent())
    }
}
