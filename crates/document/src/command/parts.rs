//! Copying and separating parts of meshes: duplicate, split off, rip, separate.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{Refusal, Transform};

use super::space::TransformSpace;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

const FACES: &str = "at least one selected face";

/// Duplicates the selection within its mesh, and selects the copies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Duplicate {
    /// The offset of the copies, in metres.
    pub offset: [f64; 3],
}

impl Action for Duplicate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let offset = DVec3::from(self.offset);
        change.edit_selected("duplicating", "something selected", |mesh, selection| {
            let (faces, edges) = (selection.faces(mesh, kind), selection.edges(mesh, kind));
            let made = mesh.duplicate(&selection.vertices(mesh, kind), &edges, &faces)?;
            if offset != DVec3::ZERO {
                mesh.transform_vertices(&made.vertices, &Transform::Translate { offset }, None)?;
            }
            Ok(AfterEdit::Select(Elements::Vertices(made.vertices)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Splits the selected faces off from the others, within their mesh.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SplitOff {}

impl Action for SplitOff {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("splitting off", FACES, |mesh, selection| {
            let faces = selection.faces(mesh, kind);
            mesh.split_off(&faces)?;
            Ok(AfterEdit::Select(Elements::Faces(faces)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Opens meshes along the selected edges, or at selected vertices without such edges, and selects the side that
/// comes loose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rip {
    /// The direction in which the side that comes loose lies; its length does not matter.
    pub direction: [f64; 3],
    /// The space of the direction.
    pub space: TransformSpace,
    /// Whether faces fill the gap.
    pub fill: bool,
}

impl Default for Rip {
    fn default() -> Self {
        Self { direction: [1.0, 0.0, 0.0], space: TransformSpace::default(), fill: false }
    }
}

impl Action for Rip {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (command, kind) = ("ripping", change.selection().kind());
        if kind == ElementKind::Face {
            let reason = "it works on edges and vertices; switch to one of these";
            return Err(Refusal::NotPossible { operation: command, reason }.into());
        }
        let into_meshes = self.space.into_meshes(command, change)?;
        let mut faces = 0;
        change.edit_selected_meshes(command, "a selected edge or vertex", |id, mesh, selection| {
            let into_mesh = into_meshes.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            let direction = (into_mesh.matrix3 * DVec3::from(self.direction)).normalize_or_zero();
            let vertices = match kind {
                ElementKind::Vertex => selection.vertices(mesh, kind),
                ElementKind::Edge | ElementKind::Face => Vec::new(),
            };
            let ripped = mesh.rip(&selection.edges(mesh, kind), &vertices, direction, self.fill)?;
            faces += ripped.faces.len();
            Ok(AfterEdit::Select(Elements::Vertices(ripped.vertices)))
        })?;
        if self.fill { Ok(Outcome::counted("made", faces, ["face", "faces"])) } else { Ok(Outcome::silent()) }
    }
}

/// Makes the selected faces of each mesh a separate object in the same place.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Separate {}

impl Action for Separate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut parts = Vec::new();
        change.edit_selected_meshes("separating", FACES, |id, mesh, selection| {
            parts.push((id, mesh.separate(&selection.faces(mesh, kind))?));
            Ok(AfterEdit::Clear)
        })?;
        let count = parts.len();
        parts.into_iter().for_each(|(mesh, part)| change.add_part(mesh, part));
        Ok(Outcome::counted("made", count, ["object", "objects"]))
    }
}
