//! Skins: joints that meshes follow; `scene/skin_pose` computes their poses.

use trigon_math::glam::DAffine3;

use super::NodeId;
use crate::arena::Id;

/// Identifies a skin.
pub type SkinId = Id<Skin>;

/// The joints of a skin, which the mesh's skin weights refer to.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// A display name; need not be unique.
    pub name: String,
    /// A removed joint stays at the mesh's placement.
    pub joints: Vec<NodeId>,
    /// For each joint the inverse bind matrix: from the mesh into the joint's space in the bind
    /// pose; the identity if missing.
    pub inverse_bind_matrices: Vec<DAffine3>,
}
