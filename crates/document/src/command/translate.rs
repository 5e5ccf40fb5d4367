//! Moving, rotating and scaling: elements in edit mode, objects in object mode. Rotations are as people type them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DMat3, DQuat, DVec3, elementary};
use trigon_modelling::{Refusal, Transform};
use trigon_scene::Transform as NodeTransform;

use super::space::{
    TransformSpace, inverse, islands, keeps_angles, length_factor, middle, objects_to_change, parent_to_world,
};
use super::transform::{Proportional, VERTICES};
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::{AfterEdit, Change};

/// Moves the selection.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Translate {
    /// The offset, in metres.
    pub offset: [f64; 3],
    /// The space of the offset.
    pub space: TransformSpace,
    /// Also moves nearby elements.
    pub proportional: Option<Proportional>,
}

/// Rotates the selection about a centre, counter-clockwise when looking from the tip of the axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rotate {
    /// The angle, in degrees.
    pub angle: f64,
    /// The axis; its length does not matter.
    pub axis: [f64; 3],
    /// The fixed point, in metres. Default: the centre of each mesh's selected vertices; for
    /// objects, each one's origin.
    pub center: Option<[f64; 3]>,
    /// The space of the axis and of the centre.
    pub space: TransformSpace,
    /// Whether connected vertices rotate about their own centre; `center` is then ignored.
    pub individual: bool,
    /// Also rotates nearby elements.
    pub proportional: Option<Proportional>,
}

impl Default for Rotate {
    fn default() -> Self {
        Self {
            angle: 0.0,
            axis: [0.0, 1.0, 0.0],
            center: None,
            space: TransformSpace::default(),
            individual: false,
            proportional: None,
        }
    }
}

/// The common part of moving, rotating and scaling.
pub(super) struct Placing<'a> {
    pub(super) command: &'static str,
    pub(super) space: TransformSpace,
    pub(super) center: Option<[f64; 3]>,
    pub(super) individual: bool,
    pub(super) proportional: Option<&'a Proportional>,
}

impl Placing<'_> {
    /// Transforms the selected vertices of each mesh; `transform` gets the centre in the space of
    /// the mesh, and the map into that space.
    pub(super) fn transform_vertices(
        &self,
        change: &mut Change<'_>,
        transform: impl Fn(DVec3, &DAffine3) -> Transform,
    ) -> Result<Outcome, EditError> {
        if self.individual && self.proportional.is_some() {
            let reason = "proportional editing does not work with individual pivots; choose another pivot";
            return Err(Refusal::NotPossible { operation: self.command, reason }.into());
        }
        let into_meshes = self.space.into_meshes(self.command, change)?;
        let kind = change.selection().kind();
        change.edit_selected_meshes(self.command, VERTICES, |id, mesh, selection| {
            let into_mesh = into_meshes.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            if self.individual {
                for group in islands(mesh, selection, kind) {
                    let transform = transform(middle(mesh, &group), &into_mesh);
                    mesh.transform_vertices(&group, &transform, None)?;
                }
                return Ok(AfterEdit::Keep);
            }
            let vertices = selection.vertices(mesh, kind);
            let given = self.center.map(|center| into_mesh.transform_point3(DVec3::from(center)));
            let center = given.unwrap_or_else(|| middle(mesh, &vertices));
            let falloff = self.proportional.map(|near| near.falloff(length_factor(&into_mesh)));
            mesh.transform_vertices(&vertices, &transform(center, &into_mesh), falloff.as_ref())?;
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::silent())
    }

    /// Changes each selected object; `transform` gets the map from its parent into the space of the
    /// command, and the inverse.
    pub(super) fn transform_objects(
        &self,
        change: &mut Change<'_>,
        transform: impl Fn(&mut NodeTransform, &DAffine3, &DAffine3),
    ) -> Result<Outcome, EditError> {
        for object in objects_to_change(change, self.command, self.space)? {
            let outward = match self.space {
                TransformSpace::Local => DAffine3::IDENTITY,
                TransformSpace::World => parent_to_world(change.scene(), object),
            };
            let inward = inverse(outward, self.command)?;
            if let Some(node) = change.scene_mut().node_mut(object) {
                transform(&mut node.transform, &outward, &inward);
            }
        }
        Ok(Outcome::silent())
    }
}

impl Action for Translate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let offset = DVec3::from(self.offset);
        let proportional = self.proportional.as_ref();
        let placing =
            Placing { command: "moving", space: self.space, center: None, individual: false, proportional };
        if !change.selection().is_editing() {
            return placing.transform_objects(change, |node, _, inward| {
                node.translate(inward.matrix3 * offset);
            });
        }
        placing.transform_vertices(change, |_, into_mesh| Transform::Translate {
            offset: into_mesh.matrix3 * offset,
        })
    }
}

