//! How volumes are combined, and what comes of it.

use trigon_math::DAffine3;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};

/// Its name in messages.
pub(super) const OPERATION: &str = "a boolean";

/// How volumes are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum BooleanOperation {
    /// What is in any of them.
    Union,
    /// What is in the first one and in no other.
    #[default]
    Difference,
    /// What is in all of them.
    Intersection,
}

/// A mesh that is combined with another one.
#[derive(Debug, Clone, Copy)]
pub struct BooleanTool<'m> {
    /// The mesh. It has to bound a volume: [`EditMesh::check_solid`].
    pub mesh: &'m EditMesh,
    /// From its space to that of the other mesh, in metres.
    pub transform: DAffine3,
}

/// What a boolean made.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Combined {
    /// The faces that are new, or come from tools.
    pub faces: Vec<FaceId>,
    /// The edges where faces of different operands meet.
    pub edges: Vec<EdgeId>,
}
