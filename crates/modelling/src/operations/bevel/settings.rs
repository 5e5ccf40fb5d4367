//! The settings of a bevel.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::refusal::Refusal;

const MOST_SEGMENTS: usize = 100;

/// Settings of [`EditMesh::bevel_edges`](crate::EditMesh::bevel_edges) and
/// [`EditMesh::bevel_vertices`](crate::EditMesh::bevel_vertices).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BevelSettings {
    /// In metres, or percent of a length; at least 0.
    pub width: f64,
    /// What the width measures.
    pub width_type: BevelWidth,
    /// The number of faces across a bevel: 1 to 100.
    pub segments: usize,
    /// The cross-section, 0 to 1. With `r = -2 ln 2 / ln profile` it is the superellipse `x^r + y^r
    /// = 1` between the two rims at (1, 0) and (0, 1), whose tangents meet at the old edge at (1,
    /// 1); so its middle lies at `√profile`. 0.5 is round, 0.25 flat, less is concave, 1 keeps the
    /// edge. 0 counts as 0.000001. Points are evenly spaced along it.
    pub profile: f64,
    /// Whether the width is reduced where new vertices would pass each other along an edge.
    pub clamp_overlap: bool,
    /// What happens where two rims meet at a reflex angle of a face. For edges.
    pub outer_miter: OuterMiter,
    /// What happens where two rims meet at another angle of a face. For edges.
    pub inner_miter: InnerMiter,
    /// Whether the rims are marked sharp, so that shading stops there. For edges.
    pub mark_sharp: bool,
    /// Whether the rims are marked as seams, so that the bevel can be unwrapped alone. For edges.
    pub mark_seams: bool,
    /// Whether the old faces keep the shading that they would have if the old edges were sharp: new
    /// faces are shaded smooth, and the corners at the rims get the normals of the old faces. For edges.
    pub harden_normals: bool,
}

impl Default for BevelSettings {
    fn default() -> Self {
        Self {
            width: 0.1,
            width_type: BevelWidth::default(),
            segments: 1,
            profile: 0.5,
            clamp_overlap: true,
            outer_miter: OuterMiter::default(),
            inner_miter: InnerMiter::default(),
            mark_sharp: false,
            mark_seams: false,
            harden_normals: false,
        }
    }
}

/// What the width of a bevel measures. A rim is a new edge beside an old face. If a distance of rims or a height is
/// measured, no rim is farther from the old edge than 20 times the width, which almost flat and almost folded edges
/// would exceed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BevelWidth {
    /// For edges, the distance of each new rim from the old edge, in the face's plane; for vertices the
    /// distance of each new vertex from the old one, along its edge.
    #[default]
    Offset,
    /// For edges, the distance between the two rims; for vertices, twice the distance of a new vertex from
    /// the mean direction of the edges.
    Width,
    /// For edges, how far the old edge lies above the plane through both rims; for vertices, how far the old
    /// vertex lies above a new one, along the mean direction of the edges.
    Depth,
    /// How far new vertices move along the edges beside a bevel, in percent of the length of each.
    Percent,
    /// How far new vertices move along the edges beside a bevel, in metres.
    Absolute,
}

/// The shape of a rim at a reflex angle between two beveled edges of one face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OuterMiter {
    /// Both rims go on until they meet.
    #[default]
    Sharp,
    /// Like a sharp one, with two more vertices where the rims pass the old vertex.
    Patch,
    /// A curve around the old vertex, in the shape of the profile.
    Arc,
}

/// The shape of a rim at another angle between two beveled edges of one face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InnerMiter {
    /// Both rims go on until they meet.
    #[default]
    Sharp,
    /// A curve in the shape of the profile, which begins at the width from where they meet.
    Arc,
}

impl BevelSettings {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let refused = |parameter, value, range| Err(Refusal::OutOfRange { parameter, value, range });
        if !(self.width >= 0.0 && self.width.is_finite()) {
            return refused("the width of a bevel", self.width, "at least 0");
        }
        if !(1..=MOST_SEGMENTS).contains(&self.segments) {
            return refused("the number of segments", self.segments as f64, "1 to 100");
        }
        if !(0.0..=1.0).contains(&self.profile) {
            return refused("the profile of a bevel", self.profile, "0 to 1");
        }
        Ok(())
    }
}
