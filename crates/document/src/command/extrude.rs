//! Extruding, insetting and beveling.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{
    BevelSettings, BevelWidth, ExtrudeOffset, InnerMiter, Inset as InsetSettings, OuterMiter, VertexId,
};

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

/// Replaces the selected edges or vertices with new faces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Bevel {
    /// The distance of the new edges from the old ones, or what else the type of the width says.
    #[schemars(range(min = 0.0))]
    pub width: f64,
    /// What the width measures.
    pub width_type: BevelWidth,
    /// The number of faces side by side.
    #[schemars(range(min = 1, max = 100))]
    pub segments: u32,
    /// The shape of the cross-section: 0.5 is round.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub profile: f64,
    /// Whether the width is limited so that nothing overlaps.
    pub clamp_overlap: bool,
    /// Whether vertices are beveled instead of edges.
    pub vertices: bool,
    /// The shape of corners of more than 180 degrees between two new edges.
    pub outer_miter: OuterMiter,
    /// The shape of other corners between two new edges.
    pub inner_miter: InnerMiter,
    /// Whether the new edges beside the old faces are marked sharp.
    pub mark_sharp: bool,
    /// Whether the new edges beside the old faces are marked as seams.
    pub mark_seams: bool,
    /// Whether the old faces keep their shading, and the new ones are smooth.
    pub harden_normals: bool,
}

impl Default for Bevel {
    fn default() -> Self {
        let settings = BevelSettings::default();
        Self {
            width: settings.width,
            width_type: BevelWidth::default(),
            segments: settings.segments as u32,
            profile: settings.profile,
            clamp_overlap: settings.clamp_overlap,
            vertices: false,
            outer_miter: OuterMiter::default(),
            inner_miter: InnerMiter::default(),
            mark_sharp: settings.mark_sharp,
            mark_seams: settings.mark_seams,
            harden_normals: settings.harden_normals,
        }
    }
}

impl Bevel {
    fn settings(&self) -> BevelSettings {
        BevelSettings {
            width: self.width,
            width_type: self.width_type,
            segments: self.segments as usize,
            profile: self.profile,
            clamp_overlap: self.clamp_overlap,
            outer_miter: self.outer_miter,
            inner_miter: self.inner_miter,
            mark_sharp: self.mark_sharp,
            mark_seams: self.mark_seams,
            harden_normals: self.harden_normals,
        }
    }
}

impl Action for Bevel {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let settings = self.settings();
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
