//! Putting one scene into another: several files in one picture.

use super::{NodeId, Scene};
use crate::arena::{Arena, Id};
use crate::material::Material;
use crate::node::Node;

impl Scene {
    /// Adds everything that another scene holds, placed as it is there. Meshes
    /// and textures are shared between the two, not copied. Returns the ids of
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
        let meshes = NewIds::new(&other.meshes, |asset| self.meshes.insert(asset.clone()));
        let textures = NewIds::new(&other.textures, |asset| self.textures.insert(asset.clone()));
        let materials = NewIds::new(&other.materials, |material| {
            let mut material = material.clone();
            if let Some(binding) = &mut material.base_color_texture {
                match textures.get(binding.texture) {
                    Some(texture) => binding.texture = texture,
                    None => material.base_color_texture = None,
                }
            }
            self.materials.insert(material)
        });
        // A slot whose material was removed is drawn with the default one; its
        // old id must not find a stranger here.
        let mut default = None;
        let nodes = NewIds::new(&other.nodes, |node| {
            let mut node = Node { parent: None, children: Vec::new(), ..node.clone() };
            node.mesh = node.mesh.and_then(|mesh| meshes.get(mesh));
            for id in &mut node.materials {
                let missing = || *default.get_or_insert_with(|| self.materials.insert(Material::default()));
                *id = materials.get(*id).unwrap_or_else(missing);
            }
            self.nodes.insert(node)
        });
        for (id, node) in other.nodes.iter() {
            let Some(place) = nodes.get(id).and_then(|id| self.nodes.get_mut(id)) else { continue };
            place.parent = node.parent.and_then(|parent| nodes.get(parent));
            place.children = node.children.iter().filter_map(|&child| nodes.get(child)).collect();
        }
        nodes.0.into_iter().flatten().map(|(_, new)| new).collect()
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

#[cfg(test)]
mod tests {
    use trigon_math::{DVec3, Vec3};
    use trigon_mesh::primitives;

    use super::*;

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
}
