//! Cutting: subdivide, loop cut, slide.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::edit::LoopCutSettings;

use super::{Action, Outcome};
use crate::document::{AfterEdit, Change};
use crate::error::EditError;
use crate::selection::Elements;

const EDGES: &str = "at least one selected edge";

/// Cuts the selected edges into equal pieces, and the faces at them into a grid. Nothing is moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Subdivide {
    /// How many cuts each edge gets.
    #[schemars(range(min = 1, max = 1000))]
    pub cuts: u32,
}

impl Default for Subdivide {
    fn default() -> Self {
        Self { cuts: 1 }
    }
}

impl Action for Subdivide {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut faces = 0;
        change.edit_selected("subdividing", EDGES, |mesh, selection| {
            let made = mesh.subdivide(&selection.edges(mesh, kind), self.cuts)?;
            faces += made.faces.len();
            Ok(AfterEdit::Select(Elements::Edges(made.edges)))
        })?;
        Ok(Outcome::counted("cut into", faces, ["face", "faces"]))
    }
}

/// Cuts new loops across the ring of quads of an edge: the last selected one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LoopCut {
    /// How many loops, side by side.
    #[schemars(range(min = 1, max = 1000))]
    pub cuts: u32,
    /// How far they are moved together: −1 to 1 from side to side, 0 in the middle.
    #[schemars(range(min = -1.0, max = 1.0))]
    pub position: f64,
}

impl Default for LoopCut {
    fn default() -> Self {
        Self { cuts: 1, position: 0.0 }
    }
}

impl Action for LoopCut {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let settings = LoopCutSettings { cuts: self.cuts as usize, position: self.position };
        let mut edges = 0;
        change.edit_selected("cutting a loop", EDGES, |mesh, selection| {
            let selected = selection.edges(mesh, kind);
            let last = selection.order().last().copied();
            let of_last = selected.iter().copied().find(|edge| last == Some(edge.index()));
            let Some(edge) = of_last.or(selected.first().copied()) else {
                return Ok(AfterEdit::Keep);
            };
            let cut = mesh.loop_cut(edge, &settings)?;
            edges += cut.edges.len();
            Ok(AfterEdit::Select(Elements::Edges(cut.edges)))
        })?;
        Ok(Outcome::counted("cut", edges, ["edge", "edges"]))
    }
}

/// Slides the selected loops of edges along the edges beside them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SlideEdges {
    /// How far: −1 (all the way to one side) to 1 (to the other).
    #[schemars(range(min = -1.0, max = 1.0))]
    pub factor: f64,
}

impl Action for SlideEdges {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.edit_selected_edges("sliding edges", EDGES, |mesh, edges| {
            mesh.slide_edges(edges, self.factor).map(drop)
        })?;
        Ok(Outcome::silent())
    }
}
