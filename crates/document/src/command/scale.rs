//! Scaling: elements in edit mode, objects in object mode.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DMat3, DVec3};
use trigon_modelling::{Refusal, Transform};
use trigon_scene::Transform as NodeTransform;

use super::place::Placing;
use super::space::TransformSpace;
use super::transform::Proportional;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Scales the selection about a centre, along three axes.
///
/// An object is never sheared: if the given axes are not its own, it is scaled along its own axes by the
/// amount that these get longer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Scale {
    /// The factors along the three axes; negative ones mirror.
    pub factors: [f64; 3],
    /// The axes, one after another; they must be linearly independent. Default: those of the space; for
    /// objects in local space, each one's own.
    pub orientation: Option<[[f64; 3]; 3]>,
    /// The fixed point, in metres. Default: the centre of each mesh's selected vertices; for
    /// objects, each one's origin.
    pub center: Option<[f64; 3]>,
    /// The space of the axes and of the centre.
    pub space: TransformSpace,
    /// Whether connected vertices are scaled about their own centre; `center` is then ignored.
    pub individual: bool,
    /// Also scales nearby elements.
    pub proportional: Option<Proportional>,
}

impl Default for Scale {
    fn default() -> Self {
        Self {
            factors: [1.0; 3],
            orientation: None,
            center: None,
            space: TransformSpace::default(),
            individual: false,
            proportional: None,
        }
    }
}

impl Action for Scale {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let factors = DVec3::from(self.factors);
        let placing = Placing {
            command: "scaling",
            space: self.space,
            center: self.center,
            individual: self.individual,
            proportional: self.proportional.as_ref(),
        };
        let axes = self.axes()?;
        if !change.selection().is_editing() {
            return placing.transform_objects(change, |node, outward, inward| {
                let own = self.orientation.is_none() && self.space == TransformSpace::Local;
                node.scale_by(if own { factors } else { axes.own_factors(node, outward) });
                if let Some(center) = self.center.map(DVec3::from) {
                    let arm = outward.transform_point3(node.translation()) - center;
                    node.set_translation(inward.transform_point3(center + axes.scaled(arm)));
                }
            });
        }
        placing.transform_vertices(change, |center, into_mesh| {
            let orientation = match (self.orientation, self.space) {
                (None, TransformSpace::Local) => DMat3::IDENTITY,
                _ => into_mesh.matrix3 * axes.axes,
            };
            Transform::Scale { center, factors, orientation }
        })
    }
}

/// Factors along axes.
struct Axes {
    factors: DVec3,
    /// In columns.
    axes: DMat3,
    inverse: DMat3,
}

impl Scale {
    fn axes(&self) -> Result<Axes, EditError> {
        let factors = DVec3::from(self.factors);
        let Some(given) = self.orientation else {
            return Ok(Axes { factors, axes: DMat3::IDENTITY, inverse: DMat3::IDENTITY });
        };
        let reason = "the axes of the orientation are not linearly independent";
        let dependent = Refusal::NotPossible { operation: "scaling", reason };
        let axes = DMat3::from_cols_array_2d(&given);
        let inverse = axes.try_inverse().filter(DMat3::is_finite).ok_or(dependent)?;
        Ok(Axes { factors, axes, inverse })
    }
}

impl Axes {
    fn scaled(&self, vector: DVec3) -> DVec3 {
        self.axes * (self.factors * (self.inverse * vector))
    }

    /// The factor by which each of an object's own axes gets longer along itself.
    fn own_factors(&self, node: &NodeTransform, outward: &DAffine3) -> DVec3 {
        if self.factors.x == self.factors.y && self.factors.y == self.factors.z {
            return self.factors;
        }
        let own = outward.matrix3 * node.to_affine().matrix3;
        let along = |axis: DVec3| {
            let axis = axis.normalize_or_zero();
            if axis == DVec3::ZERO { 1.0 } else { self.scaled(axis).dot(axis) }
        };
        DVec3::new(along(own.x_axis), along(own.y_axis), along(own.z_axis))
    }
}
