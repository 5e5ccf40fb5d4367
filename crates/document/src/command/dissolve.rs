//! Removing elements without removing the surface.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::LimitedDissolve;

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

/// Removes the selected elements and leaves the surface that they divided as larger faces.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Dissolve {}

impl Action for Dissolve {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("dissolving", "something selected", |mesh, selection| {
            let made = match kind {
                ElementKind::Vertex => mesh.dissolve_vertices(&selection.vertices(mesh, kind))?,
                ElementKind::Edge => mesh.dissolve_edges(&selection.edges(mesh, kind))?,
                ElementKind::Face => mesh.dissolve_faces(&selection.faces(mesh, kind))?,
            };
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Merges selected faces that lie in one plane, and removes vertices on straight lines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DissolveFlat {
    /// The largest angle between faces, and of lines from straight, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub angle: f64,
}

impl Default for DissolveFlat {
    fn default() -> Self {
        Self { angle: 5.0 }
    }
}

impl Action for DissolveFlat {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let limits = LimitedDissolve { angle: self.angle.to_radians() };
        let mut removed = 0;
        change.edit_selected_faces(
            "dissolving flat areas",
            "at least one selected face",
            |mesh, faces| {
                removed += mesh.dissolve_limited(faces, limits)?.removed_vertices;
                Ok(())
            },
        )?;
        Ok(Outcome::counted("removed", removed, ["vertex", "vertices"]))
    }
}
