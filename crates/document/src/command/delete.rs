//! Deleting elements of meshes, and objects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::ElementKind;
use crate::state::{AfterEdit, Change};

/// What to delete.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Deleted {
    /// Vertices, with all edges and faces at them.
    Vertices,
    /// Edges, with all faces at them and vertices that are left without edges.
    Edges,
    /// Faces, with edges and vertices that belong to nothing else.
    Faces,
    /// Faces; their edges remain as loose edges.
    OnlyFaces,
}

/// Deletes selected elements of the edited meshes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Delete {
    /// What to delete. Default: the selected kind of element.
    pub what: Option<Deleted>,
}

impl Action for Delete {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let what = self.what.unwrap_or(match kind {
            ElementKind::Vertex => Deleted::Vertices,
            ElementKind::Edge => Deleted::Edges,
            ElementKind::Face => Deleted::Faces,
        });
        change.edit_selected("delete", "something selected", |mesh, selection| {
            match what {
                Deleted::Vertices => mesh.delete_vertices(&selection.vertices(mesh, kind))?,
                Deleted::Edges => mesh.delete_edges(&selection.edges(mesh, kind))?,
                Deleted::Faces => mesh.delete_faces(&selection.faces(mesh, kind))?,
                Deleted::OnlyFaces => mesh.delete_only_faces(&selection.faces(mesh, kind))?,
            }
            Ok(AfterEdit::Clear)
        })?;
        Ok(Outcome::silent())
    }
}

/// Deletes the selected objects and their descendants.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DeleteObjects {}

impl Action for DeleteObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("deleting objects"));
        }
        let objects = std::mem::take(&mut change.selection_mut().objects);
        if objects.is_empty() {
            let needed = "at least one object";
            return Err(EditError::NothingSelected { command: "deleting objects", needed });
        }
        change.selection_mut().active = None;
        let scene = change.scene_mut();
        let count: usize = objects.into_iter().map(|object| scene.remove(object)).sum();
        Ok(Outcome::counted("deleted", count, ["object", "objects"]))
    }
}
