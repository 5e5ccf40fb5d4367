//! The kinds of movements, and where each moves a point.

use trigon_math::{DAffine3, DMat3, DVec3, elementary, unit_or_zero};

use crate::refusal::Refusal;

/// How vertices move. Lengths are metres, angles radians, counter-clockwise seen from the tip
/// of the axis.
///
/// Where a vertex moves only partly (falloff, weight `w` of 0 to 1), the *amount* is scaled: `w`
/// times the offset, the angle, the distance, or the factor's difference from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Transform {
    /// By an offset.
    Translate {
        /// How far.
        offset: DVec3,
    },
    /// About an axis through a centre.
    Rotate {
        /// What stays.
        center: DVec3,
        /// In `orientation`; of any length but zero.
        axis: DVec3,
        /// Of the turn.
        angle: f64,
        /// The axes of the space in which the turn is one, in columns: the identity for that of the
        /// mesh. They have to be independent. In a mesh that is drawn unevenly scaled this makes
        /// turns that are turns as it is drawn.
        orientation: DMat3,
    },
    /// By a factor along each of three axes. A negative factor mirrors; faces are not turned
    /// over (see [`EditMesh::mirror`](crate::EditMesh::mirror)).
    Scale {
        /// What stays.
        center: DVec3,
        /// Along the columns of `orientation`.
        factors: DVec3,
        /// The axes, in columns: the identity for those of the mesh. They have to be independent.
        orientation: DMat3,
    },
    /// Along a direction, in proportion to the distance from a plane.
    Shear {
        /// On the plane, which stays.
        center: DVec3,
        /// Perpendicular to the plane; of any length but zero.
        normal: DVec3,
        /// Where to, for what is on the side of `normal`; of any length but zero.
        direction: DVec3,
        /// How far, per metre from the plane.
        factor: f64,
    },
    /// By any affine map.
    Affine {
        /// Of the mesh into itself.
        map: DAffine3,
    },
    /// Towards a sphere, whose radius is the mean distance of the vertices from its centre,
    /// weighted by falloff. A vertex at the centre stays.
    ToSphere {
        /// Of the sphere.
        center: DVec3,
        /// 0 (as it is) to 1 (on the sphere); any finite factor works.
        factor: f64,
    },
    /// Along the normal that each vertex had at the start: shrink and fatten. A vertex without
    /// one stays.
    AlongNormals {
        /// Outwards; negative inwards.
        distance: f64,
    },
    /// Straight away from a centre, all by the same distance. A vertex at the centre stays.
    PushPull {
        /// From where.
        center: DVec3,
        /// Outwards; negative inwards. (Blender has it the other way round.)
        distance: f64,
    },
}

/// A transform whose constants are computed.
pub(super) enum Prepared {
    /// Adds an offset and the change of the place relative to a centre.
    Linear {
        center: DVec3,
        change: DMat3,
        offset: DVec3,
    },
    Rotation {
        center: DVec3,
        axis: DVec3,
        angle: f64,
        change: DMat3,
        /// The orientation and its inverse, unless they are the identity.
        orientation: Option<[DMat3; 2]>,
    },
    ToSphere {
        center: DVec3,
        radius: f64,
        factor: f64,
    },
    AlongNormals {
        distance: f64,
    },
    PushPull {
        center: DVec3,
        distance: f64,
    },
}

impl Transform {
    /// Checks the parameters and computes what all points share. `mean_distance` tells the mean
    /// distance of the vertices from a point.
    pub(super) fn prepare(&self, mean_distance: impl FnOnce(DVec3) -> f64) -> Result<Prepared, Refusal> {
        self.check_finite()?;
        Ok(match *self {
            Self::Translate { offset } => {
                Prepared::Linear { center: DVec3::ZERO, change: DMat3::ZERO, offset }
            }
            Self::Rotate { center, axis, angle, orientation } => {
                let axis = direction_of(axis, "rotating", "the axis is zero or not finite")?;
                let orientation = match orientation == DMat3::IDENTITY {
                    true => None,
                    false => Some([orientation, inverse(orientation, "rotating")?]),
                };
                let change = turn_within(orientation.as_ref(), axis, angle);
                Prepared::Rotation { center, axis, angle, change, orientation }
            }
            Self::Scale { center, factors, orientation } => {
                let change = scaling(factors, orientation)?;
                Prepared::Linear { center, change, offset: DVec3::ZERO }
            }
            Self::Shear { center, normal, direction, factor } => {
                let normal = direction_of(normal, "shearing", "the plane's normal is zero or not finite")?;
                let direction =
                    direction_of(direction, "shearing", "the shear direction is zero or not finite")?;
                let along = direction * factor;
                let change = DMat3::from_cols(along * normal.x, along * normal.y, along * normal.z);
                Prepared::Linear { center, change, offset: DVec3::ZERO }
            }
            Self::Affine { map } => Prepared::Linear {
                center: DVec3::ZERO,
                change: map.matrix3 - DMat3::IDENTITY,
                offset: map.translation,
            },
            Self::ToSphere { center, factor } => {
                Prepared::ToSphere { center, radius: mean_distance(center), factor }
            }
            Self::AlongNormals { distance } => Prepared::AlongNormals { distance },
            Self::PushPull { center, distance } => Prepared::PushPull { center, distance },
        })
    }

