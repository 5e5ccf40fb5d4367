//! The order in which nodes are listed, as in an outliner. Images do not depend on it.

use fixedbitset::FixedBitSet;

use super::{NodeId, Scene, SceneError};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::Node;

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
}
