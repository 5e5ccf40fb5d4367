//! What all commands have in common: how they run, what they report, how they name objects, and how they change whole
//! meshes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::EditMesh;
use trigon_scene::{MeshId, NodeId, Scene};

use crate::error::EditError;
use crate::selection::ElementKind;
use crate::state::Change;

/// The implementation of a command.
pub(crate) trait Action {
    /// Runs the command. On an error the caller undoes all changes made so far.
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError>;

    /// The memory that its parameters take, if they may be large, in bytes.
    fn bytes(&self) -> usize {
        0
    }
}

/// A report to the user.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Outcome {
    /// A line for the status bar, as "merged 12 vertices"; empty if the image shows everything.
    pub message: String,
    /// A warning, as "cube: 2 corners …".
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Nothing to report.
    pub(crate) fn silent() -> Self {
        Self::default()
    }

    /// As "merged 12 vertices".
    pub(crate) fn counted(verb: &str, count: usize, [one, many]: [&str; 2]) -> Self {
        Self::with_message(format!("{verb} {count} {}", if count == 1 { one } else { many }))
    }

    /// How many vertices, edges and faces went, as "removed 1 vertex, 2 edges and 1 face"; vertices always.
    pub(crate) fn removed([vertices, edges, faces]: [usize; 3]) -> Self {
        let words = [(vertices, "vertex", "vertices"), (edges, "edge", "edges"), (faces, "face", "faces")];
        let reported: Vec<String> = words
            .iter()
            .enumerate()
            .filter(|(kind, (count, ..))| *kind == 0 || *count > 0)
            .map(|(_, (count, one, many))| format!("{count} {}", if *count == 1 { one } else { many }))
            .collect();
        let (last, others) = reported.split_last().expect("vertices are always told");
        let separator = if others.is_empty() { "" } else { " and " };
        Self::with_message(format!("removed {}{separator}{last}", others.join(", ")))
    }

    pub(crate) fn with_message(message: impl Into<String>) -> Self {
        Self { message: message.into(), warnings: Vec::new() }
    }
}

/// An object by its number, or by its name: the first one with that name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ObjectName {
    /// Its number: the index of its node.
    Number(u32),
    /// Its name.
    Name(String),
}

impl ObjectName {
    /// An object of a scene.
    #[must_use]
    pub fn of(id: NodeId) -> Self {
        Self::Number(id.index() as u32)
    }

    /// The object with this name.
    pub(crate) fn find(&self, scene: &Scene) -> Result<NodeId, EditError> {
        let found = match self {
            Self::Number(number) => scene.nodes().id_at(*number as usize),
            Self::Name(name) => scene.nodes().iter().find(|(_, node)| node.name == *name).map(|(id, _)| id),
        };
        found.ok_or_else(|| match self {
            Self::Number(number) => EditError::NoSuchObject(format!("number {number}")),
            Self::Name(name) => EditError::NoSuchObject(format!("{name:?}")),
        })
    }
}

/// The meshes that are edited, or those of the selected objects. `command` names the command in the error
/// if there are none.
pub(super) fn whole_meshes(change: &Change<'_>, command: &'static str) -> Result<Vec<MeshId>, EditError> {
    let ids: Vec<MeshId> = if change.selection().is_editing() {
        change.selection().meshes().map(|(id, _)| id).collect()
    } else {
        change.meshes_of(change.selection().objects.iter().copied())
    };
    if ids.is_empty() {
        return Err(EditError::NothingSelected { command, needed: "at least one object with a mesh" });
    }
    Ok(ids)
}

/// Gives a mesh other edges and faces throughout, so that those selected before are gone whatever their
/// numbers; vertices stay selected. Returns how many faces it has.
pub(super) fn remake(
    change: &mut Change<'_>,
    id: MeshId,
    with: impl FnOnce(&mut EditMesh) -> Result<(), EditError>,
) -> Result<usize, EditError> {
    let faces = change.edit(id, |mesh| {
        with(mesh)?;
        Ok(mesh.face_count())
    })?;
    let kind = change.selection().kind();
    let selection = change.selection_mut().of_mut(id);
    if let Some(selection) = selection.filter(|_| kind != ElementKind::Vertex) {
        selection.clear();
    }
    Ok(faces)
}
