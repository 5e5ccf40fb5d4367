//! The order in which nodes are listed, as in an outliner, which images do not depend on; and turning a scene to another
//! up axis.

use fixedbitset::FixedBitSet;
use trigon_camera::UpAxis;
use trigon_math::DAffine3;

use super::{NodeId, Scene, SceneError};
use crate::node::Node;
use crate::transform::Transform;

impl Scene {
    /// The nodes that hang on no other: first those of [`Self::order_roots`], then the others in the
    /// order of their indices.
    pub fn roots(&self) -> impl Iterator<Item = NodeId> {
        let is_root = |id: NodeId| self.nodes.get(id).is_some_and(|node| node.parent.is_none());
        let listed = self.root_order.iter().copied().filter(move |&id| is_root(id));
        let mut is_listed = FixedBitSet::with_capacity(self.nodes.index_bound());
        listed.clone().for_each(|id| is_listed.insert(id.index()));
        let all = self.nodes.iter().map(|(id, _)| id);
        listed.chain(all.filter(move |&id| is_root(id) && !is_listed.contains(id.index())))
    }

    /// All nodes with the number of nodes that each hangs on, directly and indirectly: each one before its
    /// children, siblings in their order.
    #[must_use]
    pub fn tree(&self) -> Vec<(NodeId, usize)> {
        let mut waiting: Vec<(NodeId, usize)> = self.roots().map(|id| (id, 0)).collect();
        waiting.reverse();
        let mut tree = Vec::with_capacity(self.nodes.len());
        while let Some((id, depth)) = waiting.pop() {
            tree.push((id, depth));
            let children = self.nodes.get(id).map_or(&[][..], |node| node.children());
            waiting.extend(children.iter().rev().map(|&child| (child, depth + 1)));
        }
        tree
    }

    /// Lists these before all other roots, in this order. Nodes that are no roots now are listed at their
    /// places once they are.
    pub fn order_roots(&mut self, mut roots: Vec<NodeId>) {
        let mut is_known = FixedBitSet::with_capacity(self.nodes.index_bound());
        roots.retain(|id| self.nodes.get(*id).is_some() && !is_known.put(id.index()));
        self.root_order = roots;
    }

    /// Lists a node at another place among the children of its parent, or among the roots: the `to`-th
    /// from 0, or the last.
    ///
    /// # Errors
    /// When it is gone.
    pub fn reorder(&mut self, id: NodeId, to: usize) -> Result<(), SceneError> {
        let parent = self.nodes.get(id).ok_or(SceneError::NoSuchNode(id))?.parent;
        let moved = |siblings: &mut Vec<NodeId>| {
            siblings.retain(|&sibling| sibling != id);
            siblings.insert(to.min(siblings.len()), id);
        };
        match parent.and_then(|parent| self.nodes.get_mut(parent)) {
            Some(parent) => moved(&mut parent.children),
            None => {
                let mut roots: Vec<NodeId> = self.roots().collect();
                moved(&mut roots);
                self.root_order = roots;
            }
        }
        Ok(())
    }
}

