//! Nodes: places in the scene that hold something, or hold other nodes together.

use trigon_camera::Projection;
use trigon_math::DVec3;

use crate::arena::Id;
use crate::light::Light;
use crate::material::MaterialId;
use crate::scene::MeshId;
use crate::skin::SkinId;
use crate::transform::Transform;

/// Names a node.
pub type NodeId = Id<Node>;

/// A place in the scene. What it holds moves, turns and scales with it, and so
/// do its children.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// For people; need not be unique.
    pub name: String,
    /// The placement in the parent's space, or in the world for a root.
    pub transform: Transform,
    /// The mesh that is drawn here.
    pub mesh: Option<MeshId>,
    /// The materials of the mesh's slots. A slot beyond the list, or with a
    /// removed material, is drawn with the default material.
    pub materials: Vec<MaterialId>,
    /// The joints that the mesh follows, if it has skin weights; it is then
    /// drawn where they put it, see `Scene::skin_pose`.
    pub skin: Option<SkinId>,
    /// How far the mesh is moved towards each of its morph targets: usually 0
    /// to 1, but any value adds that many times the difference. Targets
    /// beyond the list are at 0.
    pub morph_weights: Vec<f32>,
    /// The light that stands here, shining along −Z where it has a direction.
    pub light: Option<Light>,
    /// The camera that stands here, looking along −Z with +Y up.
    pub camera: Option<Projection>,
    /// Whether the node is drawn; a hidden node hides its children too, and
    /// its light is out.
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
    /// A node that draws a mesh in one material.
    pub fn from_mesh(mesh: MeshId, material: MaterialId) -> Self {
        Self { mesh: Some(mesh), materials: vec![material], ..Self::default() }
    }

    /// A node that holds a light at the origin; place it with [`Node::at`].
    pub fn from_light(light: Light) -> Self {
        Self { light: Some(light), ..Self::default() }
    }

    /// The same node under another name.
    pub fn with_name(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same node with another placement.
    pub fn with_transform(self, transform: Transform) -> Self {
        Self { transform, ..self }
    }

    /// The same node with its origin at a point of its parent.
    pub fn at(mut self, translation: DVec3) -> Self {
        self.transform.set_translation(translation);
        self
    }

    /// The node that this one hangs on; change it with `Scene::set_parent`.
    pub fn parent(&self) -> Option<NodeId> {
        self.parent
    }

    /// The nodes that hang on this one.
    pub fn children(&self) -> &[NodeId] {
        &self.children
    }
}
