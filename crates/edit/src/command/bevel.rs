//! Beveling.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::edit::BevelSettings;

use super::{Action, Outcome};
use crate::document::{AfterEdit, Change};
use crate::error::EditError;
use crate::selection::Elements;

/// Replaces the selected edges or vertices with new faces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Bevel {
    /// The distance of the new edges from the old ones, in metres.
    #[schemars(range(min = 0.0))]
    pub width: f64,
    /// The number of faces side by side.
    #[schemars(range(min = 1, max = 1000))]
    pub segments: u32,
    /// The shape of the cross-section: 0.5 is round.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub profile: f64,
    /// Whether the width is limited so that nothing overlaps.
    pub clamp_overlap: bool,
    /// Whether vertices are beveled instead of edges.
    pub vertices: bool,
}

impl Default for Bevel {
    fn default() -> Self {
        Self { width: 0.1, segments: 1, profile: 0.5, clamp_overlap: true, vertices: false }
    }
}

impl Action for Bevel {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let settings = BevelSettings {
            width: self.width,
            segments: self.segments as usize,
            profile: self.profile,
            clamp_overlap: self.clamp_overlap,
        };
        let mut left_out = 0;
        change.edit_selected("beveling", "at least one selected edge", |mesh, selection| {
            let made = if self.vertices {
                mesh.bevel_vertices(&selection.vertices(mesh, kind), &settings)?
            } else {
                mesh.bevel_edges(&selection.edges(mesh, kind), &settings)?
            };
            left_out += made.left_out.count();
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        if left_out == 0 {
            Ok(Outcome::silent())
        } else {
            Ok(Outcome::counted("left out", left_out, ["edge", "edges"]))
        }
    }
}
