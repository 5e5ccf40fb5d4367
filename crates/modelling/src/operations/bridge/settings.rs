//! Parameters of bridges.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BRIDGING;
use crate::refusal::Refusal;

/// Joins two selected loops or chains of edges with a band of faces. Selected faces are removed and their
/// outlines joined, so two faces become a handle or a hole.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BridgeSettings {
    /// The number of rings of vertices between both ends.
    #[schemars(range(min = 0, max = 1000))]
    pub cuts: u32,
    /// How rings are placed.
    pub interpolation: BridgePath,
    /// For a path: how far it goes on straight at both ends. With 1, a bend is almost an arc of a circle.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub smoothness: f64,
    /// By how many vertices the second loop is turned from the best match, in either direction. Only for loops.
    pub twist: i32,
    /// How much larger the middle ring is than it would be, as a part of its size; negative makes it smaller.
    #[schemars(range(min = -100.0, max = 100.0))]
    pub profile_factor: f64,
    /// How the size changes along the bridge.
    pub profile_shape: BridgeProfile,
}

impl Default for BridgeSettings {
    /// Without rings between.
    fn default() -> Self {
        Self {
            cuts: 0,
            interpolation: BridgePath::Linear,
            smoothness: 1.0,
            twist: 0,
            profile_factor: 0.0,
            profile_shape: BridgeProfile::Smooth,
        }
    }
}

/// How the rings of a bridge are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BridgePath {
    /// On straight lines.
    #[default]
    Linear,
    /// Along a curve that leaves both loops at right angles and turns rings with it. Open chains are left in the
    /// direction of the faces beside them.
    Path,
}

/// How the size of rings changes from the ends of a bridge to its middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BridgeProfile {
    /// Slowly at the ends and in the middle.
    #[default]
    Smooth,
    /// As a circle.
    Sphere,
    /// Evenly.
    Linear,
}

/// More rings than that are a mistake.
const MOST_CUTS: u32 = 1000;
const LARGEST: f64 = 100.0;

impl BridgeSettings {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let refused = |parameter, value, range| Err(Refusal::OutOfRange { parameter, value, range });
        if self.cuts > MOST_CUTS {
            return refused("the number of cuts", f64::from(self.cuts), "at most 1000");
        }
        if !(0.0..=LARGEST).contains(&self.smoothness) {
            return refused("the smoothness", self.smoothness, "0 to 100");
        }
        if !(-LARGEST..=LARGEST).contains(&self.profile_factor) {
            return refused("the factor of the profile", self.profile_factor, "-100 to 100");
        }
        Ok(())
    }

    /// Turns a closed chain, which has vertices, by the twist.
    pub(super) fn twist<T>(&self, closed: &mut [T]) {
        closed.rotate_left(i64::from(self.twist).rem_euclid(closed.len() as i64) as usize);
    }

    pub(super) fn check_open(&self) -> Result<(), Refusal> {
        if self.twist == 0 {
            return Ok(());
        }
        let reason = "open chains cannot be twisted: use a twist of 0";
        Err(Refusal::NotPossible { operation: BRIDGING, reason })
    }

    /// The size of a ring after a part of the bridge, 0 to 1.
    pub(super) fn size(&self, part: f64) -> f64 {
        let inwards = 1.0 - (2.0 * part - 1.0).abs();
        let shape = match self.profile_shape {
            BridgeProfile::Smooth => inwards * inwards * (3.0 - 2.0 * inwards),
            BridgeProfile::Sphere => (inwards * (2.0 - inwards)).sqrt(),
            BridgeProfile::Linear => inwards,
        };
        1.0 + self.profile_factor * shape
    }
}
