//! Nodes: placements in the scene that hold content, or group other nodes. The joints of skins are nodes; `scene/pose`
//! computes the poses of skins.

use trigon_camera::Projection;
use trigon_math::DVec3;
use trigon_math::glam::DAffine3;

use crate::arena::Id;
use crate::light::Light;
use crate::material::MaterialId;
use crate::mesh_asset::MeshId;
use crate::transform::Transform;

/// Identifies a node.
pub type NodeId = Id<Node>;

/// A placement in the scene. Its content moves, rotates and scales with it, and so do its children.
///
/// A scene may have millions: what few nodes have is in a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// A display name; need not be unique.
    pub name: String,
    /// The placement in the parent's space, or in the world for a root.
    pub transform: Transform,
    /// The mesh drawn here.
    pub mesh: Option<MeshId>,
    /// The materials of the mesh's slots. A slot beyond the list, or with a removed material, uses
    /// the default material.
    pub materials: Vec<MaterialId>,
    /// The joints that the mesh follows, if it has skin weights; it is then drawn where they place
    /// it, see `Scene::skin_pose`.
    pub skin: Option<SkinId>,
    /// The weight of each morph target: usually 0 to 1, but any value adds that multiple of the
    /// difference. Targets beyond the list have weight 0.
    pub morph_weights: Vec<f32>,
    /// The light at this node, shining along −Z if it has a direction.
    pub light: Option<Box<Light>>,
    /// The camera at this node, looking along −Z with +Y up.
    pub camera: Option<Box<Projection>>,
    /// Whether the node is drawn; a hidden node also hides its children and turns off its light.
    pub visible: bool,
    pub(crate) parent: Option<NodeId>,
    pub(crate) children: Vec<NodeId>,
}

impl Default for Node {
    fn default() -> Self {
        Self {
            name: String::new(),
            transform: Transform::IDENTITY,
            mesh: None,
            materials: Vec::new(),
            skin: None,
            morph_weights: Vec::new(),
            light: None,
            camera: None,
            visible: true,
            parent: None,
            children: Vec::new(),
        }
    }
}

impl Node {
    /// A node that draws a mesh with one material.
    #[must_use]
    pub fn from_mesh(mesh: MeshId, material: MaterialId) -> Self {
        Self { mesh: Some(mesh), materials: vec![material], ..Self::default() }
    }

    /// A node that holds a light at the origin; place it with [`Node::at`].
    #[must_use]
    pub fn from_light(light: Light) -> Self {
        Self { light: Some(Box::new(light)), ..Self::default() }
    }

    /// The same node under another name.
    #[must_use]
    pub fn with_name(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same node with another placement.
    #[must_use]
    pub fn with_transform(self, transform: Transform) -> Self {
        Self { transform, ..self }
    }

    /// The same node with its origin at a point in its parent's space.
    #[must_use]
    pub fn at(mut self, translation: DVec3) -> Self {
        self.transform.set_translation(translation);
        self
    }

    /// The parent of this node; change it with `Scene::set_parent`.
    #[must_use]
    pub fn parent(&self) -> Option<NodeId> {
        self.parent
    }

    /// The children of this node.
    #[must_use]
    pub fn children(&self) -> &[NodeId] {
        &self.children
    }
}

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
