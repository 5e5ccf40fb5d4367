//! Everything in a scene except the contents of its meshes: what an editor stores to undo a change of nodes
//! or materials.

use crate::animation::Animation;
use crate::arena::Arena;
use crate::material::Material;
use crate::node::{Node, Skin};

use super::{NodeId, Scene, TextureAsset};

/// The nodes, materials, textures, skins and animations of a scene, with their ids.
///
/// ```
/// use trigon_scene::{Node, Scene};
///
/// let mut scene = Scene::new();
/// let node = scene.add(Node::default());
/// let mut before = scene.parts();
/// scene.remove(node);
/// scene.swap_parts(&mut before);
/// assert!(scene.node(node).is_some(), "it is there again, under the same id");
/// ```
#[derive(Clone, Debug)]
pub struct SceneParts {
    nodes: Arena<Node>,
    root_order: Vec<NodeId>,
    materials: Arena<Material>,
    textures: Arena<TextureAsset>,
    skins: Arena<Skin>,
    animations: Vec<Animation>,
}

impl SceneParts {
    /// A node as it was.
    #[must_use]
    pub fn node(&self, id: NodeId) -> Option<&Node> {
        self.nodes.get(id)
    }

    /// Roughly the memory that they take, in bytes; images and curves, which scenes share or
    /// seldom have, do not count.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let names = self.nodes.iter().map(|(_, node)| node.name.len()).sum::<usize>();
        self.nodes.index_bound() * size_of::<Node>()
            + self.materials.index_bound() * size_of::<Material>()
            + names
    }
}

impl Scene {
    /// A copy of all but the meshes.
    #[must_use]
    pub fn parts(&self) -> SceneParts {
        SceneParts {
            nodes: self.nodes.clone(),
            root_order: self.root_order.clone(),
            materials: self.materials.clone(),
            textures: self.textures.clone(),
            skins: self.skins.clone(),
            animations: self.animations.clone(),
        }
    }

    /// Exchanges all but the meshes. Nodes of other parts may name meshes that are gone: these are not
    /// drawn.
    pub fn swap_parts(&mut self, parts: &mut SceneParts) {
        self.reading.forget();
        std::mem::swap(&mut self.nodes, &mut parts.nodes);
        std::mem::swap(&mut self.root_order, &mut parts.root_order);
        std::mem::swap(&mut self.materials, &mut parts.materials);
        std::mem::swap(&mut self.textures, &mut parts.textures);
        std::mem::swap(&mut self.skins, &mut parts.skins);
        std::mem::swap(&mut self.animations, &mut parts.animations);
    }
}
