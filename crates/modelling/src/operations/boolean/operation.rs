//! What is combined, and what comes of it. How is `modifier::BooleanOperation`.

use trigon_math::DAffine3;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};

/// Its name in messages.
pub(super) const OPERATION: &str = "a boolean";

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
