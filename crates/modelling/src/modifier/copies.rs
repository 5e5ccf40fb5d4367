//! Modifiers that copy a mesh, and the one that joins what then touches.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_distance, check_finite, check_range};
use crate::refusal::Refusal;

/// Adds a mirrored copy of all faces, and of edges without faces, for each axis one after the other. The planes go through the
/// origin of the mesh. Vertices without edges get no copy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MirrorModifier {
    /// Along x, y and z.
    pub axes: [bool; 3],
    /// Vertices at most this far from the plane, in metres, are moved onto it and shared by both halves. Null: none are.
    #[schemars(range(min = 0.0))]
    pub merge_distance: Option<f64>,
    /// Whether faces are cut at the plane, and what lies behind it is removed before. Edges without faces stay.
    pub bisect: bool,
    /// Whether the side of the negative axis is the one that stays. Matters with `bisect` alone.
    pub flip: bool,
    /// Whether vertices on a plane stay on it, and others stay on their side of it, while they are moved.
    pub clip: bool,
    /// Whether the texture coordinates of copies are mirrored: u becomes 1 − u.
    pub mirror_u: bool,
    /// The same for v.
    pub mirror_v: bool,
}

impl Default for MirrorModifier {
    fn default() -> Self {
        Self {
            axes: [true, false, false],
            merge_distance: Some(0.001),
            bisect: false,
            flip: false,
            clip: false,
            mirror_u: false,
            mirror_v: false,
        }
    }
}

impl MirrorModifier {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        self.merge_distance.map_or(Ok(()), |distance| check_distance("the distance for merging", distance))
    }
}

/// Adds copies in a row, each moved by the same offset from the one before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ArrayModifier {
    /// How many there are, with the mesh itself.
    #[schemars(range(min = 1, max = 1000))]
    pub count: u32,
    /// What is added to the offset, in metres along the axes of the mesh.
    pub offset: [f64; 3],
    /// The offset along each axis as a factor of the size of the mesh along it.
    pub relative_offset: [f64; 3],
    /// The name of another object: each copy also stands to the one before as that object to the mesh, turned and scaled like
    /// it. Empty: none.
    pub object: String,
    /// Vertices of all copies at most this far apart, in metres, become one. Null: none do.
    #[schemars(range(min = 0.0))]
    pub merge_distance: Option<f64>,
}

impl ArrayModifier {
    /// The most copies, with the mesh itself.
    pub const MOST: u32 = 1000;

    pub(super) fn check(&self) -> Result<(), Refusal> {
        let most = f64::from(Self::MOST);
        check_range("the number of copies", f64::from(self.count), 1.0..=most, "1 to 1000")?;
        check_finite("the offset", self.offset)?;
        check_finite("the relative offset", self.relative_offset)?;
        self.merge_distance.map_or(Ok(()), |distance| check_distance("the distance for merging", distance))
    }
}

impl Default for ArrayModifier {
    fn default() -> Self {
        Self {
            count: 2,
            offset: [0.0; 3],
            relative_offset: [1.0, 0.0, 0.0],
            object: String::new(),
            merge_distance: None,
        }
    }
}

/// Merges vertices that are close to one another, as the command `merge` does by distance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WeldModifier {
    /// The largest distance, in metres.
    #[schemars(range(min = 0.0))]
    pub distance: f64,
}

impl WeldModifier {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        check_distance("the distance", self.distance)
    }
}

impl Default for WeldModifier {
    fn default() -> Self {
        Self { distance: 0.001 }
    }
}
