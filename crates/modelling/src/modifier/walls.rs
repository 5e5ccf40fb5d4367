//! Modifiers that make walls of faces, and faces of outlines.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_distance, check_finite, check_range};
use crate::refusal::Refusal;

/// Gives faces a second layer behind them, joined along borders, so that a surface becomes a wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SolidifySettings {
    /// The distance between both layers, in metres.
    #[schemars(range(min = 0.0))]
    pub thickness: f64,
    /// Where the wall lies: −1 is behind the surface, 0 in its middle, 1 in front of it.
    #[schemars(range(min = -1.0, max = 1.0))]
    pub offset: f64,
    /// Whether the distance between the planes of both layers is the thickness, also at folds. Otherwise vertices move by
    /// the thickness, and walls that meet at an angle are thinner.
    pub even: bool,
    /// Whether the layers are joined along borders.
    pub rim: bool,
    /// The material slot of the rim. Default: those of the faces beside it.
    pub rim_material: Option<u32>,
    /// The material slot of the second layer. Default: those of the faces in front of it.
    pub inner_material: Option<u32>,
    /// The vertex group that limits it; empty for none. The thickness at a vertex is times its weight.
    pub group: String,
    /// Whether it acts where the group does not: with 1 minus the weight.
    pub invert_group: bool,
}

impl SolidifySettings {
    pub(crate) fn check(&self) -> Result<(), Refusal> {
        check_distance("the thickness of a wall", self.thickness)?;
        check_range("the offset of a wall", self.offset, -1.0..=1.0, "-1 to 1")
    }
}

impl Default for SolidifySettings {
    /// A centimetre behind the surface, even, with a rim.
    fn default() -> Self {
        Self {
            thickness: 0.01,
            offset: -1.0,
            even: true,
            rim: true,
            rim_material: None,
            inner_material: None,
            group: String::new(),
            invert_group: false,
        }
    }
}

/// Sweeps edges that are not between two faces, and vertices without edges, around an axis through the origin of the mesh. With
/// a height this is a screw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ScrewModifier {
    /// The direction of the axis; its length does not matter.
    pub axis: [f64; 3],
    /// The angle of a turn in degrees, counter-clockwise seen from the tip of the axis; not 0 without a height.
    pub angle: f64,
    /// The number of steps of a turn.
    #[schemars(range(min = 1, max = 10000))]
    pub steps: u32,
    /// How far each turn moves along the axis, in metres.
    pub height: f64,
    /// How many turns follow each other. Without a height, the sum of their angles is at most 360.
    #[schemars(range(min = 1, max = 10000))]
    pub turns: u32,
}

impl ScrewModifier {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        check_finite("the axis", self.axis)?;
        check_finite("the angle of a turn and the height", [self.angle, self.height, 0.0])?;
        check_range("the number of steps", f64::from(self.steps), 1.0..=1e4, "1 to 10000")?;
        check_range("the number of turns", f64::from(self.turns), 1.0..=1e4, "1 to 10000")
    }
}

impl Default for ScrewModifier {
    fn default() -> Self {
        Self { axis: [0.0, 1.0, 0.0], angle: 360.0, steps: 16, height: 0.0, turns: 1 }
    }
}