impl Scene {
    /// Turns everything so that another axis points up; what is on the right and in front stays there. All roots
    /// get a new node as their parent, which holds the rotation and is named after the old axis; nothing else
    /// changes. Between the six axes of the world the rotation is exact: coordinates are exchanged and negated.
    ///
    /// Returns the new node, or `None` if the axis is up already or there are no nodes.
    ///
    /// ```
    /// use trigon_scene::camera::UpAxis;
    /// use trigon_scene::math::DVec3;
    /// use trigon_scene::{Node, Scene};
    ///
    /// let mut scene = Scene::new();
    /// scene.up = UpAxis::Z;
    /// let top = scene.add(Node::default().at(DVec3::new(1.0, 2.0, 3.0)));
    /// let turned = scene.turn_to(UpAxis::Y).expect("it was turned");
    /// assert_eq!(scene.node(turned).map(|node| node.name.as_str()), Some("+Z up"));
    /// assert_eq!(scene.world_transform(top).translation, DVec3::new(1.0, 3.0, -2.0));
    /// ```
    pub fn turn_to(&mut self, up: UpAxis) -> Option<NodeId> {
        let before = std::mem::replace(&mut self.up, up);
        let roots: Vec<NodeId> = self.roots().collect();
        if before == up || roots.is_empty() {
            return None;
        }
        let turn = Transform::Affine(DAffine3::from_mat3(before.turn_to(up)));
        let id = self.add(Node::default().with_name(format!("{before} up")).with_transform(turn));
        for &root in &roots {
            self.nodes.get_mut(root)?.parent = Some(id);
        }
        self.nodes.get_mut(id)?.children = roots;
        Some(id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::Node;
    use trigon_math::DVec3;

    #[test]
    fn roots_are_listed_as_ordered_and_new_ones_last() {
        let mut scene = Scene::new();
        let [a, b, c] = [(); 3].map(|()| scene.add(Node::default()));
        let roots = |scene: &Scene| scene.roots().collect::<Vec<_>>();
        scene.reorder(c, 0).expect("it is there");
        assert_eq!(roots(&scene), [c, a, b], "moved to the front");
        scene.set_parent(a, Some(b)).expect("no loop");
        let d = scene.add(Node::default());
        assert_eq!(roots(&scene), [c, b, d], "what hangs on another is no root");
        scene.reorder(c, 99).expect("it is there");
        assert_eq!(roots(&scene), [b, d, c], "beyond the last is the last");
        scene.remove(d);
        scene.set_parent(a, None).expect("it is there");
        let e = scene.add(Node::default());
        assert_eq!(
            (e.index(), roots(&scene)),
            (d.index(), vec![b, c, a, e]),
            "no stranger in the place of one that is gone"
        );
        assert_eq!(scene.reorder(d, 0), Err(SceneError::NoSuchNode(d)), "it is gone");
        scene.order_roots(vec![e, d, e, a]);
        assert_eq!(roots(&scene), [e, a, b, c], "each once");
    }

    #[test]
    fn children_are_reordered_below_their_parent() {
        let mut scene = Scene::new();
        let parent = scene.add(Node::default());
        let [a, b, c] = [(); 3].map(|()| scene.add_child(parent, Node::default()).expect("it is there"));
        scene.reorder(a, 1).expect("it is there");
        assert_eq!(scene.node(parent).expect("there").children(), [b, a, c], "one down");
        scene.set_parent(c, Some(b)).expect("no loop");
        assert_eq!(scene.tree(), [(parent, 0), (b, 1), (c, 2), (a, 1)], "each before its children");
    }

    #[test]
    fn a_scene_is_turned_with_all_that_hangs_on_its_roots() {
        let mut scene = Scene { up: UpAxis::new(DVec3::NEG_X), ..Scene::new() };
        let first = scene.add(Node::default().at(DVec3::new(1.0, 2.0, 3.0)));
        let child = scene.add_child(first, Node::default().at(DVec3::X)).expect("its parent is there");
        let second = scene.add(Node::default());
        scene.order_roots(vec![second]);
        let turned = scene.turn_to(UpAxis::Z).expect("another axis");
        // -X becomes Z, +Y (right) becomes X, and +Z (front) becomes -Y.
        assert_eq!(scene.world_transform(first).translation, DVec3::new(2.0, -3.0, -1.0));
        assert_eq!(scene.world_transform(child).translation, DVec3::new(2.0, -3.0, -2.0));
        assert_eq!(scene.roots().collect::<Vec<_>>(), [turned]);
        assert_eq!(scene.node(turned).map(Node::children), Some(&[second, first][..]), "in their order");
        assert_eq!(scene.up, UpAxis::Z);
        assert_eq!(scene.turn_to(UpAxis::Z), None, "nothing is left to do");
    }

    #[test]
    fn an_empty_scene_gets_no_node() {
        let mut scene = Scene { up: UpAxis::Z, ..Scene::new() };
        assert_eq!((scene.turn_to(UpAxis::Y), scene.up), (None, UpAxis::Y));
        assert!(scene.nodes().is_empty(), "still empty");
    }
}
