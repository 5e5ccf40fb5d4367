//! Spinning: edges and vertices are swept around an axis, in steps.

mod faces;
mod sweep;
#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_math::{DMat3, DVec3, elementary};

use self::faces::SweptFaces;
use self::sweep::Sweep;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

/// Parameters of [`EditMesh::spin`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SpinSettings {
    /// A point on the axis, in metres.
    pub center: [f64; 3],
    /// The direction of the axis; its length does not matter.
    pub axis: [f64; 3],
    /// The angle of a turn in radians, counter-clockwise seen from the tip of the axis; not 0 without a height. A whole
    /// turn without a height joins its ends.
    pub angle: f64,
    /// How many steps a turn has; at least 1.
    pub steps: u32,
    /// How far each turn moves along the axis, in metres.
    pub height: f64,
    /// How many turns follow each other; at least 1. Without a height, the sum of their angles is at most a whole turn.
    pub turns: u32,
}

impl Default for SpinSettings {
    /// Around +Y, a whole turn in 16 steps.
    fn default() -> Self {
        Self { center: [0.0; 3], axis: [0.0, 1.0, 0.0], angle: TAU, steps: 16, height: 0.0, turns: 1 }
    }
}

/// The new elements.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Spun {
    /// The faces: for each step one for each edge that is not on the axis.
    pub faces: Vec<FaceId>,
    /// The edges at the end of the last step; those given, if the ends are joined.
    pub edges: Vec<EdgeId>,
    /// The vertices there.
    pub vertices: Vec<VertexId>,
    /// The faces there, if faces were swept and the ends are not joined.
    pub ends: Vec<FaceId>,
}

/// Settings that have been checked.
struct Turns {
    center: DVec3,
    axis: DVec3,
    steps: u32,
    angle: f64,
    height: f64,
    /// Whether the last step leads back to the first position.
    is_joined: bool,
}

/// A whole turn may be off by this much, as degrees that were turned to radians are.
const SAME_ANGLE: f64 = 1e-9;

impl SpinSettings {
    fn check(&self) -> Result<Turns, Refusal> {
        let refused = |parameter, value, range| Err(Refusal::OutOfRange { parameter, value, range });
        let not_possible = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        for (parameter, value) in [("the angle of a turn", self.angle), ("the height of a turn", self.height)]
        {
            if !value.is_finite() {
                return refused(parameter, value, "finite");
            }
        }
        if self.steps == 0 {
            return refused("the number of steps", 0.0, "at least 1");
        }
        if self.turns == 0 {
            return refused("the number of turns", 0.0, "at least 1");
        }
        let Some(steps) = self.steps.checked_mul(self.turns) else { return Err(Refusal::TooMany) };
        let (center, axis) = (DVec3::from(self.center), DVec3::from(self.axis).try_normalize());
        let Some(axis) = axis.filter(|_| center.is_finite()) else {
            return not_possible("the axis has no direction, or its centre is not finite");
        };
        let turns = f64::from(self.turns);
        let (angle, height) = (self.angle * turns, self.height * turns);
        let is_joined = height == 0.0 && (angle.abs() - TAU).abs() <= SAME_ANGLE;
        if height == 0.0 && angle == 0.0 {
            return not_possible("nothing moves: give an angle or a height");
        }
        if height == 0.0 && angle.abs() > TAU + SAME_ANGLE {
            return not_possible("more than a whole turn lies on itself: give a height");
        }
        if is_joined && steps < 3 {
            return not_possible("a whole turn has at least three steps");
        }
        Ok(Turns { center, axis, steps, angle, height, is_joined })
    }
}

impl Turns {
    /// The rotation after some steps, and the way along the axis.
    fn after(&self, step: u32) -> (DMat3, DVec3) {
        let part = f64::from(step) / f64::from(self.steps);
        let (sin, cos) = elementary::sin_cos(self.angle * part);
        let DVec3 { x, y, z } = self.axis;
        // O. Rodrigues' formula.
        let across = DMat3::from_cols(DVec3::new(0.0, z, -y), DVec3::new(-z, 0.0, x), DVec3::new(y, -x, 0.0));
        let rotation = DMat3::IDENTITY + across * sin + across * across * (1.0 - cos);
        (rotation, self.axis * (self.height * part))
    }

    /// The part of a position's distance from the centre that is across the axis.
    fn arm(&self, point: DVec3) -> DVec3 {
        let arm = point - self.center;
        arm - self.axis * arm.dot(self.axis)
    }
}

const OPERATION: &str = "spinning";

impl EditMesh {
    /// Sweeps edges and vertices around an axis: each edge makes a quad in each step, each other vertex an edge. With a
    /// height this is a screw.
    ///
    /// Faces all of whose edges are given are swept as a whole: only their outline makes faces, and they close both ends. Those
    /// that are a part of a larger surface leave it, so that it goes on along the sweep; others stay as the beginning, and all
    /// faces then look outwards. If the ends are joined, they are removed. Faces of closed surfaces have no outline: each of their
    /// edges is swept.
    ///
    /// Other given elements stay where they are and are the beginning. Without a height, vertices on the axis stay single, so
    /// that edges there make triangles; a vertex is on the axis if it is nearer than a millionth of the farthest one. New
    /// faces at an open border continue its face and have its values; others are wound like each other, so that they look
    /// away from the axis on the whole. New vertices have the values of the given ones, and new edges their marks.
    ///
    /// # Errors
    /// No element is given, or one does not exist; all are on the axis; a parameter is out of range; there would be too many
    /// elements.
    ///
    /// ```
    /// use trigon_mesh::math::Vec3;
    /// use trigon_modelling::{EditMesh, SpinSettings};
    ///
    /// // A cone: its slope and its base, which both begin on the axis.
    /// let mut mesh = EditMesh::new();
    /// let [top, rim, middle] = [Vec3::Y, Vec3::X, Vec3::ZERO].map(|at| mesh.add_vertex(at));
    /// let edges = [mesh.add_edge(top.clone()?, rim.clone()?)?, mesh.add_edge(rim?, middle?)?];
    /// let made = mesh.spin(&edges, &[], &SpinSettings { steps: 8, ..SpinSettings::default() })?;
    /// assert_eq!((made.faces.len(), mesh.vertex_count()), (16, 10));
    /// assert!(mesh.is_watertight() && mesh.volume() > 0.0);
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn spin(
        &mut self,
        edges: &[EdgeId],
        vertices: &[VertexId],
        settings: &SpinSettings,
    ) -> Result<Spun, Refusal> {
        if edges.is_empty() && vertices.is_empty() {
            let needed = "at least one edge or vertex";
            return Err(Refusal::NothingGiven { operation: OPERATION, needed });
        }
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let turns = settings.check()?;
        let swept = SweptFaces::of(self, edges);
        let (edges, vertices) = swept.outlines(edges, vertices);
        let sweep = Sweep::of(self, &edges, &vertices, &turns)?;
        self.check_capacity_for(sweep.new_elements(&turns).and(swept.new_elements(self)))?;
        if swept.is_empty() {
            return Ok(sweep.run(self, &turns));
        }
        let copy = swept.open(self, &turns);
        // Where faces went, the new ones continue others.
        let sweep = Sweep::of(self, &edges, &vertices, &turns)?;
        let mut spun = sweep.run(self, &turns);
        if !turns.is_joined {
            swept.close(self, &copy, &turns, &sweep, &mut spun);
        }
        Ok(spun)
    }
}