    fn check_finite(&self) -> Result<(), Refusal> {
        let finite = |parameter, value: f64| {
            if value.is_finite() {
                return Ok(());
            }
            Err(Refusal::OutOfRange { parameter, value, range: "a finite number" })
        };
        let all = |parameter, values: DVec3| {
            values.to_array().into_iter().try_for_each(|value| finite(parameter, value))
        };
        let axes = |parameter, axes: DMat3| {
            [axes.x_axis, axes.y_axis, axes.z_axis].into_iter().try_for_each(|axis| all(parameter, axis))
        };
        match *self {
            Self::Translate { offset } => all("the offset", offset),
            Self::Rotate { center, axis, angle, orientation } => {
                all("the centre", center)?;
                all("the axis", axis)?;
                axes("the orientation", orientation)?;
                finite("the angle", angle)
            }
            Self::Scale { center, factors, orientation } => {
                all("the centre", center)?;
                all("the factor", factors)?;
                axes("the orientation", orientation)
            }
            Self::Shear { center, normal, direction, factor } => {
                all("the centre", center)?;
                all("the normal", normal)?;
                all("the direction", direction)?;
                finite("the factor", factor)
            }
            Self::Affine { map } => {
                all("the offset", map.translation)?;
                axes("the map", map.matrix3)
            }
            Self::ToSphere { center, factor } => {
                all("the centre", center)?;
                finite("the factor", factor)
            }
            Self::AlongNormals { distance } => finite("the distance", distance),
            Self::PushPull { center, distance } => {
                all("the centre", center)?;
                finite("the distance", distance)
            }
        }
    }
}

impl Prepared {
    /// Where a point goes.
    #[inline]
    pub(super) fn moved(&self, start: DVec3, weight: f64, normal: DVec3) -> DVec3 {
        // Each adds a change to the start, so that no change keeps every bit.
        match *self {
            Self::Linear { center, change, offset } => start + (offset + change * (start - center)) * weight,
            Self::Rotation { center, axis, angle, change, ref orientation } => {
                let part = || turn_within(orientation.as_ref(), axis, angle * weight);
                let change = if weight == 1.0 { change } else { part() };
                start + change * (start - center)
            }
            Self::ToSphere { center, radius, factor } => {
                let from_center = start - center;
                let on_sphere = unit_or_zero(from_center) * radius;
                let change = if on_sphere == DVec3::ZERO { DVec3::ZERO } else { on_sphere - from_center };
                start + change * (factor * weight)
            }
            Self::AlongNormals { distance } => start + normal * (distance * weight),
            Self::PushPull { center, distance } => start + unit_or_zero(start - center) * (distance * weight),
        }
    }

    /// The matrix by which directions turn where all of a face moves wholly; `None` where it
    /// bends.
    pub(super) fn linear(&self) -> Option<DMat3> {
        match *self {
            Self::Linear { change, .. } | Self::Rotation { change, .. } => Some(DMat3::IDENTITY + change),
            Self::ToSphere { .. } | Self::AlongNormals { .. } | Self::PushPull { .. } => None,
        }
    }
}

fn direction_of(vector: DVec3, operation: &'static str, reason: &'static str) -> Result<DVec3, Refusal> {
    let unit = unit_or_zero(vector);
    if unit == DVec3::ZERO { Err(Refusal::NotPossible { operation, reason }) } else { Ok(unit) }
}

/// What a turn about a unit axis adds to a vector: sin θ K + (1 − cos θ) K², where K is the cross
/// product with the axis (O. Rodrigues, 1840). 1 − cos θ is 2 sin² θ/2, which loses nothing at
/// small angles.
fn turn(axis: DVec3, angle: f64) -> DMat3 {
    let cross = DMat3::from_cols(axis.cross(DVec3::X), axis.cross(DVec3::Y), axis.cross(DVec3::Z));
    let half = elementary::sin(angle * 0.5);
    cross * elementary::sin(angle) + cross * cross * (2.0 * half * half)
}

/// The same in the space of an orientation, given with its inverse.
fn turn_within(orientation: Option<&[DMat3; 2]>, axis: DVec3, angle: f64) -> DMat3 {
    match orientation {
        None => turn(axis, angle),
        Some([axes, inverse]) => *axes * turn(axis, angle) * *inverse,
    }
}

/// What scaling along the axes of an orientation adds to a vector.
fn scaling(factors: DVec3, orientation: DMat3) -> Result<DMat3, Refusal> {
    let change = DMat3::from_diagonal(factors - DVec3::ONE);
    if orientation == DMat3::IDENTITY {
        return Ok(change);
    }
    Ok(orientation * change * inverse(orientation, "scaling")?)
}

fn inverse(orientation: DMat3, operation: &'static str) -> Result<DMat3, Refusal> {
    let reason = "the axes of the orientation are not linearly independent";
    orientation.try_inverse().ok_or(Refusal::NotPossible { operation, reason })
}
