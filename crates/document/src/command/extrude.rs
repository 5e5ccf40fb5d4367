//! Extruding and insetting.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{ExtrudeOffset, Inset as InsetSettings, VertexId};

use super::space::TransformSpace;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

/// Extrudes the selection: faces as a region; without faces, edges become faces, and vertices at none of
/// these edges become edges. The extruded elements are selected and moved.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Extrude {
    /// The distance along normals, in metres; faces only.
    pub distance: f64,
    /// An additional offset, in metres.
    pub offset: [f64; 3],
    /// The space of the offset.
    pub space: TransformSpace,
    /// Whether each face is extruded individually.
    pub individual: bool,
}

impl Action for Extrude {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let into_meshes = self.space.into_meshes("extruding", change)?;
        change.edit_selected_meshes("extruding", "something selected", |id, mesh, selection| {
            let into_mesh = into_meshes.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            let offset = into_mesh.matrix3 * DVec3::from(self.offset);
            let faces = selection.faces(mesh, kind);
            if !faces.is_empty() {
                let along = ExtrudeOffset::Along(self.distance);
                let made = if self.individual {
                    mesh.extrude_individual(&faces, along)?
                } else {
                    mesh.extrude_region(&faces, along)?
                };
                if offset != DVec3::ZERO {
                    let moved = trigon_modelling::Transform::Translate { offset };
                    mesh.transform_vertices(&made.vertices, &moved, None)?;
                }
                return Ok(AfterEdit::Select(Elements::Faces(faces)));
            }
            let edges = selection.edges(mesh, kind);
            let ends: BTreeSet<VertexId> = edges.iter().flat_map(|&edge| mesh.edge_vertices(edge)).collect();
            let mut alone = selection.vertices(mesh, kind);
            alone.retain(|vertex| !ends.contains(vertex));
            if alone.is_empty() {
                return Ok(AfterEdit::Select(Elements::Edges(mesh.extrude_edges(&edges, offset)?.edges)));
            }
            let mut vertices = mesh.extrude_vertices(&alone, offset)?.vertices;
            if !edges.is_empty() {
                let made = mesh.extrude_edges(&edges, offset)?.edges;
                vertices.extend(made.iter().flat_map(|&edge| mesh.edge_vertices(edge)));
            }
            Ok(AfterEdit::Select(Elements::Vertices(vertices)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Which faces an inset shrinks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InsetMode {
    /// The selected faces as one region.
    #[default]
    Region,
    /// Each selected face individually.
    Individual,
    /// The faces around the selected ones.
    Outset,
}

/// Makes a border of faces inside the selected ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Inset {
    /// The width of the border, in metres.
    #[schemars(range(min = 0.0))]
    pub thickness: f64,
    /// How far the faces move along their normals, in metres.
    pub depth: f64,
    /// What shrinks.
    pub mode: InsetMode,
    /// Whether the border also runs along open borders of the mesh.
    pub open_borders: bool,
}

impl Default for Inset {
    fn default() -> Self {
        Self { thickness: 0.1, depth: 0.0, mode: InsetMode::default(), open_borders: true }
    }
}

impl Action for Inset {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let (thickness, depth, open_borders) = (self.thickness, self.depth, self.open_borders);
        let settings = InsetSettings { thickness, depth, open_borders };
        change.edit_selected("insetting", "at least one selected face", |mesh, selection| {
            let faces = selection.faces(mesh, kind);
            match self.mode {
                InsetMode::Region => mesh.inset_region(&faces, settings)?,
                InsetMode::Individual => mesh.inset_individual(&faces, settings)?,
                InsetMode::Outset => mesh.outset_region(&faces, settings)?,
            };
            Ok(AfterEdit::Select(Elements::Faces(faces)))
        })?;
        Ok(Outcome::silent())
    }
}
