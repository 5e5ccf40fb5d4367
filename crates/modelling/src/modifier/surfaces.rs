//! Modifiers that give the same surface other faces: smoother, beveled, of triangles, or fewer.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_distance, check_range};
use crate::refusal::Refusal;

/// Shows the Catmull-Clark surface of a mesh. Edges with a crease stay sharp.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SubdivisionModifier {
    /// The number of subdivisions.
    #[schemars(range(min = 1, max = 5))]
    pub levels: u32,
}

impl SubdivisionModifier {
    /// The most levels: a quad becomes 1,024 faces.
    pub const MOST: u32 = 5;

    pub(super) fn check(&self) -> Result<(), Refusal> {
        let most = f64::from(Self::MOST);
        check_range("the number of levels", f64::from(self.levels), 1.0..=most, "1 to 5")
    }
}

impl Default for SubdivisionModifier {
    fn default() -> Self {
        Self { levels: 1 }
    }
}

/// Which edges a bevel replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BeveledEdges {
    /// Those between two faces whose directions differ by more than the angle, and those marked sharp.
    #[default]
    Angle,
    /// Those marked sharp.
    Sharp,
    /// Those with a crease.
    Creased,
    /// All.
    All,
}

/// Replaces edges with faces, as the command `bevel` does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BevelModifier {
    /// Which edges. Those that are not between two faces stay.
    pub edges: BeveledEdges,
    /// For edges by angle, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub angle: f64,
    /// The distance of the new edges from the old ones, in metres.
    #[schemars(range(min = 0.0))]
    pub width: f64,
    /// The number of faces side by side.
    #[schemars(range(min = 1, max = 100))]
    pub segments: u32,
    /// The shape of the cross-section: 0.5 is round.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub profile: f64,
    /// Whether the width is limited so that nothing overlaps.
    pub clamp_overlap: bool,
    /// Whether the old faces stay shaded as flat ones.
    pub harden_normals: bool,
    /// The vertex group that limits it; empty for none. Of the edges those remain whose two vertices have at least half a
    /// weight.
    pub group: String,
    /// Whether it acts where the group does not: with 1 minus the weight.
    pub invert_group: bool,
}

impl BevelModifier {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        check_range("the angle", self.angle, 0.0..=180.0, "0 to 180")?;
        check_distance("the width of a bevel", self.width)?;
        check_range("the number of segments", f64::from(self.segments), 1.0..=100.0, "1 to 100")?;
        check_range("the profile of a bevel", self.profile, 0.0..=1.0, "0 to 1")
    }
}

impl Default for BevelModifier {
    fn default() -> Self {
        Self {
            edges: BeveledEdges::default(),
            angle: 30.0,
            width: 0.1,
            segments: 1,
            profile: 0.5,
            clamp_overlap: true,
            harden_normals: false,
            group: String::new(),
            invert_group: false,
        }
    }
}

/// Cuts faces into triangles, as the command `triangulate` does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TriangulateModifier {
    /// Faces with fewer corners stay.
    #[schemars(range(min = 4))]
    pub least_corners: u32,
}

impl TriangulateModifier {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        check_range("the number of corners", f64::from(self.least_corners), 4.0..=f64::MAX, "at least 4")
    }
}

impl Default for TriangulateModifier {
    fn default() -> Self {
        Self { least_corners: 4 }
    }
}

/// When a reduction ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DecimateGoal {
    /// At a part of the triangles.
    #[default]
    Ratio,
    /// At a number of triangles.
    Faces,
    /// At an error.
    Error,
}

/// Cuts faces into triangles and reduces their number, with as little change of the surface as possible. Borders, seams,
/// sharp edges and the borders of materials hold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DecimateSettings {
    /// When to end; the other goals' values are not used.
    pub goal: DecimateGoal,
    /// How many triangles to leave, in parts of all.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ratio: f64,
    /// How many triangles to leave in each mesh.
    pub faces: u32,
    /// The largest error, in metres: the root of the mean squared distance of a new vertex from the planes of the triangles
    /// that it stands for.
    #[schemars(range(min = 0.0))]
    pub error: f64,
    /// Whether borders of texture coordinates and colours hold. Without it corners keep their values where their vertices
    /// move.
    pub hold_values: bool,
    /// The vertex group that limits it; empty for none. An error at an edge counts as divided by the least weight
    /// of its two vertices, so that edges with a small one go last; at weight 0 nothing goes.
    pub group: String,
    /// Whether it acts where the group does not: with 1 minus the weight.
    pub invert_group: bool,
}

impl DecimateSettings {
    pub(crate) fn check(&self) -> Result<(), Refusal> {
        check_range("the ratio of triangles", self.ratio, 0.0..=1.0, "0 to 1")?;
        check_distance("the error", self.error)
    }
}

impl Default for DecimateSettings {
    /// Half of the triangles.
    fn default() -> Self {
        Self {
            goal: DecimateGoal::default(),
            ratio: 0.5,
            faces: 1000,
            error: 0.001,
            hold_values: true,
            group: String::new(),
            invert_group: false,
        }
    }
}
