//! Texture coordinates by projection onto a cylinder or a sphere.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{CylinderProjection, SphereProjection};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

const FACES: &str = "at least one selected face";
const COMMAND: &str = "projecting texture coordinates";

/// Projects texture coordinates onto the selected faces from a cylinder around them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectUvsCylinder {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// A point on the axis at the middle of the image, in metres. Default: the middle of the faces.
    pub center: Option<[f64; 3]>,
    /// The upward direction of the axis.
    pub axis: [f64; 3],
    /// The height of the image, in metres. Default: that of the faces.
    pub height: Option<f64>,
}

impl Default for ProjectUvsCylinder {
    fn default() -> Self {
        let CylinderProjection { axis, .. } = CylinderProjection::default();
        Self { uv_set: 0, center: None, axis: axis.into(), height: None }
    }
}

impl Action for ProjectUvsCylinder {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (center, axis) = (self.center.map(DVec3::from), DVec3::from(self.axis));
        let projection = CylinderProjection { center, axis, height: self.height };
        change.edit_selected_faces(COMMAND, FACES, |mesh, faces| {
            mesh.project_uvs_on_cylinder(faces, self.uv_set as usize, &projection)
        })?;
        Ok(Outcome::silent())
    }
}

/// Projects texture coordinates onto the selected faces from a sphere around them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectUvsSphere {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// The centre, in metres. Default: the middle of the faces.
    pub center: Option<[f64; 3]>,
    /// Towards the upper pole.
    pub axis: [f64; 3],
}

impl Default for ProjectUvsSphere {
    fn default() -> Self {
        Self { uv_set: 0, center: None, axis: SphereProjection::default().axis.into() }
    }
}

impl Action for ProjectUvsSphere {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let projection =
            SphereProjection { center: self.center.map(DVec3::from), axis: DVec3::from(self.axis) };
        change.edit_selected_faces(COMMAND, FACES, |mesh, faces| {
            mesh.project_uvs_on_sphere(faces, self.uv_set as usize, &projection)
        })?;
        Ok(Outcome::silent())
    }
}
