//! Laying out texture coordinates.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{BoxProjection, PlanarProjection};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

const FACES: &str = "at least one selected face";

/// Projects texture coordinates onto the selected faces, from one side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectUvs {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// The point at the centre of the image, in metres.
    pub center: [f64; 3],
    /// Towards the viewer.
    pub normal: [f64; 3],
    /// The upward direction in the image.
    pub up: [f64; 3],
    /// The height of the image, in metres.
    pub height: f64,
    /// Its aspect ratio, width divided by height.
    pub aspect: f64,
}

impl Default for ProjectUvs {
    fn default() -> Self {
        let PlanarProjection { center, normal, up, height, aspect } = PlanarProjection::default();
        Self { uv_set: 0, center: center.into(), normal: normal.into(), up: up.into(), height, aspect }
    }
}

impl Action for ProjectUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let projection = PlanarProjection {
            center: DVec3::from(self.center),
            normal: DVec3::from(self.normal),
            up: DVec3::from(self.up),
            height: self.height,
            aspect: self.aspect,
        };
        change.edit_selected_faces("projecting texture coordinates", FACES, |mesh, faces| {
            mesh.project_uvs(faces, self.uv_set as usize, &projection)
        })?;
        Ok(Outcome::silent())
    }
}

/// Projects texture coordinates onto the selected faces from the six sides of a box, each face from the side
/// that it faces most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectUvsOnBox {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// The point at the centre of each image, in metres.
    pub center: [f64; 3],
    /// The height of the image, in metres.
    pub height: f64,
    /// Its aspect ratio, width divided by height.
    pub aspect: f64,
}

impl Default for ProjectUvsOnBox {
    fn default() -> Self {
        let BoxProjection { center, height, aspect } = BoxProjection::default();
        Self { uv_set: 0, center: center.into(), height, aspect }
    }
}

impl Action for ProjectUvsOnBox {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (center, height, aspect) = (DVec3::from(self.center), self.height, self.aspect);
        let projection = BoxProjection { center, height, aspect };
        change.edit_selected_faces("projecting texture coordinates", FACES, |mesh, faces| {
            mesh.project_uvs_on_box(faces, self.uv_set as usize, &projection)
        })?;
        Ok(Outcome::silent())
    }
}
