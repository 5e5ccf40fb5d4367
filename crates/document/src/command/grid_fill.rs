//! Filling a loop of edges with a grid of quads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::GridSides;

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

/// Fills the selected loop, which needs an even number of edges, with a grid of quads.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct GridFill {
    /// The number of edges on the first side of the grid: 1 to half of all, minus 1. Default: as square as
    /// possible.
    #[schemars(range(min = 1))]
    pub span: Option<u32>,
    /// Shifts the first corner along the loop by this number of edges.
    pub offset: u32,
}

impl Action for GridFill {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let sides = GridSides { span: self.span.map(|span| span as usize), offset: self.offset as usize };
        let mut count = 0;
        change.edit_selected("filling with a grid", "one loop of edges", |mesh, selection| {
            let made = mesh.grid_fill(&selection.edges(mesh, kind), sides)?;
            count += made.faces.len();
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::counted("made", count, ["face", "faces"]))
    }
}