impl Action for Rotate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (axis, angle) = (DVec3::from(self.axis), self.angle.to_radians());
        let placing = Placing {
            command: "turning",
            space: self.space,
            center: self.center,
            individual: self.individual,
            proportional: self.proportional.as_ref(),
        };
        if !change.selection().is_editing() {
            return placing.transform_objects(change, |node, outward, inward| {
                turn_object(node, outward, inward, axis, angle);
                if let (Some(center), Some(axis)) = (self.center.map(DVec3::from), axis.try_normalize()) {
                    let arm = outward.transform_point3(node.translation()) - center;
                    node.set_translation(inward.transform_point3(center + turned(arm, axis, angle)));
                }
            });
        }
        placing.transform_vertices(change, |center, into_mesh| Transform::Rotate {
            center,
            axis,
            angle,
            orientation: into_mesh.matrix3,
        })
    }
}

/// Rotates an object about its origin; the axis is in the space into which `outward` maps.
fn turn_object(node: &mut NodeTransform, outward: &DAffine3, inward: &DAffine3, axis: DVec3, angle: f64) {
    if keeps_angles(&outward.matrix3) {
        let is_mirrored = outward.matrix3.determinant() < 0.0;
        return node.rotate(inward.matrix3 * axis, if is_mirrored { -angle } else { angle });
    }
    // Within an unevenly scaled parent the result is not a rotation, so only the whole map can be
    // kept.
    let Some(axis) = axis.try_normalize() else { return };
    let mut map = node.to_affine();
    let column = |vector: DVec3| inward.matrix3 * turned(outward.matrix3 * vector, axis, angle);
    let DMat3 { x_axis, y_axis, z_axis } = map.matrix3;
    map.matrix3 = DMat3::from_cols(column(x_axis), column(y_axis), column(z_axis));
    *node = NodeTransform::Affine(map);
}

/// Rotates a vector about an axis of unit length (Olinde Rodrigues, 1840).
fn turned(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sine, cosine) = elementary::sin_cos(angle);
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
}

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

/// A rotation as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "by", rename_all = "snake_case", deny_unknown_fields)]
#[schemars(extend("examples" = [
    Rotation::Euler { angles: [0.0; 3] },
    Rotation::Quaternion { xyzw: [0.0, 0.0, 0.0, 1.0] },
]))]
pub enum Rotation {
    /// Three rotations about the fixed axes of the space: first about x, then y, then z.
    Euler {
        /// About x, y and z, in degrees.
        angles: [f64; 3],
    },
    /// A quaternion; its length does not matter.
    Quaternion {
        /// The imaginary part, then the real part.
        xyzw: [f64; 4],
    },
}

impl Rotation {
    /// As a unit quaternion; no rotation if a quaternion has no direction.
    #[must_use]
    pub fn to_quaternion(self) -> DQuat {
        let quaternion = match self {
            Self::Euler { angles } => {
                let turn = |axis: DVec3, degrees: f64| {
                    let (sine, cosine) = elementary::sin_cos(degrees.to_radians() * 0.5);
                    DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine)
                };
                let [x, y, z] = angles;
                turn(DVec3::Z, z) * turn(DVec3::Y, y) * turn(DVec3::X, x)
            }
            Self::Quaternion { xyzw } => DQuat::from_array(xyzw),
        };
        let length = quaternion.length();
        if length.is_finite() && length > 0.0 { quaternion / length } else { DQuat::IDENTITY }
    }

    /// The angles of a unit quaternion: y from −90° to 90°, x and z from −180° to 180°. If y is
    /// ±90°, z is 0.
    #[must_use]
    pub fn euler(quaternion: DQuat) -> Self {
        let matrix = DMat3::from_quat(quaternion);
        let sine = -matrix.x_axis.z;
        // Closer to the pole than this, the other columns hold only rounding errors.
        const POLE: f64 = 1.0 - 1e-12;
        let radians = if sine.abs() < POLE {
            let x = elementary::atan2(matrix.y_axis.z, matrix.z_axis.z);
            [x, elementary::asin(sine), elementary::atan2(matrix.x_axis.y, matrix.x_axis.x)]
        } else {
            let x = elementary::atan2(-matrix.z_axis.y, matrix.y_axis.y);
            [x, elementary::asin(sine.clamp(-1.0, 1.0)), 0.0]
        };
        Self::Euler { angles: radians.map(f64::to_degrees) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_at_the_pole_turn_to_the_same_place() {
        for y in [90.0, -90.0] {
            let turned = Rotation::Euler { angles: [20.0, y, 50.0] }.to_quaternion();
            let again = Rotation::euler(turned).to_quaternion();
            // Near the pole the sine gives the angle with half of its digits.
            assert!(turned.dot(again).abs() > 1.0 - 1e-7, "{y}: {turned} and {again}");
        }
    }
}
