//! Merging vertices.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::VertexId;

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

/// Where vertices are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MergeAt {
    /// At their centre.
    #[default]
    Center,
    /// At the vertex selected first.
    First,
    /// At the vertex selected last.
    Last,
    /// Each group connected by selected edges, at its own centre.
    Collapse,
    /// Vertices that are close to one another.
    Distance,
}

/// Merges the selected vertices.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Merge {
    /// Where.
    pub at: MergeAt,
    /// The largest distance of vertices that are merged by distance, in metres.
    #[schemars(range(min = 0.0))]
    pub distance: f64,
}

impl Default for Merge {
    fn default() -> Self {
        Self { at: MergeAt::default(), distance: 1e-4 }
    }
}

impl Action for Merge {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut removed = 0;
        change.edit_selected("merging", "at least two selected vertices", |mesh, selection| {
            let mut vertices = selection.vertices(mesh, kind);
            if kind == ElementKind::Vertex {
                // In the order of selection, as far as it is known.
                let order: Vec<VertexId> = selection.order().iter().map(|&v| VertexId::new(v)).collect();
                let rank = |vertex: &VertexId| order.iter().rposition(|other| other == vertex);
                if !order.is_empty() {
                    vertices.sort_by_key(rank);
                }
            }
            let merged = match self.at {
                MergeAt::Center => mesh.merge_at_center(&vertices)?,
                MergeAt::First => mesh.merge_at_first(&vertices)?,
                MergeAt::Last => mesh.merge_at_last(&vertices)?,
                MergeAt::Collapse => mesh.collapse_edges(&selection.edges(mesh, kind))?,
                MergeAt::Distance => mesh.merge_by_distance(&vertices, self.distance)?,
            };
            removed += merged.removed;
            Ok(AfterEdit::Select(Elements::Vertices(merged.vertices)))
        })?;
        Ok(Outcome::counted("removed", removed, ["vertex", "vertices"]))
    }
}
