//! Mirroring and symmetry.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DVec3, Plane};
use trigon_modelling::Refusal;

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

/// A plane in the space of the mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MirrorPlane {
    /// On the plane, in metres.
    pub point: [f64; 3],
    /// Perpendicular to it; its length does not matter.
    pub normal: [f64; 3],
}

impl Default for MirrorPlane {
    fn default() -> Self {
        Self { point: [0.0; 3], normal: [1.0, 0.0, 0.0] }
    }
}

impl MirrorPlane {
    fn plane(&self) -> Result<Plane, Refusal> {
        let plane = Plane::from_point_and_normal(DVec3::from(self.point), DVec3::from(self.normal));
        let reason = "the plane's normal is zero or not finite";
        plane.ok_or(Refusal::NotPossible { operation: "mirroring", reason })
    }
}

/// Mirrors the selection, in place or as a copy.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Mirror {
    /// The mirror plane.
    pub plane: MirrorPlane,
    /// Whether the selection stays and a copy is mirrored.
    pub copy: bool,
    /// For a copy: vertices at most this far from the plane, in metres, are shared by both halves.
    pub merge_distance: Option<f64>,
}

impl Action for Mirror {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let plane = self.plane.plane()?;
        let kind = change.selection().kind();
        change.edit_selected("mirroring", "something selected", |mesh, selection| {
            if !self.copy {
                mesh.mirror(&selection.vertices(mesh, kind), &plane)?;
                return Ok(AfterEdit::Keep);
            }
            let (faces, edges) = (selection.faces(mesh, kind), selection.edges(mesh, kind));
            let made = mesh.mirror_copy(&faces, &edges, &plane, self.merge_distance)?;
            Ok(AfterEdit::Select(Elements::Vertices(made.vertices)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Makes the selected faces symmetric: the side of the plane's normal replaces the other side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Symmetrize {
    /// The plane of symmetry.
    pub plane: MirrorPlane,
    /// Vertices at most this far from the plane, in metres, are moved onto it.
    #[schemars(range(min = 0.0))]
    pub merge_distance: f64,
}

impl Default for Symmetrize {
    fn default() -> Self {
        Self { plane: MirrorPlane::default(), merge_distance: 1e-4 }
    }
}

impl Action for Symmetrize {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let plane = self.plane.plane()?;
        let kind = change.selection().kind();
        change.edit_selected("symmetrizing", "at least one selected face", |mesh, selection| {
            let made = mesh.symmetrize(&selection.faces(mesh, kind), &plane, self.merge_distance)?;
            let mut faces = made.retained;
            faces.extend(made.mirrored.faces);
            Ok(AfterEdit::Select(Elements::Faces(faces)))
        })?;
        Ok(Outcome::silent())
    }
}
