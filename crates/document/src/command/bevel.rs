//! Beveling.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{BevelSettings, BevelWidth, InnerMiter, OuterMiter};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

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
