//! Scenes in other forms: appended to another scene, for several files in one image, or without the contents of meshes,
//! which is what an editor stores to undo a change of nodes or materials.

use super::{NodeId, Scene, TextureAsset};
use crate::animation::{Animation, Channel};
use crate::arena::{Arena, Id};
use crate::material::Material;
use crate::node::{Node, Skin};

impl Scene {
    /// Adds everything that another scene holds, placed as it is there, whichever axis is up there
    /// ([`Scene::turn_to`] turns it before). Meshes and textures are shared between the two, not copied. Returns the ids of
    /// the new nodes, in the order of the other scene's.
    ///
    /// ```
    /// use trigon_math::Vec3;
    /// use trigon_mesh::primitives;
    /// use trigon_scene::{Material, Scene};
    ///
    /// let (mut scene, mut other) = (Scene::new(), Scene::new());
    /// scene.add_object("red", primitives::cube(1.0), Material::from_color(Vec3::X));
    /// other.add_object("green", primitives::cube(1.0), Material::from_color(Vec3::Y));
    /// let added = scene.append(&other);
    /// assert_eq!(scene.nodes().len(), 2);
    /// assert_eq!(scene.node(added[0]).expect("just added").name, "green");
    /// ```
    pub fn append(&mut self, other: &Self) -> Vec<NodeId> {
        self.reading.forget();
        let meshes = NewIds::new(&other.meshes, |asset| self.meshes.insert(asset.clone()));
        let textures = NewIds::new(&other.textures, |asset| self.textures.insert(asset.clone()));
        let materials = NewIds::new(&other.materials, |material| {
            let mut material = material.clone();
            material.replace_textures(|texture| textures.get(texture));
            self.materials.insert(material)
        });
        let skins = NewIds::new(&other.skins, |skin| self.skins.insert(skin.clone()));
        // A slot whose material was removed is drawn with the default one; its
        // old id must not find a stranger here.
        let mut default = None;
        let nodes = NewIds::new(&other.nodes, |node| {
            let mut node = Node { parent: None, children: Vec::new(), ..node.clone() };
            node.mesh = node.mesh.and_then(|mesh| meshes.get(mesh));
            node.skin = node.skin.and_then(|skin| skins.get(skin));
            for id in &mut node.materials {
                let missing = || *default.get_or_insert_with(|| self.materials.insert(Material::default()));
                *id = materials.get(*id).unwrap_or_else(missing);
            }
            self.nodes.insert(node)
        });
        for (id, node) in other.nodes.iter() {
            let Some(copied) = nodes.get(id).and_then(|id| self.nodes.get_mut(id)) else { continue };
            copied.parent = node.parent.and_then(|parent| nodes.get(parent));
            copied.children = node.children.iter().filter_map(|&child| nodes.get(child)).collect();
        }
        self.append_movements(other, &nodes, &skins);
        nodes.0.into_iter().flatten().map(|(_, new)| new).collect()
    }
}

impl Scene {
    /// Skins and animations: what refers to nodes by their ids.
    fn append_movements(&mut self, other: &Self, nodes: &NewIds<Node>, skins: &NewIds<Skin>) {
        // A removed joint must find nothing here, and no stranger.
        let nobody = self.nodes.insert(Node::default());
        self.nodes.remove(nobody);
        for (id, skin) in other.skins.iter() {
            let Some(copy) = skins.get(id).and_then(|id| self.skins.get_mut(id)) else { continue };
            copy.joints = skin.joints.iter().map(|&joint| nodes.get(joint).unwrap_or(nobody)).collect();
        }
        for animation in &other.animations {
            let moved =
                |channel: &Channel| Some(Channel { node: nodes.get(channel.node)?, ..channel.clone() });
            let channels = animation.channels.iter().filter_map(moved).collect();
            self.animations.push(Animation { name: animation.name.clone(), channels });
        }
    }
}

/// The old and the new id of each item, by the index of the old one.
struct NewIds<T>(Vec<Option<(Id<T>, Id<T>)>>);

impl<T> NewIds<T> {
    fn new(items: &Arena<T>, mut insert: impl FnMut(&T) -> Id<T>) -> Self {
        let mut table = vec![None; items.index_bound()];
        for (old, item) in items.iter() {
            table[old.index()] = Some((old, insert(item)));
        }
        Self(table)
    }

    /// `None` when the old id's item was removed.
    fn get(&self, old: Id<T>) -> Option<Id<T>> {
        let &(known, new) = self.0.get(old.index())?.as_ref()?;
        (known == old).then_some(new)
    }
}

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

#[cfg(test)]
mod tests {
    use trigon_math::{DVec3, Vec3};
    use trigon_mesh::primitives;

    use super::*;
    use crate::animation::{Curve, Interpolation, Property};

    #[test]
    fn nodes_keep_their_parents_meshes_and_materials() {
        let mut other = Scene::new();
        let gone = other.add(Node::default());
        let parent = other.add(Node::default().at(DVec3::X));
        let mesh = other.add_mesh("cube", primitives::cube(1.0));
        let (red, dead) =
            (other.add_material(Material::from_color(Vec3::X)), other.add_material(Material::default()));
        let child = Node { materials: vec![red, dead], ..Node::from_mesh(mesh, red) };
        other.add_child(parent, child.at(DVec3::Y)).expect("the parent is there");
        other.remove(gone);
        other.materials.remove(dead);

        let mut scene = Scene::new();
        scene.add_object("before", primitives::cube(1.0), Material::from_color(Vec3::Y));
        let ids = scene.append(&other);
        let [parent, child] = ids[..] else { panic!("two nodes were alive, {} came", ids.len()) };
        assert_eq!(scene.node(parent).expect("added").children(), [child], "children");
        assert_eq!(scene.world_transform(child).translation, DVec3::new(1.0, 1.0, 0.0), "placement");
        let materials = &scene.node(child).expect("added").materials;
        let color =
            |slot: usize| scene.materials.get(materials[slot]).expect("every slot has one").base_color;
        assert_eq!(color(0).truncate(), Vec3::X, "its own material");
        assert_eq!(color(1), Material::default().base_color, "no stranger's");
        assert_eq!(scene.bounds().max, DVec3::new(1.5, 1.5, 0.5), "drawn where it was");
    }

    #[test]
    fn joints_and_channels_name_the_new_nodes() {
        let mut other = Scene::new();
        let (joint, gone) = (other.add(Node::default().at(DVec3::X)), other.add(Node::default()));
        let skin = other.skins.insert(Skin { joints: vec![gone, joint], ..Skin::default() });
        other.add(Node { skin: Some(skin), ..Node::default() });
        other.remove(gone);
        let curve = Curve::new(Interpolation::Step, 3, vec![0.0], vec![0.0, 5.0, 0.0]).expect("a curve");
        let channel = |node| Channel { node, property: Property::Translation, curve: curve.clone() };
        other.animations =
            vec![Animation { name: "up".to_owned(), channels: vec![channel(gone), channel(joint)] }];

        let mut scene = Scene::new();
        scene.add(Node::default().at(DVec3::splat(9.0)));
        let added = scene.append(&other);
        let pose = scene.skin_pose(added[1]).expect("the skin came along");
        assert_eq!(pose.palette[0].translation, Vec3::ZERO, "nobody's");
        assert_eq!(pose.palette[1].translation, Vec3::X, "the joint's");
        let pose = scene.pose(&scene.animations[0], 0.0);
        assert_eq!(pose.nodes.keys().collect::<Vec<_>>(), [&added[0]], "the one that is there");
    }
}
