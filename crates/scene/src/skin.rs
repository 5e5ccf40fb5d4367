//! Skins: joints that meshes follow; `scene/skin_pose` puts them into a pose.

use trigon_math::glam::DAffine3;

use crate::arena::Id;
use crate::node::NodeId;

/// Names a skin.
pub type SkinId = Id<Skin>;

/// The joints of a skin, which the mesh's skin weights count.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// For people; need not be unique.
    pub name: String,
    /// A joint that was removed stays where the mesh is.
    pub joints: Vec<NodeId>,
    /// For each joint the map from the mesh into the joint's space in the pose
    /// in which the two were bound; identity where there is none.
    pub inverse_bind_matrices: Vec<DAffine3>,
}
