//! Deforming the selected vertices: shear, to sphere, along normals, push and pull; and what falls off
//! with distance.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{Falloff, FalloffDistance, FalloffShape, Transform};

use super::space::middle;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Also moves elements near the selection, less with greater distance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Proportional {
    /// The radius of influence, in metres.
    #[schemars(range(min = 0.0))]
    pub radius: f64,
    /// The shape of the falloff.
    pub shape: ProportionalShape,
    /// Whether only vertices connected to the selection move, by their distance along edges.
    pub connected: bool,
}

impl Default for Proportional {
    fn default() -> Self {
        Self { radius: 1.0, shape: ProportionalShape::default(), connected: false }
    }
}

/// How a move falls off with distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names are those of every modeller")]
pub enum ProportionalShape {
    #[default]
    Smooth,
    Sphere,
    Root,
    Sharp,
    Linear,
    Constant,
}

impl Proportional {
    /// For a mesh whose lengths are those of the command times a factor.
    pub(super) fn falloff(&self, length_factor: f64) -> Falloff {
        Falloff {
            radius: self.radius * length_factor,
            shape: match self.shape {
                ProportionalShape::Smooth => FalloffShape::Smooth,
                ProportionalShape::Sphere => FalloffShape::Sphere,
                ProportionalShape::Root => FalloffShape::Root,
                ProportionalShape::Sharp => FalloffShape::Sharp,
                ProportionalShape::Linear => FalloffShape::Linear,
                ProportionalShape::Constant => FalloffShape::Constant,
            },
            distance: if self.connected { FalloffDistance::AlongEdges } else { FalloffDistance::Straight },
        }
    }
}

/// Shears the selected vertices: each moves in a direction in proportion to its distance from a
/// plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Shear {
    /// The offset per metre from the plane.
    pub factor: f64,
    /// Perpendicular to the plane.
    pub normal: [f64; 3],
    /// Where to.
    pub direction: [f64; 3],
    /// A point of the plane. Default: the centre of the selected vertices.
    pub center: Option<[f64; 3]>,
    /// Also shears nearby vertices.
    pub proportional: Option<Proportional>,
}

impl Default for Shear {
    fn default() -> Self {
        let (normal, direction) = ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
        Self { factor: 0.0, normal, direction, center: None, proportional: None }
    }
}

/// Moves the selected vertices towards a sphere around their centre.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ToSphere {
    /// 0 (unchanged) to 1 (on the sphere).
    pub factor: f64,
    /// The centre of the sphere. Default: that of the selected vertices.
    pub center: Option<[f64; 3]>,
    /// Also moves nearby vertices.
    pub proportional: Option<Proportional>,
}

impl Default for ToSphere {
    fn default() -> Self {
        Self { factor: 1.0, center: None, proportional: None }
    }
}

/// Moves the selected vertices along their normals.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ShrinkFatten {
    /// Outwards, in metres; negative inwards.
    pub distance: f64,
    /// Also moves nearby vertices.
    pub proportional: Option<Proportional>,
}

/// Moves the selected vertices directly away from a centre, all by the same distance.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PushPull {
    /// Outwards, in metres; negative inwards.
    pub distance: f64,
    /// The centre. Default: that of the selected vertices.
    pub center: Option<[f64; 3]>,
    /// Also moves nearby vertices.
    pub proportional: Option<Proportional>,
}

/// Moves the selected vertices back to where they were created or loaded.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ResetVertices {}

pub(super) const VERTICES: &str = "at least one selected vertex";

/// Runs a transform on the selected vertices of each mesh. The selection is unchanged.
fn transform_vertices(
    change: &mut Change<'_>,
    command: &'static str,
    center: Option<[f64; 3]>,
    proportional: Option<&Proportional>,
    transform: impl Fn(DVec3) -> Transform,
) -> Result<Outcome, EditError> {
    let falloff = proportional.map(|near| near.falloff(1.0));
    change.edit_selected_vertices(command, VERTICES, |mesh, vertices| {
        let center = center.map_or_else(|| middle(mesh, vertices), DVec3::from);
        mesh.transform_vertices(vertices, &transform(center), falloff.as_ref())
    })?;
    Ok(Outcome::silent())
}

impl Action for Shear {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (normal, direction) = (DVec3::from(self.normal), DVec3::from(self.direction));
        let shear = |center| Transform::Shear { center, normal, direction, factor: self.factor };
        transform_vertices(change, "shearing", self.center, self.proportional.as_ref(), shear)
    }
}

impl Action for ToSphere {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let to_sphere = |center| Transform::ToSphere { center, factor: self.factor };
        transform_vertices(change, "moving to a sphere", self.center, self.proportional.as_ref(), to_sphere)
    }
}

impl Action for ShrinkFatten {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let along = |_| Transform::AlongNormals { distance: self.distance };
        transform_vertices(change, "moving along normals", None, self.proportional.as_ref(), along)
    }
}

impl Action for PushPull {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let push = |center| Transform::PushPull { center, distance: self.distance };
        transform_vertices(change, "pushing", self.center, self.proportional.as_ref(), push)
    }
}

impl Action for ResetVertices {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut moved = 0;
        change.edit_selected_vertices("resetting vertices", VERTICES, |mesh, vertices| {
            moved += mesh.reset_vertices(vertices)?;
            Ok(())
        })?;
        Ok(Outcome::counted("took back", moved, ["vertex", "vertices"]))
    }
}
