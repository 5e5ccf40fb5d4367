//! Repairing faults found by inspection.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Repairs the selected kinds of faults in the edited meshes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Repair {
    /// Removes all but one of several faces on the same vertices.
    pub doubled_faces: bool,
    /// Removes edges without faces.
    pub loose_edges: bool,
    /// Removes vertices without edges.
    pub loose_vertices: bool,
    /// Collapses edges of at most this length, in metres.
    pub zero_length: Option<f64>,
    /// Merges faces of at most this area with their neighbours, in square metres.
    pub zero_area: Option<f64>,
}

impl Default for Repair {
    fn default() -> Self {
        Self {
            doubled_faces: true,
            loose_edges: true,
            loose_vertices: true,
            zero_length: Some(0.0),
            zero_area: Some(0.0),
        }
    }
}

impl Action for Repair {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            return Err(EditError::NotEditing("repairing"));
        }
        let ids: Vec<_> = change.selection().meshes().map(|(id, _)| id).collect();
        let mut repaired = 0;
        for id in ids {
            repaired += change.edit(id, |mesh| {
                let mut count = 0;
                if let Some(most) = self.zero_length {
                    count += mesh.collapse_zero_length_edges(most)?;
                }
                if let Some(most) = self.zero_area {
                    count += mesh.dissolve_zero_area_faces(most)?;
                }
                if self.doubled_faces {
                    count += mesh.remove_doubled_faces()?;
                }
                if self.loose_edges {
                    count += mesh.remove_loose_edges()?;
                }
                if self.loose_vertices {
                    count += mesh.remove_loose_vertices()?;
                }
                Ok(count)
            })?;
        }
        Ok(Outcome::counted("repaired", repaired, ["element", "elements"]))
    }
}
